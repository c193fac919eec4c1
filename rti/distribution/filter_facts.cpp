// Passes facts about objects and federates to the filter, but none that it ignores.
#include "rti/distribution/filter_facts.h"

#include <cstddef>

namespace rink::rti {

void FilterFacts::add_federate(std::uint32_t federate) {
  if (federate >= federates_.size()) federates_.resize(federate + std::size_t{1});
  federates_[federate] = {};
}

bool FilterFacts::set_heading(std::uint32_t federate, const im::Heading& heading) {
  if (federates_[federate].heading == heading) return false;
  federates_[federate].heading = heading;
  return true;
}

bool FilterFacts::set_federate_facts(std::uint32_t federate, const im::Facts& facts) {
  if (!traits_.uses_facts || federates_[federate].facts == facts) return false;
  federates_[federate].facts = facts;
  return true;
}

void FilterFacts::inform_facts(std::uint32_t federate, im::Subscriber subscriber) const {
  if (traits_.uses_facts) filter_.set_subscriber_facts(subscriber, federates_[federate].facts);
}

void FilterFacts::inform_subscriber(std::uint32_t federate, im::Subscriber subscriber) const {
  if (traits_.uses_roles) filter_.set_subscriber_role(subscriber, federates_[federate].role);
  inform_heading(federate, subscriber);
  inform_facts(federate, subscriber);
}

void FilterFacts::inform_heading(std::uint32_t federate, im::Subscriber subscriber) const {
  if (traits_.uses_headings) filter_.set_heading(subscriber, federates_[federate].heading);
}

void FilterFacts::set_object_role(ObjectSlot object, const im::Role& role) {
  if (object >= objects_.size()) objects_.resize(object + std::size_t{1});
  objects_[object] = role;
}

/// Objects that share a region are one entity to the filter, so its role is what they agree in; if
/// one of them is always relevant, all are.
void FilterFacts::inform_entity(const DistributedRegion& region) const {
  if (!traits_.uses_roles || !region.is_placed || !region.is_committed || region.objects.empty())
    return;
  im::Role common = object_role(region.objects.front());
  for (const ObjectSlot object : region.objects) {
    const im::Role role = object_role(object);
    if (role.team != common.team) common.team = im::Role::none;
    if (role.owner != common.owner) common.owner = im::Role::none;
    common.is_always_relevant |= role.is_always_relevant;
  }
  filter_.set_entity_role(region.entity, common);
}

void FilterFacts::set_flight(const DistributedRegion& region, const im::Flight& flight) const {
  if (traits_.uses_flights && region.is_placed && region.is_committed)
    filter_.set_flight(region.entity, flight);
}

void FilterFacts::set_facts(const DistributedRegion& region, const im::Facts& facts) const {
  if (traits_.uses_facts && region.is_placed && region.is_committed)
    filter_.set_entity_facts(region.entity, facts);
}

}  // namespace rink::rti
