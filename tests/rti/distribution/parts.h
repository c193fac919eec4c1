// What a data distribution is made of, put together by hand around a filter that lets through what
// a test says.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "rti/distribution/scope_matcher.h"
#include "tests/rti/distribution/told_filter.h"

namespace rink::rti {

/// Federate 0 owns a body and a puck, each with a region of its own; federate 1 subscribes.
struct Parts {
  explicit Parts(const im::Traits& traits = {}, std::size_t budget = 0,
                 std::size_t newcomer_pairs_max = 1000)
      : filter(traits, budget),
        subscriptions(plain_fom(), regions, filter, facts, newcomer_pairs_max) {
    for (const std::uint32_t federate : {0u, 1u}) {
      facts.add_federate(federate);
      regions.add_federate(federate);
      subscriptions.add_federate(federate);
      FederateInterest& interest = scopes.add(federate);
      interest.by_class.resize(plain_fom().object_classes().size());
      if (turns.is_needed()) interest.turns = std::make_unique<Turns>();
    }
    for (const std::uint16_t object_class : {body_class, puck_class}) add_object(object_class);
  }
  ObjectSlot add_object(std::uint16_t object_class) {
    const ObjectSlot slot = objects.insert({objects.slot_count()}, 0, object_class, "");
    regions.add_object(slot);
    changed.push_back(slot);
    regions.create(0, {slot}, {});
    regions.modify(0, {slot}, im::Region{0, 0, 1, 1});
    regions.associate(slot, regions.slot_of(0, {slot}));
    return slot;
  }
  /// Of federate 1.
  RegionSlot view(RegionHandle handle = {0}) {
    regions.create(1, handle, {});
    regions.modify(1, handle, im::Region{0, 0, 9, 9});
    return regions.slot_of(1, handle);
  }
  void match(std::vector<im::Change> changes = {}) {
    filter.changes = std::move(changes);
    matcher.match(filter.match(), changed);
  }
  const FederateInterest& told() { return scopes.of(1); }
  /// For the subscription of federate 1 with its region number `view_number`.
  im::Change change(im::Transition transition, ObjectSlot slot, std::uint8_t tier = 0,
                    std::size_t view_number = 0) {
    return {.subscriber = subscriptions.of(1).regionals.at(view_number).subscriber,
            .entity = regions.use_of(slot).entity,
            .transition = transition,
            .tier = tier};
  }

  ObjectTable objects{plain_fom()};
  Ownership ownership{plain_fom(), objects};
  ToldFilter filter;
  FilterFacts facts{filter};
  DistributionCounters counters;
  RegionTable regions{plain_fom(), objects, filter, facts, counters};
  Subscriptions subscriptions;
  TurnPlanner turns{filter, objects, regions, subscriptions, facts};
  Scopes scopes;
  ScopeMatcher matcher{{.objects = objects,
                        .ownership = ownership,
                        .regions = regions,
                        .subscriptions = subscriptions,
                        .facts = facts,
                        .turns = turns,
                        .scopes = scopes,
                        .counters = counters}};
  std::vector<ObjectSlot> changed;
  const AttributeSet both = plain_fom().attributes({body_class}), one{AttributeHandle{0}};
};

}  // namespace rink::rti
