// Roles, headings and flights: what the filter knows of objects and federates beside regions, and
// what a federate owns.
#include "rti/distribution/interest.h"

namespace rink::rti {

void Interest::set_role(ObjectSlot slot, const im::Role& role) {
  if (slot >= roles_.size()) roles_.resize(slot + std::size_t{1});
  if (roles_[slot] == role) return;
  if (roles_[slot].owner != role.owner) changed_objects_.push_back(slot);
  roles_[slot] = role;
  if (!traits_.uses_roles) return;
  for (const Association& each : associations_of(slot)) tell_role(each.region);
}

void Interest::set_federate_role(std::uint32_t federate, const im::Role& role) {
  DeclaredInterest& interest = *federates_[federate];
  if (interest.role == role) return;
  interest.is_changed |= interest.role.owner != role.owner && !interest.regionals.empty();
  interest.role = role;
  for (const Regional& each : interest.regionals)
    if (each.is_placed) tell_subscriber(interest, each.subscriber);
}

/// Objects that share a region differ to the filter in nothing, so they have in common what they
/// agree in; one of them that is always relevant takes the others along.
void Interest::tell_role(RegionSlot slot) {
  const DistributedRegion& region = regions_[slot];
  if (!traits_.uses_roles || !region.is_placed || !region.is_committed || region.objects.empty())
    return;
  const auto role_of = [this](ObjectSlot object) {
    return object < roles_.size() ? roles_[object] : im::Role{};
  };
  im::Role common = role_of(region.objects.front());
  for (const ObjectSlot object : region.objects) {
    const im::Role role = role_of(object);
    if (role.team != common.team) common.team = im::Role::none;
    if (role.owner != common.owner) common.owner = im::Role::none;
    common.is_always_relevant |= role.is_always_relevant;
  }
  filter_->set_entity_role(region.entity, common);
}

void Interest::tell_subscriber(const DeclaredInterest& interest, im::Subscriber subscriber) {
  if (traits_.uses_roles) filter_->set_subscriber_role(subscriber, interest.role);
  if (traits_.uses_headings) filter_->set_heading(subscriber, interest.heading);
}

void Interest::set_federate_heading(std::uint32_t federate, const im::Heading& heading) {
  DeclaredInterest& interest = *federates_[federate];
  if (interest.heading == heading) return;
  interest.heading = heading;
  if (!traits_.uses_headings) return;
  for (const Regional& each : interest.regionals)
    if (each.is_placed) filter_->set_heading(each.subscriber, heading);
}

void Interest::set_flight(ObjectSlot slot, const im::Flight& flight) {
  if (!traits_.uses_flights) return;
  for (const Association& each : associations_of(slot))
    if (const DistributedRegion& region = regions_[each.region];
        region.is_placed && region.is_committed)
      filter_->set_flight(region.entity, flight);
}

void Interest::set_time(double now) {
  if (traits_.uses_flights) filter_->set_time(now);
}

bool Interest::is_own(const DeclaredInterest& interest, ObjectSlot slot) const {
  return interest.role.owner != im::Role::none && slot < roles_.size() &&
         roles_[slot].owner == interest.role.owner;
}

}  // namespace rink::rti
