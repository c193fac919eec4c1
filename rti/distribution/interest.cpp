// The scope that follows from subscriptions and regions: which attributes of which objects.
#include "rti/distribution/interest.h"

#include <algorithm>

#include "im/stages/priority_order.h"

namespace rink::rti {

Interest::Interest(const Fom& fom, const ObjectTable& objects, const Ownership& ownership,
                   std::unique_ptr<im::Filter> filter)
    : fom_(fom),
      objects_(objects),
      ownership_(ownership),
      filter_(std::move(filter)),
      traits_(filter_->traits()),
      budget_(filter_->priority() ? filter_->priority()->budget() : 0) {
  const auto x = fom.dimension("X"), y = fom.dimension("Y");
  if (!x || !y) return;
  x_ = *x, y_ = *y;
  plane_ = {x_, y_};
}

void Interest::add_federate(std::uint32_t federate) {
  if (federate >= federates_.size()) {
    federates_.resize(federate + 1);
    told_.resize(federate + 1);
  }
  federates_[federate] = std::make_unique<DeclaredInterest>();
  DeclaredInterest& interest = *federates_[federate];
  told_[federate] = &interest;
  interest.federate = federate;
  if (traits_.says_tiers || budget_ > 0) interest.turns = std::make_unique<Turns>();
  interest.everywhere.declared.resize(fom_.object_classes().size());
  interest.everywhere.expanded = interest.by_class = interest.everywhere.declared;
}

void Interest::remove_federate(std::uint32_t federate) {
  DeclaredInterest& interest = *federates_[federate];
  for (std::uint32_t region = 0; region < interest.regions.size(); ++region)
    if (interest.regions[region] != no_region) delete_region(federate, {region});
  if (watches_scope_) interest.in_scope.for_each([this](ObjectSlot slot) { touch(slot); });
  federates_[federate].reset();
  told_[federate] = nullptr;
}

AttributeSet Interest::active(const ClassInterest& interest, std::uint16_t object_class) const {
  if (interest.passive.empty()) return interest.expanded[object_class];
  AttributeSet set;
  for (ObjectClassHandle each{object_class}; each; each = fom_.at(each).parent)
    set = set | interest.declared[each.value].without(interest.passive[each.value]);
  return set;
}

Interest::Regional* Interest::find(DeclaredInterest& interest, im::Subscriber subscriber) {
  for (Regional& each : interest.regionals)
    if (each.is_placed && each.subscriber == subscriber) return &each;
  return nullptr;
}

void Interest::object_registered(ObjectSlot slot) {
  if (slot >= uses_.size()) uses_.resize(slot + 1);
  changed_objects_.push_back(slot);
}

void Interest::object_deleted(ObjectSlot slot) {
  if (uses_[slot].region != no_region) set_associations(slot, {});
  if (slot < roles_.size()) roles_[slot] = {};
  for (const auto& interest : federates_)
    if (interest) interest->in_scope.erase(slot);
}

bool Interest::overlaps(const Regional& regional, RegionSlot update) {
  const DistributedRegion& region = regions_[update];
  if (!regional.is_placed || !region.is_placed)
    return regions_overlap(region, regions_[regional.region]);
  if (!regional.inside.contains(region.entity)) return false;
  if (regional.is_planar || region.is_planar) return true;
  const DistributedRegion& subscribed = regions_[regional.region];
  return ranges_overlap(
      region, subscribed,
      DimensionSet(region.dimensions.bits & subscribed.dimensions.bits & ~plane_.bits));
}

/// Those of `attributes` that the regional subscription gets of an object that uses several
/// regions.
AttributeSet Interest::covered(const Regional& regional, ObjectSlot object,
                               AttributeSet attributes) {
  AttributeSet placed, inside;
  for (const Association& each : associations_.at(object)) {
    placed = placed | each.attributes;
    if (!(each.attributes & attributes).is_empty() && overlaps(regional, each.region))
      inside = inside | each.attributes;
  }
  return AttributeSet(attributes.bits & (inside.bits | ~placed.bits));
}

void Interest::owner_changed(ObjectSlot slot) {
  changed_objects_.push_back(slot);
  touch(slot);
}

template <bool is_active_only>
AttributeSet Interest::wanted(const DeclaredInterest& interest, ObjectSlot slot) {
  const Object& object = objects_[slot];
  if (!object.is_alive || object.is_leaving || object.owner == interest.federate) return {};
  AttributeSet set = is_active_only ? active(interest.everywhere, object.object_class)
                                    : interest.everywhere.expanded[object.object_class];
  const Use& used = uses_[slot];
  for (const Regional& each : interest.regionals) {
    const AttributeSet named = is_active_only ? active(each.classes, object.object_class)
                                              : each.classes.expanded[object.object_class];
    if (used.region == several) {
      set = set | (is_own(interest, slot) ? named : covered(each, slot, named));
      continue;
    }
    const bool is_heard = used.region == no_region || (used.entity != no_entity && each.is_placed
                                                           ? each.inside.contains(used.entity)
                                                           : overlaps(each, used.region));
    if (is_heard || is_own(interest, slot)) set = set | named;
  }
  return object.owner == no_federate ? set & ownership_.owned_by_others(interest.federate, slot)
                                     : set;
}

AttributeSet Interest::told_actively(std::uint32_t federate, ObjectSlot slot) {
  const DeclaredInterest& interest = *federates_[federate];
  const AttributeSet told = interest.told(slot, objects_[slot].object_class);
  const auto is_passive = [](const Regional& each) { return !each.classes.passive.empty(); };
  const bool has_passive =
      !interest.everywhere.passive.empty() || std::ranges::any_of(interest.regionals, is_passive);
  return told.is_empty() || !has_passive ? told : told & wanted<true>(interest, slot);
}

void Interest::match() {
  ++match_;
  take_filter_changes();
  for (const auto& interest : federates_)
    if (interest && interest->is_changed) reconsider_all(*interest);
  take_changed_regions();
  for (const ObjectSlot slot : changed_objects_)
    for (const auto& interest : federates_)
      if (interest) reconsider(*interest, slot);
  changed_objects_.clear();
}

void Interest::take_filter_changes() {
  // Memberships first, all of them: what a federate wants of an object depends on several regions.
  const std::span<const im::Change> changes = filter_->match();
  for (const im::Change& each : changes) {
    Regional* regional = find(*federates_[subscribers_[each.subscriber]], each.subscriber);
    if (each.transition == im::Transition::left) regional->inside.erase(each.entity);
    else regional->inside.insert(each.entity);  // it may be there already and only change its tier
    if (traits_.says_tiers)
      set_tier(*regional, each.entity, each.transition == im::Transition::left ? 0u : each.tier);
  }
  for (const im::Change& each : changes) {
    DeclaredInterest& interest = *federates_[subscribers_[each.subscriber]];
    if (interest.is_changed) continue;
    for (const ObjectSlot slot : regions_[region_of_entity_[each.entity]].objects)
      reconsider(interest, slot);
  }
}

/// Those that changed in a way that the filter can't know: in other dimensions than the plane's, or
/// against a region that lacks one of these.
void Interest::take_changed_regions() {
  for (const RegionSlot slot : changed_regions_) {
    DistributedRegion& region = regions_[slot];
    region.is_changed = false;
    changed_objects_.insert(changed_objects_.end(), region.objects.begin(), region.objects.end());
    if (region.subscription_count == 0) continue;
    DeclaredInterest& interest = *federates_[region.federate];
    for (const Regional& each : interest.regionals)
      if (each.region == slot) reconsider_around(interest, each);
  }
  changed_regions_.clear();
}

/// All that may have come or gone by a change of the subscription's region in other dimensions:
/// what the filter lets through and what it doesn't know.
void Interest::reconsider_around(DeclaredInterest& interest, const Regional& regional) {
  if (!regional.is_placed) {
    for (ObjectSlot slot = 0; slot < uses_.size(); ++slot)
      if (uses_[slot].region != no_region) reconsider(interest, slot);
    return;
  }
  if (!regional.is_planar)
    regional.inside.for_each([&](im::Entity entity) {
      for (const ObjectSlot slot : regions_[region_of_entity_[entity]].objects)
        reconsider(interest, slot);
    });
  for (const RegionSlot region : unplaced_)
    for (const ObjectSlot slot : regions_[region].objects) reconsider(interest, slot);
}

bool Interest::uniform_classes(const DeclaredInterest& interest,
                               std::vector<AttributeSet>& by_class) const {
  if (!associations_.empty() && !interest.regionals.empty()) return false;
  by_class = interest.everywhere.expanded;
  for (const Regional& each : interest.regionals)
    for (std::size_t i = 0; i < by_class.size(); ++i) {
      const AttributeSet set = each.classes.expanded[i];
      if (by_class[i].is_empty()) by_class[i] = set;
      else if (!set.is_empty() && set != by_class[i]) return false;
    }
  return true;
}

void Interest::reconsider_all(DeclaredInterest& interest) {
  interest.is_changed = false;
  std::vector<AttributeSet> by_class, by_object;
  const bool is_uniform = uniform_classes(interest, by_class);
  if (!is_uniform)
    by_object.resize(
        objects_.slot_count());  // else four bytes per object of the world would come and go with
                                 // every client, and leave holes in the heap
  for (ObjectSlot slot = 0; slot < objects_.slot_count(); ++slot) {
    const AttributeSet was = interest.told(slot, objects_[slot].object_class);
    const AttributeSet is = wanted(interest, slot);
    settle(interest, slot, was, is);
    if (!is.is_empty()) touch(slot);
    if (!is_uniform) by_object[slot] = is;
  }
  interest.is_uniform = is_uniform;
  interest.by_class = std::move(by_class);
  interest.by_object = std::move(by_object);
}

void Interest::reconsider(DeclaredInterest& interest, ObjectSlot slot) {
  ++counters_.pairs_reconsidered;
  const AttributeSet was = interest.told(slot, objects_[slot].object_class),
                     is = wanted(interest, slot);
  settle(interest, slot, was, is);
  if (!is.is_empty()) touch(slot);  // what is heard as before may be heard passively now
  if (interest.is_uniform) return;
  if (slot >= interest.by_object.size()) interest.by_object.resize(objects_.slot_count());
  interest.by_object[slot] = is;
}

void Interest::settle(DeclaredInterest& interest, ObjectSlot slot, AttributeSet was,
                      AttributeSet is) {
  if (traits_.says_tiers && !is.is_empty()) place_in_tier(interest, slot, was.is_empty());
  if (was == is) return;
  touch(slot);
  if (was.is_empty()) {
    interest.in_scope.insert(slot);
    interest.events.push_back({slot, im::Transition::entered});
    ++counters_.entries;
  } else if (is.is_empty()) {
    interest.in_scope.erase(slot);
    interest.events.push_back({slot, im::Transition::left});
    ++counters_.exits;
  }
  if (!was.includes(is)) {
    interest.fresh.insert(slot);
    interest.has_fresh = true;
  }
}

}  // namespace rink::rti
