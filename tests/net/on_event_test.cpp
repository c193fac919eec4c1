// Under the policy "on-event" a trajectory is sent when it changes; every mirror must know at every
// tick, within the stated error, where all in its interest are.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/net/lockstep_rink.h"
#include "tests/net/scenes.h"

namespace rink::game {
namespace {

/// How far all replicas are from the server's exact state, over all entities in scope and all
/// ticks.
struct Error {
  double squares = 0.0, greatest = 0.0;
  std::size_t count = 0;
  double rms() const { return count == 0 ? 0.0 : std::sqrt(squares / static_cast<double>(count)); }
};

/// The grid decides by centres.
bool is_by_centre(LockstepRink& rink) { return rink.scheme() == "grid"; }

std::vector<im::Region> views_of(LockstepRink& rink) {
  std::vector<im::Region> views;
  for (std::size_t k = 0; k < rink.client_count(); ++k) views.push_back(rink.client(k).view());
  return views;
}

void measure(LockstepRink& rink, std::size_t client, const im::Region& view, Error& error) {
  const Game& game = rink.server().game();
  for (const Entity& entity : game.entities()) {
    const Vector2 centre = game.position(entity.id);
    const EntityReplica* mirrored =
        rink.client(client).replicas().find(rink.server().publisher().object(entity.id));
    const bool is_known = mirrored != nullptr && mirrored->in_scope;
    ASSERT_TRUE(is_known || !overlaps(view, centre,
                                      is_by_centre(rink) ? Vector2(0.0, 0.0) : entity.half_extent))
        << "client " << client << " misses entity " << entity.id.index << " at t = " << game.now();
    if (!is_known) continue;
    ASSERT_TRUE(mirrored->trajectory.has_value());
    const double off = (mirrored->position_at(game.now()) - centre).norm();
    ASSERT_LE(off, trajectory_error_max)
        << "client " << client << ", entity " << entity.id.index << ", t = " << game.now();
    error.squares += off * off;
    error.greatest = std::max(error.greatest, off);
    ++error.count;
  }
}

/// Plays `ticks` and compares all clients after each.
void follow(LockstepRink& rink, int ticks, Error& error) {
  for (int tick = 0; tick < ticks && !testing::Test::HasFatalFailure(); ++tick) {
    rink.settle();
    const std::vector<im::Region> views = views_of(rink);
    rink.tick();
    for (std::size_t k = 0; k < views.size(); ++k) measure(rink, k, views[k], error);
  }
}

class OnEventUnderScheme : public testing::TestWithParam<const char*> {};

TEST_P(OnEventUnderScheme, MirrorsFollowACrowdWithinTheStatedErrorAtEveryTick) {
  const Scene scene = small_crowd();
  LockstepRink rink(scene, {.scheme = GetParam(),
                            .clients = 12,
                            .view_fraction = 0.3,
                            .server = {.policy = "on-event", .replay = keys_for(scene, 5, 8.0)}});
  rink.start();
  Error error;
  follow(rink, 240, error);
  EXPECT_GT(error.count, 10'000u);
  EXPECT_LE(error.rms(), 0.5 * trajectory_error_max);
  EXPECT_EQ(rink.client(0).replicas().counters().malformed, 0u);
  RecordProperty("rms_mm", std::to_string(1e3 * error.rms()));
  RecordProperty("greatest_mm", std::to_string(1e3 * error.greatest));
}

TEST_P(OnEventUnderScheme, AMirrorThatComesLateKnowsWhatWasLastSaidLongBefore) {
  Scene scene = small_crowd();
  scene.bodies.bats.resize(3);
  LockstepRink rink(scene, {.scheme = GetParam(),
                            .clients = 2,
                            .view_fraction = 0.5,
                            .server = {.policy = "on-event", .replay = std::vector<InputEvent>{}}});
  rink.start();
  Error error;
  for (int round = 0; round < 8; ++round) {
    for (int tick = 0; tick < 240; ++tick) rink.tick();
    follow(rink, 3, error);
  }
  rink.add_client("bat-2");
  rink.tick(), rink.tick(), rink.tick();
  ASSERT_EQ(rink.client(2).state(), Client::State::playing);
  follow(rink, 30, error);
}

INSTANTIATE_TEST_SUITE_P(Schemes, OnEventUnderScheme, testing::Values("none", "grid", "region"),
                         [](const auto& info) { return std::string(info.param); });

TEST(OnEvent, WithoutDragATrajectoryIsToldAgainBeforeRoundingLeadsItAstray) {
  Scene scene = match();
  scene.world.puck_drag = 0.0;
  scene.world.field.goal_width = 0.0;
  scene.world.restitution =
      physics::RestitutionTable(scene.world.restitution.material_count(), 1.0);
  scene.bodies.pucks[0].body.velocity = {0.313, 0.0};  // 4.7 s from wall to wall
  LockstepRink rink(scene, {.clients = 2,
                            .view_fraction = 1.0,
                            .server = {.policy = "on-event", .replay = std::vector<InputEvent>{}}});
  rink.start();
  Error error;
  follow(rink, 1800, error);
  EXPECT_GT(error.greatest, 0.3 * trajectory_error_max) << "or the test shows nothing";
}

TEST(OnEvent, MirrorsFollowPucksThatFrictionBringsToRest) {
  Scene scene = small_crowd();
  scene.world.puck_friction = 0.4;
  for (const double drag : {0.0, 0.25}) {
    scene.world.puck_drag = drag;
    LockstepRink rink(scene, {.clients = 6,
                              .view_fraction = 0.5,
                              .server = {.policy = "on-event", .replay = keys_for(scene, 5, 5.0)}});
    rink.start();
    Error error;
    follow(rink, 300, error);
    EXPECT_GT(error.count, 5'000u);
    EXPECT_EQ(rink.client(0).replicas().drag().puck_friction, 0.4);
    EXPECT_GT(rink.server().game().world().counters().stops, 50u) << "or the test shows nothing";
  }
}

TEST(OnEvent, MirrorsFollowGoalsAndFaceOffs) {
  Scene scene = match();
  scene.world.field.goal_width = 0.8;
  scene.rules.goals_to_win.reset();
  scene.bodies.pucks[0].body.velocity = {-3.0, 0.1};
  LockstepRink rink(scene, {.clients = 2,
                            .view_fraction = 1.0,
                            .server = {.policy = "on-event", .replay = keys_for(scene, 3, 40.0)}});
  rink.start();
  Error error;
  follow(rink, 1200, error);
  const Score score = rink.server().game().score();
  EXPECT_GT(score.left + score.right, 0u) << "or the test shows nothing";
}

TEST(OnEvent, MirrorsFollowBatsThatLeaveAndComeBack) {
  const Scene scene = small_crowd();
  LockstepRink rink(
      scene, {.clients = 6, .view_fraction = 0.5, .server = {.policy = "on-event", .replay = {}}});
  rink.start();
  for (std::size_t k = 0; k < 6; ++k) rink.client(k).press(static_cast<Key>(k % 4));
  Error error;
  follow(rink, 20, error);
  rink.client(5).ambassador().resign();
  rink.settle();
  for (int tick = 0; tick < 20; ++tick) {
    rink.settle();
    const std::vector<im::Region> views = views_of(rink);
    rink.tick();
    for (std::size_t k = 0; k < 5; ++k) measure(rink, k, views[k], error);
  }
  Client& back = rink.add_client("bat-5");
  for (int tick = 0; tick < 40; ++tick) rink.tick();
  ASSERT_EQ(back.state(), Client::State::playing);
  ASSERT_NE(back.bat(), nullptr);
  EXPECT_LE((back.bat()->position_at(rink.now) -
             rink.server().game().position(*rink.server().game().bat(5)))
                .norm(),
            trajectory_error_max);
}

TEST(OnEvent, APressedPuckIsFollowedAndNotToldEveryTick) {
  Scene scene = match();
  scene.bodies.pucks[0].body.position = {0.05, 0.6};
  scene.bodies.pucks[0].body.velocity = {0.0, 0.0};
  scene.world.field.goal_width = 0.0;
  LockstepRink rink(
      scene, {.clients = 2, .view_fraction = 1.0, .server = {.policy = "on-event", .replay = {}}});
  rink.start();
  rink.client(0).press(Key::left);  // the bat presses the puck to the wall
  Error error;
  follow(rink, 90, error);
  const std::uint64_t before = rink.client(0).replicas().counters().updates;
  follow(rink, 300, error);
  EXPECT_LE(rink.client(0).replicas().counters().updates - before, 300u)
      << "less than one update a tick for the two of them";
}

TEST(OnEvent, PlaysTheSameGameAsPeriodicWithAFractionOfTheUpdates) {
  const Scene scene = small_crowd();
  std::uint64_t hash[2] = {}, bytes[2] = {}, updates[2] = {};
  for (const int which : {0, 1}) {
    LockstepRink rink(scene, {.scheme = "region",
                              .clients = 12,
                              .server = {.policy = which == 0 ? "periodic" : "on-event",
                                         .replay = keys_for(scene, 5, 3.0)}});
    rink.start();
    const auto start_bytes = rink.execution().counters().bytes_sent,
               start_updates = rink.execution().counters().updates_sent;
    rink.run(3.0);
    hash[which] = rink.server().game().hash();
    bytes[which] = rink.execution().counters().bytes_sent - start_bytes;
    updates[which] = rink.execution().counters().updates_sent - start_updates;
  }
  EXPECT_EQ(hash[0], hash[1]);
  EXPECT_LT(3 * updates[1], updates[0]);
  EXPECT_LT(bytes[1], bytes[0]);
}

}  // namespace
}  // namespace rink::game
