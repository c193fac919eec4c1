// Regions of all federates: their bounds, which objects use them for updates, and when two of them
// overlap.
#pragma once

#include <cassert>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "im/filter.h"
#include "rti/distribution/data_distribution.h"
#include "rti/distribution/distributed_region.h"
#include "rti/distribution/filter_facts.h"
#include "rti/objects/bitmap.h"

namespace rink::rti {

/// Attributes of an object that use a region.
struct Association {
  RegionSlot region = no_region;
  AttributeSet attributes;
};

/// The consequences when objects use other regions than before.
struct Reassociation {
  std::vector<ObjectSlot> objects;  ///< those
  std::vector<im::Entity> gone;     ///< the filter's numbers that are free now
  bool is_mixing_changed = false;   ///< some object uses several regions now, or none does any more

  void add(const Reassociation& other) {
    objects.insert(objects.end(), other.objects.begin(), other.objects.end());
    gone.insert(gone.end(), other.gone.begin(), other.gone.end());
    is_mixing_changed |= other.is_mixing_changed;
  }
};

/// What a commit did.
enum class Commit : std::uint8_t { impossible, unchanged, first, moved };

/// Passes the places of entities to the filter. Federates and regions named by a caller must exist
/// unless stated otherwise (asserted where it costs little).
class RegionTable {
 public:
  /// The region that an object uses. The copy of the entity spares nearly all objects, which use
  /// one region over the plane alone, a look at the region.
  struct Use {
    RegionSlot region = no_region;  ///< or none, or `several`
    im::Entity entity = no_entity;  ///< if it is planar
  };
  static constexpr RegionSlot several = no_region - 1;
  static constexpr im::Entity no_entity = 0xffffffffu;

  /// All must outlive it.
  RegionTable(const Fom& fom, const ObjectTable& objects, im::Filter& filter,
              const FilterFacts& facts, DistributionCounters& counters);

  void add_federate(std::uint32_t federate);
  bool has(std::uint32_t federate, RegionHandle region) const;
  RegionSlot slot_of(std::uint32_t federate, RegionHandle region) const {
    assert(has(federate, region));
    return handles_[federate][region.value];
  }
  /// Handles below it may be in use.
  std::uint32_t handle_count(std::uint32_t federate) const {
    return static_cast<std::uint32_t>(handles_[federate].size());
  }
  const DistributedRegion& operator[](RegionSlot slot) const { return regions_[slot]; }
  const DistributedRegion& of_entity(im::Entity entity) const {
    assert(entity < region_of_entity_.size());
    return regions_[region_of_entity_[entity]];
  }

  bool create(std::uint32_t federate, RegionHandle region, DimensionSet dimensions);
  /// `impossible` if there is no such region or it is not over the plane alone.
  Commit modify(std::uint32_t federate, RegionHandle region, const im::Region& bounds);
  Commit modify(std::uint32_t federate, RegionHandle region, std::span<const Range> ranges);
  /// No subscription may use the region any more (asserted).
  Reassociation remove(std::uint32_t federate, RegionHandle region);
  /// One subscription to an object class more, or less, names the region.
  void count_subscription(RegionSlot slot, bool is_added);

  void add_object(ObjectSlot object);
  const Use& use_of(ObjectSlot object) const {
    assert(object < uses_.size());
    return uses_[object];
  }
  const ObjectTable& objects() const { return objects_; }
  ObjectSlot object_count() const { return static_cast<ObjectSlot>(uses_.size()); }
  /// The associations of an object that uses several regions.
  const std::vector<Association>& several_of(ObjectSlot object) const {
    return associations_.at(object);
  }
  bool has_several() const { return !associations_.empty(); }
  /// Objects that use no region, among them some that are gone.
  const Bitmap& without_region() const { return without_region_; }
  std::vector<Association> associations_of(ObjectSlot object) const;
  /// All of the object uses the region alone, or none if it is no_region.
  Reassociation associate(ObjectSlot object, RegionSlot region);
  Reassociation associate(ObjectSlot object, RegionSlot region, AttributeSet attributes);
  Reassociation disassociate(ObjectSlot object, RegionSlot region, AttributeSet attributes);

  /// True if the regions overlap in all dimensions that they have in common, of which there must be
  /// one (IEEE 1516.1-2010, 9.1).
  bool overlap(const DistributedRegion& a, const DistributedRegion& b);
  /// True if two regions that overlap in the plane overlap in all other common dimensions too.
  bool overlap_beyond_plane(const DistributedRegion& a, const DistributedRegion& b);
  /// Those of `attributes` whose regions overlap `asked`; those of the default region always do.
  AttributeSet overlapping(const DistributedRegion& asked, ObjectSlot object,
                           AttributeSet attributes);

  /// Regions that are used for updates and lack X or Y.
  std::span<const RegionSlot> unplaced() const { return unplaced_; }
  /// Regions that changed since `forget_changed` in a way that the filter cannot see: in other
  /// dimensions than the plane's, or against a region that lacks one of these.
  std::span<const RegionSlot> changed() const { return changed_; }
  void forget_changed();
  /// Asserts that handles and regions lead to each other, and that lists and counts are right.
  void check() const;

 private:
  bool slot_of_holder(const DistributedRegion& region, RegionSlot slot) const;
  RegionSlot take_slot();
  Commit commit(RegionSlot slot, const im::Region& plane, std::span<const Range> ranges);
  void become_entity(RegionSlot slot);
  void free_entity(RegionSlot slot, Reassociation& change);
  void use(RegionSlot region, ObjectSlot object);
  void stop_using(RegionSlot region, ObjectSlot object, Reassociation& change);
  Reassociation set_associations(ObjectSlot object, std::vector<Association> associations);
  AttributeSet all_of(ObjectSlot object) const;
  bool overlap_in(const DistributedRegion& a, const DistributedRegion& b, DimensionSet dimensions);
  Range range(const DistributedRegion& region, DimensionHandle dimension) const;

  const Fom& fom_;
  const ObjectTable& objects_;
  im::Filter& filter_;
  const FilterFacts& facts_;
  DistributionCounters& counters_;
  DimensionHandle x_, y_;                         ///< if the model has both
  DimensionSet plane_;                            ///< of these
  std::vector<std::vector<RegionSlot>> handles_;  ///< by federate and handle
  std::vector<DistributedRegion> regions_;        ///< by slot
  std::vector<RegionSlot> free_, changed_, unplaced_;
  std::uint32_t unplaced_subscription_count_ = 0;
  std::vector<RegionSlot> region_of_entity_;
  std::vector<im::Entity> free_entities_;
  std::vector<Use> uses_;  ///< by object
  Bitmap without_region_;  ///< objects
  std::unordered_map<ObjectSlot, std::vector<Association>>
      associations_;  ///< of objects that use `several`
};

}  // namespace rink::rti
