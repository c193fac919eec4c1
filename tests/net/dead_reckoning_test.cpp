// Under the dead-reckoning policies a state is sent when what receivers extrapolate is off by more
// than a threshold; under "periodic" clients extrapolate from positions alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "game/model/scene_file.h"
#include "game/replication/trajectory_codec.h"
#include "tests/net/lockstep_rink.h"
#include "tests/net/scenes.h"
#include "tests/places.h"

namespace rink::game {
namespace {

/// What rounding alone makes of a position [m], and of a velocity that is at most a sixteenth of a
/// second old.
constexpr double rounding = 0.5 * trajectory_position_step * 1.4143 * (1.0 + trajectory_time_step);

/// Greatest distance at the server's instant between what the clients believe and what is, over all
/// that they have in scope.
double farthest_off(LockstepRink& rink, std::size_t& compared) {
  const Game& game = rink.server().game();
  double farthest = 0.0;
  for (std::size_t k = 0; k < rink.client_count(); ++k)
    for (const Entity& entity : game.entities()) {
      const EntityReplica* mirrored =
          rink.client(k).replicas().find(rink.server().publisher().object(entity.id));
      if (mirrored == nullptr || !mirrored->in_scope) continue;
      farthest =
          std::max(farthest, (mirrored->position_at(game.now()) - game.position(entity.id)).norm());
      ++compared;
    }
  return farthest;
}

class DeadReckoning : public testing::TestWithParam<std::tuple<const char*, const char*, double>> {
};

TEST_P(DeadReckoning, KeepsEveryMirrorWithinTheThresholdAtEveryTick) {
  const auto [policy, scheme, threshold] = GetParam();
  const Scene scene = small_crowd();
  LockstepRink rink(
      scene,
      {.scheme = scheme,
       .clients = 12,
       .view_fraction = 0.3,
       .server = {.policy = policy, .threshold = threshold, .replay = keys_for(scene, 5, 8.0)}});
  rink.start();
  std::size_t compared = 0;
  double farthest = 0.0;
  for (int tick = 0; tick < 240; ++tick) {
    rink.tick();
    farthest = std::max(farthest, farthest_off(rink, compared));
    ASSERT_LE(farthest, std::max(threshold, rounding)) << "t = " << rink.server().game().now();
  }
  EXPECT_GT(compared, 10'000u);
  EXPECT_GT(farthest, 0.5 * threshold) << "the threshold is made use of";
  EXPECT_EQ(rink.client(0).replicas().counters().malformed, 0u);
}

const auto policies_schemes_and_thresholds =
    testing::Combine(testing::Values("dead-reckoning", "dead-reckoning-drag"),
                     testing::Values("none", "grid", "region"), testing::Values(2e-3, 2e-2));

INSTANTIATE_TEST_SUITE_P(Policies, DeadReckoning, policies_schemes_and_thresholds,
                         [](const auto& info) {
                           const std::string policy =
                               std::get<0>(info.param) == std::string("dead-reckoning")
                                   ? "FirstOrder"
                                   : "WithDrag";
                           return policy + "_" + std::get<1>(info.param) +
                                  (std::get<2>(info.param) < 1e-2 ? "_2mm" : "_20mm");
                         });

/// Updates of entities that a client of everything hears in `seconds` of `scene`, in which nobody
/// presses a key.
std::uint64_t updates_of(const Scene& scene, const char* policy, double threshold, double seconds) {
  LockstepRink rink(
      scene,
      {.scheme = "none",
       .clients = 1,
       .server = {.policy = policy, .threshold = threshold, .replay = std::vector<InputEvent>{}}});
  rink.start();
  rink.tick();
  const std::uint64_t before = rink.client(0).replicas().counters().updates;
  rink.run(seconds);
  return rink.client(0).replicas().counters().updates - before;
}

Scene lone_puck(double drag) {
  return parse_scene(
      "name = 'lone'\nseed = 1\n[field]\nlength = 40.0\nwidth = 4.0\n[drag]\npucks = " +
          std::to_string(drag) +
          "\nbats = 0.5\n[[puck]]\nname = 'puck'\nposition = [2.0, 2.0]\nvelocity = [4.0, "
          "0.0]\nradius = 0.04\nmass = 0.02\n"
          "[[bat]]\nname = 'bat'\nposition = [39.0, 1.0]\nhalf_extent = [0.03, 0.1]\nmass = "
          "0.5\nthrust = 1.0\n",
      "lone.toml");
}

TEST(DeadReckoningOfALonePuck, SaysNothingWhereTheReceiversLawIsItsOwn) {
  EXPECT_EQ(updates_of(lone_puck(0.0), "dead-reckoning", 5e-3, 3.0), 0u);
  EXPECT_EQ(updates_of(lone_puck(0.3), "dead-reckoning-drag", 5e-3, 3.0), 0u);
  EXPECT_GT(updates_of(lone_puck(0.3), "dead-reckoning", 5e-3, 3.0), 10u)
      << "a straight line at constant speed is not what it follows";
}

TEST(DeadReckoningOfALonePuck, SpeaksAsOftenAsTheThresholdAsks) {
  // A straight line misses a deceleration a by a t^2 / 2, so one is due each sqrt(2 threshold / a);
  // with a = g v, g = 0.3 and v from 4 to 2.5 m/s.
  for (const double threshold : {5e-3, 2e-2, 8e-2}) {
    const double seconds = 1.5;
    double expected = 0.0;
    for (double t = 0.0; t < seconds; t += 1e-3)
      expected +=
          1e-3 / (std::sqrt(2.0 * threshold / (0.3 * 4.0 * std::exp(-0.3 * t))) + 0.5 / 30.0);
    EXPECT_NEAR(
        static_cast<double>(updates_of(lone_puck(0.3), "dead-reckoning", threshold, seconds)),
        expected, 0.1 * expected + 1.0)
        << threshold;
  }
}

TEST(DeadReckoningPolicies, LeaveTheGameAsItIs) {
  const Scene scene = small_crowd();
  std::uint64_t hashes[3];
  const char* const policies[] = {"periodic", "dead-reckoning", "dead-reckoning-drag"};
  for (int which = 0; which < 3; ++which) {
    LockstepRink rink(
        scene,
        {.clients = 4, .server = {.policy = policies[which], .replay = keys_for(scene, 5, 3.0)}});
    rink.start();
    for (int tick = 0; tick < 90; ++tick) rink.tick();
    hashes[which] = rink.server().game().hash();
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

/// What a client of everything believes of the puck half a tick after the tenth tick, off by so
/// much [m].
double off_between_ticks(double drag, bool extrapolates) {
  LockstepRink rink(lone_puck(drag), {.scheme = "none",
                                      .clients = 1,
                                      .extrapolates = extrapolates,
                                      .server = {.replay = std::vector<InputEvent>{}}});
  rink.start();
  for (int tick = 0; tick < 10; ++tick) rink.tick();
  const Game& game = rink.server().game();
  const Entity puck =
      *std::find_if(game.entities().begin(), game.entities().end(),
                    [](const Entity& each) { return each.kind == physics::BodyKind::puck; });
  const double later = game.now() + 0.5 / 30.0;
  return (rink.client(0)
              .replicas()
              .find(rink.server().publisher().object(puck.id))
              ->position_at(later) -
          game.world().motion(puck.id).at(later).position)
      .norm();
}

TEST(PeriodicPositions, AreShownAheadByTheVelocityBetweenTheLastTwo) {
  for (const double drag : {0.0, 0.3}) {
    EXPECT_LT(off_between_ticks(drag, true), 1e-5) << "single precision is what is left";
    EXPECT_NEAR(off_between_ticks(drag, false), 4.0 * std::exp(-drag * 0.35) * 0.5 / 30.0, 2e-3)
        << "as the paper shows them, half a tick behind";
  }
}

TEST(PeriodicPositions, OfWhatWasPutElsewhereAreShownWhereItWasPut) {
  const ObjectModel model(load_rink_fom(test::source_folder() + "/game/net/rink.fom.xml"));
  ReplicaSet replicas(model);
  replicas.extrapolate();
  const rti::ObjectHandle puck{7};
  replicas.discover(puck, model.entity);
  replicas.set_scope(puck, true);
  std::vector<std::byte> bytes;
  const auto tell = [&](float x, double time) {
    replicas.reflect(puck, {model.position}, encode(bytes, Position{x, 0.0f}),
                     {.time = time, .tag = 1});
  };
  const auto shown = [&](double instant) { return replicas.find(puck)->position_at(instant).x(); };
  tell(1.0f, 1.0);
  EXPECT_EQ(shown(2.0), 1.0) << "one position says nothing of how it moves";
  tell(1.5f, 1.25);
  EXPECT_NEAR(shown(1.5), 2.0, 1e-12);
  tell(20.0f, 1.5);
  EXPECT_EQ(shown(1.75), 20.0) << "74 m/s is no way";
  tell(20.5f, 1.75);
  EXPECT_NEAR(shown(2.0), 21.0, 1e-12);
  tell(20.5f, 2.0);
  EXPECT_EQ(shown(3.0), 20.5) << "it rests";
  tell(21.0f, 4.0);
  EXPECT_EQ(shown(5.0), 21.0) << "two seconds ago is too long ago";
  tell(21.5f, 4.25);
  replicas.set_scope(puck, false);
  replicas.set_scope(puck, true);
  EXPECT_EQ(shown(5.0), 21.5) << "it was away meanwhile";
  tell(22.0f, 4.5);
  EXPECT_EQ(shown(5.0), 22.0);
}

}  // namespace
}  // namespace rink::game
