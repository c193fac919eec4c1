// The RTI's own data distribution: subscriptions, regions over any dimensions, and a filter that
// decides in the plane of X and Y.
#pragma once

#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "rti/distribution/data_distribution.h"
#include "rti/ownership/ownership.h"

namespace rink::rti {

/// Number of a region among those of all federates; used again after it is deleted.
using RegionSlot = std::uint32_t;
inline constexpr RegionSlot no_region = 0xffffffffu;

/// The attributes of each class that one subscription names, as declared and with what subclasses
/// inherit.
struct ClassInterest {
  std::vector<AttributeSet> declared, expanded;  ///< by class
  std::vector<AttributeSet> passive;  ///< those of `declared` that are passive; empty if none is
};

/// A region as it was last committed, and who uses it for updates. Over X and Y the filter knows
/// it; other dimensions are compared one by one, for pairs that the filter lets through or, where
/// one of two regions lacks X or Y, for all. The rejected alternative, filters of more dimensions,
/// would make the common plane slower for a case in which the plane leaves few pairs.
struct DistributedRegion {
  bool exists = false, is_committed = false;
  bool is_placed = false;   ///< over both X and Y: the filter's business
  bool is_planar = false;   ///< over nothing else: the filter's business alone
  bool is_changed = false;  ///< since the last match, in a way that the filter doesn't know
  std::uint32_t federate = 0;
  im::Entity entity = 0;  ///< the filter's number, if placed and used for updates
  DimensionSet dimensions;
  im::Region plane;
  std::vector<Range> ranges;        ///< by rank of the dimension; empty if planar
  std::vector<ObjectSlot> objects;  ///< that use it for updates, each once for every association
  std::uint32_t subscription_count = 0;  ///< to object classes or interactions
};

/// What one federate declared; what it is told is its base.
struct DeclaredInterest : FederateInterest {
  struct Regional {
    RegionSlot region = no_region;
    im::Subscriber subscriber = 0;  ///< the filter's number, if placed
    bool is_placed = false, is_planar = false;
    ClassInterest classes;
    Bitmap inside;  ///< entities whose region overlaps in the plane, as of the last match
    std::vector<Bitmap> tiers;  ///< of those, who is in tier 1, 2 ..., as far as there are any
  };
  struct InteractionRegion {
    std::uint16_t interaction_class = 0;
    RegionSlot region = no_region;
    bool is_passive = false;
  };
  ClassInterest everywhere;
  std::vector<Regional> regionals;
  std::vector<InteractionRegion> interactions;
  std::vector<RegionSlot> regions;  ///< by handle
  im::Role role;
  im::Heading heading;
  bool is_changed = false;  ///< subscriptions differ from those of the last match
};

/// May be derived from, to replace some of it. One region per object and one region over X and Y
/// per subscription take the short way: one call of the filter when it moves, one bit when it is
/// asked for.
class Interest : public DataDistribution {
 public:
  Interest(const Fom& fom, const ObjectTable& objects, const Ownership& ownership,
           std::unique_ptr<im::Filter> filter);

  void add_federate(std::uint32_t federate) override;
  void remove_federate(std::uint32_t federate) override;

  bool subscribe(std::uint32_t federate, std::uint16_t object_class, const Subscription& attributes,
                 RegionHandle region) override;
  Subscription subscribed(std::uint32_t federate, std::uint16_t object_class,
                          RegionHandle region) const override;
  Subscription subscribed_anywhere(std::uint32_t federate,
                                   std::uint16_t object_class) const override;
  bool subscribe_interaction(std::uint32_t federate, std::uint16_t interaction_class,
                             RegionHandle region, Listening listening) override;
  Listening subscribes_interaction(std::uint32_t federate,
                                   std::uint16_t interaction_class) const override;
  bool hears(std::uint32_t federate, std::uint16_t interaction_class, std::uint32_t sender,
             std::span<const RegionHandle> sent) override;

  bool has_region(std::uint32_t federate, RegionHandle region) const override;
  bool create_region(std::uint32_t federate, RegionHandle region, DimensionSet dimensions) override;
  DimensionSet dimensions(std::uint32_t federate, RegionHandle region) const override {
    return regions_[slot_of(federate, region)].dimensions;
  }
  bool modify_region(std::uint32_t federate, RegionHandle region,
                     const im::Region& bounds) override;
  void modify_region(std::uint32_t federate, RegionHandle region,
                     std::span<const Range> ranges) override;
  void delete_region(std::uint32_t federate, RegionHandle region) override;

  void associate(std::uint32_t federate, ObjectSlot slot, RegionHandle region) override;
  void associate(std::uint32_t federate, ObjectSlot slot, RegionHandle region,
                 AttributeSet attributes) override;
  void disassociate(std::uint32_t federate, ObjectSlot slot, RegionHandle region,
                    AttributeSet attributes) override;
  AttributeSet overlapping(std::uint32_t federate, RegionHandle region, ObjectSlot slot,
                           AttributeSet attributes) override;

  void object_registered(ObjectSlot slot) override;
  void object_deleted(ObjectSlot slot) override;
  void owner_changed(ObjectSlot slot) override;
  AttributeSet told_actively(std::uint32_t federate, ObjectSlot slot) override;
  void set_role(ObjectSlot slot, const im::Role& role) override;
  void set_federate_role(std::uint32_t federate, const im::Role& role) override;
  void set_federate_heading(std::uint32_t federate, const im::Heading& heading) override;
  void set_flight(ObjectSlot slot, const im::Flight& flight) override;
  void set_time(double now) override;
  void take_turns(std::uint32_t federate) override;
  bool has_budget() const override { return budget_ > 0; }
  void share_out(std::uint32_t federate, const BytesDue& bytes_due) override;

