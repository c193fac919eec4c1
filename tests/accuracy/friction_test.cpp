// Coulomb friction with the table: where and when pucks come to rest. Impacts under it are in pair_test.cpp.
#include <cmath>

#include "tests/accuracy/accuracy_scene.h"

namespace rink::accuracy {
namespace {

/// Coulomb (1785): a puck slows by mu g, so it rests after v/(mu g), v^2/(2 mu g) further on, and keeps its direction.
TEST(PuckUnderCoulombFriction, StopsWhereAndWhenTheClosedFormSays) {
  const Scene scene = scene_named("friction-stop");
  const double deceleration = scene.world.puck_friction, length = scene.world.field.length;
  std::vector<double> position_errors, early_speeds;
  for (std::uint32_t k = 0; k < scene.bodies.pucks.size(); ++k) {
    const physics::PuckSpec& puck = scene.bodies.pucks[k].body;
    const double speed = puck.velocity.norm(), stop = speed / deceleration;
    Game game(scene);
    game.advance(stop * (1.0 - 1e-9));
    early_speeds.push_back(std::abs(game.velocity({k}).norm() / (1e-9 * speed) - 1.0));
    EXPECT_FALSE(game.world().is_resting({k}));
    game.advance(stop * (1.0 + 1e-14));
    EXPECT_EQ(game.velocity({k}), Vector2(0.0, 0.0));
    EXPECT_TRUE(game.world().is_resting({k}));
    const Vector2 expected = puck.position + 0.5 * speed / deceleration * puck.velocity;
    position_errors.push_back((game.position({k}) - expected).norm() / length);
    game.advance(100.0);
    EXPECT_LE((game.position({k}) - expected).norm() / length, 1e-13);
  }
  expect_at_most("largest error of a resting place / length of the field", largest(position_errors), 1e-13);
  // A billionth of the time before the end a billionth of the speed is left; 53 bits know that difference to 4e-7.
  expect_at_most("largest relative error of the last billionth of speed", largest(early_speeds), 1e-6);
}

}  // namespace
}  // namespace rink::accuracy
