// Changes of bounds and uses: each is passed to the filter at once, and what the filter cannot see
// is listed for the next match.
#include "rti/distribution/region_table.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <utility>

#include "im/basics/checked.h"

namespace rink::rti {

RegionTable::RegionTable(const Fom& fom, const ObjectTable& objects, im::Filter& filter,
                         const FilterFacts& facts, DistributionCounters& counters)
    : fom_(fom), objects_(objects), filter_(filter), facts_(facts), counters_(counters) {
  const auto x = fom.dimension("X"), y = fom.dimension("Y");
  if (!x || !y) return;
  x_ = *x, y_ = *y;
  plane_ = {x_, y_};
}

void RegionTable::add_federate(std::uint32_t federate) {
  if (federate >= handles_.size()) handles_.resize(federate + std::size_t{1});
  // The slot's former federate has no regions left.
  assert(
      std::ranges::all_of(handles_[federate], [](RegionSlot slot) { return slot == no_region; }));
  handles_[federate].clear();
}

bool RegionTable::has(std::uint32_t federate, RegionHandle region) const {
  assert(federate < handles_.size());
  const std::vector<RegionSlot>& slots = handles_[federate];
  return region.value < slots.size() && slots[region.value] != no_region;
}

RegionSlot RegionTable::take_slot() {
  if (free_.empty()) {
    regions_.emplace_back();
    return static_cast<RegionSlot>(regions_.size() - 1);
  }
  const RegionSlot slot = free_.back();
  free_.pop_back();
  return slot;
}

bool RegionTable::create(std::uint32_t federate, RegionHandle region, DimensionSet dimensions) {
  assert(federate < handles_.size());
  std::vector<RegionSlot>& slots = handles_[federate];
  if (region.value > slots.size() || has(federate, region)) return false;
  if (region.value == slots.size()) slots.push_back(no_region);
  const RegionSlot slot = slots[region.value] = take_slot();
  DistributedRegion& made = regions_[slot] = {};
  made.exists = true;
  made.federate = federate;
  made.is_planar = dimensions.is_empty() || dimensions == plane_;
  made.dimensions = made.is_planar ? plane_ : dimensions;
  made.is_placed = made.is_planar || (!plane_.is_empty() && dimensions.includes(plane_));
  return true;
}

Commit RegionTable::modify(std::uint32_t federate, RegionHandle handle, const im::Region& bounds) {
  if (!has(federate, handle)) return Commit::impossible;
  const RegionSlot slot = slot_of(federate, handle);
  const DistributedRegion& region = regions_[slot];
  if (!region.is_planar) return Commit::impossible;
  if (region.is_committed && region.plane == bounds) return Commit::unchanged;
  return commit(slot, bounds, {});
}

Commit RegionTable::modify(std::uint32_t federate, RegionHandle handle,
                           std::span<const Range> ranges) {
  const RegionSlot slot = slot_of(federate, handle);
  const DistributedRegion& region = regions_[slot];
  assert(ranges.size() == region.dimensions.count());
  im::Region plane;
  if (region.is_placed) {
    const Range x = ranges[region.dimensions.rank(x_)], y = ranges[region.dimensions.rank(y_)];
    plane = {x.low, y.low, x.high, y.high};
  }
  if (region.is_planar) return modify(federate, handle, plane);
  if (region.is_committed && std::ranges::equal(region.ranges, ranges)) return Commit::unchanged;
  return commit(slot, plane, ranges);
}

/// The filter ignores roles of entities that it does not know yet, so a new one is passed with its
/// role.
Commit RegionTable::commit(RegionSlot slot, const im::Region& plane,
                           std::span<const Range> ranges) {
  DistributedRegion& region = regions_[slot];
  assert(region.exists && ranges.empty() == region.is_planar);
  const bool is_first = !region.is_committed;
  region.is_committed = true;
  region.plane = plane;
  region.ranges.assign(ranges.begin(), ranges.end());
  ++counters_.regions_changed;
  if (region.is_placed && !region.objects.empty()) {
    filter_.set_update_region(region.entity, plane);
    if (is_first) facts_.inform_entity(region);
  }
  const bool is_beyond_filter =
      !region.is_planar || !unplaced_.empty() || unplaced_subscription_count_ > 0;
  if (is_beyond_filter && !std::exchange(region.is_changed, true)) changed_.push_back(slot);
  return is_first ? Commit::first : Commit::moved;
}

Reassociation RegionTable::remove(std::uint32_t federate, RegionHandle handle) {
  const RegionSlot slot = slot_of(federate, handle);
  assert(regions_[slot].exists && regions_[slot].federate == federate);
  assert(regions_[slot].subscription_count == 0);
  Reassociation change;
  while (!regions_[slot].objects.empty()) {
    const ObjectSlot object = regions_[slot].objects.back();
    std::vector<Association> left = associations_of(object);
    std::erase_if(left, [slot](const Association& each) { return each.region == slot; });
    change.add(set_associations(object, std::move(left)));
  }
  if (regions_[slot].is_changed) std::erase(changed_, slot);
  regions_[slot] = {};
  handles_[federate][handle.value] = no_region;
  free_.push_back(slot);
  if constexpr (checks_whole_structures) check();
  return change;
}

void RegionTable::count_subscription(RegionSlot slot, bool is_added) {
  DistributedRegion& region = regions_[slot];
  assert(is_added || region.subscription_count > 0);
  region.subscription_count += is_added ? 1u : ~0u;
  if (!region.is_placed) unplaced_subscription_count_ += is_added ? 1u : ~0u;
}

void RegionTable::add_object(ObjectSlot object) {
  if (object >= uses_.size()) uses_.resize(object + std::size_t{1});
  assert(uses_[object].region == no_region);
  without_region_.insert(object);
}

void RegionTable::become_entity(RegionSlot slot) {
  DistributedRegion& region = regions_[slot];
  assert(region.objects.empty());
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
  if (region.is_committed) filter_.set_update_region(region.entity, region.plane);
}

void RegionTable::free_entity(RegionSlot slot, Reassociation& change) {
  const DistributedRegion& region = regions_[slot];
  assert(region.objects.empty());
  if (!region.is_placed) {
    std::erase(unplaced_, slot);
    return;
  }
  free_entities_.push_back(region.entity);
  if (!region.is_committed) return;
  filter_.remove_entity(region.entity);
  change.gone.push_back(region.entity);
}

void RegionTable::use(RegionSlot region, ObjectSlot object) {
  assert(regions_[region].exists);
  if (regions_[region].objects.empty()) become_entity(region);
  regions_[region].objects.push_back(object);
  facts_.inform_entity(regions_[region]);
}

void RegionTable::stop_using(RegionSlot region, ObjectSlot object, Reassociation& change) {
  std::vector<ObjectSlot>& objects = regions_[region].objects;
  const auto found = std::find(objects.begin(), objects.end(), object);
  assert(found != objects.end());
  objects.erase(found);
  if (objects.empty()) free_entity(region, change);
  else facts_.inform_entity(regions_[region]);
}

AttributeSet RegionTable::all_of(ObjectSlot object) const {
  return fom_.attributes(ObjectClassHandle{objects_[object].object_class});
}

std::vector<Association> RegionTable::associations_of(ObjectSlot object) const {
  const RegionSlot region = uses_[object].region;
  if (region == no_region) return {};
  if (region == several) return associations_.at(object);
  return {{region, all_of(object)}};
}

Reassociation RegionTable::set_associations(ObjectSlot object,
                                            std::vector<Association> associations) {
  std::erase_if(associations, [](const Association& each) { return each.attributes.is_empty(); });
  assert(object < uses_.size());
  Reassociation change;
  change.objects.push_back(object);
  const std::vector<Association> former = associations_of(object);
  for (const Association& each : associations) use(each.region, object);
  for (const Association& each : former) stop_using(each.region, object, change);
  const bool had_several = has_several();
  if (uses_[object].region == several) associations_.erase(object);
  Use& used = uses_[object] = {};
  if (associations.size() == 1 && associations[0].attributes == all_of(object)) {
    const DistributedRegion& region = regions_[associations[0].region];
    used = {associations[0].region, region.is_planar ? region.entity : no_entity};
  } else if (!associations.empty()) {
    used.region = several;
    associations_[object] = std::move(associations);
  }
  if (used.region == no_region) without_region_.insert(object);
  else without_region_.erase(object);
  change.is_mixing_changed = had_several != has_several();
  assert((used.region == several) == associations_.contains(object));
  return change;
}

Reassociation RegionTable::associate(ObjectSlot object, RegionSlot region) {
  if (region == no_region) return set_associations(object, {});
  return set_associations(object, {{region, all_of(object)}});
}

Reassociation RegionTable::associate(ObjectSlot object, RegionSlot region,
                                     AttributeSet attributes) {
  std::vector<Association> all = associations_of(object);
  const auto found = std::ranges::find(all, region, &Association::region);
  if (found == all.end()) all.push_back({region, attributes});
  else found->attributes = found->attributes | attributes;
  return set_associations(object, std::move(all));
}

Reassociation RegionTable::disassociate(ObjectSlot object, RegionSlot region,
                                        AttributeSet attributes) {
  std::vector<Association> all = associations_of(object);
  for (Association& each : all)
    if (each.region == region) each.attributes.bits &= ~attributes.bits;
  return set_associations(object, std::move(all));
}

bool RegionTable::overlap_in(const DistributedRegion& a, const DistributedRegion& b,
                             DimensionSet dimensions) {
  for (std::uint64_t left = dimensions.bits; left != 0; left &= left - 1) {
    const DimensionHandle dimension{static_cast<std::uint32_t>(std::countr_zero(left))};
    ++counters_.ranges_tested;
    if (!range(a, dimension).overlaps(range(b, dimension))) return false;
  }
  return true;
}

Range RegionTable::range(const DistributedRegion& region, DimensionHandle dimension) const {
  assert(region.is_committed && region.dimensions.contains(dimension));
  if (!region.is_planar) return region.ranges[region.dimensions.rank(dimension)];
  return dimension == x_ ? Range{region.plane.low_x, region.plane.high_x}
                         : Range{region.plane.low_y, region.plane.high_y};
}

bool RegionTable::overlap(const DistributedRegion& a, const DistributedRegion& b) {
  if (!a.is_committed || !b.is_committed) return false;
  if (!a.is_placed || !b.is_placed) {
    const DimensionSet common = a.dimensions & b.dimensions;
    return !common.is_empty() && overlap_in(a, b, common);
  }
  counters_.ranges_tested += 2;
  const im::Region &p = a.plane, &q = b.plane;
  return p.low_x <= q.high_x && q.low_x <= p.high_x && p.low_y <= q.high_y && q.low_y <= p.high_y &&
         overlap_beyond_plane(a, b);
}

bool RegionTable::overlap_beyond_plane(const DistributedRegion& a, const DistributedRegion& b) {
  return overlap_in(a, b, DimensionSet(a.dimensions.bits & b.dimensions.bits & ~plane_.bits));
}

AttributeSet RegionTable::overlapping(const DistributedRegion& asked, ObjectSlot object,
                                      AttributeSet attributes) {
  AttributeSet regional, inside;
  for (const Association& each : associations_of(object)) {
    regional = regional | each.attributes;
    if (overlap(regions_[each.region], asked)) inside = inside | each.attributes;
  }
  return AttributeSet(attributes.bits & (inside.bits | ~regional.bits));
}

void RegionTable::forget_changed() {
  for (const RegionSlot slot : changed_) regions_[slot].is_changed = false;
  changed_.clear();
  if constexpr (checks_whole_structures) check();
}

void RegionTable::check() const {
  [[maybe_unused]] std::uint32_t subscriptions = 0;
  for (RegionSlot slot = 0; slot < regions_.size(); ++slot) {
    const DistributedRegion& region = regions_[slot];
    if (!region.exists) continue;
    assert(slot_of_holder(region, slot));
    if (!region.is_placed) subscriptions += region.subscription_count;
    [[maybe_unused]] const bool is_listed = std::ranges::count(unplaced_, slot) == 1;
    assert(is_listed == (!region.is_placed && !region.objects.empty()));
    assert(!region.is_placed || region.objects.empty() || region_of_entity_[region.entity] == slot);
    assert(region.is_changed == (std::ranges::count(changed_, slot) == 1));
  }
  assert(subscriptions == unplaced_subscription_count_);
}

/// True if the region's maker has it under one of its handles.
bool RegionTable::slot_of_holder(const DistributedRegion& region, RegionSlot slot) const {
  return std::ranges::count(handles_[region.federate], slot) == 1;
}

}  // namespace rink::rti
