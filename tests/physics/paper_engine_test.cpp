// The paper's engine against closed forms and the exact engine.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <string>

#include "game/physics/simulator_choice.h"
#include "tests/physics/play.h"
#include "tests/physics/scenes.h"

namespace rink::physics {
namespace {

using test::integrators;
using test::play;
using test::rink_of;
using test::uniform;

std::unique_ptr<Simulator> paper(const WorldSpec& spec, const std::string& integrator, double dt) {
  return make_simulator(spec, {.engine = "paper", .integrator = integrator, .dt = dt});
}

/// How far a bat under thrust and drag is from its closed form after 1 s.
double free_flight_error(const std::string& integrator, double dt) {
  const WorldSpec spec = rink_of(20.0, 20.0, 1.0, 0.0, 3.0);
  const auto simulator = paper(spec, integrator, dt);
  const Vector2 position(10.0, 10.0), velocity(-2.0, 1.0), thrust(6.0, -8.0);
  const BodyId bat = simulator->add(BatSpec{.position = position, .velocity = velocity});
  simulator->set_thrust(bat, thrust);
  play(*simulator, 1.0);
  const WarpedTime w = warp(1.0, 3.0);
  return (simulator->position(bat) - (position + w.s * velocity + w.q * thrust)).norm();
}

TEST(IntegratorsInFreeFlight, ConvergeWithOrdersOneOneTwoAndFour) {
  const std::array<double, 4> orders{1.0, 1.0, 2.0, 4.0};
  for (std::size_t i = 0; i < integrators.size(); ++i)
    for (const double frames : {64.0, 128.0, 256.0}) {
      const double order = std::log2(free_flight_error(integrators[i], 1.0 / frames) /
                                     free_flight_error(integrators[i], 0.5 / frames));
      EXPECT_NEAR(order, orders[i], 0.08)
          << integrators[i] << " at " << frames << " frames per second";
    }
}

TEST(IntegratorsInFreeFlight, KeepTheirOrderWhenAKeyFallsWithinAFrame) {
  const std::array<double, 4> orders{1.0, 1.0, 2.0, 4.0};
  const double key_time = 0.3937, drag = 3.0;
  const Vector2 before(6.0, 0.0), after(-3.0, 5.0);
  const WarpedTime w1 = warp(key_time, drag), w2 = warp(1.0 - key_time, drag);
  const Vector2 expected =
      Vector2(10.0, 10.0) + w1.q * before + w2.s * (w1.s * before) + w2.q * after;
  const auto error = [&](const char* integrator, double dt) {
    const auto simulator = paper(rink_of(20.0, 20.0, 1.0, 0.0, drag), integrator, dt);
    const BodyId bat = simulator->add(BatSpec{.position = {10.0, 10.0}});
    simulator->set_thrust(bat, before);
    play(*simulator, key_time);
    simulator->set_thrust(bat, after);
    play(*simulator, 1.0);
    return (simulator->position(bat) - expected).norm();
  };
  for (std::size_t i = 0; i < integrators.size(); ++i) {
    const double order =
        std::log2(error(integrators[i], 1.0 / 64) / error(integrators[i], 1.0 / 256)) / 2;
    EXPECT_NEAR(order, orders[i], 0.25) << integrators[i];
  }
}

TEST(ExplicitEuler, MultipliesSpeedByOneMinusDragTimesFrameAndGrowsWithoutBoundBeyondTwo) {
  const auto speed_after = [](double drag, double dt, double until) {
    const auto simulator = paper(rink_of(100.0, 100.0, 1.0, drag), "euler", dt);
    const BodyId puck = simulator->add(PuckSpec{.position = {50.0, 50.0}, .velocity = {1.0, 0.0}});
    play(*simulator, until);
    return simulator->velocity(puck).x();
  };
  EXPECT_NEAR(speed_after(0.5, 1.0 / 64, 1.0), std::pow(1.0 - 0.5 / 64, 64),
              1e-14);  // the truth is exp(-0.5)
  EXPECT_NEAR(speed_after(25.0, 0.125, 1.0), std::pow(1.0 - 25.0 * 0.125, 8), 1e-9);
}

TEST(PapersEngine, MeetsTheExactOneInFreePairsWithoutForces) {
  std::mt19937_64 random(11);
  for (int round = 0; round < 50; ++round) {
    const WorldSpec spec = rink_of(4.0, 2.0, uniform(random, 0.0, 1.0));
    World world(spec);
    const auto simulator = paper(spec, integrators[random() % 4], 1.0 / 60);
    for (const double x : {1.0, 3.0}) {
      const PuckSpec puck{
          .position = {x, uniform(random, 0.9, 1.1)},
          .velocity = {x < 2.0 ? uniform(random, 0.5, 3.0) : uniform(random, -3.0, -0.5),
                       uniform(random, -0.1, 0.1)},
          .radius = uniform(random, 0.1, 0.3),
          .mass = uniform(random, 0.1, 10.0)};
      world.add(puck);
      simulator->add(puck);
    }
    EXPECT_FALSE(world.advance(1.2));
    play(*simulator, 1.2);
    EXPECT_EQ(simulator->counters().impacts(), world.counters().impacts()) << round;
    for (const BodyId puck : {BodyId{0}, BodyId{1}})
      EXPECT_LT((simulator->position(puck) - world.position(puck)).norm(), 1e-12) << round;
  }
}

/// The distance from the exact engine after a collision of two pucks under drag, 1 s from the
/// start.
double pair_error(const std::string& integrator, double dt) {
  const WorldSpec spec = rink_of(4.0, 2.0, 0.9, 0.8);
  World world(spec);
  const auto simulator = paper(spec, integrator, dt);
  const PuckSpec light{.position = {1.0, 1.0}, .velocity = {1.5, 0.05}, .radius = 0.2},
      heavy{.position = {2.5, 1.1}, .velocity = {-1.0, 0.0}, .radius = 0.2, .mass = 2.0};
  for (const PuckSpec& puck : {light, heavy}) {
    world.add(puck);
    simulator->add(puck);
  }
  EXPECT_FALSE(world.advance(1.0));
  play(*simulator, 1.0);
  EXPECT_EQ(world.counters().disc_impacts, 1u);
  EXPECT_EQ(simulator->counters().disc_impacts, 1u);
  return (simulator->position({0}) - world.position({0})).norm() +
         (simulator->position({1}) - world.position({1})).norm();
}

TEST(PapersEngine, ApproachesTheExactOneAsFramesShrinkAndAnImpactLimitsTheOrderToTwo) {
  const std::array<double, 4> least_orders{0.9, 0.9, 1.7, 1.7};
  for (std::size_t i = 0; i < integrators.size(); ++i) {
    const double coarse = pair_error(integrators[i], 1.0 / 50),
                 fine = pair_error(integrators[i], 1.0 / 3200);
    EXPECT_GT(std::log2(coarse / fine) / 6.0, least_orders[i])
        << integrators[i] << ": " << coarse << " to " << fine;
    EXPECT_LT(fine, i < 2 ? 1e-3 : 1e-6) << integrators[i];
  }
}

TEST(PapersEngine, KeepsTheEnergyAndMomentumOfAnElasticGas) {
  std::mt19937_64 random(5);
  const WorldSpec spec = rink_of(3.0, 3.0);
  World world(spec);
  const auto pucks = test::scatter_pucks(world, random, 100, 0.1, 10.0);
  const auto simulator = paper(spec, "euler", 1.0 / 60);
  for (const BodyId puck : pucks)
    simulator->add(PuckSpec{.position = world.position(puck),
                            .velocity = world.velocity(puck),
                            .mass = world.mass(puck)});
  const double before = simulator->kinetic_energy();
  play(*simulator, 10.0);
  EXPECT_GT(simulator->counters().impacts(), 3000u);
  EXPECT_NEAR(simulator->kinetic_energy() / before, 1.0, 1e-12);
  EXPECT_LT(simulator->max_overlap(), 1e-12);
  EXPECT_EQ(escape_count(*simulator), 0u);
}

/// After an impact explicit Euler spends the rest r of the frame along v r, away from the wall; the
/// others along a path that thrust bends back, into the wall again if v < a r.
TEST(PaperEngine, CountsTheBatThatLeansOnAWallByTheSchemesNatureButKeepsItThere) {
  std::uint64_t impacts[4];
  for (std::size_t k = 0; k < 4; ++k) {
    constexpr double dt = 1.0 / 60, thrust = 6.0;
    const auto simulator =
        make_simulator(rink_of(4.0, 2.0, 0.9, 0.0, 3.0),
                       {.engine = "paper", .integrator = integrator_names()[k], .dt = dt});
    const BodyId bat = simulator->add(BatSpec{.position = {0.5, 1.0}, .half_extent = {0.05, 0.1}});
    simulator->set_thrust(bat, {-thrust, 0.0});
    simulator->advance(10.0);
    const std::uint64_t before = simulator->counters().impacts();
    simulator->advance(20.0);
    impacts[k] = simulator->counters().impacts() - before;
    EXPECT_LE(impacts[k], 21u * 600u);  // 20 a frame, and the one that stops it
    EXPECT_NEAR(simulator->position(bat).x(), 0.05, 10.0 * thrust * dt * dt)
        << integrator_names()[k];
    EXPECT_LT(simulator->max_overlap(), 1e-15);
  }
  EXPECT_EQ(integrator_names()[0], "euler");
  for (std::size_t k = 1; k < 4; ++k)
    EXPECT_GT(impacts[k], 5 * impacts[0]) << integrator_names()[k];
}

TEST(PapersEngine, FinishesItsFramesWhileABatPressesAPuckIntoAWall) {
  for (const char* integrator : integrators)
    for (const double restitution : {0.0, 0.5, 1.0}) {
      const auto simulator = paper(rink_of(2.0, 1.0, restitution, 0.0, 3.0), integrator, 1.0 / 60);
      const BodyId bat =
                       simulator->add(BatSpec{.position = {0.3, 0.5}, .half_extent = {0.05, 0.1}}),
                   puck = simulator->add(PuckSpec{.position = {0.15, 0.5}, .mass = 0.1});
      simulator->set_thrust(bat, {-8.0, 0.0});
      play(*simulator, 10.0);
      EXPECT_GE(simulator->position(puck).x(), 0.04 - 1e-3) << integrator << ' ' << restitution;
      EXPECT_LT(simulator->position(bat).x(), 0.6) << integrator << ' ' << restitution;
      EXPECT_LT(simulator->max_overlap(), 1e-3) << integrator << ' ' << restitution;
    }
}

TEST(PapersEngine, ScoresTheSameGoalsAtTheSameTimesWithoutForces) {
  WorldSpec spec = rink_of(2.0, 1.0);
  spec.field.goal_width = 0.3;
  for (const double slope : {0.0, 0.1, 0.16, -0.175,
                             0.19}) {  // through the middle, past and off the edges, off the wall
    World world(spec);
    const auto simulator = paper(spec, "euler", 1.0 / 60);
    const PuckSpec puck{.position = {1.0, 0.5}, .velocity = {-2.0, 2.0 * slope}};
    world.add(puck);
    simulator->add(puck);
    const auto expected = world.advance(0.9), seen = simulator->advance(0.9);
    ASSERT_EQ(seen.has_value(), expected.has_value()) << slope;
    if (expected) {
      EXPECT_NEAR(seen->time, expected->time, 1e-12) << slope;
      EXPECT_EQ(seen->end, expected->end) << slope;
    }
    EXPECT_LT((simulator->position({0}) - world.position({0})).norm(), 1e-12) << slope;
  }
}

TEST(PapersEngine, MeetsACornerTooEarlyUnlessItIsToldToRoundIt) {
  const WorldSpec spec = rink_of(4.0, 2.0);
  const auto time_of_impact = [&](const SimulatorChoice& choice) {
    const auto simulator = make_simulator(spec, choice);
    simulator->record_events(true);
    simulator->add(BatSpec{.position = {2.0, 1.0}, .half_extent = {0.1, 0.1}, .mass = 1e3});
    simulator->add(PuckSpec{.position = {2.6, 1.6},
                            .velocity = {-1.0, -1.0},
                            .radius = 0.1});  // along the diagonal, at a corner
    play(*simulator, 1.0);
    return simulator->events().front().time;
  };
  const double truth = 0.5 - 0.1 / std::sqrt(2.0);
  EXPECT_NEAR(time_of_impact({}), truth, 1e-14);
  EXPECT_NEAR(time_of_impact({.engine = "paper", .has_sharp_corners = false}), truth, 1e-12);
  EXPECT_NEAR(time_of_impact({.engine = "paper"}), 0.4, 1e-12);
}

TEST(PapersEngine, LooksAtFewPairsInALargeGas) {
  const WorldSpec spec = rink_of(20.0, 20.0);
  const auto simulator = paper(spec, "euler", 1.0 / 60);
  std::mt19937_64 random(2);
  for (int column = 0; column < 50; ++column)
    for (int row = 0; row < 50; ++row)
      simulator->add(
          PuckSpec{.position = {0.2 + 0.4 * column, 0.2 + 0.4 * row},
                   .velocity = {uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0)}});
  play(*simulator, 1.0);
  EXPECT_GT(simulator->counters().disc_impacts, 200u);
  EXPECT_LT(simulator->counters().predictions, 60u * 2500u);
}

}  // namespace
}  // namespace rink::physics
