// Coulomb friction with the table: where and when pucks come to rest. Impacts under it are in
// pair_test.cpp.
#include <cmath>

#include "tests/accuracy/accuracy_scene.h"

namespace rink::accuracy {
namespace {

/// Coulomb (1785): a puck slows by mu g, so it rests after v/(mu g), v^2/(2 mu g) further on, and
/// keeps its direction.
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
  expect_at_most("largest error of a resting place / length of the field", largest(position_errors),
                 1e-13);
  // A billionth of the time before the end a billionth of the speed is left; 53 bits know that
  // difference to 4e-7.
  expect_at_most("largest relative error of the last billionth of speed", largest(early_speeds),
                 1e-6);
}

/// Bat M and pucks of mass m in all: (M + m) dv/dt = M (a - g v) - m k, from rest; a bat whose
/// thrust is below m k/M stands.
TEST(PucksPushedUnderFriction, MoveAsOneByTheClosedFormOrStandAndCostNoEvents) {
  const Scene scene = scene_named("pushed-friction");
  Game game(scene);
  const physics::BatSpec& bat = scene.bodies.bats[0].body;
  const double pucks = 1.0, total = bat.mass + pucks,
               drag = bat.mass * scene.world.bat_drag / total;
  const double driving =
                   (bat.mass * scene.bodies.bats[0].thrust - pucks * scene.world.puck_friction) /
                   total,
               time = 1.25;
  game.advance(time);
  const double faded = -std::expm1(-drag * time), speed = driving / drag * faded,
               way = driving / drag * (time - faded / drag);
  double error = 0.0, speed_error = 0.0;
  for (const char* name : {"strong", "near", "far"}) {
    const BodyId body = body_named(scene, name);
    error =
        std::max(error, std::abs(game.position(body).x() - Game(scene).position(body).x() - way) /
                            scene.world.field.length);
    speed_error = std::max(speed_error, std::abs(game.velocity(body).x() / speed - 1.0));
  }
  expect_at_most("largest error of a place / length of the field", error, 1e-13);
  expect_at_most("largest relative error of a speed", speed_error, 1e-13);
  EXPECT_EQ(game.position(body_named(scene, "weak")), scene.bodies.bats[1].body.position);
  EXPECT_EQ(game.position(body_named(scene, "borne")), scene.bodies.pucks[2].body.position);
  expect_at_most("events, the two keys among them",
                 static_cast<double>(game.world().counters().events()), 10.0);
}

}  // namespace
}  // namespace rink::accuracy
