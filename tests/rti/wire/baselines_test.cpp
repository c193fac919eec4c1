// Periodic state as differences to acknowledged baselines: whatever is lost, late or unknown, what
// is heard is the quantised truth.
#include <gtest/gtest.h>

#include "rti/baselines/keyframe_memory.h"
#include "rti/fom/quantised_codec.h"
#include "rti/wire/baseline_messages.h"
#include "tests/rti/scenes/fjord_traffic.h"

namespace rink::rti::testing {
namespace {

constexpr double tick_s = 1.0 / 60.0;

/// A fleet that its owner tells of at every tick.
struct Fleet {
  FjordTraffic traffic;
  std::mt19937_64 dice;
  std::vector<Boat> boats;

  explicit Fleet(unsigned seed, std::size_t count, const FederationSettings& settings = {})
      : traffic(settings), dice(seed) {
    for (std::size_t i = 0; i < count; ++i) launch();
  }
  void launch() {
    Boat& made = boats.emplace_back(Boat::random(dice));
    made.object = traffic.owner.ambassador.register_object_instance(boat);
    made.region = traffic.owner.ambassador.create_region();
    follow(made);
    traffic.owner.ambassador.associate_regions_for_updates(made.object, made.region);
  }
  void follow(const Boat& moved) {
    traffic.owner.ambassador.set_region(moved.region, moved.box());
    traffic.owner.ambassador.commit_region_modifications(moved.region);
  }
  void sail() {
    traffic.now += tick_s;
    for (Boat& each : boats) {
      each.sail(tick_s, dice);
      follow(each);
      each.tell(traffic.owner.ambassador, traffic.now);
    }
  }
  const BaselineCounters& counters() const { return traffic.execution.baseline_counters(); }
};

/// Every boat that `shore` was told of at `now` is as it was told; returns how many those are.
std::size_t expect_truth(const Shore& shore, const Fleet& fleet) {
  std::size_t told = 0;
  for (const Boat& each : fleet.boats) {
    const auto seen = shore.heard.seen.find(each.object.value);
    if (seen == shore.heard.seen.end() || seen->second.time != fleet.traffic.now) continue;
    EXPECT_EQ(seen->second.track, each.truth)
        << "boat " << each.object.value << " at " << fleet.traffic.now;
    ++told;
  }
  EXPECT_EQ(shore.heard.lost, "");
  return told;
}

TEST(Baselines, WhatIsHeardIsTheQuantisedTruthInAThirdOfTheBytes) {
  Fleet fleet(1, 200);
  Shore& shore = fleet.traffic.watch("lighthouse");
  fleet.traffic.tick();
  std::uint64_t bytes = 0, updates = 0;
  for (int i = 0; i < 300; ++i) {
    fleet.sail();
    const FederationCounters before = fleet.traffic.execution.counters();
    fleet.traffic.tick();
    ASSERT_EQ(expect_truth(shore, fleet), 200u);
    if (i < 10) continue;
    bytes += fleet.traffic.execution.counters().bytes_sent - before.bytes_sent;
    updates += fleet.traffic.execution.counters().updates_sent - before.updates_sent;
  }
  const double absolute =
      1.0 + static_cast<double>(
                (track_codec().packed_bits() + 7) /
                8);  // bytes of a record that refers to nothing, with the step to its handle
  EXPECT_LT(static_cast<double>(bytes) / static_cast<double>(updates), absolute / 2.5);
  EXPECT_EQ(fleet.counters().acknowledgements_ignored, 0u);
  EXPECT_EQ(fleet.counters().refused, 0u);
}

TEST(Baselines, LostFramesAndLateAcknowledgementsNeverBreakDecoding) {
  for (unsigned seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    FederationSettings settings;
    settings.keyframe_period = 1 + seed % 4;
    Fleet fleet(seed, 30, settings);
    for (const char* name : {"north", "south", "west"}) fleet.traffic.watch(name);
    fleet.traffic.tick();
    fleet.sail();
    fleet.traffic.tick();
    std::mt19937_64 weather(seed);
    const unsigned held = static_cast<unsigned>(weather() % 100),
                   lost = static_cast<unsigned>(weather() % 60);
    const auto holds = [&](Shore& shore) {
      return &shore != &fleet.traffic.owner && weather() % 100 < held;
    };
    const auto loses = [&](Shore&) { return weather() % 100 < lost; };
    std::size_t told = 0;
    for (int i = 0; i < 200; ++i) {
      fleet.sail();
      fleet.traffic.tick(holds, loses);
      for (const Shore& shore : fleet.traffic.shores) told += expect_truth(shore, fleet);
    }
    EXPECT_GT(told, 200u * 30u * 3u * (100u - lost) / 100u * 9u / 10u);
    EXPECT_EQ(fleet.counters().refused, 0u) << "the RTI never refers to what was not acknowledged";
  }
}

TEST(Baselines, AcknowledgementsThatNeverComeLeaveAbsoluteStates) {
  Fleet fleet(3, 20);
  Shore& shore = fleet.traffic.watch("lighthouse");
  fleet.traffic.tick();
  const auto holds = [&](Shore& each) { return &each == &shore; };
  for (int i = 0; i < 100; ++i) {
    fleet.sail();
    fleet.traffic.tick(holds);
    ASSERT_EQ(expect_truth(shore, fleet), 20u);
  }
  EXPECT_EQ(fleet.counters().differences_sent, 0u);
  fleet.traffic.tick();  // now all come at once; only those of the last keyframes count
  EXPECT_EQ(fleet.counters().acknowledged, keyframe_window);
  EXPECT_EQ(fleet.counters().acknowledged + fleet.counters().acknowledgements_ignored,
            fleet.counters().keyframes);
  fleet.sail();
  fleet.traffic.tick();
  EXPECT_EQ(expect_truth(shore, fleet), 20u);
  EXPECT_GT(fleet.counters().differences_sent, 0u);
}

TEST(Baselines, InterestEntriesExitsStopsNewBoatsAndOddValuesStayTrue) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    FederationSettings settings;
    settings.filter = seed % 2 == 0 ? "region" : "grid";
    settings.filter_settings.cell_size = 150.0;
    settings.filter_settings.world = {0.0, 0.0, 2000.0, 2000.0};
    Fleet fleet(seed, 60, settings);
    for (const double low : {0.0, 300.0, 900.0})
      fleet.traffic.watch("shore " + std::to_string(low),
                          im::Region{low, low, low + 700.0, low + 700.0});
    fleet.traffic.tick();
    std::mt19937_64 weather(seed);
    const auto holds = [&](Shore& shore) {
      return &shore != &fleet.traffic.owner && weather() % 3 == 0;
    };
    std::size_t told = 0;
    for (int i = 0; i < 300; ++i) {
      fleet.traffic.now += tick_s;
      for (Boat& each : fleet.boats) {
        if (fleet.dice() % 20 == 0) continue;  // it has nothing to say
        for (int hour = 0; hour < 20; ++hour) each.sail(tick_s, fleet.dice);
        if (fleet.dice() % 200 == 0) each.x = 1e9;  // beyond the range
        fleet.follow(each);
        each.tell(fleet.traffic.owner.ambassador, fleet.traffic.now);
        if (each.x == 1e9) each.x = 1000.0;
        if (fleet.dice() % 30 == 0)
          fleet.traffic.owner.ambassador.update_attribute_values(
              each.object, {track, cargo},
              [&] {
                auto both = each.value();
                each.truth = rounded(both);
                std::ranges::copy(values_of(1.5), std::back_inserter(both));
                return both;
              }(),
              {fleet.traffic.now, 0});
      }
      if (i % 40 == 20)
        fleet.traffic.owner.ambassador.delete_object_instance(fleet.boats.back().object),
            fleet.boats.pop_back();
      if (i % 40 == 30) fleet.launch();
      fleet.traffic.tick(holds);
      for (const Shore& shore : fleet.traffic.shores) told += expect_truth(shore, fleet);
    }
    EXPECT_GT(told, 3000u);
    EXPECT_GT(fleet.counters().differences_sent, fleet.counters().absolutes_sent);
    EXPECT_EQ(fleet.counters().refused, 0u);
  }
}

