// The scheme `sight`: an entity matters to a subscriber while their closed rectangles overlap and
// no post hides all of it from the middle of the subscription.
#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "im/schemes/predicate_filter.h"
#include "im/view/shadow.h"

namespace rink::im {
namespace {

struct InSight {
  std::vector<Disc> posts;

  explicit InSight(std::vector<Disc> all) : posts(std::move(all)) {
    for (Disc& post : posts) post = {plain(post.x), plain(post.y), plain(post.radius)};
  }
  /// A change of all coordinates of a region by 1 moves its corners and its middle by sqrt 2.
  Judgement operator()(const Party& subscriber, const Party& entity) const {
    const Eye eye(plain(subscriber.region));
    const Region box = plain(entity.region);
    double free = std::numeric_limits<double>::infinity();
    for (const Disc& post : posts) {
      const double clearance = shadow_clearance(post, eye, box);
      if (clearance > 0.0) return {false, 0.7 * clearance};
      if (clearance == 0.0 && hides(post, eye, box)) return {false, 0.0};
      free = std::min(free, -clearance);
    }
    return {true, 0.7 * free};
  }
};

}  // namespace

std::unique_ptr<Filter> make_sight_filter(const FilterSettings& settings);

std::unique_ptr<Filter> make_sight_filter(const FilterSettings& settings) {
  return make_predicate_filter(settings, InSight(settings.posts));
}

}  // namespace rink::im
