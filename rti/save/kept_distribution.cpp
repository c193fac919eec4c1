// Reads declarations from the tables of the data distribution, and declares them again by its
// services, which check them.
#include "rti/save/kept_distribution.h"

#include <algorithm>

namespace rink::rti {

namespace {

DimensionSet all_of(const Fom& fom) {
  const std::size_t count = fom.dimensions().size();
  return count >= dimension_max ? DimensionSet(~std::uint64_t{0})
                                : DimensionSet((std::uint64_t{1} << count) - 1);
}

}  // namespace

void KeptDistribution::gather(const Interest& interest, const FederateTable& federates) {
  const RegionTable& regions = interest.regions();
  std::vector<RegionHandle> handles;  // by the region's slot
  for (std::uint32_t slot = 0; slot < federates.size(); ++slot) {
    if (!federates[slot].is_joined) continue;
    Federate& kept = federates_.emplace_back();
    kept.slot = slot;
    kept.region_count = regions.handle_count(slot);
    for (RegionHandle each{0}; each.value < kept.region_count; ++each.value) {
      if (!regions.has(slot, each)) continue;
      const RegionSlot at = regions.slot_of(slot, each);
      const DistributedRegion& region = regions[at];
      kept.regions.push_back({each, region.dimensions, region.is_planar, region.is_committed,
                              region.plane, region.ranges});
      if (at >= handles.size()) handles.resize(at + std::size_t{1});
      handles[at] = each;
    }
    const DeclaredInterest& declared = interest.subscriptions().of(slot);
    gather_classes(declared.everywhere, {}, kept);
    for (const DeclaredInterest::Regional& each : declared.regionals)
      gather_classes(each.classes, handles[each.region], kept);
    for (const DeclaredInterest::InteractionRegion& each : declared.interactions)
      kept.interactions.push_back({each.interaction_class, handles[each.region], each.is_passive});
  }
  for (ObjectSlot object = 0; object < regions.object_count(); ++object)
    for (const Association& each : regions.associations_of(object))
      associations_.push_back(
          {object, regions[each.region].federate, handles[each.region], each.attributes});
}

void KeptDistribution::gather_classes(const ClassInterest& classes, RegionHandle region,
                                      Federate& kept) const {
  for (std::size_t i = 0; i < classes.declared.size(); ++i) {
    const AttributeSet passive = classes.passive.empty() ? AttributeSet() : classes.passive[i];
    if (!classes.declared[i].is_empty())
      kept.classes.push_back({static_cast<std::uint16_t>(i),
                              region,
                              {classes.declared[i], classes.declared[i].without(passive)}});
  }
}

bool KeptDistribution::is_of(const FederateTable& federates) const {
  const auto is_joined = [&](std::uint32_t slot) {
    return slot < federates.size() && federates[slot].is_joined;
  };
  auto next = federates_.begin();
  for (std::uint32_t slot = 0; slot < federates.size(); ++slot)
    if (federates[slot].is_joined && (next == federates_.end() || next++->slot != slot))
      return false;
  return next == federates_.end() &&
         std::ranges::all_of(associations_, is_joined, &KeptAssociation::maker);
}

bool KeptDistribution::apply(const Fom& fom, const ObjectTable& objects, Interest& interest) const {
  for (ObjectSlot object = 0; object < objects.slot_count(); ++object)
    if (objects[object].is_alive) interest.object_registered(object);
  for (const Federate& kept : federates_)
    if (!apply_regions(fom, kept, interest) || !apply_subscriptions(fom, kept, interest))
      return false;
  for (const KeptAssociation& each : associations_) {
    if (each.object >= objects.slot_count() || !objects[each.object].is_alive ||
        !interest.has_region(each.maker, each.region))
      return false;
    const AttributeSet all = fom.attributes(ObjectClassHandle{objects[each.object].object_class});
    interest.associate(each.maker, each.object, each.region, each.attributes & all);
  }
  return true;
}

/// Handles are made in order: those between, which were deleted, are made and deleted again.
bool KeptDistribution::apply_regions(const Fom& fom, const Federate& kept, Interest& interest) {
  if (kept.region_count > region_max) return false;
  auto next = kept.regions.begin();
  for (RegionHandle each{0}; each.value < kept.region_count; ++each.value) {
    const bool exists = next != kept.regions.end() && next->handle == each;
    const DimensionSet dimensions = exists && !next->is_planar ? next->dimensions : DimensionSet();
    if (!all_of(fom).includes(dimensions) || !interest.create_region(kept.slot, each, dimensions))
      return false;
    if (!exists) continue;
    const KeptRegion& region = *next++;
    if (!region.is_committed) continue;
    if (region.is_planar) {
      interest.modify_region(kept.slot, each, region.plane);
    } else {
      if (region.ranges.size() != region.dimensions.count()) return false;
      interest.modify_region(kept.slot, each, region.ranges);
    }
  }
  if (next != kept.regions.end()) return false;
  next = kept.regions.begin();
  for (RegionHandle each{0}; each.value < kept.region_count; ++each.value) {
    if (next != kept.regions.end() && next->handle == each) ++next;
    else interest.delete_region(kept.slot, each);
  }
  return true;
}

bool KeptDistribution::apply_subscriptions(const Fom& fom, const Federate& kept,
                                           Interest& interest) {
  for (const ClassSubscription& each : kept.classes)
    if (each.object_class >= fom.object_classes().size() ||
        !each.subscription.subscribed.includes(each.subscription.active) ||
        !interest.subscribe(kept.slot, each.object_class, each.subscription, each.region))
      return false;
  return std::ranges::all_of(kept.interactions, [&](const InteractionSubscription& each) {
    return each.interaction_class < fom.interaction_classes().size() &&
           interest.subscribe_interaction(kept.slot, each.interaction_class, each.region,
                                          each.is_passive ? Listening::passive : Listening::active);
  });
}

}  // namespace rink::rti
