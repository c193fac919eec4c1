// What the table and rough surfaces do to bodies that are stepped, and where their energy goes.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "game/physics/simulator_choice.h"
#include "tests/physics/play.h"
#include "tests/physics/scenes.h"

namespace rink::physics {
namespace {

using test::play;
using test::rink_of;

TEST(PapersEngineWithFriction, StopsAPuckWhereItShouldAsFramesShrink) {
  WorldSpec spec = rink_of(10.0, 2.0);
  spec.puck_friction = 0.7;
  const double speed = 1.4, distance = speed * speed / (2 * 0.7);  // v^2/(2 mu g)
  for (const char* integrator : {"euler", "semi_implicit", "verlet", "rk4"}) {
    const auto error = [&](double dt) {
      const auto simulator =
          make_simulator(spec, {.engine = "paper", .integrator = integrator, .dt = dt});
      const BodyId puck =
          simulator->add(PuckSpec{.position = {1.0, 1.0}, .velocity = {speed, 0.0}});
      play(*simulator, 3.0);
      EXPECT_EQ(simulator->velocity(puck), Vector2(0.0, 0.0)) << integrator;
      EXPECT_EQ(Counters(simulator->counters()).of(EventKind::stop), 1u) << integrator;
      return std::abs(simulator->position(puck).x() - 1.0 - distance);
    };
    EXPECT_LT(error(1.0 / 60), 0.03) << integrator;
    EXPECT_LT(error(1.0 / 1920), 0.001) << integrator;
  }
}

TEST(PapersEngineWithRoughSurfaces, TurnsPucksAsTheExactOneDoes) {
  WorldSpec spec = rink_of(4.0, 2.0, 0.8);
  spec.surface_friction = SurfaceFriction{PairTable(1, 0.3), RestitutionTable(1, 0.4)};
  World world(spec);
  const auto simulator = make_simulator(spec, {.engine = "paper"});
  const PuckSpec left{.position = {1.0, 1.0}, .velocity = {1.5, 0.1}, .radius = 0.2, .spin = 3.0},
      right{.position = {2.5, 1.15}, .velocity = {-1.0, 0.0}, .radius = 0.15, .mass = 2.0};
  for (const PuckSpec& puck : {left, right}) {
    world.add(puck);
    simulator->add(puck);
  }
  EXPECT_FALSE(world.advance(4.0));
  play(*simulator, 4.0);
  EXPECT_GE(world.counters().impacts(), 3u);
  for (const BodyId puck : {BodyId{0}, BodyId{1}}) {
    EXPECT_NEAR(simulator->spin(puck), world.spin(puck), 1e-11);
    EXPECT_LT((simulator->position(puck) - world.position(puck)).norm(), 1e-11);
  }
  EXPECT_NEAR(simulator->kinetic_energy(), world.kinetic_energy(), 1e-11);
}

TEST(PapersEngine, WorksAndDissipatesAsTheExactOneDoesAsFramesShrink) {
  WorldSpec spec = rink_of(4.0, 2.0, 0.5, 0.3, 3.0);
  spec.accounts_energy = true;
  World world(spec);
  const auto simulator = make_simulator(spec, {.engine = "paper", .integrator = "rk4", .dt = 1e-3});
  const BatSpec bat{.position = {1.0, 1.0}, .half_extent = {0.1, 0.2}, .mass = 0.5};
  const PuckSpec puck{.position = {1.4, 1.1}, .mass = 0.2};
  world.add(bat), world.add(puck);
  simulator->add(bat), simulator->add(puck);
  world.set_thrust({0}, {8.0, 0.0});
  simulator->set_thrust({0}, {8.0, 0.0});
  EXPECT_FALSE(world.advance(0.5));
  play(*simulator, 0.5);
  EXPECT_EQ(world.counters().bat_impacts, 1u);
  EXPECT_EQ(simulator->counters().bat_impacts, 1u);
  EXPECT_GT(world.work_of_thrust(), 1.0);
  EXPECT_NEAR(simulator->work_of_thrust(), world.work_of_thrust(), 1e-5);
  EXPECT_NEAR(simulator->dissipated(), world.dissipated(), 1e-5);
}

/// As under the exact engine: who is put back into play begins anew.
TEST(PaperEngines, PutAPuckBackWithoutTheSpinThatItScoredWith) {
  WorldSpec spec = test::rink_of(4.0, 2.0);
  spec.field.goal_width = 0.5;
  spec.surface_friction = SurfaceFriction{PairTable(1, 0.5), RestitutionTable(1, 0.5)};
  for (const char* engine : {"exact", "paper", "naive"}) {
    const auto simulator = make_simulator(spec, {.engine = engine});
    const BodyId puck = simulator->add(PuckSpec{.position = {3.5, 1.0},
                                                .velocity = {2.0, 0.0},
                                                .radius = 0.0625,
                                                .mass = 0.5,
                                                .spin = 10.0});
    ASSERT_TRUE(simulator->advance(5.0)) << engine;
    EXPECT_EQ(simulator->spin(puck), 10.0) << engine;
    simulator->place(puck, {2.0, 1.0}, {3.0, 4.0});
    EXPECT_EQ(simulator->spin(puck), 0.0) << engine;
    EXPECT_NEAR(simulator->kinetic_energy(), 0.5 * 0.5 * 25.0, 1e-14) << engine;
  }
}

}  // namespace
}  // namespace rink::physics