TEST(Baselines, OneBlockServesAllWhoHaveTheSameKeyframe) {
  Fleet fleet(5, 50);
  for (int i = 0; i < 40; ++i) fleet.traffic.watch("shore " + std::to_string(i));
  for (int i = 0; i < 10; ++i) fleet.sail(), fleet.traffic.tick();
  const BaselineCounters before = fleet.counters();
  for (int i = 0; i < 20; ++i) fleet.sail(), fleet.traffic.tick();
  EXPECT_EQ(fleet.counters().blocks_encoded - before.blocks_encoded, 20u);
  EXPECT_EQ(fleet.counters().blocks_shared - before.blocks_shared, 20u * 40u);
}

TEST(Baselines, AnUnknownBaselineIsRefusedAndAbsoluteStatesFollowOverTheSameConnection) {
  Fleet fleet(6, 10);
  Shore& shore = fleet.traffic.watch("lighthouse");
  fleet.traffic.tick();
  for (int i = 0; i < 10; ++i) fleet.sail(), fleet.traffic.tick();
  // Four frames are lost, among them two keyframes; somebody acknowledges one of them all the same.
  for (int i = 0; i < 4; ++i)
    fleet.sail(), fleet.traffic.tick({}, [&](Shore& each) { return &each == &shore; });
  const auto lost_keyframe = static_cast<std::uint16_t>(fleet.counters().keyframes);
  std::vector<std::byte> forged;
  AcknowledgeKeyframeMessage message{lost_keyframe};
  write(forged, message);
  fleet.traffic.execution.receive(shore.connection, in_frame(forged));
  fleet.sail();
  fleet.traffic.tick();
  EXPECT_EQ(expect_truth(shore, fleet),
            shore.ambassador.counters().differences_refused == 10u ? 0u : 1u)
      << "nothing is shown that may be wrong";
  EXPECT_GT(shore.ambassador.counters().differences_refused, 0u);
  fleet.sail();
  fleet.traffic.tick();
  EXPECT_EQ(fleet.counters().refused, 1u);
  EXPECT_EQ(expect_truth(shore, fleet), 10u);
  const std::uint64_t differences = fleet.counters().differences_sent;
  for (int i = 0; i < 4; ++i) {
    fleet.sail();
    fleet.traffic.tick();
    EXPECT_EQ(expect_truth(shore, fleet), 10u);
  }
  EXPECT_GT(fleet.counters().differences_sent, differences) << "and then differences again";
}

