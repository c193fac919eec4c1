// The scope that follows from subscriptions and regions: which attributes of which objects, worked
// out again where something changed.
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

/// One region per object and one region over X and Y per subscription take the short way: one bit
/// when it is asked for.
class ScopeMatcher {
 public:
  /// What decides, and where the decision is written; all must outlive the matcher.
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

  /// Works out what follows from the filter's changes, and from all that was said since the last
  /// match; empties `changed`, the objects of which something is another than then.
  void match(std::span<const im::Change> changes, std::vector<ObjectSlot>& changed);
  /// See DataDistribution.
  AttributeSet actively_in_scope(std::uint32_t federate, ObjectSlot slot) const;

 private:
  using Regional = DeclaredInterest::Regional;

  void apply_filter_changes(std::span<const im::Change> changes);
  void apply_changed_regions(std::vector<ObjectSlot>& changed);
  void reconsider_around(const DeclaredInterest& declared, const Regional& regional);
  void reconsider_all(const DeclaredInterest& declared);
  void reconsider(const DeclaredInterest& declared, ObjectSlot slot);
  void settle(const DeclaredInterest& declared, FederateInterest& interest, ObjectSlot slot,
              AttributeSet is);
  template <bool is_active_only = false>
  AttributeSet wanted(const DeclaredInterest& declared, ObjectSlot slot) const;
  AttributeSet covered(const Regional& regional, ObjectSlot object, AttributeSet attributes) const;
  bool uniform_classes(const DeclaredInterest& declared, std::vector<AttributeSet>& by_class) const;

  const Parts parts_;
};

}  // namespace rink::rti
