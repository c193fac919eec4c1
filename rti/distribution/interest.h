// Data distribution: who hears of which object, decided once per match from subscriptions, regions and the filter.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "im/filter.h"
#include "rti/objects/bitmap.h"
#include "rti/objects/object_table.h"
#include "rti/ownership/ownership.h"

namespace rink::rti {

/// The attributes of each class that one subscription names, as declared and with what subclasses inherit.
struct ClassInterest {
  std::vector<AttributeSet> declared, expanded;  ///< by class
};

/// A change that a federate has not been told yet.
struct ScopeEvent {
  ObjectSlot slot;
  im::Transition transition;
};

/// What one federate wants and what it is told.
struct FederateInterest {
  struct Regional {
    RegionHandle region;
    im::Subscriber subscriber = 0;  ///< the filter's number
    ClassInterest classes;
    Bitmap inside;                  ///< objects whose region overlaps, as of the last match
  };
  struct Region {
    bool exists = false, has_bounds = false;
    im::Region bounds;
    std::vector<ObjectSlot> objects;  ///< those that use it for updates
  };
  std::uint32_t federate = 0;
  ClassInterest everywhere;
  std::vector<Regional> regionals;
  std::vector<Region> regions;          ///< by handle
  bool is_changed = false;              ///< subscriptions differ from those of the last match

  Bitmap known;                         ///< discovered and not removed
  Bitmap in_scope;                      ///< of the last match
  Bitmap fresh;                         ///< came into scope since the last flush: the whole state is due
  bool has_fresh = false;
  std::vector<ScopeEvent> events;       ///< since the last flush
  bool is_uniform = true;               ///< all of a class's objects in scope have the same attributes: `by_class`; else `by_object`
  std::vector<AttributeSet> by_class, by_object;

  /// What it is told of an object.
  AttributeSet told(ObjectSlot slot, std::uint16_t object_class) const {
    if (!in_scope.contains(slot)) return {};
    return is_uniform ? by_class[object_class] : by_object[slot];
  }
};

/// Federates are dense slots, as in the federation execution.
class Interest {
 public:
  Interest(const Fom& fom, ObjectTable& objects, const Ownership& ownership, std::unique_ptr<im::Filter> filter);

  void add_federate(std::uint32_t federate);
  /// What it owned must be gone or have another owner; objects that still use its regions return to the default region.
  void remove_federate(std::uint32_t federate);
  FederateInterest& of(std::uint32_t federate) { return *federates_[federate]; }
  const FederateInterest& of(std::uint32_t federate) const { return *federates_[federate]; }

  /// False if the region does not exist.
  bool subscribe(std::uint32_t federate, std::uint16_t object_class, AttributeSet attributes, RegionHandle region);

  bool has_region(std::uint32_t federate, RegionHandle region) const;
  /// False if the handle is in use or leaves a gap.
  bool create_region(std::uint32_t federate, RegionHandle region);
  void modify_region(std::uint32_t federate, RegionHandle region, const im::Region& bounds);
  void delete_region(std::uint32_t federate, RegionHandle region);
  /// `federate` is whose region it is, and should own what the region is for.
  void associate(std::uint32_t federate, ObjectSlot slot, RegionHandle region);

  void object_registered(ObjectSlot slot) { changed_objects_.push_back(slot); }
  /// Some of its attributes have another owner than at the last match. Its region stays until the new owner associates its own, or its maker deletes it or leaves:
  /// falling back to the default region meanwhile would show every body that is handed over to everybody.
  void owner_changed(ObjectSlot slot) { changed_objects_.push_back(slot); }
  /// Nobody hears of it any more; who knew it still has it in `known`.
  void object_deleted(ObjectSlot slot);

  void match();
  const im::Filter& filter() const { return *filter_; }
  std::uint64_t entries() const { return entries_; }
  std::uint64_t exits() const { return exits_; }

 private:
  FederateInterest::Regional& regional(FederateInterest& interest, RegionHandle region);
  FederateInterest::Regional* find(FederateInterest& interest, im::Subscriber subscriber);
  void drop_regional(FederateInterest& interest, RegionHandle region);
  void expand(ClassInterest& interest) const;
  void leave_region(ObjectSlot slot);
  void forget(ObjectSlot slot);
  AttributeSet wanted(const FederateInterest& interest, ObjectSlot slot) const;
  void take_filter_changes();
  void reconsider_all(FederateInterest& interest);
  void reconsider(FederateInterest& interest, ObjectSlot slot);
  void settle(FederateInterest& interest, ObjectSlot slot, AttributeSet was, AttributeSet is);
  bool uniform_classes(const FederateInterest& interest, std::vector<AttributeSet>& by_class) const;

  const Fom& fom_;
  ObjectTable& objects_;
  const Ownership& ownership_;
  std::unique_ptr<im::Filter> filter_;
  std::vector<std::unique_ptr<FederateInterest>> federates_;  ///< by federate slot; null where nobody is
  std::vector<std::uint32_t> subscribers_;                    ///< federate slot, by the filter's number
  std::vector<im::Subscriber> free_subscribers_;
  std::vector<ObjectSlot> changed_objects_;
  std::uint64_t entries_ = 0, exits_ = 0;
};

}  // namespace rink::rti
