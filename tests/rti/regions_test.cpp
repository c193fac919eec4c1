// Random federations of regions over one to four dimensions, against the standard's definition of
// overlap applied to every pair.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "rti/distribution/interest.h"
#include "rti/wire/region_messages.h"
#include "tests/rti/scenes/airspace.h"

namespace rink::rti::testing {
namespace {

/// What a region is to the test: dimensions, and ranges as they were handed in and last committed.
struct Area {
  RegionHandle handle;
  DimensionSet dimensions;
  std::map<std::uint32_t, Range> set, committed;
};

/// IEEE 1516.1-2010, 9.1: two regions overlap if they have a dimension in common, and their ranges
/// overlap in each such. [low, high) of whole numbers for the channel.
bool overlap(const Area& a, const Area& b) {
  const DimensionSet common = a.dimensions & b.dimensions;
  if (common.is_empty() || a.committed.empty() || b.committed.empty()) return false;
  bool all = true;
  common.for_each([&](DimensionHandle each) {
    const Range &p = a.committed.at(each.value), &q = b.committed.at(each.value);
    all = all &&
          (each == channel ? p.low < q.high && q.low < p.high : p.low <= q.high && q.low <= p.high);
  });
  return all;
}

/// A pilot and what it did, as far as overlap depends on it.
struct Planner : Pilot {
  std::deque<Area> areas;
  std::map<std::uint32_t, std::map<std::uint32_t, AttributeSet>>
      updates;  ///< by object: attributes by the index of their area
  std::vector<ObjectHandle> objects;
  std::map<std::uint32_t, AttributeSet> subscriptions;  ///< by the index of the area
  std::vector<std::uint32_t> calls;                     ///< areas in which it listens
  AttributeSet everywhere;
};

/// Pilots who move, subscribe and register at random.
class Airspace : public Flights<Planner> {
 public:
  Airspace(unsigned seed, int pilots) : Flights(pilots), random_(seed) {}
  int below(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }
  bool by_chance(int in_ten) { return below(10) < in_ten; }

  std::uint32_t add_area(Planner& pilot) {
    Area area;
    const std::uint64_t bits = 1 + random_() % 15;
    area.dimensions = DimensionSet(by_chance(4) ? DimensionSet{x, y}.bits : bits);
    area.handle = pilot.ambassador.create_region(area.dimensions);
    pilot.areas.push_back(area);
    if (by_chance(9)) move(pilot, pilot.areas.back());
    return static_cast<std::uint32_t>(pilot.areas.size() - 1);
  }
  /// Small whole numbers, so that ranges often touch.
  void move(Planner& pilot, Area& area) {
    area.dimensions.for_each([&](DimensionHandle each) {
      if (area.set.contains(each.value) && by_chance(4)) return;
      Range range{static_cast<double>(below(5)), 0.0};
      const int size = below(3);
      range.high = range.low + size;
      if (each == channel) range.high = std::min(6.0, range.high + 1.0);
      area.set[each.value] = range;
      pilot.ambassador.set_range_bounds(area.handle, each, range);
    });
    area.committed = area.set;
    pilot.ambassador.commit_region_modifications(area.handle);
  }
  AttributeSet some_attributes() {
    const AttributeSet set(static_cast<std::uint32_t>(1 + below(3)));
    return set;  // position, radio or both
  }
  void change_subscription(Planner& pilot) {
    const std::uint32_t area =
        pilot.areas.empty() || by_chance(3)
            ? add_area(pilot)
            : static_cast<std::uint32_t>(below(static_cast<int>(pilot.areas.size())));
    const AttributeSet set = some_attributes();
    const AttributeRegions pair{set, {pilot.areas[area].handle}};
    AttributeSet& now = pilot.subscriptions[area];
    if (by_chance(6)) {
      pilot.ambassador.subscribe_object_class_attributes_with_regions(aircraft,
                                                                      std::span(&pair, 1));
      now = now | set;
    } else {
      pilot.ambassador.unsubscribe_object_class_attributes_with_regions(aircraft,
                                                                        std::span(&pair, 1));
      now = now.without(set);
    }
  }
  void change_listening(Planner& pilot) {
    const std::uint32_t area =
        pilot.areas.empty() || by_chance(3)
            ? add_area(pilot)
            : static_cast<std::uint32_t>(below(static_cast<int>(pilot.areas.size())));
    const auto found = std::ranges::find(pilot.calls, area);
    if (found == pilot.calls.end()) {
      pilot.ambassador.subscribe_interaction_class_with_regions(
          call, std::span(&pilot.areas[area].handle, 1));
      pilot.calls.push_back(area);
    } else {
      pilot.ambassador.unsubscribe_interaction_class_with_regions(
          call, std::span(&pilot.areas[area].handle, 1));
      pilot.calls.erase(found);
    }
  }
  void change_objects(Planner& pilot) {
    if (pilot.objects.empty() || by_chance(4)) {
      const std::uint32_t area = add_area(pilot);
      const AttributeSet set = some_attributes();
      const AttributeRegions pair{set, {pilot.areas[area].handle}};
      const ObjectHandle object =
          pilot.ambassador.register_object_instance_with_regions(aircraft, std::span(&pair, 1));
      pilot.objects.push_back(object);
      pilot.updates[object.value][area] = set;
      return;
    }
    const std::size_t at = static_cast<std::size_t>(below(static_cast<int>(pilot.objects.size())));
    const ObjectHandle object = pilot.objects[at];
    if (by_chance(2)) {
      pilot.ambassador.delete_object_instance(object);
      pilot.updates.erase(object.value);
      pilot.objects.erase(pilot.objects.begin() + static_cast<std::ptrdiff_t>(at));
      return;
    }
    const std::uint32_t area =
        static_cast<std::uint32_t>(below(static_cast<int>(pilot.areas.size())));
    const AttributeSet set = some_attributes();
    const AttributeRegions pair{set, {pilot.areas[area].handle}};
    AttributeSet& now = pilot.updates[object.value][area];
    if (by_chance(6)) {
      pilot.ambassador.associate_regions_for_updates(object, std::span(&pair, 1));
      now = now | set;
    } else {
      pilot.ambassador.unassociate_regions_for_updates(object, std::span(&pair, 1));
      now = now.without(set);
    }
  }
  void change(Planner& pilot) {
    for (Area& area : pilot.areas)
      if (by_chance(4)) move(pilot, area);
    if (by_chance(5)) change_subscription(pilot);
    if (by_chance(4)) change_listening(pilot);
    if (by_chance(5)) change_objects(pilot);
    if (by_chance(1)) {
      pilot.everywhere = by_chance(5) ? AttributeSet{weight} : AttributeSet{};
      pilot.ambassador.subscribe_object_class_attributes(aircraft, pilot.everywhere);
    }
  }

