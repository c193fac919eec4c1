// Tiers, bounds and budgets: which objects in scope are not updated yet.
#pragma once

#include <cstddef>
#include <cstdint>

#include "im/filter.h"
#include "rti/distribution/data_distribution.h"
#include "rti/distribution/subscriptions.h"

namespace rink::rti {

/// For filters that decide tiers, hold updates back or have a budget; with others no object waits.
class TurnPlanner {
 public:
  /// All must outlive it.
  TurnPlanner(im::Filter& filter, const ObjectTable& objects, const RegionTable& regions,
              const Subscriptions& subscriptions, const FilterFacts& facts);

  bool decides_tiers() const { return decides_tiers_; }
  bool holds_updates() const { return holds_updates_; }
  bool has_budget() const { return budget_ > 0; }
  /// True if federates have turns at all.
  bool is_needed() const { return places_objects() || has_budget(); }
  /// True if `place` has something to say.
  bool places_objects() const { return decides_tiers_ || holds_updates_; }

  void begin_match() { ++match_; }
  /// Puts an object in scope into the nearest tier in which some subscription has it, and among
  /// those that are held; into none if the filter does not decide on one of the subscriptions.
  void place(Turns& turns, const DeclaredInterest& declared, ObjectSlot slot, bool is_new) const;
  /// See `DataDistribution`.
  void plan_turns(FederateInterest& interest) const;
  void share_out(FederateInterest& interest, const DataDistribution::BytesDue& bytes_due);

 private:
  bool never_waits(const DeclaredInterest& declared, ObjectSlot slot) const;
  bool is_held(const DeclaredInterest& declared, ObjectSlot slot) const;
  std::uint32_t tier_of(const DeclaredInterest& declared, ObjectSlot slot) const;
  void list(const DeclaredInterest& declared, im::Entity entity, Bitmap& objects) const;
  void fill(const FederateInterest& interest, const DataDistribution::BytesDue& bytes_due,
            std::size_t budget);

  im::Filter& filter_;
  const ObjectTable& objects_;
  const RegionTable& regions_;
  const Subscriptions& subscriptions_;
  const FilterFacts& facts_;
  const bool decides_tiers_, holds_updates_;
  const std::size_t budget_;  ///< of the filter's priority [bytes]; 0: none
  std::uint64_t match_ = 0;   ///< number of the last match
  Bitmap put_off_, sent_;     ///< of the federate whose budget is shared out; members to reuse
                              ///< their memory
};

}  // namespace rink::rti
