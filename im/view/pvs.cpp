// The scheme `pvs`: an entity matters to a subscriber while their rectangles overlap and its cell
// is in the potentially visible set of the subscriber's: no post hides all of the one from all of
// the other (Airey et al. 1990; Teller & Sequin 1991; RING, Funkhouser 1995).
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "im/schemes/cells.h"
#include "im/schemes/predicate_filter.h"
#include "im/view/shadow.h"

namespace rink::im {
namespace {

/// A middle's cell, and how far the middle is from its edges [m].
struct Cell {
  Region box;
  double slack;
};

class PotentiallyVisible {
 public:
  explicit PotentiallyVisible(const FilterSettings& settings)
      : size_(cell_size_of(settings)), low_x_(settings.world.low_x), low_y_(settings.world.low_y) {
    for (const Disc& post : settings.posts)
      posts_.push_back({plain(post.x), plain(post.y), plain(post.radius)});
  }
  /// Sets are not kept: of a post that hides no cell the first way mostly shows that.
  Judgement operator()(const Party& subscriber, const Party& entity) const {
    const Cell mine = cell_around(subscriber.region), its = cell_around(entity.region);
    const double rest = std::min(mine.slack, its.slack);
    const bool is_hidden = std::any_of(posts_.begin(), posts_.end(), [&](const Disc& post) {
      return hides_cell(post, mine.box, its.box);
    });
    return {!is_hidden, rest};
  }

 private:
  /// What hides a whole cell from a place hides it from all places between such: both the places in
  /// shadow of a point and those that see it only through the post are convex. So corners decide.
  static bool hides_cell(const Disc& post, const Region& from, const Region& cell) {
    return hides(post, Eye({from.low_x, from.low_y, from.low_x, from.low_y}), cell) &&
           hides(post, Eye({from.low_x, from.high_y, from.low_x, from.high_y}), cell) &&
           hides(post, Eye({from.high_x, from.low_y, from.high_x, from.low_y}), cell) &&
           hides(post, Eye({from.high_x, from.high_y, from.high_x, from.high_y}), cell);
  }
  Cell cell_around(const Region& region) const {
    const Region middle = centre_of(region);
    const auto [low_x, high_x] = edges(middle.low_x, low_x_);
    const auto [low_y, high_y] = edges(middle.low_y, low_y_);
    const double slack = std::min({middle.low_x - low_x, high_x - middle.low_x,
                                   middle.low_y - low_y, high_y - middle.low_y}),
                 rounding = 1e-12 * (std::abs(low_x_) + std::abs(low_y_) + size_);
    return {plain(Region{low_x, low_y, high_x, high_y}), std::max(slack - rounding, 0.0)};
  }
  std::array<double, 2> edges(double coordinate, double origin) const {
    const double number = cell_of(coordinate, origin, size_);
    return {origin + number * size_, origin + (number + 1.0) * size_};
  }

  double size_, low_x_, low_y_;
  std::vector<Disc> posts_;
};

class PvsFilter final : public PredicateFilter<PotentiallyVisible> {
 public:
  explicit PvsFilter(const FilterSettings& settings)
      : PredicateFilter(settings.world, PotentiallyVisible(settings)),
        cell_size_(cell_size_of(settings)) {}
  double cell_size() const override { return cell_size_; }

 private:
  double cell_size_;
};

}  // namespace

std::unique_ptr<Filter> make_pvs_filter(const FilterSettings& settings);

std::unique_ptr<Filter> make_pvs_filter(const FilterSettings& settings) {
  return std::make_unique<PvsFilter>(settings);
}

}  // namespace rink::im
