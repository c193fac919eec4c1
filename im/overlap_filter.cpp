// Joins subscriptions with entities where either moved and reports the pairs whose overlap changed.
#include "im/overlap_filter.h"

#include <algorithm>

namespace rink::im {

void OverlapFilter::set_update_region(Entity entity, const Region& region) {
  if (!entities_.set(entity, region)) return;
  ++counters_.regions_moved;
  everyone_is_current_ = false;
}

void OverlapFilter::remove_entity(Entity entity) {
  if (entities_.remove(entity)) everyone_is_current_ = false;
}

void OverlapFilter::set_subscription_region(Subscriber subscriber, const Region& region) {
  if (subscribers_.set(subscriber, region)) ++counters_.regions_moved;
}

void OverlapFilter::remove_subscriber(Subscriber subscriber) { subscribers_.remove(subscriber); }

void OverlapFilter::index_everyone() {
  if (everyone_is_current_) return;
  present_.clear();
  for (std::uint32_t entity = 0; entity < entities_.size(); ++entity)
    if (!is_nowhere(entities_[entity].now)) present_.push_back(entity);
  everyone_.build(present_, entities_);
  everyone_is_current_ = true;
}

void OverlapFilter::match_subscriber(Subscriber subscriber, CellIndex& index) {
  changed_.clear();
  const Motion& subscription = subscribers_[subscriber];
  counters_.pairs_tested += index.find_changes(subscription, changed_);
  std::sort(changed_.begin(), changed_.end());
  for (const Entity entity : changed_) {
    const bool is_in = overlap(entities_[entity].now, subscription.now);
    changes_.push_back({subscriber, entity, is_in ? Transition::entered : Transition::left});
  }
}

void OverlapFilter::match_moved_subscribers(std::span<const std::uint32_t> subscribers) {
  index_everyone();
  for (const Subscriber subscriber : subscribers) match_subscriber(subscriber, everyone_);
}

void OverlapFilter::match_every_subscriber(std::span<const std::uint32_t> moved_entities, bool some_subscribers_moved) {
  if (some_subscribers_moved) index_everyone();
  const bool all_moved = some_subscribers_moved && moved_entities.size() == present_.size();
  CellIndex& for_the_still = all_moved ? everyone_ : movers_;
  if (!all_moved) movers_.build(moved_entities, entities_);
  for (Subscriber subscriber = 0; subscriber < subscribers_.size(); ++subscriber) {
    if (is_nowhere(subscribers_[subscriber].now)) continue;
    match_subscriber(subscriber, subscribers_.has_moved(subscriber) ? everyone_ : for_the_still);
  }
}

std::span<const Change> OverlapFilter::match() {
  changes_.clear();
  const auto moved_entities = entities_.take_moved(), moved_subscribers = subscribers_.take_moved();
  if (!moved_entities.empty())
    match_every_subscriber(moved_entities, !moved_subscribers.empty());
  else if (!moved_subscribers.empty())
    match_moved_subscribers(moved_subscribers);
  if (!moved_entities.empty()) everyone_is_current_ = false;  // its copies of `before` end here
  entities_.settle();
  subscribers_.settle();
  counters_.changes += changes_.size();
  return changes_;
}

}  // namespace rink::im
