// States that no world can have are refused, though their bytes are intact.
#include "game/physics/bodies/world_state.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "game/physics/world.h"
#include "tests/physics/scenes.h"

namespace rink::physics::test {
namespace {

/// Posts, bats, pucks in play and one that was removed.
WorldState some_state() {
  World world(rink_of(2, 1, 0.5, 0.1, 1.0));
  std::mt19937_64 random(3);
  scatter_posts(world, random, 2);
  scatter_bats(world, random, 2);
  scatter_pucks(world, random, 4);
  world.advance(1.0);
  world.remove({world.body_count() - 1});
  return *from_snapshot(world.save());
}

bool is_accepted(const WorldState& state) { return from_snapshot(to_snapshot(state)).has_value(); }

TEST(AWorldsState, IsRefusedIfAnInverseMassIsNotThatOfTheMass) {
  const WorldState sound = some_state();
  ASSERT_TRUE(is_accepted(sound));
  for (std::size_t body = 0; body < sound.bodies.bodies.size(); ++body) {
    const Body& before = sound.bodies.bodies[body];
    for (const double inverse :
         {0.0, 0.5 * before.inverse_mass + 0.25, -1.0, std::numeric_limits<double>::infinity(),
          std::numeric_limits<double>::quiet_NaN()}) {
      WorldState state = sound;
      state.bodies.bodies[body].inverse_mass = state.bodies.shapes[body].inverse_mass = inverse;
      const bool may_be_fixed = before.kind == BodyKind::post || before.is(Body::removed);
      EXPECT_EQ(is_accepted(state), inverse == 0.0 && may_be_fixed)
          << "body " << body << ", inverse mass " << inverse;
    }
  }
}

TEST(AWorldsState, IsRefusedIfAMassIsNone) {
  const WorldState sound = some_state();
  for (std::size_t body = 0; body < sound.bodies.bodies.size(); ++body)
    for (const double mass : {0.0, -1.0, std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::quiet_NaN(), 1e-320}) {
      if (sound.bodies.bodies[body].kind == BodyKind::post && mass > 0.0) continue;
      WorldState state = sound;
      state.bodies.shapes[body].mass = mass;
      if (mass > 0.0)
        state.bodies.bodies[body].inverse_mass = state.bodies.shapes[body].inverse_mass =
            1.0 / mass;
      const bool is_gone = state.bodies.bodies[body].is(Body::removed) &&
                           state.bodies.shapes[body].inverse_mass == 0.0;
      EXPECT_EQ(is_accepted(state), is_gone) << "body " << body << ", mass " << mass;
    }
}

}  // namespace
}  // namespace rink::physics::test