TEST(Baselines, AcknowledgementsOfWhatWasNeverSentAreIgnored) {
  Fleet fleet(7, 5);
  Shore& shore = fleet.traffic.watch("lighthouse");
  for (int i = 0; i < 5; ++i) fleet.sail(), fleet.traffic.tick();
  const std::uint64_t ignored = fleet.counters().acknowledgements_ignored;
  for (const unsigned number : {0u, 77u, 65535u, 32768u}) {
    const std::vector<std::byte> frame = {std::byte{3},
                                          {},
                                          std::byte{50},
                                          static_cast<std::byte>(number),
                                          static_cast<std::byte>(number >> 8)};
    fleet.traffic.execution.receive(shore.connection, frame);
  }
  EXPECT_EQ(fleet.counters().acknowledgements_ignored, ignored + 4);
  fleet.sail();
  fleet.traffic.tick();
  EXPECT_EQ(expect_truth(shore, fleet), 5u);
}

TEST(Baselines, NumbersGoRoundWithoutHarm) {
  FederationSettings settings;
  settings.keyframe_period = 1;
  Fleet fleet(8, 1, settings);
  Shore& shore = fleet.traffic.watch("lighthouse");
  for (int i = 0; i < 66'000; ++i) {
    fleet.sail();
    fleet.traffic.tick();
    if (i > 65'500) {
      ASSERT_EQ(expect_truth(shore, fleet), 1u);
    }
  }
  EXPECT_EQ(fleet.counters().acknowledgements_ignored, 0u);
  EXPECT_GT(fleet.counters().differences_sent, 65'000u);
}

TEST(Baselines, FederatesSurviveHostileBlocks) {
  Fleet fleet(9, 20);
  Shore& shore = fleet.traffic.watch("lighthouse");
  for (int i = 0; i < 6; ++i) fleet.sail(), fleet.traffic.tick();
  std::vector<std::byte> frame;
  fleet.sail();
  fleet.traffic.tick({}, [&](Shore& each) {
    if (&each == &shore) frame = each.frames.front();
    return false;
  });
  for (unsigned seed = 1; seed <= 2000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    std::vector<std::byte> altered = frame;
    for (unsigned i = 0; i < 1 + seed % 4; ++i) {
      const std::size_t head = frame_head_size(0), at = head + random() % (frame.size() - head);
      altered[at] ^= static_cast<std::byte>(1u << random() % 8);
    }
    Ambassador stranger(fjord(), shore.heard);
    stranger.join("rink", "stranger", "tester");
    const std::vector<std::byte> joined = values_of(std::uint8_t{64}, 9u, 9u);
    ASSERT_TRUE(stranger.receive(in_frame(joined)));
    for (const Boat& each : fleet.boats) {
      std::vector<std::byte> discovery;
      DiscoverObjectMessage message{each.object.value, static_cast<std::uint16_t>(boat.value), ""};
      write(discovery, message);
      ASSERT_TRUE(stranger.receive(in_frame(discovery)));
    }
    stranger.receive(altered);  // understood or not, it ends
  }
}

TEST(Baselines, ModelsWithoutPeriodicStatePayNothing) {
  Rig rig(Carrier::in_process);
  Station& owner = rig.join("owner");
  Station& watcher = rig.join("watcher");
  owner.ambassador.publish_object_class_attributes(vessel, {position});
  watcher.ambassador.subscribe_object_class_attributes(vessel, {position});
  rig.settle();
  const ObjectHandle object = owner.ambassador.register_object_instance(vessel);
  for (int i = 0; i < 10; ++i) {
    owner.ambassador.update_attribute_values(object, {position}, values_of(1.0f, 2.0f), {1.0, 0});
    rig.settle();
  }
  EXPECT_EQ(rig.execution().baseline_counters().keyframes, 0u);
  EXPECT_EQ(rig.execution().baseline_counters().blocks_encoded, 0u);
  EXPECT_EQ(watcher.ambassador.counters().keyframes_acknowledged, 0u);
}

}  // namespace
}  // namespace rink::rti::testing
