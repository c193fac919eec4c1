// Subscriptions, regions and the scope that follows from them.
#include "rti/distribution/interest.h"

#include <algorithm>
#include <cassert>

#include "rti/wire/message.h"

namespace rink::rti {

Interest::Interest(const Fom& fom, ObjectTable& objects, const Ownership& ownership, std::unique_ptr<im::Filter> filter)
    : fom_(fom), objects_(objects), ownership_(ownership), filter_(std::move(filter)) {}

void Interest::add_federate(std::uint32_t federate) {
  if (federate >= federates_.size()) federates_.resize(federate + 1);
  federates_[federate] = std::make_unique<FederateInterest>();
  FederateInterest& interest = *federates_[federate];
  interest.federate = federate;
  interest.everywhere.declared.resize(fom_.object_classes().size());
  interest.everywhere.expanded = interest.by_class = interest.everywhere.declared;
}

void Interest::remove_federate(std::uint32_t federate) {
  FederateInterest& interest = of(federate);
  while (!interest.regionals.empty()) drop_regional(interest, interest.regionals.back().region);
  for (const FederateInterest::Region& each : interest.regions)
    while (!each.objects.empty()) associate(federate, each.objects.back(), {});
  federates_[federate].reset();
}

void Interest::expand(ClassInterest& interest) const {
  for (std::uint32_t i = 0; i < interest.declared.size(); ++i) {
    interest.expanded[i] = interest.declared[i];
    for (ObjectClassHandle parent = fom_.at(ObjectClassHandle{i}).parent; parent; parent = fom_.at(parent).parent)
      interest.expanded[i] = interest.expanded[i] | interest.declared[parent.value];
  }
}

bool Interest::subscribe(std::uint32_t federate, std::uint16_t object_class, AttributeSet attributes, RegionHandle region) {
  FederateInterest& interest = of(federate);
  if (region && !has_region(federate, region)) return false;
  ClassInterest& classes = region ? regional(interest, region).classes : interest.everywhere;
  classes.declared[object_class] = attributes;
  expand(classes);
  interest.is_changed = true;
  const auto& declared = classes.declared;
  if (region && std::all_of(declared.begin(), declared.end(), [](AttributeSet set) { return set.is_empty(); })) drop_regional(interest, region);
  return true;
}

FederateInterest::Regional& Interest::regional(FederateInterest& interest, RegionHandle region) {
  for (FederateInterest::Regional& each : interest.regionals)
    if (each.region == region) return each;
  FederateInterest::Regional& added = interest.regionals.emplace_back();
  added.region = region;
  added.classes.declared.resize(fom_.object_classes().size());
  added.classes.expanded = added.classes.declared;
  if (free_subscribers_.empty()) {
    free_subscribers_.push_back(static_cast<im::Subscriber>(subscribers_.size()));
    subscribers_.emplace_back();
  }
  added.subscriber = free_subscribers_.back();
  free_subscribers_.pop_back();
  subscribers_[added.subscriber] = interest.federate;
  const FederateInterest::Region& bounds = interest.regions[region.value];
  if (bounds.has_bounds) filter_->set_subscription_region(added.subscriber, bounds.bounds);
  return added;
}

FederateInterest::Regional* Interest::find(FederateInterest& interest, im::Subscriber subscriber) {
  for (FederateInterest::Regional& each : interest.regionals)
    if (each.subscriber == subscriber) return &each;
  return nullptr;
}

void Interest::drop_regional(FederateInterest& interest, RegionHandle region) {
  const auto found = std::find_if(interest.regionals.begin(), interest.regionals.end(), [&](const auto& each) { return each.region == region; });
  if (found == interest.regionals.end()) return;
  filter_->remove_subscriber(found->subscriber);
  free_subscribers_.push_back(found->subscriber);
  interest.regionals.erase(found);
  interest.is_changed = true;
}

bool Interest::has_region(std::uint32_t federate, RegionHandle region) const {
  const auto& regions = of(federate).regions;
  return region.value < regions.size() && regions[region.value].exists;
}

bool Interest::create_region(std::uint32_t federate, RegionHandle region) {
  auto& regions = of(federate).regions;
  if (region.value > regions.size() || has_region(federate, region)) return false;
  if (region.value == regions.size()) regions.emplace_back();
  regions[region.value].exists = true;
  return true;
}

void Interest::modify_region(std::uint32_t federate, RegionHandle region, const im::Region& bounds) {
  FederateInterest& interest = of(federate);
  FederateInterest::Region& changed = interest.regions[region.value];
  changed.has_bounds = true;
  changed.bounds = bounds;
  for (const ObjectSlot slot : changed.objects) {
    filter_->set_update_region(slot, bounds);
    objects_[slot].is_filtered = true;
  }
  for (const FederateInterest::Regional& each : interest.regionals)
    if (each.region == region) filter_->set_subscription_region(each.subscriber, bounds);
}

void Interest::delete_region(std::uint32_t federate, RegionHandle region) {
  FederateInterest& interest = of(federate);
  drop_regional(interest, region);
  while (!interest.regions[region.value].objects.empty()) associate(federate, interest.regions[region.value].objects.back(), {});
  interest.regions[region.value] = {};
}

void Interest::leave_region(ObjectSlot slot) {
  Object& object = objects_[slot];
  if (!object.region) return;
  auto& objects = of(object.region_federate).regions[object.region.value].objects;
  objects.erase(std::find(objects.begin(), objects.end(), slot));
  object.region = {};
}

void Interest::associate(std::uint32_t federate, ObjectSlot slot, RegionHandle region) {
  leave_region(slot);
  Object& object = objects_[slot];
  object.region = region;
  object.region_federate = federate;
  changed_objects_.push_back(slot);
  if (!region) return forget(slot);
  FederateInterest::Region& joined = of(federate).regions[region.value];
  joined.objects.push_back(slot);
  if (!joined.has_bounds) return forget(slot);
  filter_->set_update_region(slot, joined.bounds);
  object.is_filtered = true;
}

void Interest::forget(ObjectSlot slot) {
  if (!objects_[slot].is_filtered) return;
  objects_[slot].is_filtered = false;
  filter_->remove_entity(slot);
  for (const auto& interest : federates_)
    if (interest)
      for (FederateInterest::Regional& each : interest->regionals) each.inside.erase(slot);
}

void Interest::object_deleted(ObjectSlot slot) {
  leave_region(slot);
  forget(slot);
  for (const auto& interest : federates_)
    if (interest) interest->in_scope.erase(slot);
}

AttributeSet Interest::wanted(const FederateInterest& interest, ObjectSlot slot) const {
  const Object& object = objects_[slot];
  if (!object.is_alive || object.owner == interest.federate) return {};
  AttributeSet set = interest.everywhere.expanded[object.object_class];
  for (const FederateInterest::Regional& each : interest.regionals)
    if (!object.region || each.inside.contains(slot)) set = set | each.classes.expanded[object.object_class];
  return object.owner == no_federate ? set & ownership_.owned_by_others(interest.federate, slot) : set;
}

void Interest::match() {
  take_filter_changes();
  for (const auto& interest : federates_)
    if (interest && interest->is_changed) reconsider_all(*interest);
  for (const ObjectSlot slot : changed_objects_)
    for (const auto& interest : federates_)
      if (interest) reconsider(*interest, slot);
  changed_objects_.clear();
}

void Interest::take_filter_changes() {
  // Memberships first, all of them: what a federate wants of an object depends on several regions.
  const std::span<const im::Change> changes = filter_->match();
  for (const im::Change& each : changes) {
    FederateInterest::Regional* regional = find(of(subscribers_[each.subscriber]), each.subscriber);
    if (each.transition == im::Transition::entered) regional->inside.insert(each.entity);
    else regional->inside.erase(each.entity);
  }
  for (const im::Change& each : changes) {
    FederateInterest& interest = of(subscribers_[each.subscriber]);
    if (!interest.is_changed) reconsider(interest, each.entity);
  }
}

bool Interest::uniform_classes(const FederateInterest& interest, std::vector<AttributeSet>& by_class) const {
  by_class = interest.everywhere.expanded;
  for (const FederateInterest::Regional& each : interest.regionals)
    for (std::size_t i = 0; i < by_class.size(); ++i) {
      const AttributeSet set = each.classes.expanded[i];
      if (by_class[i].is_empty()) by_class[i] = set;
      else if (!set.is_empty() && set != by_class[i]) return false;
    }
  return true;
}

void Interest::reconsider_all(FederateInterest& interest) {
  interest.is_changed = false;
  std::vector<AttributeSet> by_class, by_object;
  const bool is_uniform = uniform_classes(interest, by_class);
  if (!is_uniform) by_object.resize(objects_.slot_count());  // else four bytes per object of the world would come and go with every client, and leave holes in the heap
  for (ObjectSlot slot = 0; slot < objects_.slot_count(); ++slot) {
    const AttributeSet was = interest.told(slot, objects_[slot].object_class);
    const AttributeSet is = wanted(interest, slot);
    settle(interest, slot, was, is);
    if (!is_uniform) by_object[slot] = is;
  }
  interest.is_uniform = is_uniform;
  interest.by_class = std::move(by_class);
  interest.by_object = std::move(by_object);
}

void Interest::reconsider(FederateInterest& interest, ObjectSlot slot) {
  const AttributeSet was = interest.told(slot, objects_[slot].object_class), is = wanted(interest, slot);
  settle(interest, slot, was, is);
  if (interest.is_uniform) return;
  if (slot >= interest.by_object.size()) interest.by_object.resize(objects_.slot_count());
  interest.by_object[slot] = is;
}

void Interest::settle(FederateInterest& interest, ObjectSlot slot, AttributeSet was, AttributeSet is) {
  if (was == is) return;
  if (was.is_empty()) {
    interest.in_scope.insert(slot);
    interest.events.push_back({slot, im::Transition::entered});
    ++entries_;
  } else if (is.is_empty()) {
    interest.in_scope.erase(slot);
    interest.events.push_back({slot, im::Transition::left});
    ++exits_;
  }
  if (!was.includes(is)) {
    interest.fresh.insert(slot);
    interest.has_fresh = true;
  }
}

}  // namespace rink::rti
