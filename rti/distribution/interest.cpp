// Forwards each change to its part; where it concerns two, the second may rely on what the first
// has done.
#include "rti/distribution/interest.h"

#include <algorithm>
#include <utility>

namespace rink::rti {

Interest::Interest(const Fom& fom, const ObjectTable& objects, const Ownership& ownership,
                   std::unique_ptr<im::Filter> filter, std::size_t newcomer_pairs_max)
    : DataDistribution(scopes_),
      class_count_(fom.object_classes().size()),
      filter_(std::move(filter)),
      facts_(*filter_),
      regions_(fom, objects, *filter_, facts_, counters_),
      subscriptions_(fom, regions_, *filter_, facts_, newcomer_pairs_max),
      planner_(*filter_, objects, regions_, subscriptions_, facts_),
      matcher_({.objects = objects,
                .ownership = ownership,
                .regions = regions_,
                .subscriptions = subscriptions_,
                .facts = facts_,
                .turns = planner_,
                .scopes = scopes_,
                .counters = counters_}) {}

void Interest::add_federate(std::uint32_t federate) {
  facts_.add_federate(federate);
  regions_.add_federate(federate);
  subscriptions_.add_federate(federate);
  FederateInterest& interest = scopes_.add(federate);
  if (planner_.is_needed()) interest.turns = std::make_unique<Turns>();
  interest.by_class.resize(class_count_);
}

void Interest::remove_federate(std::uint32_t federate) {
  for (std::uint32_t region = 0; region < regions_.handle_count(federate); ++region)
    if (regions_.has(federate, {region})) delete_region(federate, {region});
  subscriptions_.remove_federate(federate);
  scopes_.remove(federate);
}

bool Interest::subscribe(std::uint32_t federate, std::uint16_t object_class,
                         const Subscription& attributes, RegionHandle region) {
  if (region && !regions_.has(federate, region)) return false;
  subscriptions_.subscribe(federate, object_class, attributes,
                           region ? regions_.slot_of(federate, region) : no_region);
  return true;
}

Subscription Interest::subscribed(std::uint32_t federate, std::uint16_t object_class,
                                  RegionHandle region) const {
  return subscriptions_.subscribed(federate, object_class,
                                   region ? regions_.slot_of(federate, region) : no_region);
}

Subscription Interest::subscribed_anywhere(std::uint32_t federate,
                                           std::uint16_t object_class) const {
  return subscriptions_.subscribed_anywhere(federate, object_class);
}

bool Interest::subscribe_interaction(std::uint32_t federate, std::uint16_t interaction_class,
                                     RegionHandle region, Listening listening) {
  if (!regions_.has(federate, region)) return false;
  subscriptions_.subscribe_interaction(federate, interaction_class,
                                       regions_.slot_of(federate, region), listening);
  return true;
}

Listening Interest::subscribes_interaction(std::uint32_t federate,
                                           std::uint16_t interaction_class) const {
  return subscriptions_.subscribes_interaction(federate, interaction_class);
}

bool Interest::receives(std::uint32_t federate, std::uint16_t interaction_class,
                        std::uint32_t sender, std::span<const RegionHandle> sent) {
  return subscriptions_.any_region_of_interaction(
      federate, interaction_class, [&](RegionSlot subscribed) {
        return std::ranges::any_of(sent, [&](RegionHandle each) {
          return regions_.overlap(regions_[regions_.slot_of(sender, each)], regions_[subscribed]);
        });
      });
}

bool Interest::has_region(std::uint32_t federate, RegionHandle region) const {
  return regions_.has(federate, region);
}

bool Interest::create_region(std::uint32_t federate, RegionHandle region, DimensionSet dimensions) {
  return regions_.create(federate, region, dimensions);
}

DimensionSet Interest::dimensions(std::uint32_t federate, RegionHandle region) const {
  return regions_[regions_.slot_of(federate, region)].dimensions;
}

bool Interest::modify_region(std::uint32_t federate, RegionHandle region,
                             const im::Region& bounds) {
  const Commit commit = regions_.modify(federate, region, bounds);
  follow(federate, region, commit);
  return commit != Commit::impossible;
}

void Interest::modify_region(std::uint32_t federate, RegionHandle region,
                             std::span<const Range> ranges) {
  follow(federate, region, regions_.modify(federate, region, ranges));
}

void Interest::follow(std::uint32_t federate, RegionHandle region, Commit commit) {
  if (commit == Commit::first || commit == Commit::moved)
    subscriptions_.follow(regions_.slot_of(federate, region));
}

void Interest::delete_region(std::uint32_t federate, RegionHandle region) {
  subscriptions_.drop(federate, regions_.slot_of(federate, region));
  take(regions_.remove(federate, region));
}

void Interest::associate(std::uint32_t federate, ObjectSlot slot, RegionHandle region) {
  take(regions_.associate(slot, region ? regions_.slot_of(federate, region) : no_region));
}

void Interest::associate(std::uint32_t federate, ObjectSlot slot, RegionHandle region,
                         AttributeSet attributes) {
  take(regions_.associate(slot, regions_.slot_of(federate, region), attributes));
}

void Interest::disassociate(std::uint32_t federate, ObjectSlot slot, RegionHandle region,
                            AttributeSet attributes) {
  take(regions_.disassociate(slot, regions_.slot_of(federate, region), attributes));
}

/// The scope of a class may stop or start to be uniform when objects begin or end to use several
/// regions.
void Interest::take(const Reassociation& change) {
  for (const im::Entity entity : change.gone) subscriptions_.forget(entity);
  changed_objects_.insert(changed_objects_.end(), change.objects.begin(), change.objects.end());
  // What was held back of them is held back by the new region's entity, which knows of none.
  for (const ObjectSlot slot : change.objects) object_updated(slot);
  if (change.is_mixing_changed) subscriptions_.mark_regional_changed();
}

AttributeSet Interest::overlapping(std::uint32_t federate, RegionHandle region, ObjectSlot slot,
                                   AttributeSet attributes) {
  return regions_.overlapping(regions_[regions_.slot_of(federate, region)], slot, attributes);
}

void Interest::object_registered(ObjectSlot slot) {
  regions_.add_object(slot);
  changed_objects_.push_back(slot);
}

void Interest::object_deleted(ObjectSlot slot) {
  if (regions_.use_of(slot).region != no_region) take(regions_.associate(slot, no_region));
  facts_.forget(slot);
  scopes_.forget(slot);
}

void Interest::owner_changed(ObjectSlot slot) {
  changed_objects_.push_back(slot);
  scopes_.touch(slot);
}

AttributeSet Interest::actively_in_scope(std::uint32_t federate, ObjectSlot slot) {
  return matcher_.actively_in_scope(federate, slot);
}

void Interest::set_role(ObjectSlot slot, const im::Role& role) {
  const im::Role former = facts_.object_role(slot);
  if (former == role) return;
  if (former.owner != role.owner) changed_objects_.push_back(slot);
  facts_.set_object_role(slot, role);
  if (!facts_.are_roles_used()) return;
  for (const Association& each : regions_.associations_of(slot))
    facts_.inform_entity(regions_[each.region]);
}

void Interest::set_federate_role(std::uint32_t federate, const im::Role& role) {
  const im::Role former = facts_.role_of(federate);
  if (former == role) return;
  facts_.set_federate_role(federate, role);
  if (former.owner != role.owner && !subscriptions_.of(federate).regionals.empty())
    subscriptions_.mark_changed(federate);
  subscriptions_.inform_filter(federate);
}

void Interest::set_federate_heading(std::uint32_t federate, const im::Heading& heading) {
  if (facts_.set_heading(federate, heading)) subscriptions_.inform_headings(federate);
}

void Interest::set_flight(ObjectSlot slot, const im::Flight& flight) {
  if (!facts_.are_flights_used()) return;
  for (const Association& each : regions_.associations_of(slot))
    facts_.set_flight(regions_[each.region], flight);
}

void Interest::object_updated(ObjectSlot slot) {
  if (!planner_.holds_updates()) return;
  const RegionTable::Use& used = regions_.use_of(slot);
  if (used.entity != RegionTable::no_entity) filter_->note_update(used.entity);
}

void Interest::set_facts(ObjectSlot slot, const im::Facts& facts) {
  if (!facts_.are_facts_used()) return;
  for (const Association& each : regions_.associations_of(slot))
    facts_.set_facts(regions_[each.region], facts);
}

void Interest::set_federate_facts(std::uint32_t federate, const im::Facts& facts) {
  if (facts_.set_federate_facts(federate, facts)) subscriptions_.inform_facts(federate);
}

void Interest::share_out(std::uint32_t federate, const BytesDue& bytes_due) {
  planner_.share_out(scopes_.of(federate), bytes_due);
}

void Interest::match() {
  planner_.begin_match();
  subscriptions_.admit_waiting();
  matcher_.match(filter_->match(), changed_objects_);
  subscriptions_.end_match();
}

void Interest::list_regions_of_interest(std::vector<RegionOfInterest>& regions) const {
  subscriptions_.list_regions(regions);
}

}  // namespace rink::rti
