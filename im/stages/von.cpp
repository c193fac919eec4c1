// The stage `von`: of the relevant entities those within the area of interest, and those whose
// Voronoi regions enclose the subscriber's (Hu, Chen & Chen 2006).
#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "im/basics/exact.h"
#include "im/stages/chooser.h"
#include "im/stages/stages.h"

namespace rink::im {
namespace {

/// An entity's middle seen from the subscriber's, in doubles that four factors of keep exact.
struct Site {
  double x, y;
  std::size_t place;  ///< in the list
};

bool is_here(const Site& site) { return site.x == 0.0 && site.y == 0.0; }

/// Above 0 if `b` lies to the left of the way from the subscriber to `a`.
int side_of(const Site& a, const Site& b) {
  return sign_of(std::array{a.x, a.y, b.x, b.y},
                 [](const auto& at) { return at[0] * at[3] - at[1] * at[2]; });
}
int dot_sign(const Site& a, const Site& b) {
  return sign_of(std::array{a.x, a.y, b.x, b.y},
                 [](const auto& at) { return at[0] * at[2] + at[1] * at[3]; });
}
/// Below 0 if `a` is nearer than `b`.
int compare_distance(const Site& a, const Site& b) {
  return sign_of(std::array{a.x, a.y, b.x, b.y}, [](const auto& at) {
    return at[0] * at[0] + at[1] * at[1] - (at[2] * at[2] + at[3] * at[3]);
  });
}
/// Above 0 if `s` lies inside of the circle through the subscriber, `a` and `b`, which follow each
/// other counter-clockwise; 0 if on it.
int in_circle(const Site& a, const Site& b, const Site& s) {
  return sign_of(std::array{a.x, a.y, b.x, b.y, s.x, s.y}, [](const auto& at) {
    const auto square = [&](std::size_t i) { return at[i] * at[i] + at[i + 1] * at[i + 1]; };
    const auto cross = [&](std::size_t i, std::size_t k) {
      return at[i] * at[k + 1] - at[i + 1] * at[k];
    };
    return square(2) * cross(0, 4) - square(0) * cross(2, 4) - square(4) * cross(0, 2);
  });
}

/// Finds those whose regions touch the subscriber's, in a point too, by walking around that region:
/// from each neighbour on to the next one counter-clockwise.
class RegionWalk {
 public:
  /// Sites at the subscriber's own place are left out.
  void add(const Site& site) { sites_.push_back(site); }
  void clear() { sites_.clear(); }

  /// Calls `mark(place)` for each, some twice.
  template <class Mark>
  void run(const Mark& mark) {
    if (sites_.empty()) return;
    const std::size_t start = nearest();
    for (const Site& site : sites_)
      if (is_same(site, sites_[start])) mark(site.place);
    if (comes_round(start, mark)) return;
    // The region has no end on that side, so the other is still to be walked: in a mirror.
    for (Site& site : sites_) site.y = -site.y;
    comes_round(start, mark);
  }

 private:
  static bool is_same(const Site& a, const Site& b) { return a.x == b.x && a.y == b.y; }

  /// The circle between the subscriber and the nearest has nobody inside, nor others on it, so
  /// their regions share more than a point.
  std::size_t nearest() const {
    std::size_t best = 0;
    for (std::size_t i = 1; i < sites_.size(); ++i)
      if (compare_distance(sites_[i], sites_[best]) < 0) best = i;
    return best;
  }

  template <class Mark>
  bool comes_round(std::size_t start, const Mark& mark) {
    std::size_t at = start;
    for ([[maybe_unused]] std::size_t steps = 0;; ++steps) {
      assert(steps <= sites_.size());
      if (!find_left(at) && !find_opposite(at)) return false;
      bool is_round = false;
      for (const std::size_t i : tied_) mark(sites_[i].place), is_round |= i == start;
      if (is_round) return true;
      at = tied_.front();
    }
  }

  /// Sets `tied_` to those on the left whose circle through `at` has nobody inside; first the one
  /// farthest round.
  bool find_left(std::size_t at) {
    tied_.clear();
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      if (side_of(sites_[at], sites_[i]) <= 0) continue;
      const int inside =
          tied_.empty() ? 1 : in_circle(sites_[at], sites_[tied_.front()], sites_[i]);
      if (inside > 0) tied_.clear();
      if (inside < 0) continue;
      tied_.push_back(i);
      if (side_of(sites_[tied_.front()], sites_[i]) > 0) std::swap(tied_.front(), tied_.back());
    }
    return !tied_.empty();
  }
  /// With nobody on the left, the nearest right behind the subscriber: their edges are parallel.
  bool find_opposite(std::size_t at) {
    tied_.clear();
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      if (side_of(sites_[at], sites_[i]) != 0 || dot_sign(sites_[at], sites_[i]) >= 0) continue;
      const int order = tied_.empty() ? -1 : compare_distance(sites_[i], sites_[tied_.front()]);
      if (order < 0) tied_.clear();
      if (order <= 0) tied_.push_back(i);
    }
    return !tied_.empty();
  }

  std::vector<Site> sites_;
  std::vector<std::size_t> tied_;
};

class Von final : public Chooser {
 public:
  Von(std::unique_ptr<Filter> inner, double area)
      : Chooser(std::move(inner), {.roles = true}), area_(area) {
    assert(area_ >= 0.0 && area_ <= 1.0);
  }
  void list_counts(std::vector<StageCount>& counts) const override {
    Parts::list_counts(counts);
    counts.push_back({"von", "enclosing neighbours beyond the area of interest", enclosing_});
    counts.push_back({"von", "entities left out", left_out_});
  }

 private:
  void choose(Subscriber subscriber, const CandidatePairs::List& list) override {
    const rink_party& me = subscribers_.data()[subscriber];
    const double range = area_ * (0.5 * std::min(me.high_x - me.low_x, me.high_y - me.low_y));
    walk_.clear();
    for (std::size_t i = 0; i < list.size(); ++i) {
      const rink_party& its = entities_.data()[list.entity(i)];
      const double x = its.x - me.x, y = its.y - me.y;
      const Site site{plain(x), plain(y), i};
      const bool is_own = me.owner != RINK_NONE && its.owner == me.owner;
      is_chosen_[i] = is_own || is_here(site) || x * x + y * y <= range * range;
      if (!is_own && !is_here(site)) walk_.add(site);
    }
    walk_.run([this](std::size_t place) {
      enclosing_ += is_chosen_[place] ? 0u : 1u;
      is_chosen_[place] = true;
    });
    pairs_tested_ += list.size();
  }

  double area_;
  RegionWalk walk_;
  std::uint64_t enclosing_ = 0;
};

}  // namespace

std::unique_ptr<Filter> make_von(std::unique_ptr<Filter> inner, double area) {
  return std::make_unique<Von>(std::move(inner), area);
}

}  // namespace rink::im
