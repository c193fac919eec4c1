// The seam of data distribution: who receives which object and interaction, as
// `FederationExecution` asks it. `Interest` is the one that comes with the RTI.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "im/filter.h"
#include "rti/distribution/scopes.h"
#include "rti/objects/object_table.h"
#include "rti/types.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

/// The change that a message makes to a class's attributes and the regions that follow.
enum class RegionAction : std::uint8_t { remove, add, request_update, add_passively };

/// Attributes of a class that a federate subscribes to, and those of them that count for advisories
/// since they are not subscribed passively (IEEE 1516.1-2010, 5.8).
struct Subscription {
  AttributeSet subscribed, active;
  friend bool operator==(const Subscription&, const Subscription&) = default;
  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, subscribed, active);
  }
};
/// How a federate subscribes to an interaction class; the numbers are those on the wire.
enum class Listening : std::uint8_t { none, active, passive };

/// A region that a federate subscribes with, as it last committed it.
struct RegionOfInterest {
  std::uint32_t federate = 0;  ///< slot
  im::Region bounds;
};

/// What a data distribution did since it was made; a test proves by it that what does not change
/// costs nothing.
struct DistributionCounters {
  std::uint64_t regions_changed = 0;  ///< commits that changed a region
  std::uint64_t pairs_reconsidered =
      0;                            ///< (federate, object) pairs whose scope was computed again
  std::uint64_t ranges_tested = 0;  ///< pairs of ranges compared outside the filter
  std::uint64_t entries = 0, exits = 0;  ///< objects that came into and went out of scope
};

/// Federates are dense slots, as in the federation execution; regions are named by their maker and
/// its own handle. All arguments have been checked: classes, attributes and dimensions exist,
/// ranges are finite and not inverted. A region that was never committed overlaps nothing; what has
/// no region is of the default region, which overlaps all.
class DataDistribution {
 public:
  virtual ~DataDistribution() = default;

  virtual void add_federate(std::uint32_t federate) = 0;
  /// Removes the federate with its regions and subscriptions.
  virtual void remove_federate(std::uint32_t federate) = 0;
  /// What `match` decided for the federate; valid until it is removed.
  FederateInterest& of(std::uint32_t federate) { return scopes_.of(federate); }
  const FederateInterest& of(std::uint32_t federate) const { return scopes_.of(federate); }

  /// Replaces the federate's subscription to the class with the region; an empty handle is the
  /// default region. False if the region does not exist.
  virtual bool subscribe(std::uint32_t federate, std::uint16_t object_class,
                         const Subscription& attributes, RegionHandle region) = 0;
  /// The federate's present subscription to the class with the region.
  virtual Subscription subscribed(std::uint32_t federate, std::uint16_t object_class,
                                  RegionHandle region) const = 0;
  /// All attributes of the class that the federate subscribes to, in any region, superclasses
  /// included.
  virtual Subscription subscribed_anywhere(std::uint32_t federate,
                                           std::uint16_t object_class) const = 0;
  /// Subscribes to one interaction class within a region; false if the region does not exist.
  virtual bool subscribe_interaction(std::uint32_t federate, std::uint16_t interaction_class,
                                     RegionHandle region, Listening listening) = 0;
  /// How the federate subscribes to the class or a superclass with any region.
  virtual Listening subscribes_interaction(std::uint32_t federate,
                                           std::uint16_t interaction_class) const = 0;
  /// True if a region with which the federate subscribes to the class overlaps one of the sender's,
  /// as they are committed now.
  virtual bool receives(std::uint32_t federate, std::uint16_t interaction_class,
                        std::uint32_t sender, std::span<const RegionHandle> sent) = 0;

  virtual bool has_region(std::uint32_t federate, RegionHandle region) const = 0;
  /// False if the handle is in use or leaves a gap. Without dimensions: over the plane.
  virtual bool create_region(std::uint32_t federate, RegionHandle region,
                             DimensionSet dimensions) = 0;
  virtual DimensionSet dimensions(std::uint32_t federate, RegionHandle region) const = 0;
  /// False if there is no such region, or it is not over the plane alone. The one call for a moved
  /// region of the plane: a crowd makes thousands a tick.
  virtual bool modify_region(std::uint32_t federate, RegionHandle region,
                             const im::Region& bounds) = 0;
  /// `ranges` has one range for each of the region's dimensions in ascending order.
  virtual void modify_region(std::uint32_t federate, RegionHandle region,
                             std::span<const Range> ranges) = 0;
  /// Ends the subscriptions with the region; attributes that used it have the default region again
  /// unless they have other regions.
  virtual void delete_region(std::uint32_t federate, RegionHandle region) = 0;

