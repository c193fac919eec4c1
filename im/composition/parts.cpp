// Forwards calls to the parts, and adds up their counters.
#include "im/composition/parts.h"

#include <algorithm>
#include <cassert>

#include "im/basics/checked.h"

namespace rink::im {
namespace {

/// True if pairs ascend, each there once.
[[maybe_unused]] bool are_ordered(std::span<const Change> changes) {
  const auto is_out_of_order = [](const Change& a, const Change& b) {
    return a.subscriber != b.subscriber ? a.subscriber > b.subscriber : a.entity >= b.entity;
  };
  return std::adjacent_find(changes.begin(), changes.end(), is_out_of_order) == changes.end();
}

}  // namespace

Parts::Parts(std::vector<std::unique_ptr<Filter>> parts) : parts_(std::move(parts)) {
  assert(!parts_.empty());
  assert(std::find(parts_.begin(), parts_.end(), nullptr) == parts_.end());
}

Parts::Parts(std::unique_ptr<Filter> only) {
  assert(only != nullptr);
  parts_.push_back(std::move(only));
}

void Parts::set_update_region(Entity entity, const Region& region) {
  for (const auto& part : parts_) part->set_update_region(entity, region);
}
void Parts::remove_entity(Entity entity) {
  for (const auto& part : parts_) part->remove_entity(entity);
}
void Parts::set_subscription_region(Subscriber subscriber, const Region& region) {
  for (const auto& part : parts_) part->set_subscription_region(subscriber, region);
}
void Parts::remove_subscriber(Subscriber subscriber) {
  for (const auto& part : parts_) part->remove_subscriber(subscriber);
}
void Parts::set_swept_update_region(Entity entity, const Region& from, const Region& to) {
  for (const auto& part : parts_) part->set_swept_update_region(entity, from, to);
}
void Parts::set_swept_subscription_region(Subscriber subscriber, const Region& from,
                                          const Region& to) {
  for (const auto& part : parts_) part->set_swept_subscription_region(subscriber, from, to);
}
void Parts::set_heading(Subscriber subscriber, const Heading& heading) {
  for (const auto& part : parts_) part->set_heading(subscriber, heading);
}
void Parts::set_entity_role(Entity entity, const Role& role) {
  for (const auto& part : parts_) part->set_entity_role(entity, role);
}
void Parts::set_subscriber_role(Subscriber subscriber, const Role& role) {
  for (const auto& part : parts_) part->set_subscriber_role(subscriber, role);
}
void Parts::set_flight(Entity entity, const Flight& flight) {
  for (const auto& part : parts_) part->set_flight(entity, flight);
}
void Parts::set_subscriber_flight(Subscriber subscriber, const Flight& flight) {
  for (const auto& part : parts_) part->set_subscriber_flight(subscriber, flight);
}
void Parts::set_time(double now) {
  for (const auto& part : parts_) part->set_time(now);
}
void Parts::set_entity_facts(Entity entity, const Facts& facts) {
  for (const auto& part : parts_) part->set_entity_facts(entity, facts);
}
void Parts::set_subscriber_facts(Subscriber subscriber, const Facts& facts) {
  for (const auto& part : parts_) part->set_subscriber_facts(subscriber, facts);
}
void Parts::note_update(Entity entity) {
  for (const auto& part : parts_) part->note_update(entity);
}
void Parts::share_with(Worker* worker) {
  for (const auto& part : parts_) part->share_with(worker);
}

Traits Parts::traits() const {
  Traits all;
  for (const auto& part : parts_) {
    const Traits own = part->traits();
    all.uses_roles |= own.uses_roles, all.uses_headings |= own.uses_headings,
        all.uses_flights |= own.uses_flights, all.decides_tiers |= own.decides_tiers,
        all.uses_facts |= own.uses_facts, all.uses_time |= own.uses_time,
        all.holds_updates |= own.holds_updates, all.depends_on_crowd |= own.depends_on_crowd;
  }
  return all;
}

double Parts::cell_size() const {
  double smallest = 0.0;
  for (const auto& part : parts_) {
    const double size = part->cell_size();
    if (size > 0.0 && (smallest == 0.0 || size < smallest)) smallest = size;
  }
  return smallest;
}

void Parts::list_counts(std::vector<StageCount>& counts) const {
  for (const auto& part : parts_) part->list_counts(counts);
}

std::span<const Change> Parts::reported(std::span<const Change> changes) {
  assert(!checks_whole_structures || are_ordered(changes));
  counters_.regions_moved = 0;
  counters_.pairs_tested = pairs_tested_;
  for (const auto& part : parts_) {
    counters_.regions_moved += part->counters().regions_moved;
    counters_.pairs_tested += part->counters().pairs_tested;
  }
  counters_.changes += changes.size();
  for (const Change& change : changes)
    counters_.entries += change.transition == Transition::entered ? 1u : 0u;
  return changes;
}

}  // namespace rink::im
