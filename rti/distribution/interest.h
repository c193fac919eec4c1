// The RTI's own data distribution: subscriptions, regions over any dimensions, and a filter that
// decides in the plane of X and Y.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "rti/distribution/data_distribution.h"
#include "rti/distribution/filter_facts.h"
#include "rti/distribution/region_table.h"
#include "rti/distribution/scope_matcher.h"
#include "rti/distribution/scopes.h"
#include "rti/distribution/subscriptions.h"
#include "rti/distribution/turn_planner.h"
#include "rti/ownership/ownership.h"

namespace rink::rti {

/// Forwards every service to its part, and to a second one where a change concerns two. Users may
/// derive from it to replace some of it.
class Interest : public DataDistribution {
 public:
  Interest(const Fom& fom, const ObjectTable& objects, const Ownership& ownership,
           std::unique_ptr<im::Filter> filter,
           std::size_t newcomer_pairs_max = FederationSettings{}.newcomer_pairs_per_match_max);
  Interest(const Interest&) = delete;
  Interest& operator=(const Interest&) = delete;

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
  bool receives(std::uint32_t federate, std::uint16_t interaction_class, std::uint32_t sender,
                std::span<const RegionHandle> sent) override;

  bool has_region(std::uint32_t federate, RegionHandle region) const override;
  bool create_region(std::uint32_t federate, RegionHandle region, DimensionSet dimensions) override;
  DimensionSet dimensions(std::uint32_t federate, RegionHandle region) const override;
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
  AttributeSet actively_in_scope(std::uint32_t federate, ObjectSlot slot) override;
  void set_role(ObjectSlot slot, const im::Role& role) override;
  void set_federate_role(std::uint32_t federate, const im::Role& role) override;
  void set_federate_heading(std::uint32_t federate, const im::Heading& heading) override;
  void set_flight(ObjectSlot slot, const im::Flight& flight) override;
  void set_facts(ObjectSlot slot, const im::Facts& facts) override;
  void set_federate_facts(std::uint32_t federate, const im::Facts& facts) override;
  void set_time(double now) override { facts_.set_time(now); }
  void object_updated(ObjectSlot slot) override;
  void plan_turns(std::uint32_t federate) override { planner_.plan_turns(scopes_.of(federate)); }
  bool has_budget() const override { return planner_.has_budget(); }
  void share_out(std::uint32_t federate, const BytesDue& bytes_due) override;

  void match() override;
  const DistributionCounters& counters() const override { return counters_; }
  void list_regions_of_interest(std::vector<RegionOfInterest>& regions) const override;
  const im::Filter& filter() const override { return *filter_; }
  /// For who keeps the state of a federation (rti/save).
  const RegionTable& regions() const { return regions_; }
  const Subscriptions& subscriptions() const { return subscriptions_; }

 private:
  void take(const Reassociation& change);
  void follow(std::uint32_t federate, RegionHandle region, Commit commit);

  const std::size_t class_count_;
  std::unique_ptr<im::Filter> filter_;
  DistributionCounters counters_;
  Scopes scopes_;
  FilterFacts facts_;
  RegionTable regions_;
  Subscriptions subscriptions_;
  TurnPlanner planner_;
  ScopeMatcher matcher_;
  std::vector<ObjectSlot> changed_objects_;  ///< since the last match, in order
};

}  // namespace rink::rti
