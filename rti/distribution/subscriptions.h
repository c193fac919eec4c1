// Each federate's subscriptions, everywhere or within a region, and what the filter last let
// through for each.
#pragma once

#include <cassert>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "im/filter.h"
#include "rti/distribution/data_distribution.h"
#include "rti/distribution/filter_facts.h"
#include "rti/distribution/newcomers.h"
#include "rti/distribution/region_table.h"
#include "rti/federation_settings.h"
#include "rti/objects/bitmap.h"

namespace rink::rti {

/// The attributes of each class that one subscription names, as declared and, once it is taken in,
/// with what subclasses inherit.
struct ClassInterest {
  std::vector<AttributeSet> declared, expanded;  ///< by class
  std::vector<AttributeSet> passive;  ///< those of `declared` that are passive; empty if none is
};

/// What one federate declared.
struct DeclaredInterest {
  struct Regional {
    RegionSlot region = no_region;
    im::Subscriber subscriber = 0;  ///< the filter's number, if placed
    bool is_placed = false, is_planar = false;
    bool is_passed = false;  ///< the filter has its region,
    bool is_new = false;     ///< since the last match
    ClassInterest classes;
    Bitmap inside;  ///< entities whose region overlaps in the plane, as of the last match
    std::vector<Bitmap> tiers;  ///< the part of those in tier 1, 2 ..., as far as there are any
  };
  struct InteractionRegion {
    std::uint16_t interaction_class = 0;
    RegionSlot region = no_region;
    bool is_passive = false;
  };
  std::uint32_t federate = 0;
  ClassInterest everywhere;
  std::vector<Regional> regionals;
  std::vector<InteractionRegion> interactions;
  bool is_changed = false;  ///< subscriptions differ from those of the last match
  bool is_waiting = false;  ///< some were declared and are taken in by a later match (Newcomers)
};

/// Passes the places of subscribers to the filter. Regions are named by their slots.
class Subscriptions {
 public:
  using Regional = DeclaredInterest::Regional;

  /// All must outlive it.
  Subscriptions(const Fom& fom, RegionTable& regions, im::Filter& filter, const FilterFacts& facts,
                std::size_t newcomer_pairs_max = FederationSettings{}.newcomer_pairs_per_match_max);

  void add_federate(std::uint32_t federate);
  /// The federate's regions must be removed before (asserted).
  void remove_federate(std::uint32_t federate);
  const DeclaredInterest& of(std::uint32_t federate) const {
    assert(federate < federates_.size() && federates_[federate]);
    return *federates_[federate];
  }
  /// Calls `visit(declared)` for each federate in order of slots.
  template <class Visit>
  void for_each(Visit visit) const {
    for (const std::unique_ptr<DeclaredInterest>& each : federates_)
      if (each) visit(*each);
  }

  /// Replaces the federate's subscription to the class with the region; `no_region` is everywhere.
  /// What the federate did not subscribe to before may wait for later matches (Newcomers).
  void subscribe(std::uint32_t federate, std::uint16_t object_class, const Subscription& attributes,
                 RegionSlot region);
  Subscription subscribed(std::uint32_t federate, std::uint16_t object_class,
                          RegionSlot region) const;
  Subscription subscribed_anywhere(std::uint32_t federate, std::uint16_t object_class) const;
  void subscribe_interaction(std::uint32_t federate, std::uint16_t interaction_class,
                             RegionSlot region, Listening listening);
  Listening subscribes_interaction(std::uint32_t federate, std::uint16_t interaction_class) const;
  /// Calls `visit(region)` for each region with which the federate subscribes to the class or a
  /// superclass, until it returns true. Returns whether it did.
  template <class Visit>
  bool any_region_of_interaction(std::uint32_t federate, std::uint16_t interaction_class,
                                 Visit visit) const {
    for (const auto& each : federates_[federate]->interactions)
      if (is_a(interaction_class, each.interaction_class) && visit(each.region)) return true;
    return false;
  }
  /// The attributes of a class to which a subscription is not passive.
  AttributeSet active(const ClassInterest& interest, std::uint16_t object_class) const;

  /// Ends all subscriptions of the federate with the region.
  void drop(std::uint32_t federate, RegionSlot region);
  /// The region was committed, for the first time or again: passes the subscribers with it to the
  /// filter, unless they wait.
  void follow(RegionSlot region);
  /// A federate's role or heading has changed: passes it to the filter for all its subscriptions.
  void inform_filter(std::uint32_t federate);
  void inform_headings(std::uint32_t federate);
  void inform_facts(std::uint32_t federate);

  /// The federate whose subscription the filter calls `subscriber`.
  std::uint32_t federate_of(im::Subscriber subscriber) const {
    assert(subscriber < subscribers_.size());
    return subscribers_[subscriber];
  }
  /// The filter lets an entity through, or no longer, or puts it into another tier.
  void take(const im::Change& change, bool decides_tiers);
  /// The filter's number is free now.
  void forget(im::Entity entity);
  /// True if the subscription's region overlaps an update region; where the filter decides, as of
  /// the last match.
  bool is_within(const Regional& regional, RegionSlot update) const;

  /// The federate's whole scope must be computed again.
  void mark_changed(std::uint32_t federate) { federates_[federate]->is_changed = true; }
  /// The scopes of all federates that subscribe with regions must be computed again.
  void mark_regional_changed();
  void clear_changed(std::uint32_t federate) { federates_[federate]->is_changed = false; }

  /// Before the filter matches: takes in those that wait, as many as there is room for.
  void admit_waiting();
  /// After the filter's changes were taken.
  void end_match();
  /// Federates with subscriptions that wait.
  std::size_t waiting_count() const { return newcomers_.waiting_count(); }

  /// Appends every region of the plane that a federate subscribes with and has committed.
  void list_regions(std::vector<RegionOfInterest>& regions) const;

 private:
  bool is_a(std::uint16_t interaction_class, std::uint16_t superclass) const;
  void expand(ClassInterest& interest) const;
  AttributeSet inherited(const ClassInterest& interest, std::uint16_t object_class) const;
  bool is_expanded(const ClassInterest& interest) const;
  std::size_t object_count(std::uint16_t object_class) const;
  std::size_t pairs_of(const Regional& regional) const;
  std::size_t pairs_of(const DeclaredInterest& interest) const;
  std::size_t pairs_looked_at(const DeclaredInterest& interest) const;
  void pass(const DeclaredInterest& interest, Regional& regional);
  void wait(DeclaredInterest& interest);
  void take_in(DeclaredInterest& interest);
  Regional& regional(DeclaredInterest& interest, RegionSlot region);
  void number(DeclaredInterest& interest, Regional& added);
  void drop_regional(DeclaredInterest& interest, RegionSlot region);

  const Fom& fom_;
  RegionTable& regions_;
  im::Filter& filter_;
  const FilterFacts& facts_;
  std::vector<std::unique_ptr<DeclaredInterest>> federates_;  ///< by slot; null in free slots
  std::vector<std::uint32_t> subscribers_;  ///< federate slot, by the filter's number
  std::vector<im::Subscriber> free_subscribers_;
  Newcomers newcomers_;
  struct Passed {
    std::uint32_t federate;
    RegionSlot region;
  };
  std::vector<Passed> passed_;  ///< to the filter since the last match, for the first time
  double passed_area_ = 0.0;    ///< of these [m^2]
  std::size_t found_ = 0;       ///< entities that the filter let through for them
};

}  // namespace rink::rti
