// What no real rink does: pucks as fast as meteors, a rink a million metres from the origin, and
// pucks that start inside each other.
#include <cmath>

#include "tests/accuracy/accuracy_scene.h"

namespace rink::accuracy {
namespace {

/// How far the farthest body stands out of the field [m].
double escape(const World& world) {
  double farthest = 0.0;
  for (std::uint32_t k = 0; k < world.body_count(); ++k) {
    const Vector2 position = world.position({k}), reach = world.half_extent({k});
    farthest = std::max({farthest, reach.x() - position.x(), reach.y() - position.y(),
                         position.x() + reach.x() - world.spec().field.length,
                         position.y() + reach.y() - world.spec().field.width});
  }
  return farthest;
}

TEST(PucksAtTenThousandMetresPerSecond, NeverEscapeNorOverlap) {
  Game game(scene_named("fast"));
  const World& world = game.world();
  const double energy = world.kinetic_energy();
  double farthest = 0.0, deepest = 0.0;
  for (int step = 1; step <= 200; ++step) {
    game.advance(1e-4 * step + 1e-6 * (step % 7));
    farthest = std::max(farthest, escape(world));
    deepest = std::max(deepest, world.max_overlap());
  }
  EXPECT_GT(world.counters().impacts(), 100000u);
  // An instant is known to 2e-18 s at 0.02 s, a place to 4e-16 m; the rest is the speed times the
  // former.
  expect_at_most("farthest out of the field [m]", farthest, 1e-12);
  expect_at_most("deepest overlap [m]", deepest, 1e-12);
  expect_at_most("relative change of the energy", std::abs(world.kinetic_energy() / energy - 1.0),
                 1e-12);
}

/// Doubles are 1.2e-10 m apart at 1e6 m.
constexpr double far_resolution = 0x1p-33;

TEST(FarFromTheOrigin, PucksMoveLikeTheirTwinsNearIt) {
  const Scene scene = scene_named("far-corner"), twin = scene_named("near-corner");
  Game far(scene), near(twin);
  const Vector2 shift = scene.bodies.pucks[0].body.position - twin.bodies.pucks[0].body.position;
  std::vector<double> errors;
  for (int step = 1; step <= 100; ++step) {
    far.advance(0.01 * step);
    near.advance(0.01 * step);
    for (std::uint32_t k = 0; k < far.world().body_count(); ++k)
      if (far.world().kind({k}) != physics::BodyKind::post)
        errors.push_back((far.position({k}) - shift - near.position({k})).norm());
  }
  EXPECT_GT(near.world().counters().disc_impacts, 10u);
  expect_at_most("median distance of twins in 1 s [m]", median(errors), 4.0 * far_resolution);
  // Collisions magnify the rounding of a place tenfold each.
  expect_at_most("largest distance of twins in 1 s [m]", largest(errors), 1e4 * far_resolution);
}

TEST(FarFromTheOrigin, NothingEscapesHangsOrOverlapsAndWhatIsPressedComesToRest) {
  const Scene scene = scene_named("far-corner");
  Game game(scene);
  const World& world = game.world();
  double farthest = 0.0, deepest = 0.0;
  for (int step = 1; step <= 200; ++step) {
    game.advance(0.1 * step);
    farthest = std::max(farthest, escape(world));
    deepest = std::max(deepest, world.max_overlap());
  }
  expect_at_most("farthest out of the field [m]", farthest, 1e-9);
  expect_at_most("deepest overlap [m]", deepest, 1e-9);
  const std::uint64_t events = world.counters().events();
  expect_at_most("events / (bodies 20 s)",
                 static_cast<double>(events) / (20.0 * world.body_count()), 1000.0);
  EXPECT_LT(world.velocity(body_named(scene, "presser")).norm(), 1e-6);
  EXPECT_LT(world.velocity(body_named(scene, "pinned")).norm(), 1e-6);
}

}  // namespace
}  // namespace rink::accuracy
