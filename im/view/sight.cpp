// The scheme `sight`: an entity matters to a subscriber while their closed rectangles overlap and no post hides all of it from the middle of the subscription.
#include <algorithm>
#include <utility>
#include <vector>

#include "im/predicate_filter.h"
#include "im/view/shadow.h"

namespace rink::im {
namespace {

struct InSight {
  std::vector<Disc> posts;

  explicit InSight(std::vector<Disc> all) : posts(std::move(all)) {
    for (Disc& post : posts) post = {plain(post.x), plain(post.y), plain(post.radius)};
  }
  bool operator()(const Party& subscriber, const Party& entity) const {
    const Eye eye(plain(subscriber.region));
    const Region box = plain(entity.region);
    return std::none_of(posts.begin(), posts.end(), [&](const Disc& post) { return hides(post, eye, box); });
  }
};

}  // namespace

std::unique_ptr<Filter> make_sight_filter(const FilterSettings& settings);

std::unique_ptr<Filter> make_sight_filter(const FilterSettings& settings) { return make_predicate_filter(settings, InSight(settings.posts)); }

}  // namespace rink::im
