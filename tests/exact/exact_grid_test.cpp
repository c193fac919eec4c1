// On the network grid a client that computes still has the server's bits, and states are short.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "game/physics/rounding/motion_grid.h"
#include "tests/exact/exact_rink.h"

namespace rink::game {
namespace {

using physics::MotionGrid;

Scene on_grid(Scene scene, double rate_hz) {
  scene.network_grid = rate_hz;
  return scene;
}

LockstepSettings settings_for(const Scene& scene, std::uint64_t seed, double view_fraction) {
  return {.scheme = view_fraction >= 1.0 ? "none" : "region",
          .clients = 6,
          .view_fraction = view_fraction,
          .view_margin = 0.3,
          .server = {.policy = "exact", .replay = keys_for(scene, seed, 10.0)}};
}

/// Ticks come at 30 Hz: grids at the same instants, at every second one, and in between.
TEST(ExactGrid, ClientsHaveTheServersBitsAtWhateverRateBodiesAreRounded) {
  std::uint64_t told = 0, entries = 0, left_off = 0;
  for (const double rate_hz : {30.0, 15.0, 20.0, 77.0})
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const Scene scene = on_grid(with_seed(small_crowd(), seed), rate_hz);
      LockstepRink rink(scene, settings_for(scene, seed, 0.2));
      rink.start();
      Compared compared;
      for (int tick = 0; tick < 120 && !HasFatalFailure(); ++tick) {
        follow(rink, 1, std::to_string(rate_hz) + " Hz, seed " + std::to_string(seed), compared);
        left_off += rink.server().game().network_grid().left_off().size();
      }
      if (HasFatalFailure()) return;
      const ExactReplicaCounters sum = counted(rink);
      EXPECT_EQ(sum.wrong_hashes + sum.malformed, 0u) << rate_hz << " " << seed;
      told += sum.doubtful, entries += sum.entries;
    }
  EXPECT_GT(told, 100u);
  EXPECT_GT(entries, 1000u);
  RecordProperty("left_off", std::to_string(left_off));
}

TEST(ExactGrid, WhoSeesAllComesLateOrLooksAheadIsExact) {
  Scene scene = on_grid(small_crowd(), 30.0);
  scene.bodies.bats.resize(6);
  LockstepSettings settings = settings_for(scene, 4, 1.0);
  settings.clients = 2;
  LockstepRink rink(scene, settings);
  rink.start();
  Compared compared;
  for (int tick = 0; tick < 90 && !HasFatalFailure(); ++tick) {
    if (tick % 30 == 20) rink.add_client("bat-" + std::to_string(2 + tick / 30));
    for (std::size_t k = 0; k < 2; ++k) rink.client(k).computed()->look_ahead(rink.now + 0.05);
    follow(rink, 1, "all", compared);
  }
  EXPECT_GT(compared.bodies, 10'000u);
  EXPECT_EQ(counted(rink).wrong_hashes, 0u);
}

TEST(ExactGrid, GoalsAndFaceOffsStayExact) {
  Scene scene = on_grid(small_crowd(), 30.0);
  scene.world.field.goal_width = 0.8 * scene.world.field.width;
  scene.rules.face_off_delay = 0.4;
  LockstepRink rink(scene, settings_for(scene, 9, 0.4));
  rink.start();
  Compared compared;
  follow(rink, 200, "goals", compared);
  EXPECT_GT(rink.server().game().world().counters().goals, 20u);
}

/// Rest contacts, pushed rows, jams; many bodies are nearer to each other than rounding may bring
/// them.
TEST(ExactGrid, PilesStayExactAndWhoHasNoRoomIsTold) {
  std::uint64_t rests = 0, left_off = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Scene scene = on_grid(with_seed(small_crowd(), seed), 30.0);
    scene.world.restitution = physics::RestitutionTable(scene.materials.size(), 0.1);
    for (Bat& bat : scene.bodies.bats) bat.thrust = 12.0;
    LockstepRink rink(scene, settings_for(scene, seed, 0.15));
    rink.start();
    Compared compared;
    for (int tick = 0; tick < 180 && !HasFatalFailure(); ++tick) {
      follow(rink, 1, "piles of seed " + std::to_string(seed), compared);
      left_off += rink.server().game().network_grid().left_off().size();
    }
    if (HasFatalFailure()) return;
    EXPECT_EQ(counted(rink).wrong_hashes, 0u) << seed;
    rests += rink.server().game().world().counters().rests;
  }
  EXPECT_GT(rests, 100u);
  EXPECT_GT(left_off, 10u) << "or the test tests nothing";
}

TEST(ExactGrid, FrictionAndSpinAreRoundedToo) {
  Scene scene = on_grid(small_crowd(), 30.0);
  scene.world.puck_friction = 0.3;
  const std::size_t materials = scene.materials.size();
  scene.world.surface_friction = physics::SurfaceFriction{
      physics::PairTable(materials, 0.2), physics::RestitutionTable(materials, 0.0)};
  LockstepRink rink(scene, settings_for(scene, 3, 0.2));
  rink.start();
  Compared compared;
  follow(rink, 200, "friction", compared);
  EXPECT_GT(counted(rink).doubtful, 10u);
  EXPECT_EQ(counted(rink).wrong_hashes, 0u);
}

/// Every free body whose last event is the grid's.
TEST(ExactGrid, StatesOnTheGridAreShortAndKeepEveryBit) {
  const Scene scene = on_grid(small_crowd(), 30.0);
  Game game(scene);
  for (const InputEvent& event : keys_for(scene, 1, 5.0)) game.submit(event);
  game.advance(3.0 + 1.0 / 64.0);
  const ExactInstant instant{game.world().spec(), game.network_grid().instants(), game.now()};
  std::size_t count = 0, bits = 0;
  for (const Entity& entity : game.entities()) {
    if (entity.kind != physics::BodyKind::puck) continue;
    physics::Flight f = physics::Subdomain::state_in(game.world(), entity.id.index).flight;
    const bool is_short = exact::on_grid(f, instant).has_value();
    if (f.time > 3.0) {
      EXPECT_FALSE(is_short) << "changed since";
      continue;
    }
    if (!is_short) continue;
    std::vector<std::byte> bytes;
    {
      rti::BitWriter writer(bytes);
      exact::exchange_flight(writer, f, instant);
      bits += writer.at();
    }
    physics::Flight found{};
    found.radius = f.radius;
    rti::BitReader reader(bytes);
    ASSERT_TRUE(exact::exchange_flight(reader, found, instant));
    ASSERT_TRUE(are_same_bits({f.x, f.y}, {found.x, found.y}));
    ASSERT_TRUE(are_same_bits({f.vx, f.vy}, {found.vx, found.vy}));
    ASSERT_EQ(f.time, found.time);
    ++count;
  }
  EXPECT_GT(count, 100u);
  EXPECT_LT(static_cast<double>(bits) / static_cast<double>(count), 8.0 * 12.0);
}

}  // namespace
}  // namespace rink::game
