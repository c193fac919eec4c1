// Bins both sides and joins them.
#include "im/matching/batch_matcher.h"

#include <cassert>

#include "im/matching/region_history.h"

namespace rink::im {
namespace {

struct ExactRegions {
  std::span<const Region> updates, subscriptions;
};

Verdict judge(const void* context, std::uint32_t subscription, std::uint32_t update) {
  const auto& exact = *static_cast<const ExactRegions*>(context);
  assert(update < exact.updates.size() && subscription < exact.subscriptions.size());
  return overlap(exact.updates[update], exact.subscriptions[subscription]) ? Verdict::match
                                                                           : Verdict::no;
}

}  // namespace

std::optional<Rejection> BatchMatcher::set_world(const Region& world) {
  auto rejection = check_world(world);
  if (!rejection) world_ = world;
  return rejection;
}

void BatchMatcher::stage(std::span<const Region> regions, Subject subject, BoxIndex& index,
                         std::vector<Rejection>& rejections) const {
  index.begin(world_, regions.size(), Boxes::resting);
  for (std::uint32_t id = 0; id < regions.size(); ++id) {
    if (is_valid(regions[id])) index.stage(id, regions[id]);
    else rejections.push_back({*fault_of(regions[id]), subject, id});
  }
  index.build();
}

void BatchMatcher::match(std::span<const Region> updates, std::span<const Region> subscriptions) {
  // Places are ids, whose top bit is taken.
  assert(updates.size() <= RegionHistory::id_max && subscriptions.size() <= RegionHistory::id_max);
  rejections_.clear(), other_rejections_.clear();
  join_.clear();
  Worker* const worker = for_regions(worker_, updates.size() + subscriptions.size());
  join_.share_with(worker);
  run_both(
      worker, [&] { stage(updates, Subject::update_region, updates_, rejections_); },
      [&] {
        stage(subscriptions, Subject::subscription_region, subscriptions_, other_rejections_);
      });
  rejections_.insert(rejections_.end(), other_rejections_.begin(), other_rejections_.end());
  const ExactRegions exact{updates, subscriptions};
  join_.add_overlaps(updates_, subscriptions_,
                     {!(updates_.is_exact() && subscriptions_.is_exact()), judge, &exact});
  assert(join_.asker_count() == subscriptions_.size());
  assert(updates_.size() + subscriptions_.size() + rejections_.size() ==
         updates.size() + subscriptions.size());
}

}  // namespace rink::im
