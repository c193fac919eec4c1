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

namespace rink::rti {

/// What is to be done with a class's attributes and the regions that follow.
enum class RegionAction : std::uint8_t { remove, add, request_update, add_passively };

/// Attributes of a class that somebody subscribes to, and those of them that count for advisories:
/// not subscribed passively (IEEE 1516.1-2010, 5.8).
struct Subscription {
  AttributeSet subscribed, active;
  friend bool operator==(const Subscription&, const Subscription&) = default;
};
/// How somebody subscribes to an interaction class; the numbers are those on the wire.
enum class Listening : std::uint8_t { none, active, passive };

/// Where a federate subscribes, as it last committed it.
struct RegionOfInterest {
  std::uint32_t federate = 0;  ///< slot
  im::Region bounds;
};

/// What a data distribution did since it was made: the proof that what does not change costs
/// nothing.
struct DistributionCounters {
  std::uint64_t regions_changed = 0;  ///< commits that changed a region
  std::uint64_t pairs_reconsidered =
      0;                            ///< (federate, object) pairs whose scope was worked out again
  std::uint64_t ranges_tested = 0;  ///< pairs of ranges compared outside the filter
  std::uint64_t entries = 0, exits = 0;  ///< objects that came into and went out of scope
};

/// Federates are dense slots, as in the federation execution; regions are named by their maker and
/// its own handle. All that is handed in has been checked: classes, attributes and dimensions
/// exist, ranges are finite and not inverted. A region that was never committed overlaps nothing;
/// what has no region is of the default region, which overlaps all.
class DataDistribution {
 public:
  virtual ~DataDistribution() = default;

  virtual void add_federate(std::uint32_t federate) = 0;
  /// Its regions and subscriptions end.
  virtual void remove_federate(std::uint32_t federate) = 0;
  /// What `match` decided for it; valid until it is removed.
  FederateInterest& of(std::uint32_t federate) { return scopes_.of(federate); }
  const FederateInterest& of(std::uint32_t federate) const { return scopes_.of(federate); }

  /// Replaces what it named for the class and region before; an empty handle is the default region.
  /// False if the region does not exist.
  virtual bool subscribe(std::uint32_t federate, std::uint16_t object_class,
                         const Subscription& attributes, RegionHandle region) = 0;
  /// What it names for the class and region now.
  virtual Subscription subscribed(std::uint32_t federate, std::uint16_t object_class,
                                  RegionHandle region) const = 0;
  /// All that it subscribes of a class, in whatever region, superclasses included.
  virtual Subscription subscribed_anywhere(std::uint32_t federate,
                                           std::uint16_t object_class) const = 0;
  /// To one interaction class within a region; false if the region does not exist.
  virtual bool subscribe_interaction(std::uint32_t federate, std::uint16_t interaction_class,
                                     RegionHandle region, Listening listening) = 0;
  /// How it subscribes to the class or a superclass with any region.
  virtual Listening subscribes_interaction(std::uint32_t federate,
                                           std::uint16_t interaction_class) const = 0;
  /// True if a region that it subscribes to the class with overlaps one of the sender's, as they
  /// are committed now.
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
  /// One range for each of its dimensions in ascending order.
  virtual void modify_region(std::uint32_t federate, RegionHandle region,
                             std::span<const Range> ranges) = 0;
  /// Its subscriptions end; what used it is of the default region again, unless it has other
  /// regions.
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
  /// Some of its attributes have another owner than at the last match. Its regions stay until the
  /// new owner associates its own, or their maker deletes them or leaves: falling back to the
  /// default region meanwhile would show every body that is handed over to everybody.
  virtual void owner_changed(ObjectSlot slot) = 0;

  /// What the filter may know beside regions (docs/rti.md, "What a filter knows beside regions").
  /// The role of an object is that of the regions which it uses for updates: of objects that share
  /// one, what they agree in. Whose owner has the number of a federate's is always in scope of what
  /// that federate subscribes to with regions, whatever the filter says. Both last until who has
  /// them is gone.
  virtual void set_role(ObjectSlot, const im::Role&) {}
  virtual void set_federate_role(std::uint32_t /*federate*/, const im::Role&) {}

  /// Where a federate looks, how an object moves on, and which time it is [s]; each until it is
  /// said anew or a region handed in.
  virtual void set_federate_heading(std::uint32_t /*federate*/, const im::Heading&) {}
  virtual void set_flight(ObjectSlot, const im::Flight&) {}
  virtual void set_time(double /*now*/) {}

  /// Of filters that say tiers, or have a budget: fills `turns->waiting` with who is not to be told
  /// of by the flush at hand, for the tier's turn has not come. Asked once for each flush of a
  /// federate that has `turns`.
  virtual void plan_turns(std::uint32_t /*federate*/) {}
  /// Adds to it who does not fit into the budget; `bytes_due(object)` are what telling of one
  /// takes, 0 if nothing is to be told. False if there is no budget.
  using BytesDue = std::function<std::size_t(ObjectSlot)>;
  virtual bool has_budget() const { return false; }
  virtual void share_out(std::uint32_t /*federate*/, const BytesDue&) {}

  /// Those of an object's attributes that the last match put in its scope by subscriptions that are
  /// not passive.
  virtual AttributeSet actively_in_scope(std::uint32_t federate, ObjectSlot slot) = 0;
  /// See Scopes.
  void watch_scope(bool is_watched) { scopes_.watch(is_watched); }
  std::vector<ObjectSlot>& touched() { return scopes_.touched(); }

  /// Turns all that was said since the last match into changes of scope.
  virtual void match() = 0;

  virtual const DistributionCounters& counters() const = 0;
  /// Appends every region of the plane that a federate subscribes with and has committed.
  virtual void list_regions_of_interest(std::vector<RegionOfInterest>& regions) const = 0;
  /// The filter that decides in the plane; for who shows it.
  virtual const im::Filter& filter() const = 0;

 protected:
  /// `scopes`, which the derived class owns and writes, are read at every flush of every federate:
  /// asking for them is no virtual call.
  explicit DataDistribution(Scopes& scopes) : scopes_(scopes) {}

 private:
  Scopes& scopes_;
};

}  // namespace rink::rti
