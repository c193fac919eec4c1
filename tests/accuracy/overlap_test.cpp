// Pucks that start inside each other: no hang, no jump, no gain of energy.
#include <cmath>

#include "tests/accuracy/accuracy_scene.h"

namespace rink::accuracy {
namespace {

double fastest(const World& world) {
  double speed = 0.0;
  for (std::uint32_t k = 0; k < world.body_count(); ++k)
    speed = std::max(speed, world.velocity({k}).norm());
  return speed;
}

/// Bannerman, Sargant and Lue (2011): bodies that overlap and approach collide now, and none is
/// ever moved.
TEST(PucksThatStartInEachOther, NeitherHangNorJumpNorGainEnergy) {
  Game game(scene_named("overlap"));
  const World& world = game.world();
  const double energy = world.kinetic_energy(), start = world.max_overlap(), step = 1e-3;
  EXPECT_GT(start, 0.05);
  double deepest = start, growth = 0.0, jump = 0.0, gain = 0.0;
  for (int k = 1; k <= 4000; ++k) {
    std::vector<Vector2> before;
    for (std::uint32_t body = 0; body < world.body_count(); ++body)
      before.push_back(world.position({body}));
    const double speed = fastest(world);
    game.advance(step * k);
    const double reach = step * std::max(speed, fastest(world));
    for (std::uint32_t body = 0; body < world.body_count(); ++body)
      jump = std::max(jump, (world.position({body}) - before[body]).norm() / reach);
    const double overlap = world.max_overlap();
    growth = std::max(growth, overlap - deepest);
    deepest = std::min(deepest, overlap);
    gain = std::max(gain, world.kinetic_energy() / energy - 1.0);
  }
  expect_at_most("largest growth of the deepest overlap [m]", growth, 1e-12);
  expect_at_most("deepest overlap after 4 s [m]", world.max_overlap(), 1e-12);
  // Somebody may be faster within a step than anybody is at its ends; to be moved out of an
  // overlap, however, would be 10 times the fastest puck's way or more.
  expect_at_most("longest way in a step / the fastest puck's", jump, 1.1);
  expect_at_most("relative gain of energy", gain, 1e-12);
  expect_at_most("events / (pucks s)",
                 static_cast<double>(world.counters().events()) / (4.0 * world.body_count()),
                 1000.0);
}

}  // namespace
}  // namespace rink::accuracy