  /// The standard's answer: which attributes of `object` are in scope for `pilot`.
  static AttributeSet due(const Planner& owner, ObjectHandle object, const Planner& pilot) {
    AttributeSet set = pilot.everywhere;
    for (const AttributeHandle attribute : {where, radio, weight}) {
      bool has_region = false, is_inside = false;
      for (const auto& [area, attributes] : owner.updates.at(object.value)) {
        if (!attributes.contains(attribute)) continue;
        has_region = true;
        for (const auto& [wanted, subscribed] : pilot.subscriptions)
          is_inside |=
              subscribed.contains(attribute) && overlap(owner.areas[area], pilot.areas[wanted]);
      }
      if (!has_region)
        for (const auto& [wanted, subscribed] : pilot.subscriptions)
          is_inside |= subscribed.contains(attribute);
      if (is_inside) set.insert(attribute);
    }
    return set;
  }
  void expect_scope_is_due() {
    for (const Planner& owner : pilots())
      for (const ObjectHandle object : owner.objects)
        for (const Planner& pilot : pilots()) {
          if (&pilot == &owner) continue;
          const auto known = pilot.heard.objects.find(object.value);
          const bool is_in_scope = known != pilot.heard.objects.end() && known->second.is_in_scope;
          ASSERT_EQ(is_in_scope, !due(owner, object, pilot).is_empty())
              << "object " << object.value;
        }
  }
  /// Each owner says all of each object; each pilot must hear exactly the attributes that are due.
  void expect_updates_are_due(float value) {
    for (Planner& owner : pilots())
      for (const ObjectHandle object : owner.objects)
        owner.ambassador.update_attribute_values(
            object, AttributeSet{where, radio, weight},
            values_of(double{value}, double{value}, double{value}), {});
    for (Planner& pilot : pilots())
      for (auto& [object, known] : pilot.heard.objects) known.values.clear();
    tick();
    for (const Planner& owner : pilots())
      for (const ObjectHandle object : owner.objects)
        for (const Planner& pilot : pilots()) {
          if (&pilot == &owner) continue;
          AttributeSet heard;
          const auto known = pilot.heard.objects.find(object.value);
          if (known != pilot.heard.objects.end())
            for (const auto& [attribute, bytes] : known->second.values) heard.insert({attribute});
          ASSERT_EQ(heard.bits, due(owner, object, pilot).bits) << "object " << object.value;
        }
  }
  void expect_calls_are_due() {
    for (Planner& sender : pilots()) {
      if (sender.areas.empty()) continue;
      std::vector<std::uint32_t> areas{
          static_cast<std::uint32_t>(below(static_cast<int>(sender.areas.size())))};
      if (by_chance(5))
        areas.push_back(static_cast<std::uint32_t>(below(static_cast<int>(sender.areas.size()))));
      std::vector<RegionHandle> regions;
      for (const std::uint32_t area : areas) regions.push_back(sender.areas[area].handle);
      for (Planner& pilot : pilots()) pilot.heard.interactions.clear();
      sender.ambassador.send_interaction_with_regions(call, values_of(std::uint8_t{1}), regions,
                                                      {});
      tick();
      for (const Planner& pilot : pilots()) {
        bool is_due = false;
        for (const std::uint32_t area : areas)
          for (const std::uint32_t listened : pilot.calls)
            is_due |= overlap(sender.areas[area], pilot.areas[listened]);
        ASSERT_EQ(!pilot.heard.interactions.empty(), is_due && &pilot != &sender);
      }
    }
  }
  void step() {
    for (Planner& pilot : pilots()) change(pilot);
    tick();
  }

 private:
  std::mt19937 random_;
};

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
  bool hears(std::uint32_t, std::uint16_t, std::uint32_t, std::span<const RegionHandle>) override {
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
