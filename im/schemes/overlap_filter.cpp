// Keeps the old and present places of regions, and finds changes by the matching engine.
#include "im/schemes/overlap_filter.h"

#include <cassert>

namespace rink::im {

void OverlapFilter::set_update_region(Entity entity, const Region& region) {
  if (entities_.set(entity, region)) ++counters_.regions_moved;
}

void OverlapFilter::remove_entity(Entity entity) {
  if (!entities_.contains(entity)) return;
  join_.forget_entity(entity, entities_.last_place(entity));
  entities_.remove(entity);
}

void OverlapFilter::set_subscription_region(Subscriber subscriber, const Region& region) {
  if (subscribers_.set(subscriber, region)) ++counters_.regions_moved;
}

void OverlapFilter::remove_subscriber(Subscriber subscriber) {
  if (!subscribers_.contains(subscriber)) return;
  join_.forget_subscriber(subscriber, subscribers_.last_place(subscriber));
  subscribers_.remove(subscriber);
}

std::span<const Change> OverlapFilter::find() {
  const auto moved_entities = entities_.take_moved(), moved_subscribers = subscribers_.take_moved();
  const std::uint64_t tested_before = join_.pairs_tested();
  const std::span<const Change> changes =
      join_.find(entities_, moved_entities, subscribers_, moved_subscribers);
  assert(join_.pairs_tested() >= tested_before);
  counters_.pairs_tested += join_.pairs_tested() - tested_before;
  return changes;
}

void OverlapFilter::settle(std::span<const Change> changes) {
  entities_.settle();
  subscribers_.settle();
  counters_.changes += changes.size();
  for (const Change& change : changes)
    counters_.entries += change.transition == Transition::entered ? 1u : 0u;
  assert(counters_.entries <= counters_.changes);
}

std::span<const Change> OverlapFilter::match() {
  const std::span<const Change> changes = find();
  settle(changes);
  return changes;
}

std::size_t OverlapFilter::bytes() const {
  return entities_.bytes() + subscribers_.bytes() + join_.bytes();
}

}  // namespace rink::im