  /// All attributes of the object use the region alone; an empty handle gives them back to the
  /// default region.
  virtual void associate(std::uint32_t federate, ObjectSlot slot, RegionHandle region) = 0;
  /// Adds the region to those of `attributes`, or takes it away.
  virtual void associate(std::uint32_t federate, ObjectSlot slot, RegionHandle region,
                         AttributeSet attributes) = 0;
  virtual void disassociate(std::uint32_t federate, ObjectSlot slot, RegionHandle region,
                            AttributeSet attributes) = 0;
  /// Those of `attributes` whose regions overlap `region`, as they are committed now; attributes of
  /// the default region always do.
  virtual AttributeSet overlapping(std::uint32_t federate, RegionHandle region, ObjectSlot slot,
                                   AttributeSet attributes) = 0;

  virtual void object_registered(ObjectSlot slot) = 0;
  /// The object is in no federate's scope any more; it stays in `known` of those that discovered
  /// it.
  virtual void object_deleted(ObjectSlot slot) = 0;
  /// Some of the object's attributes have another owner than at the last match. Its regions stay
  /// until the new owner associates its own, or their maker deletes them or leaves: falling back to
  /// the default region meanwhile would show every body that changes owners to every federate.
  virtual void owner_changed(ObjectSlot slot) = 0;

  /// What the filter may know beside regions (docs/rti.md, "What a filter knows beside regions").
  /// The role of an object is that of the regions which it uses for updates: objects that share one
  /// have the role that they agree in. An object whose owner has the number of a federate's owner
  /// is always in scope of that federate's subscriptions with regions, whatever the filter decides.
  /// Roles last until the federate or object is removed.
  virtual void set_role(ObjectSlot, const im::Role&) {}
  virtual void set_federate_role(std::uint32_t /*federate*/, const im::Role&) {}

  /// The direction in which a federate looks, the motion of an object, and the time [s]; each holds
  /// until it is set again or a region is committed.
  virtual void set_federate_heading(std::uint32_t /*federate*/, const im::Heading&) {}
  virtual void set_flight(ObjectSlot, const im::Flight&) {}
  /// What conditions may ask. Those of an object hold while its region is committed, those of a
  /// federate until it is removed.
  virtual void set_facts(ObjectSlot, const im::Facts&) {}
  virtual void set_federate_facts(std::uint32_t /*federate*/, const im::Facts&) {}
  virtual void set_time(double /*now*/) {}
  /// Some attributes of the object were updated, which filters that hold updates back count.
  virtual void object_updated(ObjectSlot) {}

  /// For filters that decide tiers, hold updates back or have a budget: fills `turns->waiting` with
  /// the objects that this flush leaves out because their tier's turn has not come. Called once for
  /// each flush of a federate that has `turns`.
  virtual void plan_turns(std::uint32_t /*federate*/) {}
  /// Adds the objects that do not fit into the budget; `bytes_due(object)` is what sending one
  /// takes, 0 if nothing is due. False if there is no budget.
  using BytesDue = std::function<std::size_t(ObjectSlot)>;
  virtual bool has_budget() const { return false; }
  virtual void share_out(std::uint32_t /*federate*/, const BytesDue&) {}

  /// The attributes of an object that the last match put in the federate's scope by subscriptions
  /// that are not passive.
  virtual AttributeSet actively_in_scope(std::uint32_t federate, ObjectSlot slot) = 0;
  /// See Scopes.
  void watch_scope(bool is_watched) { scopes_.watch(is_watched); }
  std::vector<ObjectSlot>& touched() { return scopes_.touched(); }

  /// Turns all changes since the last match into changes of scope.
  virtual void match() = 0;

  virtual const DistributionCounters& counters() const = 0;
  /// Appends every region of the plane that a federate subscribes with and has committed.
  virtual void list_regions_of_interest(std::vector<RegionOfInterest>& regions) const = 0;
  /// The filter that decides in the plane, for displays.
  virtual const im::Filter& filter() const = 0;

 protected:
  /// `scopes`, which the derived class owns and writes, are read at every flush of every federate:
  /// asking for them is no virtual call.
  explicit DataDistribution(Scopes& scopes) : scopes_(scopes) {}

 private:
  Scopes& scopes_;
};

}  // namespace rink::rti
