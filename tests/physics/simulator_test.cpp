// The choice among engines, and that the interface adds nothing to the exact one.
#include "game/physics/simulator.h"

#include <gmock/gmock.h>

#include <limits>

#include "scenes.h"

namespace rink::physics {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(SimulatorChoices, AreRefusedByNameWithWhatIsAllowed) {
  EXPECT_THAT(objection({.engine = "box"}).value(), AllOf(HasSubstr("box"), HasSubstr("exact")));
  EXPECT_THAT(objection({.integrator = "rk5"}).value(), AllOf(HasSubstr("rk5"), HasSubstr("euler, semi_implicit, verlet, rk4")));
  for (const double dt : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THAT(objection({.dt = dt}).value(), HasSubstr("above 0 s"));
  EXPECT_FALSE(objection({}));
}

TEST(ExactSimulators, DoWhatTheirWorldDoes) {
  const WorldSpec spec = test::rink_of(2.0, 1.0, 0.9);
  World world(spec);
  const auto simulator = make_simulator(spec);
  for (const PuckSpec& puck : {PuckSpec{.position = {0.5, 0.5}, .velocity = {1.0, 0.25}}, PuckSpec{.position = {1.5, 0.55}, .velocity = {-2.0, 0.125}}}) {
    world.add(puck);
    simulator->add(puck);
  }
  const BatSpec bat{.position = {1.0, 0.2}};
  world.set_thrust(world.add(bat), {3.0, 4.0});
  simulator->set_thrust(simulator->add(bat), {3.0, 4.0});
  EXPECT_FALSE(world.advance(5.0));
  EXPECT_FALSE(simulator->advance(5.0));
  EXPECT_GT(world.counters().impacts(), 10u);
  EXPECT_EQ(simulator->hash(), world.hash());
  EXPECT_EQ(simulator->position({0}), world.position({0}));
  EXPECT_EQ(escape_count(*simulator), 0u);
}

}  // namespace
}  // namespace rink::physics
