// Under the policy "exact" whatever a client knows is as at the server, to the last bit, whoever
// comes, goes, scores, rests or is hit by somebody unknown.
#include <gtest/gtest.h>

#include "game/replication/trajectory.h"
#include "tests/exact/exact_rink.h"

namespace rink::game {
namespace {

LockstepSettings settings_for(const Scene& scene, std::uint64_t seed, double seconds,
                              double view_fraction) {
  return {.scheme = view_fraction >= 1.0 ? "none" : "region",
          .clients = 6,
          .view_fraction = view_fraction,
          .view_margin = 0.3,
          .server = {.policy = "exact", .replay = keys_for(scene, seed, seconds)}};
}

TEST(Exact, WhoSeesAllIsSentKeysAndComputesTheRest) {
  const Scene scene = small_crowd();
  LockstepRink rink(scene, settings_for(scene, 5, 8.0, 1.0));
  rink.start();
  Compared compared;
  follow(rink, 240, "all", compared);
  const ExactReplicaCounters sum = counted(rink);
  EXPECT_GT(compared.bodies, 6u * 200u * 100u);
  EXPECT_GT(sum.keys, 100u);
  EXPECT_GT(sum.hashes, 30u);
  EXPECT_EQ(sum.wrong_hashes + sum.malformed, 0u);
  EXPECT_EQ(sum.starts, 6u);
  RecordProperty("told", std::to_string(sum.doubtful));
}

TEST(Exact, WhoSeesAPartComputesItThroughEntriesExitsAndHitsFromBeyond) {
  std::uint64_t told = 0, entries = 0, exits = 0, lingering = 0, returns = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Scene scene = with_seed(small_crowd(), seed);
    LockstepRink rink(scene, settings_for(scene, seed, 6.0, 0.2));
    rink.start();
    Compared compared;
    follow(rink, 180, "seed " + std::to_string(seed), compared);
    if (HasFatalFailure()) return;
    const ExactReplicaCounters sum = counted(rink);
    EXPECT_EQ(sum.wrong_hashes + sum.malformed, 0u) << "seed " << seed;
    told += sum.doubtful, entries += sum.entries, exits += sum.exits;
    lingering += compared.lingering, returns += rink.exact_feed()->counters().returns;
  }
  EXPECT_GT(told, 50u);
  EXPECT_GT(entries, 500u);
  EXPECT_GT(exits, 300u);
  EXPECT_GT(lingering, 1000u);
  EXPECT_GT(returns, 50u);
  RecordProperty("told", std::to_string(told));
  RecordProperty("entries", std::to_string(entries));
}

TEST(Exact, WhoComesLateKnowsAllAtOnce) {
  Scene scene = small_crowd();
  scene.bodies.bats.resize(4);
  LockstepRink rink(scene, {.scheme = "region",
                            .clients = 2,
                            .view_fraction = 0.3,
                            .view_margin = 0.3,
                            .server = {.policy = "exact", .replay = keys_for(scene, 3, 20.0)}});
  rink.start();
  Compared compared;
  follow(rink, 100, "before", compared);
  for (const char* name : {"bat-2", "bat-3"}) {
    rink.add_client(name);
    follow(rink, 60, name, compared);
  }
  rink.add_client("watcher", true);
  follow(rink, 30, "with a watcher", compared);
  ASSERT_NE(rink.client(4).computed(), nullptr);
  EXPECT_GT(rink.client(4).computed()->exact().bodies().size(), 10u);
  EXPECT_EQ(counted(rink).starts, 5u);
}

/// Live players: a bat that left and came back is another body.
TEST(Exact, BatsThatLeaveAndComeBackAreUnknownUntilTheTickEnds) {
  Scene scene = small_crowd();
  scene.bodies.bats.resize(5);
  LockstepRink rink(scene, {.scheme = "region",
                            .clients = 5,
                            .view_fraction = 0.5,
                            .view_margin = 0.3,
                            .server = {.policy = "exact", .replay = {}, .key_limit_per_s = 0.0}});
  rink.start();
  Compared compared;
  for (int round = 0; round < 4; ++round) {
    for (std::size_t k = 0; k < 4; ++k)
      if (rink.client(k).state() == Client::State::playing) {
        rink.client(k).press(all_keys[(k + static_cast<std::size_t>(round)) % 4]);
        rink.now += 0.003;
      }
    follow(rink, 20, "round " + std::to_string(round), compared);
    if (round == 1) rink.leave(4);
    if (round == 2) rink.add_client("bat-4");
  }
  ASSERT_FALSE(HasFatalFailure());
  EXPECT_EQ(rink.client(5).state(), Client::State::playing);
  EXPECT_GT(counted(rink).keys, 10u);
}

TEST(Exact, PucksThatScoreAndAreFacedOffStayExact) {
  Scene scene = small_crowd();
  scene.world.field.goal_width = 0.8 * scene.world.field.width;
  scene.rules.face_off_delay = 0.4;
  LockstepRink rink(scene, settings_for(scene, 9, 8.0, 0.4));
  rink.start();
  Compared compared;
  follow(rink, 200, "goals", compared);
  EXPECT_GT(rink.server().game().world().counters().goals, 20u);
}

/// Bats without bounce that press pucks and each other against walls: rest contacts, pushed rows,
/// jams.
TEST(Exact, RestContactsAndPilesStayExactThoughSomeKnowHalfOfThem) {
  std::uint64_t held = 0, rests = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Scene scene = with_seed(small_crowd(), seed);
    scene.world.restitution = physics::RestitutionTable(scene.materials.size(), 0.1);
    for (Bat& bat : scene.bodies.bats) bat.thrust = 12.0;
    LockstepRink rink(scene, settings_for(scene, seed, 6.0, 0.15));
    rink.start();
    Compared compared;
    follow(rink, 180, "piles of seed " + std::to_string(seed), compared);
    if (HasFatalFailure()) return;
    EXPECT_EQ(counted(rink).wrong_hashes, 0u) << seed;
    held += compared.held_by_unknown, rests += rink.server().game().world().counters().rests;
  }
  EXPECT_GT(rests, 100u);
  RecordProperty("held_by_unknown", std::to_string(held));
}

