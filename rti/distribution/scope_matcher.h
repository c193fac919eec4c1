// The scope that follows from subscriptions and regions: which attributes of which objects,
// computed again where something changed.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rti/distribution/data_distribution.h"
#include "rti/distribution/region_table.h"
#include "rti/distribution/scopes.h"
#include "rti/distribution/subscriptions.h"
#include "rti/distribution/turn_planner.h"
#include "rti/ownership/ownership.h"

namespace rink::rti {

/// A subscription with one region over X and Y to objects with one region each is the fast case:
/// one bit for each pair.
class ScopeMatcher {
 public:
  /// The inputs of the decision, and the scopes that it is written to; all must outlive the
  /// matcher.
  struct Parts {
    const ObjectTable& objects;
    const Ownership& ownership;
    RegionTable& regions;
    Subscriptions& subscriptions;
    const FilterFacts& facts;
    const TurnPlanner& turns;
    Scopes& scopes;
    DistributionCounters& counters;
  };
  explicit ScopeMatcher(const Parts& parts) : parts_(parts) {}

  /// Computes the changes of scope that follow from the filter's changes and from those of
  /// subscriptions and regions since the last match. `changed` are the objects that differ from
  /// then; it is emptied.
  void match(std::span<const im::Change> changes, std::vector<ObjectSlot>& changed);
  /// See `DataDistribution`.
  AttributeSet actively_in_scope(std::uint32_t federate, ObjectSlot slot) const;

 private:
  using Regional = DeclaredInterest::Regional;

  void apply_filter_changes(std::span<const im::Change> changes);
  void prompt(const im::Change& change);
  void apply_changed_regions(std::vector<ObjectSlot>& changed);
  void reconsider_around(const DeclaredInterest& declared, const Regional& regional);
  void reconsider_all(const DeclaredInterest& declared);
  void reconsider(const DeclaredInterest& declared, ObjectSlot slot);
  void settle(const DeclaredInterest& declared, FederateInterest& interest, ObjectSlot slot,
              AttributeSet is);
  template <bool is_active_only = false>
  AttributeSet wanted(const DeclaredInterest& declared, ObjectSlot slot) const;
  AttributeSet covered(const Regional& regional, ObjectSlot object, AttributeSet attributes) const;
  void list_candidates(const DeclaredInterest& declared);
  bool uniform_classes(const DeclaredInterest& declared, std::vector<AttributeSet>& by_class) const;

  const Parts parts_;
  Bitmap candidates_;  ///< of the federate at hand; a member to reuse its memory
};

}  // namespace rink::rti
