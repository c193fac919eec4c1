// Regions over one to four dimensions: their effect by the standard's definition, what they cost,
// and who is dropped for naming what is none.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "rti/distribution/interest.h"
#include "rti/wire/region_messages.h"
#include "tests/rti/rig.h"
#include "tests/rti/scenes/airspace.h"
#include "tests/rti/scenes/random_airspace.h"

namespace rink::rti::testing {
namespace {

TEST(Regions, ScopeAndInteractionsFollowTheStandardsDefinitionInRandomFederations) {
  constexpr unsigned seed_count = 2000;
  for (unsigned seed = 1; seed <= seed_count && !::testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Airspace space(seed, 2 + static_cast<int>(seed % 3));
    for (int step = 0; step < 6 && !::testing::Test::HasFailure(); ++step) {
      space.step();
      space.expect_scope_is_due();
      space.expect_updates_are_due(static_cast<float>(step));
      space.expect_calls_are_due();
    }
  }
}

TEST(Regions, AChangedRegionTakesEffectWithinOneTickInEveryDimension) {
  for (const DimensionHandle moved : {x, y, altitude, channel}) {
    SCOPED_TRACE(airspace().at(moved).name);
    Airspace space(1, 2);
    Pilot &owner = space.pilots()[0], &watcher = space.pilots()[1];
    const DimensionSet all{x, y, altitude, channel};
    const RegionHandle update = owner.ambassador.create_region(all),
                       view = watcher.ambassador.create_region(all);
    all.for_each([&](DimensionHandle each) {
      owner.ambassador.set_range_bounds(update, each, {1.0, 2.0});
      watcher.ambassador.set_range_bounds(view, each, {1.0, 2.0});
    });
    const AttributeRegions published{AttributeSet{where}, {update}},
        wanted{AttributeSet{where}, {view}};
    owner.ambassador.register_object_instance_with_regions(aircraft, std::span(&published, 1));
    watcher.ambassador.subscribe_object_class_attributes_with_regions(aircraft,
                                                                      std::span(&wanted, 1));
    owner.ambassador.commit_region_modifications(update);
    watcher.ambassador.commit_region_modifications(view);
    space.tick();
    ASSERT_EQ(watcher.heard.objects.size(), 1u);
    const Recorder::Known& known = watcher.heard.objects.begin()->second;
    EXPECT_TRUE(known.is_in_scope);
    watcher.ambassador.set_range_bounds(view, moved, {4.0, 5.0});
    space.tick();
    EXPECT_TRUE(known.is_in_scope) << "set, but not committed";
    watcher.ambassador.commit_region_modifications(view);
    space.tick();
    EXPECT_FALSE(known.is_in_scope);
    owner.ambassador.set_range_bounds(update, moved, {4.0, 5.0});
    owner.ambassador.commit_region_modifications(update);
    space.tick();
    EXPECT_TRUE(known.is_in_scope);
  }
}

TEST(Regions, UnchangedRegionsCostNothing) {
  Airspace space(7, 4);
  for (int step = 0; step < 20; ++step) space.step();
  const DistributionCounters before = space.execution().distribution().counters();
  const im::FilterCounters filtered = space.execution().filter().counters();
  for (Planner& pilot : space.pilots())
    for (const Area& area : pilot.areas)
      if (!area.committed.empty()) pilot.ambassador.commit_region_modifications(area.handle);
  space.tick();
  const DistributionCounters after = space.execution().distribution().counters();
  EXPECT_EQ(after.regions_changed, before.regions_changed);
  EXPECT_EQ(after.pairs_reconsidered, before.pairs_reconsidered);
  EXPECT_EQ(after.ranges_tested, before.ranges_tested);
  EXPECT_EQ(space.execution().filter().counters().pairs_tested, filtered.pairs_tested);
  EXPECT_EQ(space.execution().filter().counters().regions_moved, filtered.regions_moved);
}

TEST(Regions, OverThePlaneAloneNeedNoTestOutsideTheFilter) {
  Airspace space(1, 2);
  Pilot &owner = space.pilots()[0], &watcher = space.pilots()[1];
  const RegionHandle view = watcher.ambassador.create_region();
  watcher.ambassador.subscribe_object_class_attributes(aircraft, AttributeSet{where}, view);
  std::vector<RegionBounds> bounds;
  for (int i = 0; i < 100; ++i) {
    bounds.push_back({owner.ambassador.create_region(), {}});
    owner.ambassador.associate_regions_for_updates(
        owner.ambassador.register_object_instance(aircraft), bounds.back().region);
  }
  for (int step = 0; step < 10; ++step) {
    for (RegionBounds& each : bounds) {
      const double at = static_cast<double>(space.below(10));
      each.bounds = {at, at, at, at};
    }
    owner.ambassador.commit_region_modifications(bounds);
    watcher.ambassador.set_region(view, {2.0, 2.0, 2.0 + step, 8.0});
    watcher.ambassador.commit_region_modifications(view);
    space.tick();
  }
  EXPECT_EQ(space.execution().distribution().counters().ranges_tested, 0u);
  EXPECT_GT(space.execution().distribution().counters().entries, 0u);
}

/// A user's own data distribution: the RTI's, but deaf to interactions within regions.
class Deaf final : public Interest {
 public:
  using Interest::Interest;
  bool receives(std::uint32_t, std::uint16_t, std::uint32_t,
                std::span<const RegionHandle>) override {
    return false;
  }
};

TEST(Regions, DataDistributionIsReplacedByTheUsersOwn) {
  int made = 0;
  FederationServices services;
  services.data_distribution = [&](const Fom& fom, const ObjectTable& objects,
                                   const Ownership& ownership, std::unique_ptr<im::Filter> filter) {
    ++made;
    return std::make_unique<Deaf>(fom, objects, ownership, std::move(filter));
  };
  for (const bool is_replaced : {false, true}) {
    Flights<> flights(2, is_replaced ? services : FederationServices{});
    Ambassador &up = flights.pilots()[0].ambassador, &down = flights.pilots()[1].ambassador;
    const RegionHandle sent = up.create_region({channel}), heard = down.create_region({channel});
    up.commit_region_modifications(sent);
    down.commit_region_modifications(heard);
    down.subscribe_interaction_class_with_regions(call, std::span(&heard, 1));
    flights.tick();
    up.send_interaction_with_regions(call, values_of(std::uint8_t{1}), std::span(&sent, 1), {});
    flights.tick();
    EXPECT_EQ(flights.pilots()[1].heard.interactions.size(), is_replaced ? 0u : 1u);
  }
  EXPECT_EQ(made, 1);
}

TEST(Regions, WhoNamesDimensionsOrRegionsThatAreNoneIsDroppedAndNobodyElse) {
  const std::array<std::byte, ModifyRegionsMessage::record_size> zeros{};
  const Bytes range = Bytes(zeros).first(ModifyRangesMessage::range_size);
  const std::array<std::uint32_t, 2> pair{1u, 77u};
  const auto bytes = std::as_bytes(std::span(pair));
  const auto is_dropped = [](auto... messages) {
    FederationExecution execution(harbour(), {});
    struct Drops final : Outlet {
      std::vector<ConnectionId> dropped;
      void send(ConnectionId, std::span<const Bytes>) override {}
      void drop(ConnectionId id, std::string_view) override { dropped.push_back(id); }
    } outlet;
    Recorder heard;
    Ambassador honest(harbour(), heard), other(harbour(), heard);
    execution.connect(0);
    execution.connect(1);
    honest.join("rink", "honest", "test");
    other.join("rink", "other", "test");
    execution.receive(0, honest.outgoing());
    execution.receive(1, other.outgoing());
    FrameWriter frame(frame_max_to_rti);
    const auto add = [&](auto message) {
      write(frame.begin_message(measure(message)), message);
      frame.appended();
    };
    (add(messages), ...);
    execution.receive(1, frame.bytes());
    execution.match();
    execution.flush(outlet);
    EXPECT_EQ(std::ranges::count(outlet.dropped, ConnectionId{0}), 0);
    return std::ranges::count(outlet.dropped, ConnectionId{1}) == 1;
  };
  EXPECT_FALSE(is_dropped(CreateRegionOverMessage{0, 3},
                          ModifyRangesMessage{0, 2, Bytes(zeros).first(2 * range.size())}));
  EXPECT_TRUE(is_dropped(CreateRegionOverMessage{0, 4})) << "the harbour has two dimensions";
  EXPECT_TRUE(is_dropped(CreateRegionOverMessage{1, 1})) << "a gap";
  EXPECT_TRUE(is_dropped(CreateRegionOverMessage{0, 1}, CreateRegionOverMessage{0, 1})) << "in use";
  EXPECT_TRUE(is_dropped(CreateRegionMessage{0}, ModifyRangesMessage{0, 1, range}))
      << "one range of two";
  EXPECT_TRUE(is_dropped(CreateRegionMessage{0}, ModifyRangesMessage{0, 0, {}}));
  EXPECT_TRUE(is_dropped(ModifyRangesMessage{5, 1, range}));
  EXPECT_TRUE(is_dropped(CreateRegionOverMessage{0, 1}, ModifyRegionsMessage{1, zeros}))
      << "not over the plane";
  EXPECT_TRUE(
      is_dropped(RegionalClassMessage{static_cast<std::uint16_t>(vessel.value), 1, 1, bytes}))
      << "no such region";
  EXPECT_TRUE(is_dropped(RegionalClassMessage{999, 1, 0, {}}));
  EXPECT_TRUE(is_dropped(
      RegionalInteractionMessage{static_cast<std::uint16_t>(hail.value), 1, 1, bytes.first(4)}));
  EXPECT_TRUE(is_dropped(AssociateRegionsMessage{12345, 1, 1, bytes}));
  EXPECT_TRUE(is_dropped(
      InteractionWithinMessage{static_cast<std::uint16_t>(hail.value), {}, 1, bytes.first(4), {}}));
}

}  // namespace
}  // namespace rink::rti::testing
