// Prints the state hashes of a few scenes that use all of the physics: the same text from every
// compiler and at every level of optimisation.
#include <cinttypes>
#include <cstdio>
#include <vector>

#include "game/model/random_stream.h"
#include "game/physics/extended/extended_world.h"
#include "game/physics/world.h"

namespace {

using namespace rink::physics;
using rink::game::RandomStream;

Vector2 free_place(const auto& world, RandomStream& numbers, double reach) {
  for (;;) {
    const double x = numbers.uniform(reach, 4.0 - reach),
                 y = numbers.uniform(
                     reach, 2.0 - reach);  // apart: the order of arguments is the compiler's
    const Vector2 place(x, y);
    if (world.is_free(place, reach)) return place;
  }
}

/// Pucks, posts and bats under random keys, with walls, goals, rest contacts and jams; half of the
/// scenes with friction of the table, a third with rough surfaces.
template <class AnyWorld>
std::uint64_t play(std::uint64_t seed, double restitution, double drag) {
  WorldSpec spec;
  spec.field = {.length = 4.0, .width = 2.0, .goal_width = seed % 2 == 0 ? 0.4 : 0.0};
  spec.restitution = RestitutionTable(1, restitution);
  spec.puck_drag = drag;
  spec.bat_drag = 1.0;
  if (seed > 12) spec.puck_friction = 0.4;
  if (seed % 3 == 1 && seed > 6)
    spec.surface_friction = SurfaceFriction{PairTable(1, 0.2), RestitutionTable(1, 0.3)};
  AnyWorld world(spec);
  RandomStream numbers(seed);
  std::vector<BodyId> bats;
  for (int i = 0; i < 3; ++i)
    world.add(PostSpec{.position = free_place(world, numbers, 0.1),
                       .radius = numbers.uniform(0.02, 0.1)});
  for (int i = 0; i < 5; ++i)
    bats.push_back(world.add(BatSpec{
        .position = free_place(world, numbers, 0.15), .half_extent = {0.04, 0.1}, .mass = 3.0}));
  for (int i = 0; i < 50; ++i) {
    const Vector2 place = free_place(world, numbers, 0.04), direction = numbers.direction();
    const Vector2 velocity = direction * numbers.maxwell(1.5);
    world.add(PuckSpec{.position = place, .velocity = velocity, .mass = numbers.uniform(0.1, 1.0)});
  }
  for (double time = 0.0; time < 4.0; time += numbers.uniform(0.0, 0.05)) {
    while (world.advance(time)) {
    }
    const BodyId bat = bats[static_cast<std::size_t>(numbers.uniform(0.0, 5.0))];
    const double ax = numbers.uniform(-6.0, 6.0), ay = numbers.uniform(-6.0, 6.0);
    world.set_thrust(bat, {ax, ay});
  }
  return world.hash();
}

}  // namespace

int main() {
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    const double restitution = seed % 4 == 0   ? 0.0
                               : seed % 4 == 1 ? 1.0
                                               : 0.3 * static_cast<double>(seed % 4),
                 drag = seed % 3 == 0 ? 0.0 : 0.2;
    std::printf("%2" PRIu64 " %016" PRIx64 " %016" PRIx64 "\n", seed,
                play<World>(seed, restitution, drag), play<ExtendedWorld>(seed, restitution, drag));
  }
}
