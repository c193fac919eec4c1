// Under the policy "snapshot" every replica has at every tick, to half the stated resolution,
// where all in its interest are, from differences to what it acknowledged.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/net/lockstep_rink.h"
#include "tests/net/scenes.h"

namespace rink::game {
namespace {

/// Half of what rink.fom.xml says of a Place [m] and a Pace [m/s].
constexpr double position_error_max = 0.5 * 0.0005, velocity_error_max = 0.5 * 0.004;

class SnapshotUnderScheme : public testing::TestWithParam<const char*> {};

TEST_P(SnapshotUnderScheme, MirrorsFollowACrowdWithinHalfTheResolutionAtEveryTick) {
  const Scene scene = small_crowd();
  LockstepRink rink(scene, {.scheme = GetParam(),
                            .clients = 12,
                            .view_fraction = 0.3,
                            .server = {.policy = "snapshot", .replay = keys_for(scene, 5, 8.0)}});
  rink.start();
  std::size_t compared = 0;
  for (int tick = 0; tick < 240; ++tick) {
    rink.tick();
    const Game& game = rink.server().game();
    for (std::size_t k = 0; k < rink.client_count(); ++k) {
      for (const Entity& entity : game.entities()) {
        const EntityReplica* mirrored =
            rink.client(k).replicas().find(rink.server().publisher().object(entity.id));
        if (mirrored == nullptr || !mirrored->in_scope) continue;
        ASSERT_TRUE(mirrored->trajectory.has_value());
        const Vector2 off = mirrored->position_at(game.now()) - game.position(entity.id);
        ASSERT_LE(off.cwiseAbs().maxCoeff(), position_error_max + 1e-12)
            << "client " << k << ", entity " << entity.id.index << ", t = " << game.now();
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 10'000u);
  const rti::BaselineCounters& counters = rink.execution().baseline_counters();
  EXPECT_GT(counters.differences_sent, 5 * counters.absolutes_sent);
  EXPECT_EQ(counters.refused, 0u);
  EXPECT_EQ(rink.client(0).replicas().counters().malformed, 0u);
}

INSTANTIATE_TEST_SUITE_P(Schemes, SnapshotUnderScheme, testing::Values("none", "grid", "region"),
                         [](const auto& info) { return std::string(info.param); });

TEST(Snapshot, TellsVelocitiesToHalfTheirResolution) {
  const Scene scene = small_crowd();
  LockstepRink rink(scene, {.scheme = "none",
                            .clients = 1,
                            .server = {.policy = "snapshot", .replay = keys_for(scene, 5, 2.0)}});
  rink.start();
  for (int tick = 0; tick < 60; ++tick) rink.tick();
  const Game& game = rink.server().game();
  std::size_t moving = 0;
  for (const Entity& entity : game.entities()) {
    const EntityReplica* mirrored =
        rink.client(0).replicas().find(rink.server().publisher().object(entity.id));
    ASSERT_NE(mirrored, nullptr);
    const physics::Motion motion = game.world().motion(entity.id);
    if (!game.world().is_in_play(entity.id) || game.world().is_resting(entity.id)) continue;
    const Vector2 off =
        mirrored->trajectory->velocity - motion.at(std::max(game.now(), motion.time)).velocity;
    EXPECT_LE(off.cwiseAbs().maxCoeff(), velocity_error_max + 1e-12);
    ++moving;
  }
  EXPECT_GT(moving, 20u);
}

TEST(Snapshot, LeavesTheGameAsItIs) {
  const Scene scene = small_crowd();
  std::uint64_t hashes[2];
  for (int which = 0; which < 2; ++which) {
    LockstepRink rink(scene, {.scheme = "region",
                              .clients = 4,
                              .server = {.policy = which == 0 ? "periodic" : "snapshot",
                                         .replay = keys_for(scene, 5, 3.0)}});
    rink.start();
    for (int tick = 0; tick < 90; ++tick) rink.tick();
    hashes[which] = rink.server().game().hash();
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

}  // namespace
}  // namespace rink::game