  void match() override;
  const DistributionCounters& counters() const override { return counters_; }
  void list_regions_of_interest(std::vector<RegionOfInterest>& regions) const override;
  const im::Filter& filter() const override { return *filter_; }

 private:
  using Regional = DeclaredInterest::Regional;
  /// Attributes of an object that use a region.
  struct Association {
    RegionSlot region = no_region;
    AttributeSet attributes;
  };
  /// What an object uses. The entity spares those that use one region over the plane alone, nearly
  /// all, a look at the region.
  struct Use {
    RegionSlot region = no_region;  ///< or none, or `several`
    im::Entity entity = no_entity;  ///< if it is planar
  };
  static constexpr RegionSlot several = no_region - 1;
  static constexpr im::Entity no_entity = 0xffffffffu;

  // Regions and who uses them (interest_regions.cpp).
  RegionSlot slot_of(std::uint32_t federate, RegionHandle region) const {
    return federates_[federate]->regions[region.value];
  }
  RegionSlot take_region_slot();
  void tell_filter(const DistributedRegion& region, RegionSlot slot, bool is_new);
  void take_entity(RegionSlot slot);
  void free_entity(RegionSlot slot);
  void use(RegionSlot region, ObjectSlot object);
  void stop_using(RegionSlot region, ObjectSlot object);
  std::vector<Association> associations_of(ObjectSlot object) const;
  void set_associations(ObjectSlot object, std::vector<Association> associations);
  void mark_changed(RegionSlot slot);
  bool ranges_overlap(const DistributedRegion& a, const DistributedRegion& b,
                      DimensionSet dimensions);
  bool regions_overlap(const DistributedRegion& a, const DistributedRegion& b);
  Range range(const DistributedRegion& region, DimensionHandle dimension) const;

  // What the filter is told beside regions (interest_knowledge.cpp).
  void tell_role(RegionSlot slot);
  void tell_subscriber(const DeclaredInterest& interest, im::Subscriber subscriber);
  bool is_own(const DeclaredInterest& interest, ObjectSlot slot) const;

  // Whose turn it is (interest_turns.cpp).
  void set_tier(Regional& regional, im::Entity entity, std::uint32_t tier);
  bool never_waits(const DeclaredInterest& interest, ObjectSlot slot);
  void place_in_tier(DeclaredInterest& interest, ObjectSlot slot, bool is_new);

  // Subscriptions (interest_subscriptions.cpp).
  Regional& regional(DeclaredInterest& interest, RegionSlot region);
  void drop_regional(DeclaredInterest& interest, RegionSlot region);
  void expand(ClassInterest& interest) const;

  // The scope that follows from them (interest.cpp).
  Regional* find(DeclaredInterest& interest, im::Subscriber subscriber);
  bool overlaps(const Regional& regional, RegionSlot update);
  AttributeSet covered(const Regional& regional, ObjectSlot object, AttributeSet attributes);
  template <bool is_active_only = false>
  AttributeSet wanted(const DeclaredInterest& interest, ObjectSlot slot);
  AttributeSet active(const ClassInterest& interest, std::uint16_t object_class) const;
  void touch(ObjectSlot slot) {
    if (watches_scope_) touched_.push_back(slot);
  }
  void take_filter_changes();
  void take_changed_regions();
  void reconsider_around(DeclaredInterest& interest, const Regional& regional);
  void reconsider_all(DeclaredInterest& interest);
  void reconsider(DeclaredInterest& interest, ObjectSlot slot);
  void settle(DeclaredInterest& interest, ObjectSlot slot, AttributeSet was, AttributeSet is);
  bool uniform_classes(const DeclaredInterest& interest, std::vector<AttributeSet>& by_class) const;

  const Fom& fom_;
  const ObjectTable& objects_;
  const Ownership& ownership_;
  std::unique_ptr<im::Filter> filter_;
  const im::Traits traits_;   ///< of it
  const std::size_t budget_;  ///< of its priority [bytes]; 0: none
  std::uint64_t match_ = 0;   ///< number of the last match
  Bitmap put_off_, sent_;     ///< of the federate whose budget is shared out
  DimensionHandle x_, y_;     ///< if the model has both
  DimensionSet plane_;        ///< of these
  std::vector<std::unique_ptr<DeclaredInterest>>
      federates_;                           ///< by federate slot; null where nobody is
  std::vector<DistributedRegion> regions_;  ///< by slot
  std::vector<RegionSlot> free_regions_, changed_regions_,
      unplaced_;  ///< `unplaced_`: used for updates, and lacks X or Y
  std::vector<RegionSlot> region_of_entity_;
  std::vector<im::Entity> free_entities_;
  std::uint32_t unplaced_subscription_count_ = 0;
  std::vector<std::uint32_t> subscribers_;  ///< federate slot, by the filter's number
  std::vector<im::Subscriber> free_subscribers_;
  std::vector<Use> uses_;  ///< by object
  std::unordered_map<ObjectSlot, std::vector<Association>>
      associations_;  ///< of objects that use `several`
  std::vector<ObjectSlot> changed_objects_;
  std::vector<im::Role> roles_;  ///< by object; as long as the last that has one
  DistributionCounters counters_;
};

}  // namespace rink::rti
