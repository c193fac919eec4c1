// Inelastic gases: they cool by Haff's law, and where they collapse time goes on.
#include <cmath>
#include <numbers>

#include "tests/accuracy/accuracy_scene.h"

namespace rink::accuracy {
namespace {

/// Haff (1983): temperature T0/(1 + c t/2)^2. A puck of diameter d meets others 2 d rho g sqrt(pi
/// T/m) times a second, g = (1 - 7 phi/16)/(1 - phi)^2 at contact (Henderson 1975), and each
/// collision takes (1 - e^2) T, so c = (1 - e^2) d rho g sqrt(pi T0/m). The speeds are not quite
/// Maxwell's: c is smaller by 3/16 a2, with a2 by van Noije and Ernst (1998).
double haff_rate(const World& world, double temperature) {
  const double e = world.spec().restitution(0, 0), d = 2.0 * world.radius({0}),
               area = world.spec().field.length * world.spec().field.width,
               count = world.body_count();
  const double phi = count * std::numbers::pi * d * d / (4.0 * area),
               g = (1.0 - 7.0 * phi / 16.0) / ((1.0 - phi) * (1.0 - phi));
  const double a2 =
      16.0 * (1.0 - e) * (1.0 - 2.0 * e * e) / (57.0 - 25.0 * e + 30.0 * e * e * (1.0 - e));
  return (1.0 - e * e) * d * count / area * g *
         std::sqrt(std::numbers::pi * temperature / world.mass({0})) * (1.0 + 3.0 / 16.0 * a2);
}

TEST(InelasticGas, CoolsByHaffsLaw) {
  Game game(scene_named("gas-haff"));
  const World& world = game.world();
  const double start = world.kinetic_energy() / world.body_count(), rate = haff_rate(world, start);
  // Later, neighbours' velocities fall into line and the gas cools more slowly (Goldhirsch and
  // Zanetti 1993): at 1/32 by up to 2.7 %, depending on the seed.
  for (const double cooling : {2.0, 4.0, 8.0}) {
    const double time = 2.0 * (std::sqrt(cooling) - 1.0) / rate;
    game.advance(time);
    expect_within("temperature / initial temperature",
                  world.kinetic_energy() / world.body_count() / start, 1.0 / cooling, 0.02);
  }
}

Scene with_restitution(const std::string& name, double restitution) {
  Scene scene = scene_named(name);
  scene.world.restitution = physics::RestitutionTable(scene.materials.size(), restitution);
  return scene;
}

/// McNamara and Young (1994) saw a gas of this size and packing collapse at restitution 0.6:
/// without remedy the impacts of one second are endless.
void expect_no_endless_collapse(double restitution, int duration) {
  Game game(with_restitution("collapse-gas", restitution));
  const World& world = game.world();
  double energy = world.kinetic_energy();
  std::uint64_t events = 0, most = 0;
  for (int second = 1; second <= duration; ++second) {
    game.advance(second);
    EXPECT_LE(world.kinetic_energy(), energy * (1.0 + 1e-12));
    EXPECT_LT(world.max_overlap(), 1e-9);
    energy = world.kinetic_energy();
    most = std::max(most, world.counters().events() - events);
    events = world.counters().events();
  }
  expect_at_most("most events in a second / pucks", static_cast<double>(most) / world.body_count(),
                 1000.0);
}

TEST(InelasticGas, CollapsesInFinitelyManyImpactsAndOnlyLosesEnergy) {
  for (const double restitution : {0.0, 0.3, 0.6, 0.9}) expect_no_endless_collapse(restitution, 5);
}

TEST(LongInelasticGas, CollapsesInFinitelyManyImpactsAndOnlyLosesEnergy) {
  for (const double restitution : {0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.99})
    expect_no_endless_collapse(restitution, 60);
}

/// McNamara and Young (1992): 2 pucks and a wall collapse below 0.072, n pucks below about 1 -
/// pi/(2 n); this row of twenty below 0.9.
void expect_row_to_collapse(double restitution) {
  Game game(with_restitution("collapse-row", restitution));
  const World& world = game.world();
  const double energy = world.kinetic_energy();
  game.advance(10.0);
  EXPECT_LE(world.kinetic_energy(), energy);
  EXPECT_LT(world.max_overlap(), 1e-9);
  expect_at_most("events / pucks",
                 static_cast<double>(world.counters().events()) / world.body_count(), 1000.0);
  for (std::uint32_t k = 0; k < world.body_count(); ++k)
    EXPECT_NEAR(world.position({k}).y(), 0.2, 1e-12);
}

TEST(InelasticRow, CollapsesAgainstAWallInFinitelyManyImpacts) {
  for (const double restitution :
       {0.0, 0.01, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.99})
    expect_row_to_collapse(restitution);
}

}  // namespace
}  // namespace rink::accuracy
