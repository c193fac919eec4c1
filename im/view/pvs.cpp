// The scheme `pvs`: an entity matters to a subscriber while their rectangles overlap and its cell
// is in the potentially visible set of the subscriber's: no post hides all of the one from all of
// the other (Airey et al. 1990; Teller & Sequin 1991; RING, Funkhouser 1995).
#include <algorithm>
#include <vector>

#include "im/view/cell_filter.h"
#include "im/view/middle_cell.h"
#include "im/view/shadow.h"

namespace rink::im {
namespace {

class PotentiallyVisible {
 public:
  explicit PotentiallyVisible(const FilterSettings& settings) : cells_(settings) {
    for (const Disc& post : settings.posts)
      posts_.push_back({plain(post.x), plain(post.y), plain(post.radius)});
  }
  /// Sets are not kept: of a post that hides no cell the first way mostly shows that.
  Judgement operator()(const Party& subscriber, const Party& entity) const {
    const MiddleCell mine = cells_.around(subscriber.region), its = cells_.around(entity.region);
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

  MiddleCells cells_;
  std::vector<Disc> posts_;
};

}  // namespace

std::unique_ptr<Filter> make_pvs_filter(const FilterSettings& settings);

std::unique_ptr<Filter> make_pvs_filter(const FilterSettings& settings) {
  return std::make_unique<CellFilter<PotentiallyVisible>>(settings);
}

}  // namespace rink::im
