// What the network grid does to conservation: rounding has no direction, and drifts no further than
// a random walk of independent roundings.
#include <cmath>

#include "game/physics/rounding/motion_grid.h"
#include "tests/accuracy/accuracy_scene.h"

namespace rink::accuracy {
namespace {

using physics::MotionGrid;

/// Sums over all roundings of a gas.
struct Roundings {
  double count = 0.0;                       ///< of axes: two a body
  double place = 0.0, place_squares = 0.0;  ///< [steps]
  double speed = 0.0, speed_squares = 0.0;  ///< [steps]
  double energy_variance = 0.0;             ///< that independent roundings would have [J^2]
  double left_off = 0.0;                    ///< bodies
};

/// Plays `world` to `until`, and rounds who has changed `rate_hz` times a second.
Roundings play_rounded(World& world, double until, double rate_hz) {
  Roundings sum;
  constexpr double variance = MotionGrid::velocity_step * MotionGrid::velocity_step / 12.0;
  for (int instant = 1; instant <= static_cast<int>(until * rate_hz); ++instant) {
    world.advance(instant / rate_hz);
    for (std::uint32_t k = 0; k < world.body_count(); ++k) {
      const Vector2 place = world.position({k}), velocity = world.velocity({k});
      const auto result = MotionGrid::put(world, {k}, (instant - 1) / rate_hz);
      if (result == MotionGrid::Result::left_off) sum.left_off += 1.0;
      if (result != MotionGrid::Result::put) continue;
      const Vector2 moved = (world.position({k}) - place) / MotionGrid::position_step,
                    turned = (world.velocity({k}) - velocity) / MotionGrid::velocity_step;
      sum.count += 2.0;
      sum.place += moved.sum(), sum.place_squares += moved.squaredNorm();
      sum.speed += turned.sum(), sum.speed_squares += turned.squaredNorm();
      sum.energy_variance += world.mass({k}) * world.mass({k}) * velocity.squaredNorm() * variance;
    }
  }
  return sum;
}

World gas() {
  const Scene scene = scene_named("gas-energy");
  World world(scene.world);
  for (const auto& puck : scene.bodies.pucks) world.add(puck.body);
  return world;
}

TEST(NetworkGrid, RoundingHasNoDirectionAndTheVarianceOfItsStep) {
  World world = gas();
  const Roundings sum = play_rounded(world, is_sanitized ? 2.0 : 20.0, 60.0);
  EXPECT_GT(sum.count, is_sanitized ? 1e4 : 1e5);
  const double sigma = std::sqrt(1.0 / 12.0 / sum.count);  // of a mean [steps]
  expect_at_most("mean rounding of places / its sigma", std::abs(sum.place / sum.count) / sigma,
                 4.0);
  expect_at_most("mean rounding of speeds / its sigma", std::abs(sum.speed / sum.count) / sigma,
                 4.0);
  expect_within("variance of places [steps^2]", sum.place_squares / sum.count, 1.0 / 12.0, 0.02);
  expect_within("variance of speeds [steps^2]", sum.speed_squares / sum.count, 1.0 / 12.0, 0.02);
  EXPECT_LT(sum.left_off, 0.01 * sum.count);
}

TEST(NetworkGrid, EnergyDriftsAsTheSumOfIndependentRoundings) {
  World world = gas();
  const double energy = world.kinetic_energy(), until = is_sanitized ? 2.0 : 20.0;
  const Roundings sum = play_rounded(world, until, 60.0);
  // Each adds m step^2 / 24 on average along each axis, far below the walk.
  const double bias = sum.count * MotionGrid::velocity_step * MotionGrid::velocity_step / 24.0;
  expect_at_most("drift of the energy less its bias / its sigma",
                 std::abs(world.kinetic_energy() - energy - bias) / std::sqrt(sum.energy_variance),
                 4.0);
  expect_at_most("relative drift of the energy", std::abs(world.kinetic_energy() / energy - 1.0),
                 1e-5);
  World free = gas();
  free.advance(until);
  expect_at_most("the same without the grid", std::abs(free.kinetic_energy() / energy - 1.0),
                 2e-14);
  expect_within("collisions, with and without the grid",
                static_cast<double>(world.counters().disc_impacts),
                static_cast<double>(free.counters().disc_impacts), 0.02);
  expect_at_most("deepest overlap [m]", world.max_overlap(), 1e-12);
}

TEST(NetworkGrid, MomentumAwayFromWallsDriftsAsTheSumOfIndependentRoundings) {
  Scene scene = scene_named("cluster-momentum");
  scene.network_grid = 60.0;
  Game game(scene);
  const Vector2 momentum = game.world().momentum();
  double variance = 0.0;
  for (std::uint32_t k = 0; k < game.world().body_count(); ++k)
    variance += std::pow(game.world().mass({k}) * MotionGrid::velocity_step, 2) / 12.0;
  game.advance(3.0);
  EXPECT_EQ(game.world().counters().wall_impacts, 0u);
  EXPECT_GT(game.world().counters().disc_impacts, 500u);
  // A body is rounded after each of its impacts at most.
  const double each = 1.0 + 2.0 * static_cast<double>(game.world().counters().disc_impacts) /
                                static_cast<double>(game.world().body_count());
  expect_at_most("change of the momentum / its sigma along both axes",
                 (game.world().momentum() - momentum).norm() / std::sqrt(2.0 * each * variance),
                 4.0);
}

/// The books of energy enter what rounding gives or takes.
TEST(NetworkGrid, BooksOfEnergyStayClosed) {
  Scene scene =
      game::scaled_to_bats(game::load_scene(test::source_folder() + "/scenes/crowd-grid.toml"), 12);
  scene.world.accounts_energy = true;
  Game game(scene);
  game.advance(10.0);
  const World& world = game.world();
  expect_at_most("books of energy: relative error",
                 std::abs(world.energy_introduced() + world.work_of_thrust() - world.dissipated() -
                          world.kinetic_energy()) /
                     world.energy_introduced(),
                 1e-12);
}

}  // namespace
}  // namespace rink::accuracy
