// However the field is divided, and among however many: the peers' states are those of one engine,
// every double of them, at every window.
#include <gtest/gtest.h>

#include <initializer_list>
#include <iostream>

#include "game/peer/assembly.h"
#include "game/peer/cuts.h"
#include "tests/peer/crossing_rows.h"
#include "tests/peer/scene_classes.h"
#include "tests/peer/shared_scenes.h"

namespace rink::peer::test {
namespace {

struct Played {
  PeerCounters counters;
  std::uint64_t held_ghosts =
      0;  ///< ghosts in rest contact or in a jam, summed over peers and windows
  physics::Counters truth;
  SceneClasses classes;
};

/// What `peer` has is its own, or in its halo or an annex, or in a group with what is.
void expect_only_halo(const Peer& peer, const Division& division, const std::string& where) {
  const physics::PartWorld& world = peer.world();
  for (std::uint32_t body = 0; body < world.body_count(); ++body) {
    const Box place = Box::around(world.position({body}), world.half_extent({body}));
    const bool is_near = peer.halos().is_near(peer.number(), place) || world.is_held({body});
    const bool is_ghost = std::binary_search(peer.ghosts().begin(), peer.ghosts().end(), body);
    const bool is_own = division.owner_of(world.position({body})) == peer.number();
    if (!world.is_removed({body}))
      EXPECT_TRUE(is_own || (is_ghost && is_near)) << where << ", body " << body;
    else EXPECT_FALSE(is_ghost) << where << ", body " << body;
  }
}

/// Plays scene `number` alone and among peers; stops at the first window at which they differ.
Played expect_same_history(std::uint64_t number, int window_max) {
  Random random(7 * number + 3);
  const double length = std::pow(10.0, uniform(random, -3.0, window_max < 1000 ? -1.0 : -2.0));
  const int window_count =
      window_max -
      (window_max == 3000
           ? 0
           : static_cast<int>(below(random, static_cast<std::uint32_t>(window_max) / 2)));
  SharedScene scene = shared_scene(number, length * window_count);
  const PeerNumber peer_count = 2 + below(random, 15);
  const Division division = random_division(scene.world.spec().field, random, peer_count);
  Assembly assembly(scene.world, division, uniform(random, 0.05, 0.5), length);
  std::stable_sort(scene.keys.begin(), scene.keys.end(), [](const Key& a, const Key& b) {
    return a.time != b.time ? a.time < b.time : a.bat < b.bat;
  });
  for (const Key& key : scene.keys) assembly.press(key);
  physics::World& whole = scene.world;
  const std::uint32_t body_count = whole.body_count();
  std::size_t next_key = 0;
  Played played;
  played.classes = classes_of(whole, division, scene.keys);
  played.classes.peer_counts = {peer_count}, played.classes.long_runs = window_count == 3000;
  std::vector<PeerNumber> owners(body_count);
  for (int window = 1; window <= window_count; ++window) {
    const double until = length * window;
    for (; next_key < scene.keys.size() && scene.keys[next_key].time <= until; ++next_key) {
      physics::test::RandomKeys::advance(whole, scene.keys[next_key].time);
      whole.set_thrust({scene.keys[next_key].bat}, scene.keys[next_key].thrust);
    }
    physics::test::RandomKeys::advance(whole, until);
    assembly.advance();
    const std::string where = "scene " + std::to_string(number) + ", " +
                              std::to_string(peer_count) + " peers, window " +
                              std::to_string(window) + " of " + std::to_string(window_count);
    EXPECT_EQ(assembly.misowned(), 0u) << where;
    for (const Peer& peer : assembly.peers()) {
      for (const std::uint32_t ghost : peer.ghosts())
        played.held_ghosts += peer.world().is_held({ghost});
      if (window % 8 == 1)
        expect_only_halo(peer, division, where), note_groups(played.classes, peer, division);
      for (const std::uint32_t body : peer.owned()) {
        const bool is_bullet = owners[body] != peer.number() && window > 1 &&
                               peer.world().velocity({body}).norm() >= 50.0;
        played.classes.bullet_crossings += is_bullet;
        owners[body] = peer.number();
      }
    }
    for (std::uint32_t body = 0; body < body_count; ++body) {
      if (bytes_of(assembly.state(body)) == bytes_of(physics::Subdomain::state_in(whole, body)))
        continue;
      ADD_FAILURE() << where << ", body " << body << " of " << body_count;
      window = window_count;
      break;
    }
  }
  played.truth = whole.counters();
  played.classes.ties = played.truth.events_at_once_max >= 64;
  for (const Peer& peer : assembly.peers()) played.counters += peer.counters();
  return played;
}

/// Every twentieth scene is played over as many as `long_max` windows. Answers what occurred in
/// them.
Played expect_same_histories(std::uint64_t first, std::uint64_t last, int window_max,
                             int long_max) {
  Played all;
  for (std::uint64_t number = first; number < last; ++number) {
    const Played played = expect_same_history(number, number % 20 == 7 ? long_max : window_max);
    all.counters += played.counters;
    all.held_ghosts += played.held_ghosts, all.classes += played.classes;
    for (const auto counter : physics::counter_of_kind) all.truth.*counter += played.truth.*counter;
    all.truth.joint_impacts += played.truth.joint_impacts;
  }
  const PeerCounters& c = all.counters;
  std::cout << c.windows << " windows of peers, " << c.repeats << " repeated; " << c.hand_overs
            << " bodies handed over; " << c.own_events << " own events, " << c.ghost_events
            << " of ghosts alone; held ghosts in windows: " << all.held_ghosts << "; in truth "
            << all.truth.events() << " events, " << all.truth.joint_impacts << " joint impacts, "
            << all.truth.rests << " rests, " << all.truth.hops << " hops, " << all.truth.freezes
            << " freezes, " << all.truth.goals << " goals\n"
            << all.classes << '\n';
  return all;
}

TEST(SharedSimulation, EqualsOneEngineBitForBitOver50Scenes) {
  const Played all = expect_same_histories(0, 50, 60, 200);
  const PeerCounters& c = all.counters;
  for (const std::uint64_t count : {c.repeats, c.hand_overs, c.ghost_events, all.held_ghosts,
                                    all.truth.joint_impacts, all.truth.rests, all.truth.hops})
    EXPECT_GT(count, 0u);
  const SceneClasses& k = all.classes;
  for (const std::uint64_t count :
       {k.dense, k.rows_across_borders, k.ties, k.bullets, k.bullet_crossings, k.unequal, k.drag,
        k.friction, k.rough, k.keys_at_once, k.groups_across_borders})
    EXPECT_GT(count, 0u) << k;
}

/// Joint impacts that reach from one row into the next: what they only looked at, or moved by a
/// rounding, counts as well.
TEST(SharedSimulation, EqualsOneEngineWhereCradlesLieSideBySide) {
  for (const std::uint64_t number : {1541, 1661}) {
    const Played played = expect_same_history(number, 150);
    EXPECT_GT(played.truth.joint_impacts, 0u);
    EXPECT_LT(played.counters.repeats, played.counters.windows / 10);
  }
}

/// Plays `scene` alone and among peers. Answers how many windows were repeated.
std::uint64_t expect_same_bodies(SharedScene& scene, const Division& division, double halo,
                                 int window_count, double length = 0.01) {
  physics::World& world = scene.world;
  Assembly assembly(world, division, halo, length);
  std::stable_sort(scene.keys.begin(), scene.keys.end(), [](const Key& a, const Key& b) {
    return a.time != b.time ? a.time < b.time : a.bat < b.bat;
  });
  for (const Key& key : scene.keys) assembly.press(key);
  std::size_t next = 0;
  for (int window = 1; window <= window_count; ++window) {
    for (; next < scene.keys.size() && scene.keys[next].time <= length * window; ++next) {
      physics::test::RandomKeys::advance(world, scene.keys[next].time);
      world.set_thrust({scene.keys[next].bat}, scene.keys[next].thrust);
    }
    physics::test::RandomKeys::advance(world, length * window);
    assembly.advance();
    for (std::uint32_t body = 0; body < world.body_count(); ++body) {
      if (bytes_of(assembly.state(body)) == bytes_of(physics::Subdomain::state_in(world, body)))
        continue;
      ADD_FAILURE() << division.peer_count() << " peers, window " << window << ", body " << body;
      return 0;
    }
  }
  std::uint64_t repeats = 0;
  for (const Peer& peer : assembly.peers()) repeats += peer.counters().repeats;
  return repeats;
}

/// A heap that bats press, of more contacts than glide by themselves, and above it one that nobody
/// touches, in sight of the pile alone.
SharedScene heap_below_a_stray() {
  SharedScene scene{physics::World(physics::test::rink_of(4.0, 2.0, 0.5, 0.0, 1.0)), {}};
  physics::World& world = scene.world;
  Random random(25);
  const double radius = 0.04, step = 2.0 * radius + 2e-7;
  const int columns = 10, rows = 8;
  world.add(physics::PuckSpec{.position = {1.36, 0.5 + rows * step + 0.006 + radius},
                              .velocity = {0.01, 0.0}});
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) {
      const double dx = uniform(random, 0.0, 1e-7), dy = uniform(random, 0.0, 1e-7);
      world.add(physics::PuckSpec{
          .position = {1.0 + step * (i + 0.5) + dx, 0.5 + step * (j + 0.5) + dy}, .mass = 0.2});
    }
  for (const double side : {-1.0, 1.0}) {
    const double x = side < 0.0 ? 1.0 - 0.04 - 1e-6 : 1.0 + columns * step + 0.04 + 1e-6;
    const std::uint32_t bat =
        world.add(physics::BatSpec{.position = {x, 0.82}, .half_extent = {0.04, 0.3}, .mass = 3.0})
            .index;
    scene.keys.push_back({0.0, bat, Vector2(-side * 12.0, 0.0)});
  }
  return scene;
}

/// The pile turns one that is 6 mm away to its last event's time, though halos reach 2 mm: neither
/// owner would see the other's, and their states would be others than the engine's.
TEST(SharedSimulation, EqualsOneEngineWhereAPileGathersOneBeyondTheHalo) {
  SharedScene scene = heap_below_a_stray();
  const double border = 1.143;
  const Division division(scene.world.spec().field,
                          {{{0.0, 0.0, 4.0, border}, 0}, {{0.0, border, 4.0, 2.0}, 1}}, 2);
  EXPECT_GT(expect_same_bodies(scene, division, 0.002, 10), 0u);
  const BodyState stray = physics::Subdomain::state_in(scene.world, 0);
  EXPECT_GT(stray.flight.time, 0.09) << "the pile gathers it";
  EXPECT_NEAR(stray.flight.y, 1.186, 1e-5) << "nobody touches it";
}

/// A pile of 70 bodies of six peers: its farthest body's owner saw no event of it, and was named
/// after 104 attempts.
TEST(SharedSimulation, EqualsOneEngineWhereAPileReachesOneWhomNobodyTouches) {
  const Played played = expect_same_history(1674, 150);
  EXPECT_GT(played.truth.hops, 0u);
  EXPECT_LT(played.counters.repeats, played.counters.windows / 4);
}

Division slices(const physics::Field& field, PeerNumber peer_count) {
  std::vector<Zone> zones;
  for (PeerNumber k = 0; k < peer_count; ++k)
    zones.push_back(
        {{field.length * k / peer_count, 0.0, field.length * (k + 1) / peer_count, field.width},
         k});
  return Division(field, std::move(zones), peer_count);
}

/// A row that touches from end to end. Both ends are struck across it at one instant, which makes
/// one joint impact of what nobody but the whole sees together: each peer sees one end's impact
/// alone, or none, and nobody's ghosts move otherwise than their owners say.
TEST(SharedSimulation, EqualsOneEngineWhereARowJoinsImpactsThatNoPeerSeesTogether) {
  for (const PeerNumber peer_count : {2, 3, 4, 8, 16}) {
    SharedScene scene{physics::World(physics::test::rink_of(4.0, 2.0, 1.0, 0.0, 1.0)), {}};
    physics::World& world = scene.world;
    const double radius = 0.03125;
    add_row(world, {0.5, 1.0}, {2.0 * radius, 0.0}, 49, radius, {0.0, 0.0});
    world.add(physics::PuckSpec{.position = {0.5, 1.0 - 2.0 * radius - 0.017},
                                .velocity = {0.0, 1.7},
                                .radius = radius,
                                .mass = 1.3});
    world.add(physics::PuckSpec{.position = {3.5, 1.0 - 2.0 * radius - 0.019},
                                .velocity = {0.0, 1.9},
                                .radius = radius,
                                .mass = 0.7});
    const std::uint64_t repeats =
        expect_same_bodies(scene, slices(world.spec().field, peer_count), 0.1, 4);
    EXPECT_EQ(world.counters().joint_impacts, 1u);
    EXPECT_GT(repeats, 0u) << "the row was known as a whole where it lies across borders";
  }
}

/// A slow one is about to meet one at the border, when a fast one, which was too far off to be
/// known there, knocks it aside: the border's owner sees an impact that never was. Nobody's true
/// path comes near anybody else's, so only the story of who was met tells.
TEST(SharedSimulation, EqualsOneEngineWhereOneToBeMetIsKnockedAsideByOneBeyondTheHalo) {
  SharedScene scene{physics::World(physics::test::rink_of(4.0, 2.0)), {}};
  physics::World& world = scene.world;
  const double knocked_at = 0.003, angle = 0.5235987755982988;
  const Vector2 slow(-6.0, 0.0), way(std::sin(angle), -std::cos(angle)), meeting(2.02, 1.0);
  world.add(physics::PuckSpec{.position = {1.95, 1.0}, .radius = 0.01});
  world.add(
      physics::PuckSpec{.position = meeting - slow * knocked_at, .velocity = slow, .radius = 0.03});
  world.add(physics::PuckSpec{.position = meeting - way * (0.04 + 100.0 * knocked_at),
                              .velocity = way * 100.0,
                              .radius = 0.01});
  const Box low_left{0.0, 0.0, 2.0, 1.02};
  const Division division(world.spec().field,
                          {{low_left, 0}, {{0.0, 1.02, 2.0, 2.0}, 1}, {{2.0, 0.0, 4.0, 2.0}, 1}},
                          2);
  const std::uint64_t repeats = expect_same_bodies(scene, division, 0.1, 1);
  EXPECT_EQ(world.velocity({0}), Vector2(0.0, 0.0)) << "the first one is not met in this window";
  EXPECT_EQ(world.counters().impacts(), 1u);
  EXPECT_GT(repeats, 0u);
}

/// One is struck towards the border just when a window ends, and another one from beyond touches it
/// but for a rounding: one joint impact, though neither path reaches where the other one's owner
/// would know of it. All numbers are exact.
TEST(SharedSimulation, EqualsOneEngineWhereTwoWhoDoNotKnowEachOtherCloseAtOneInstant) {
  SharedScene scene{physics::World(physics::test::rink_of(4.0, 2.0)), {}};
  physics::World& world = scene.world;
  const double length = 0x1p-6, radius = 0x1p-5, rounding = 0x1p-50, depth = 0x1p-20,
               edge = 2.0 - depth;
  world.add(physics::PuckSpec{.position = {edge - radius, 1.0}, .radius = radius});
  world.add(physics::PuckSpec{
      .position = {edge - 3.0 * radius - length, 1.0}, .velocity = {1.0, 0.0}, .radius = radius});
  world.add(physics::PuckSpec{.position = {edge + rounding + radius + 64.0 * length, 1.0},
                              .velocity = {-64.0, 0.0},
                              .radius = radius});
  const std::uint64_t repeats =
      expect_same_bodies(scene, slices(world.spec().field, 2), depth - 0.5 * rounding, 1, length);
  EXPECT_EQ(world.counters().joint_impacts, 1u);
  EXPECT_GT(repeats, 0u);
}

/// Rows along and across that meet, both struck at one instant.
TEST(SharedSimulation, EqualsOneEngineWhereCradlesCrossOverSeveralPeers) {
  for (const PeerNumber peer_count : {2, 3, 4, 6, 8, 16}) {
    SharedScene scene = shared_scene(15441, 0.0);
    std::vector<Vector2> places;
    for (std::uint32_t body = 0; body < scene.world.body_count(); ++body)
      places.push_back(scene.world.position({body}));
    const Division division =
        Cuts::by_count(scene.world.spec().field, places, peer_count).division(peer_count);
    expect_same_bodies(scene, division, 0.2, 30);
    EXPECT_GT(scene.world.counters().joint_impacts, 0u);
  }
}

/// An inelastic gas of very unequal masses that has collapsed into clusters, where discs graze each
/// other at gaps of some roundings for thousands of events; worlds that are rebuilt whenever a
/// window is repeated, beside one that never is.
TEST(SharedSimulation, EqualsOneEngineWhereAGasHasCollapsedIntoClusters) {
  SharedScene scene = shared_scene(11554, 0.0);
  std::vector<Vector2> places;
  for (std::uint32_t body = 0; body < scene.world.body_count(); ++body)
    places.push_back(scene.world.position({body}));
  const std::uint64_t repeats = expect_same_bodies(
      scene, Cuts::by_count(scene.world.spec().field, places, 4).division(4), 0.2, 34);
  EXPECT_GT(repeats, 0u);
  EXPECT_GT(scene.world.counters().hops, 10'000u);
}

void expect_same_crossing_rows(std::uint64_t first, std::uint64_t last, int window_count) {
  std::uint64_t joint_impacts = 0, repeats = 0;
  for (std::uint64_t number = first; number < last && !testing::Test::HasFailure(); ++number) {
    SCOPED_TRACE("rows " + std::to_string(number));
    Random random(11 * number + 5);
    SharedScene scene = crossing_rows(number, 0.01 * window_count);
    const PeerNumber peer_count = 2 + below(random, 15);
    const Division division = random_division(scene.world.spec().field, random, peer_count);
    repeats += expect_same_bodies(scene, division, uniform(random, 0.05, 0.25), window_count);
    joint_impacts += scene.world.counters().joint_impacts;
  }
  EXPECT_GT(joint_impacts, (last - first) / 4);
  EXPECT_GT(repeats, 0u);
  std::cout << joint_impacts << " joint impacts, " << repeats << " windows repeated\n";
}

TEST(SharedSimulation, EqualsOneEngineWhereRowsCrossAndAreStruckAtOneInstant) {
  expect_same_crossing_rows(0, 50, 12);
}

/// A lossless column out of which one puck slides sideways, and at whose ends friction stops who
/// moves at 4e-16 m/s: they rattled 6e-16 s apart, in which nobody got anywhere, without end.
TEST(SharedSimulation, EqualsOneEngineWhereAColumnRattlesAtSpeedsOfRoundings) {
  expect_same_crossing_rows(1058, 1059, 40);
}

/// A thousand in ten parts.
class CrossingRowsLong : public testing::TestWithParam<std::uint64_t> {};

TEST_P(CrossingRowsLong, EqualOneEngineAHundredTimes) {
  const std::uint64_t first = 100 + 100 * GetParam();
  expect_same_crossing_rows(first, first + 100, 40);
}

INSTANTIATE_TEST_SUITE_P(Part, CrossingRowsLong, testing::Range<std::uint64_t>(0, 10));

/// A thousand scenes in forty parts, which can be run one by one:
/// --gtest_filter='*SharedSimulationLong*/7'. Classes that are rare occur in all parts together.
class SharedSimulationLong : public testing::TestWithParam<std::uint64_t> {};

TEST_P(SharedSimulationLong, EqualsOneEngineBitForBitOver25OfThousandScenes) {
  const std::uint64_t first = 1000 + 25 * GetParam();
  EXPECT_GT(expect_same_histories(first, first + 25, 150, 3000).classes.long_runs, 0u);
}

INSTANTIATE_TEST_SUITE_P(Part, SharedSimulationLong, testing::Range<std::uint64_t>(0, 40));

}  // namespace
}  // namespace rink::peer::test
