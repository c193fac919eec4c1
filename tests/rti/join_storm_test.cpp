// Thousands who join at once beside some who play: each match takes in a part of them, all hear
// from the RTI meanwhile, and what is seen is right at every match.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <deque>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tests/rti/rig.h"

namespace rink::rti::testing {
namespace {

constexpr double storm_tick_s = 0.05;
constexpr double storm_side = 1000.0, storm_reach = 50.0;  ///< of the sea, and half of a view's [m]

/// A pilot's vessels drift over a sea, of which watchers see a part each. Bytes are carried by hand
/// and time is counted, so that a run is the same on any machine.
class Storm final : public Outlet {
 public:
  struct Watcher {
    explicit Watcher(ConnectionId connection) : connection(connection) {}
    ConnectionId connection;
    Recorder heard;
    Ambassador ambassador{harbour(), heard};
    RegionHandle region;
    im::Region view{};
    double heard_s = 0.0, silence_max_s = 0.0;
  };

  Storm(const FederationSettings& settings, std::size_t vessels) : execution(harbour(), settings) {
    execution.advance_clock(0.0);
    connect(pilot);
    pilot.ambassador.join("rink", "pilot", "tester");
    pilot.ambassador.publish_object_class_attributes(vessel, motion);
    tick();
    for (std::size_t k = 0; k < vessels; ++k) {
      const ObjectHandle object = pilot.ambassador.register_object_instance(vessel);
      const RegionHandle region = pilot.ambassador.create_region();
      pilot.ambassador.associate_regions_for_updates(object, region);
      ships.push_back({object, region, draw(), draw(), 0});
    }
    move_ships();
  }

  Watcher& join() {
    Watcher& joining = *watchers.emplace_back(
        std::make_unique<Watcher>(1 + static_cast<ConnectionId>(watchers.size())));
    connect(joining);
    Ambassador& ambassador = joining.ambassador;
    ambassador.join("rink", "watcher " + std::to_string(joining.connection), "tester");
    joining.region = ambassador.create_region();
    look_around(joining, draw(), draw());
    ambassador.subscribe_object_class_attributes(vessel, motion, joining.region);
    return joining;
  }
  void look_around(Watcher& watcher, double x, double y) {
    watcher.view = {x - storm_reach, y - storm_reach, x + storm_reach, y + storm_reach};
    watcher.ambassador.set_region(watcher.region, watcher.view);
    watcher.ambassador.commit_region_modifications(watcher.region);
  }

  /// All move, everybody sends, and the RTI answers.
  void tick() {
    now_s += storm_tick_s;
    move_ships();
    carry(pilot);
    for (const auto& each : watchers) carry(*each);
    const std::uint64_t before = execution.counters().scope_entries;
    execution.match();
    entries = execution.counters().scope_entries - before;
    execution.flush(*this);
    execution.advance_clock(now_s);
  }

  bool sees(const Watcher& watcher, std::size_t ship) const {
    return overlaps(watcher.view, ships[ship].bounds());
  }
  /// All in the watcher's view is in its scope with its newest value, and nothing else is.
  void expect_right(const Watcher& watcher) const {
    std::size_t seen = 0;
    for (std::size_t k = 0; k < ships.size(); ++k) {
      if (!sees(watcher, k)) continue;
      ++seen;
      const auto known = watcher.heard.objects.find(ships[k].object.value);
      ASSERT_TRUE(known != watcher.heard.objects.end() && known->second.is_in_scope)
          << watcher.connection << " misses vessel " << k;
      ASSERT_EQ(known->second.values.at(speed.value), values_of(ships[k].speed))
          << watcher.connection << " and vessel " << k;
    }
    const auto is_in_scope = [](const auto& each) { return each.second.is_in_scope; };
    ASSERT_EQ(std::ranges::count_if(watcher.heard.objects, is_in_scope),
              static_cast<std::ptrdiff_t>(seen))
        << watcher.connection;
  }
  static bool is_in(const Watcher& watcher) { return !watcher.heard.objects.empty(); }

  FederationExecution execution;
  Watcher pilot{0};
  std::vector<std::unique_ptr<Watcher>> watchers;
  std::uint64_t entries = 0;  ///< of the last match
  double now_s = 0.0;

 private:
  struct Ship {
    ObjectHandle object;
    RegionHandle region;
    double x, y;
    float speed;  ///< a number that is new at every tick
    im::Region bounds() const { return {x, y, x + 1.0, y + 1.0}; }
  };