TEST(Exact, AClientThatLooksAheadTakesItBackWhenNewsCome) {
  const Scene scene = small_crowd();
  LockstepRink rink(scene, settings_for(scene, 4, 4.0, 0.3));
  rink.start();
  Compared compared;
  for (int tick = 0; tick < 100 && !HasFatalFailure(); ++tick) {
    for (std::size_t k = 0; k < rink.client_count(); ++k)
      for (int step = 1; step <= 3; ++step)
        rink.client(k).computed()->look_ahead(rink.now + 0.02 * step);
    follow(rink, 1, "ahead", compared);
  }
  EXPECT_EQ(counted(rink).wrong_hashes, 0u);
}

TEST(Exact, WhoLooksBackShowsTheLastTickAgain) {
  const Scene scene = small_crowd();
  LockstepRink rink(scene, settings_for(scene, 4, 4.0, 0.3));
  rink.start();
  std::size_t moved = 0;
  for (int tick = 0; tick < 50; ++tick) {
    Compared compared;
    follow(rink, 1, "back", compared);
    for (std::size_t k = 0; k < rink.client_count(); ++k) {
      Client& client = rink.client(k);
      const std::vector<EntityReplica> before(client.replicas().entities().begin(),
                                              client.replicas().entities().end());
      client.computed()->look_ahead(rink.now + 0.1);
      for (const EntityReplica& each : before)
        moved += client.replicas().find(each.object)->motion.time != each.motion.time;
      client.computed()->look_back();
      for (const EntityReplica& each : before) {
        const EntityReplica& now = *client.replicas().find(each.object);
        EXPECT_EQ(now.motion.time, each.motion.time);
        EXPECT_EQ(now.motion.position, each.motion.position);
        EXPECT_EQ(now.motion.velocity, each.motion.velocity);
      }
    }
  }
  EXPECT_GT(moved, 100u);
}

/// All that the client has in scope is within the error of trajectories; answers how many.
std::size_t count_followed(LockstepRink& rink, Client& client) {
  std::size_t count = 0;
  for (const Entity& entity : rink.server().game().entities()) {
    const EntityReplica* const shown =
        client.replicas().find(rink.server().publisher().object(entity.id));
    if (shown == nullptr || !shown->in_scope) continue;
    const double now = rink.server().game().now();
    EXPECT_LE((shown->position_at(now) - rink.server().game().position(entity.id)).norm(),
              trajectory_error_max)
        << "entity " << entity.id.index << " at t = " << now;
    ++count;
  }
  return count;
}

TEST(Exact, WhoDoesNotComputeIsSentTrajectoriesBesideOthersWhoDo) {
  const Scene scene = small_crowd();
  LockstepSettings settings = settings_for(scene, 4, 4.0, 0.3);
  settings.told = 2;
  LockstepRink rink(scene, settings);
  rink.start();
  Compared compared;
  for (int tick = 0; tick < 60 && !HasFatalFailure(); ++tick) {
    follow(rink, 1, "mixed", compared);
    EXPECT_GT(count_followed(rink, rink.client(0)), 10u);
  }
  EXPECT_EQ(rink.client(0).computed(), nullptr);
  EXPECT_NE(rink.client(2).computed(), nullptr);
  EXPECT_EQ(rink.exact_feed()->counters().starts, 4u);
}

TEST(Exact, AMessageThatCannotBeReadIsMendedAndAfterThreeTheServerTellsAll) {
  const Scene scene = small_crowd();
  LockstepRink rink(scene, settings_for(scene, 4, 6.0, 0.3));
  rink.start();
  rink.run(1.0);
  // Right after a hash, so that no right one comes in between.
  const std::uint64_t hashes = rink.client(0).computed()->exact().counters().hashes;
  while (rink.client(0).computed()->exact().counters().hashes == hashes) rink.tick();
  const std::vector<std::byte> garbage(40, std::byte{0xff});
  const rti::FederateHandle first = rink.client(0).ambassador().federate();
  for (std::uint32_t failure = 1; failure <= ExactReplicas::wrong_in_row_max; ++failure) {
    ASSERT_TRUE(rink.client(0).computed()->exact().is_exact()) << failure;
    rink.execution().send_host_message(first, garbage);
    rink.settle();
    EXPECT_FALSE(rink.client(0).computed()->exact().is_exact()) << failure;
    if (failure == ExactReplicas::wrong_in_row_max) break;
    Compared compared;
    rink.tick();
    compare(rink, rink.client(0), "mended", compared);
    EXPECT_GT(compared.bodies, 10u);
  }
  for (int tick = 0; tick < 30; ++tick) {
    rink.tick();
    if (tick > 1) {
      EXPECT_GT(count_followed(rink, rink.client(0)), 10u);
    }
    Compared compared;
    compare(rink, rink.client(1), "another", compared);
    if (HasFatalFailure()) return;
  }
  EXPECT_EQ(rink.exact_feed()->counters().starts, 6u + 2u);
}

}  // namespace
}  // namespace rink::game
