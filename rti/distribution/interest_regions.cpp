// Regions: their bounds, which objects use them for updates, and when two of them overlap.
#include <algorithm>
#include <cassert>

#include "rti/distribution/interest.h"

namespace rink::rti {

bool Interest::has_region(std::uint32_t federate, RegionHandle region) const {
  const auto& regions = federates_[federate]->regions;
  return region.value < regions.size() && regions[region.value] != no_region;
}

RegionSlot Interest::take_region_slot() {
  if (free_regions_.empty()) {
    regions_.emplace_back();
    return static_cast<RegionSlot>(regions_.size() - 1);
  }
  const RegionSlot slot = free_regions_.back();
  free_regions_.pop_back();
  return slot;
}

bool Interest::create_region(std::uint32_t federate, RegionHandle region, DimensionSet dimensions) {
  auto& regions = federates_[federate]->regions;
  if (region.value > regions.size() || has_region(federate, region)) return false;
  if (region.value == regions.size()) regions.push_back(no_region);
  const RegionSlot slot = regions[region.value] = take_region_slot();
  DistributedRegion& made = regions_[slot] = {};
  made.exists = true;
  made.federate = federate;
  made.is_planar = dimensions.is_empty() || dimensions == plane_;
  made.dimensions = made.is_planar ? plane_ : dimensions;
  made.is_placed = made.is_planar || (!plane_.is_empty() && dimensions.includes(plane_));
  return true;
}

bool Interest::modify_region(std::uint32_t federate, RegionHandle handle,
                             const im::Region& bounds) {
  if (!has_region(federate, handle)) return false;
  const RegionSlot slot = slot_of(federate, handle);
  DistributedRegion& region = regions_[slot];
  if (!region.is_planar) return false;
  if (region.is_committed && region.plane == bounds) return true;
  const bool is_new = !region.is_committed;
  region.is_committed = true;
  region.plane = bounds;
  ++counters_.regions_changed;
  tell_filter(region, slot, is_new);
  if (!unplaced_.empty() || unplaced_subscription_count_ > 0) mark_changed(slot);
  return true;
}

void Interest::modify_region(std::uint32_t federate, RegionHandle handle,
                             std::span<const Range> ranges) {
  const RegionSlot slot = slot_of(federate, handle);
  DistributedRegion& region = regions_[slot];
  assert(ranges.size() == region.dimensions.count());
  im::Region plane;
  if (region.is_placed) {
    const Range x = ranges[region.dimensions.rank(x_)], y = ranges[region.dimensions.rank(y_)];
    plane = {x.low, y.low, x.high, y.high};
  }
  if (region.is_planar) {
    modify_region(federate, handle, plane);
    return;
  }
  if (region.is_committed && std::ranges::equal(region.ranges, ranges)) return;
  const bool is_new = !region.is_committed;
  region.is_committed = true;
  region.plane = plane;
  region.ranges.assign(ranges.begin(), ranges.end());
  ++counters_.regions_changed;
  if (region.is_placed) tell_filter(region, slot, is_new);
  mark_changed(slot);
}

/// The filter ignores roles of whom it does not know yet, so who `is_new` to it is told of with
/// his.
void Interest::tell_filter(const DistributedRegion& region, RegionSlot slot, bool is_new) {
  if (!region.objects.empty()) {
    filter_->set_update_region(region.entity, region.plane);
    if (is_new) tell_role(slot);
  }
  if (region.subscription_count == 0) return;
  const DeclaredInterest& interest = *federates_[region.federate];
  for (const Regional& each : interest.regionals) {
    if (each.region != slot) continue;
    filter_->set_subscription_region(each.subscriber, region.plane);
    if (is_new) tell_subscriber(interest, each.subscriber);
  }
}

void Interest::mark_changed(RegionSlot slot) {
  if (regions_[slot].is_changed) return;
  regions_[slot].is_changed = true;
  changed_regions_.push_back(slot);
}

void Interest::delete_region(std::uint32_t federate, RegionHandle handle) {
  DeclaredInterest& interest = *federates_[federate];
  const RegionSlot slot = interest.regions[handle.value];
  drop_regional(interest, slot);
  std::erase_if(interest.interactions, [slot](const auto& each) { return each.region == slot; });
  while (!regions_[slot].objects.empty()) {
    const ObjectSlot object = regions_[slot].objects.back();
    std::vector<Association> left = associations_of(object);
    std::erase_if(left, [slot](const Association& each) { return each.region == slot; });
    set_associations(object, std::move(left));
  }
  if (regions_[slot].is_changed) std::erase(changed_regions_, slot);
  regions_[slot] = {};
  interest.regions[handle.value] = no_region;
  free_regions_.push_back(slot);
}

void Interest::take_entity(RegionSlot slot) {
  DistributedRegion& region = regions_[slot];
  if (!region.is_placed) {
    unplaced_.push_back(slot);
    return;
  }
  if (free_entities_.empty()) {
    free_entities_.push_back(static_cast<im::Entity>(region_of_entity_.size()));
    region_of_entity_.emplace_back();
  }
  region.entity = free_entities_.back();
  free_entities_.pop_back();
  region_of_entity_[region.entity] = slot;
  if (region.is_committed) filter_->set_update_region(region.entity, region.plane);
}

void Interest::free_entity(RegionSlot slot) {
  const DistributedRegion& region = regions_[slot];
  if (!region.is_placed) {
    std::erase(unplaced_, slot);
    return;
  }
  free_entities_.push_back(region.entity);
  if (!region.is_committed) return;
  filter_->remove_entity(region.entity);
  for (const auto& interest : federates_)
    if (interest)
      for (Regional& each : interest->regionals) each.inside.erase(region.entity);
}

void Interest::use(RegionSlot region, ObjectSlot object) {
  if (regions_[region].objects.empty()) take_entity(region);
  regions_[region].objects.push_back(object);
  tell_role(region);
}

void Interest::stop_using(RegionSlot region, ObjectSlot object) {
  auto& objects = regions_[region].objects;
  objects.erase(std::find(objects.begin(), objects.end(), object));
  if (objects.empty()) free_entity(region);
  else tell_role(region);
}

std::vector<Interest::Association> Interest::associations_of(ObjectSlot object) const {
  const RegionSlot region = uses_[object].region;
  if (region == no_region) return {};
  if (region == several) return associations_.at(object);
  return {{region, fom_.attributes(ObjectClassHandle{objects_[object].object_class})}};
}

void Interest::set_associations(ObjectSlot object, std::vector<Association> associations) {
  std::erase_if(associations, [](const Association& each) { return each.attributes.is_empty(); });
  const std::vector<Association> former = associations_of(object);
  for (const Association& each : associations) use(each.region, object);
  for (const Association& each : former) stop_using(each.region, object);
  changed_objects_.push_back(object);
  const bool had_several = !associations_.empty();
  if (uses_[object].region == several) associations_.erase(object);
  const AttributeSet all = fom_.attributes(ObjectClassHandle{objects_[object].object_class});
  Use& used = uses_[object] = {};
  if (associations.size() == 1 && associations[0].attributes == all) {
    const DistributedRegion& region = regions_[associations[0].region];
    used = {associations[0].region, region.is_planar ? region.entity : no_entity};
  } else if (!associations.empty()) {
    used.region = several;
    associations_[object] = std::move(associations);
  }
  if (had_several == !associations_.empty()) return;
  // Whether all objects of a class have the same attributes in scope is no longer what it was.
  for (const auto& interest : federates_)
    if (interest && !interest->regionals.empty()) interest->is_changed = true;
}

void Interest::associate(std::uint32_t federate, ObjectSlot object, RegionHandle region) {
  if (!region) return set_associations(object, {});
  set_associations(object, {{slot_of(federate, region),
                             fom_.attributes(ObjectClassHandle{objects_[object].object_class})}});
}

void Interest::associate(std::uint32_t federate, ObjectSlot object, RegionHandle region,
                         AttributeSet attributes) {
  const RegionSlot slot = slot_of(federate, region);
  std::vector<Association> all = associations_of(object);
  const auto found = std::ranges::find(all, slot, &Association::region);
  if (found == all.end()) all.push_back({slot, attributes});
  else found->attributes = found->attributes | attributes;
  set_associations(object, std::move(all));
}

void Interest::disassociate(std::uint32_t federate, ObjectSlot object, RegionHandle region,
                            AttributeSet attributes) {
  const RegionSlot slot = slot_of(federate, region);
  std::vector<Association> all = associations_of(object);
  for (Association& each : all)
    if (each.region == slot) each.attributes.bits &= ~attributes.bits;
  set_associations(object, std::move(all));
}

bool Interest::ranges_overlap(const DistributedRegion& a, const DistributedRegion& b,
                              DimensionSet dimensions) {
  for (std::uint64_t left = dimensions.bits; left != 0; left &= left - 1) {
    const DimensionHandle dimension{static_cast<std::uint32_t>(std::countr_zero(left))};
    ++counters_.ranges_tested;
    if (!range(a, dimension).overlaps(range(b, dimension))) return false;
  }
  return true;
}

Range Interest::range(const DistributedRegion& region, DimensionHandle dimension) const {
  if (!region.is_planar) return region.ranges[region.dimensions.rank(dimension)];
  return dimension == x_ ? Range{region.plane.low_x, region.plane.high_x}
                         : Range{region.plane.low_y, region.plane.high_y};
}

/// IEEE 1516.1-2010, 9.1: in all dimensions that they have in common, of which there must be one.
bool Interest::regions_overlap(const DistributedRegion& a, const DistributedRegion& b) {
  if (!a.is_committed || !b.is_committed) return false;
  const DimensionSet common = a.dimensions & b.dimensions;
  if (!a.is_placed || !b.is_placed) return !common.is_empty() && ranges_overlap(a, b, common);
  counters_.ranges_tested += 2;
  const im::Region &p = a.plane, &q = b.plane;
  if (!(p.low_x <= q.high_x && q.low_x <= p.high_x && p.low_y <= q.high_y && q.low_y <= p.high_y))
    return false;
  return ranges_overlap(a, b, DimensionSet(common.bits & ~plane_.bits));
}

AttributeSet Interest::overlapping(std::uint32_t federate, RegionHandle region, ObjectSlot object,
                                   AttributeSet attributes) {
  const DistributedRegion& asked = regions_[slot_of(federate, region)];
  AttributeSet regional, inside;
  for (const Association& each : associations_of(object)) {
    regional = regional | each.attributes;
    if (regions_overlap(regions_[each.region], asked)) inside = inside | each.attributes;
  }
  return AttributeSet(attributes.bits & (inside.bits | ~regional.bits));
}

}  // namespace rink::rti