  static bool overlaps(const im::Region& a, const im::Region& b) {
    return a.low_x <= b.high_x && b.low_x <= a.high_x && a.low_y <= b.high_y && b.low_y <= a.high_y;
  }
  double draw() { return std::uniform_real_distribution<double>(0.0, storm_side)(random_); }
  void connect(Watcher& watcher) {
    execution.connect(watcher.connection);
    watcher.heard_s = now_s;
  }
  void move_ships() {
    for (Ship& each : ships) {
      each.x += 0.5;
      each.speed += 1.0f;
      pilot.ambassador.set_region(each.region, each.bounds());
      pilot.ambassador.commit_region_modifications(each.region);
      pilot.ambassador.update_attribute_values(
          each.object, motion, values_of(static_cast<float>(each.x), 0.0f, each.speed), {now_s, 0});
    }
  }
  void carry(Watcher& from) {
    from.ambassador.advance_clock(now_s);
    if (const Bytes said = from.ambassador.outgoing(); !said.empty())
      execution.receive(from.connection, said);
    from.ambassador.clear_outgoing();
  }
  void send(ConnectionId connection, std::span<const Bytes> parts) override {
    Watcher& to = connection == 0 ? pilot : *watchers.at(connection - 1);
    for (const Bytes each : parts) ASSERT_TRUE(to.ambassador.receive(each));
    to.silence_max_s = std::max(to.silence_max_s, now_s - to.heard_s);
    to.heard_s = now_s;
  }
  void drop(ConnectionId connection, std::string_view why) override {
    ADD_FAILURE() << connection << " was dropped: " << why;
  }

  std::vector<Ship> ships;
  std::mt19937 random_{11};
};

FederationSettings storm_with_room_for(std::size_t pairs) {
  FederationSettings settings;
  settings.filter = "region";
  settings.filter_settings.world = {0.0, 0.0, storm_side, storm_side};
  settings.newcomer_pairs_per_match_max = pairs;
  return settings;
}

TEST(JoinStorm, OfTwoThousandTakesNoTurnFromAHundredWhoPlayAndEndsWithEveryViewRight) {
  constexpr std::size_t vessels = 1500, players = 100, newcomers = 2000, room = 1200;
  Storm storm(storm_with_room_for(room), vessels);
  for (std::size_t k = 0; k < players; ++k) storm.join();
  while (!std::ranges::all_of(storm.watchers, [](const auto& each) { return Storm::is_in(*each); }))
    storm.tick();
  for (int tick = 0; tick < 20; ++tick) storm.tick();

  for (std::size_t k = 0; k < newcomers; ++k) storm.join();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> step(-1.0, 1.0);
  std::uint64_t entries_max = 0;
  int ticks = 0;
  const auto who_is_in = [&] {
    return static_cast<std::size_t>(std::ranges::count_if(
        storm.watchers, [](const auto& each) { return Storm::is_in(*each); }));
  };
  std::size_t in = who_is_in();
  for (; in < players + newcomers && ticks < 400; ++ticks) {
    for (std::size_t k = 0; k < storm.watchers.size(); k += 3) {
      Storm::Watcher& mover = *storm.watchers[k];
      storm.look_around(mover, mover.view.low_x + storm_reach + step(random),
                        mover.view.low_y + storm_reach + step(random));
    }
    storm.tick();
    entries_max = std::max(entries_max, storm.entries);
    // All players at each tick, and of newcomers who are in a few, others each time.
    for (const auto& each : storm.watchers) {
      const bool is_looked_at = each->connection <= players ||
                                (each->connection + static_cast<ConnectionId>(ticks)) % 16 == 0;
      if (is_looked_at && Storm::is_in(*each)) storm.expect_right(*each);
      if (HasFatalFailure()) return;
    }
    const std::size_t before = std::exchange(in, who_is_in());
    ASSERT_GT(in + (ticks == 0 ? 1 : 0), before) << "each match takes in somebody";
  }
  EXPECT_EQ(in, players + newcomers);
  EXPECT_GT(ticks, 40) << "they come in portions";
  // Views differ in what they see, and those who are in already meet new vessels as well.
  EXPECT_LE(entries_max, 2 * room);
  for (const auto& each : storm.watchers) {
    EXPECT_LE(each->silence_max_s, Timeouts{}.heartbeat_s + storm_tick_s + 1e-9);
    EXPECT_EQ(each->heard.lost, "");
    EXPECT_EQ(each->heard.out_of_scope_updates, 0);
    for (const auto& [object, times] : each->heard.discoveries) ASSERT_EQ(times, 1) << object;
    storm.expect_right(*each);
    if (HasFatalFailure()) return;
  }
}

/// What fits into one match comes as if there were no portions.
TEST(JoinStorm, ThatIsSmallIsOverInOneMatch) {
  constexpr std::size_t vessels = 1000;
  Storm storm(storm_with_room_for(1u << 18), vessels);
  for (int k = 0; k < 100; ++k) storm.join();
  storm.tick();
  std::uint64_t visible = 0;
  for (const auto& each : storm.watchers)
    for (std::size_t k = 0; k < vessels; ++k) visible += storm.sees(*each, k) ? 1u : 0u;
  EXPECT_GT(visible, 100u);
  EXPECT_EQ(storm.entries, visible);
  for (int tick = 0; tick < 3; ++tick) storm.tick();
  for (const auto& each : storm.watchers) storm.expect_right(*each);
}

}  // namespace
}  // namespace rink::rti::testing
