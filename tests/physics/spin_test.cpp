// Tangential friction and spin: single impacts against Walton's law worked out by hand, and what no
// impact may change.
#include <gtest/gtest.h>

#include <cmath>

#include "game/physics/flight/time_to_touch.h"
#include "tests/physics/scenes.h"

namespace rink::physics::test {
namespace {

WorldSpec rough_surfaces(double friction, double tangential, double restitution = 1.0,
                         double size = 10.0) {
  WorldSpec spec = rink_of(size, size, restitution);
  spec.surface_friction = SurfaceFriction{PairTable(1, friction), RestitutionTable(1, tangential)};
  return spec;
}

PuckSpec spinning(const Vector2& position, const Vector2& velocity, double spin,
                  double radius = 0.04, double mass = 1.0) {
  PuckSpec puck;
  puck.position = position, puck.velocity = velocity, puck.spin = spin, puck.radius = radius,
  puck.mass = mass;
  return puck;
}

double moment_of_inertia(const World& world, BodyId puck) {
  return 0.5 * world.mass(puck) * world.radius(puck) * world.radius(puck);
}

/// About the origin [kg m^2/s].
double angular_momentum(const World& world, BodyId puck) {
  return world.mass(puck) * cross(world.position(puck), world.velocity(puck)) +
         moment_of_inertia(world, puck) * world.spin(puck);
}

TEST(Spin, PuckThatSticksToAWallRollsAlongIt) {
  // A disc whose rim sticks keeps a third of its slip as speed: v' = v - (v + w r)/3, w' = w - 2 (v
  // + w r)/(3 r).
  for (const double tangential : {0.0, 0.4, 1.0}) {
    const double vx = 1.0, vy = -2.0, spin = 5.0, r = 0.04, e = 0.8, slip = vx + spin * r;
    World world(rough_surfaces(10.0, tangential, e));
    const BodyId puck = world.add(spinning({2, 1}, {vx, vy}, spin));
    world.advance(1.0);
    EXPECT_NEAR(world.velocity(puck).x(), vx - (1 + tangential) * slip / 3, 1e-15);
    EXPECT_NEAR(world.velocity(puck).y(), -e * vy, 1e-15);
    EXPECT_NEAR(world.spin(puck), spin - 2 * (1 + tangential) * slip / (3 * r), 1e-13);
    EXPECT_NEAR(world.velocity(puck).x() + world.spin(puck) * r, -tangential * slip, 2e-15);
  }
}

TEST(Spin, PuckThatSlidesAlongAWallLosesTheCoefficientTimesTheNormalImpulse) {
  for (const double direction : {-1.0, 1.0}) {
    const double vx = 3.0 * direction, vy = -1.0, mu = 0.15, e = 0.7, r = 0.05, m = 0.3;
    World world(rough_surfaces(mu, 0.0, e));
    const BodyId puck = world.add(spinning({5, 1}, {vx, vy}, 0.0, r, m));
    world.advance(1.2);
    const double change = direction * mu * (1 + e) * -vy;
    EXPECT_NEAR(world.velocity(puck).x(), vx - change, 1e-15);
    EXPECT_NEAR(world.spin(puck), -2 * change / r, 1e-13);
  }
}

TEST(Spin, EachWallTurnsThePuckItsOwnWay) {
  // Anticlockwise spin pushes to the left along the bottom, down the right wall and so on: the rim
  // moves with +spin r along the tangent that is anticlockwise.
  const double spin = 20.0, r = 0.04, m = 1.0, change = spin * r / 3;
  const struct {
    Vector2 velocity, kick;
  } walls[] = {{{0, -1}, {-1, 0}}, {{1, 0}, {0, -1}}, {{0, 1}, {1, 0}}, {{-1, 0}, {0, 1}}};
  for (const auto& wall : walls) {
    World world(rough_surfaces(10.0, 0.0, 1.0, 2.0));
    const BodyId puck = world.add(spinning({1, 1}, wall.velocity, spin, r, m));
    world.advance(1.5);
    const Vector2 expected = -wall.velocity + change * wall.kick;
    EXPECT_NEAR((world.velocity(puck) - expected).norm(), 0.0, 1e-14);
    EXPECT_NEAR(world.spin(puck), spin / 3, 1e-13);
  }
}

TEST(Spin, TwoPucksFollowWaltonsLawInBothRegimes) {
  std::mt19937_64 random(31);
  int sliding = 0, sticking = 0;
  for (int i = 0; i < 2000; ++i) {
    SCOPED_TRACE(i);
    const double mu = uniform(random, 0.0, 0.8), tangential = uniform(random, 0, 1),
                 e = uniform(random, 0, 1);
    const double r1 = uniform(random, 0.02, 0.08), r2 = uniform(random, 0.02, 0.08),
                 m1 = uniform(random, 0.1, 3), m2 = uniform(random, 0.1, 3);
    const double w1 = uniform(random, -40, 40), w2 = uniform(random, -40, 40),
                 angle = uniform(random, -3, 3);
    const Vector2 normal(std::cos(angle), std::sin(angle)),
        tangent(-normal.y(), normal.x());  // from 1 to 2
    const Vector2 v1(uniform(random, -0.1, 0.1), uniform(random, -0.1, 0.1)),
        v2 = v1 - uniform(random, 0.5, 2) * normal + uniform(random, -3, 3) * tangent;
    World world(rough_surfaces(mu, tangential, e));
    // They touch at (5, 5) and (5, 5) + reach after a hundredth of a second.
    const BodyId a = world.add(spinning(Vector2(5, 5) - 0.01 * v1, v1, w1, r1, m1)),
                 b = world.add(
                     spinning(Vector2(5, 5) + (r1 + r2) * normal - 0.01 * v2, v2, w2, r2, m2));
    const Vector2 momentum = world.momentum();
    const double angular = angular_momentum(world, a) + angular_momentum(world, b),
                 energy = world.kinetic_energy();
    world.advance(0.02);
    ASSERT_EQ(world.counters().disc_impacts, 1u);
    const double reduced = 1 / (1 / m1 + 1 / m2),
                 normal_impulse = (1 + e) * reduced * normal.dot(v1 - v2);
    const double slip = tangent.dot(v2 - v1) - (w1 * r1 + w2 * r2),
                 rim = reduced / 3;  // what the rims of two discs yield to a tangential impulse: 1
                                     // + m r^2/I = 3 times that of their centres
    const double stick = (1 + tangential) * rim * std::abs(slip),
                 impulse = -std::copysign(std::min(stick, mu * normal_impulse), slip);
    ++(stick < mu * normal_impulse ? sticking : sliding);
    EXPECT_NEAR(
        (world.velocity(a) - (v1 - (normal_impulse * normal + impulse * tangent) / m1)).norm(), 0.0,
        1e-10);  // the place in the field to 1e-15 m makes the normal
    EXPECT_NEAR(
        (world.velocity(b) - (v2 + (normal_impulse * normal + impulse * tangent) / m2)).norm(), 0.0,
        1e-10);
    EXPECT_NEAR(world.spin(a), w1 - 2 * impulse / (m1 * r1), 1e-8);
    EXPECT_NEAR(world.spin(b), w2 - 2 * impulse / (m2 * r2), 1e-8);
    EXPECT_NEAR((world.momentum() - momentum).norm(), 0.0, 1e-14);
    EXPECT_NEAR(angular_momentum(world, a) + angular_momentum(world, b), angular, 1e-13);
    const double lost = 0.5 * reduced * (1 - e * e) * std::pow(normal.dot(v1 - v2), 2) +
                        std::abs(impulse * slip) - impulse * impulse / (2 * rim);
    EXPECT_NEAR(world.kinetic_energy(), energy - lost, 1e-10);
    EXPECT_LE(world.kinetic_energy(), energy * (1 + 1e-15));
  }
  EXPECT_GT(sliding, 300);
  EXPECT_GT(sticking, 300);
}

TEST(Spin, BatAndPostTakePartWithoutTurning) {
  World world(rough_surfaces(10.0, 0.0));
  BatSpec bat;
  bat.position = {5, 5};
  bat.half_extent = {0.05, 0.5};
  bat.mass = 2.0;
  const BodyId b = world.add(bat);
  const BodyId puck = world.add(spinning({4, 5}, {1, 0.3}, 0.0));
  world.advance(1.2);
  // Sticking: the rim of the puck and the face end with one speed; 1/m + r^2/I + 1/M = 3 + 1/2.
  const double impulse = 0.3 / 3.5;
  EXPECT_NEAR(world.velocity(puck).y(), 0.3 - impulse, 1e-14);
  EXPECT_NEAR(world.velocity(b).y(), impulse / 2, 1e-14);
  EXPECT_NEAR(world.spin(b), 0.0, 0.0);
  EXPECT_NEAR(world.velocity(puck).y() + world.spin(puck) * 0.04, world.velocity(b).y(), 1e-14);

  World other(rough_surfaces(10.0, 0.0));
  PostSpec post;
  post.position = {5, 5};
  post.radius = 0.1;
  other.add(post);
  const BodyId rolling = other.add(spinning({4, 5}, {1, 0}, 30.0));
  other.advance(1.2);
  EXPECT_NEAR(other.velocity(rolling).y(), -30.0 * 0.04 / 3, 1e-14);
  EXPECT_NEAR(other.spin(rolling), 10.0, 1e-13);
}

TEST(Spin, IsKeptBetweenImpactsAndCostsNoEvents) {
  World world(rough_surfaces(0.5, 0.0));
  const BodyId puck = world.add(spinning({5, 5}, {0, 0}, 7.0));
  world.advance(1e3);
  EXPECT_EQ(world.spin(puck), 7.0);
  EXPECT_EQ(world.counters().events(), 0u);
  EXPECT_NEAR(world.kinetic_energy(), 0.5 * 0.5 * 0.04 * 0.04 * 49.0, 1e-16);
}

TEST(Spin, SmoothPairsOfMaterialsStaySmoothBesideRoughOnes) {
  WorldSpec spec = rink_of(10, 10);
  spec.restitution = RestitutionTable(2, 1.0);
  spec.surface_friction = SurfaceFriction{PairTable(2, 0.0), RestitutionTable(2, 0.0)};
  spec.surface_friction->coefficient.set(0, 1, 0.5);
  World world(spec);
  const BodyId smooth = world.add(spinning({2, 1}, {1, -1}, 3.0));
  PuckSpec other = spinning({6, 1}, {1, -1}, 3.0);
  other.material = 1;
  const BodyId rough = world.add(other);
  world.advance(2.0);
  EXPECT_EQ(world.velocity(smooth), Vector2(1, 1));
  EXPECT_EQ(world.spin(smooth), 3.0);
  EXPECT_LT(world.velocity(rough).x(), 1.0);
}

TEST(RoughGas, OfPerfectlyRoughElasticDiscsKeepsItsEnergyAndSharesItEquallyAmongItsFreedoms) {
  // Restitution 1 in both directions turns the relative velocity of the touching points round: two
  // freedoms of motion and one of spin hold as much each.
  World world(rough_surfaces(1e9, 1.0, 1.0, 4.0));
  std::mt19937_64 random(32);
  const std::vector<BodyId> pucks = scatter_pucks(world, random, 600, 0.5, 2.0);
  const double energy = world.kinetic_energy();
  double turning = 0.0;
  int samples = 0;
  for (int second = 1; second <= 40; ++second) {
    world.advance(second);
    if (second <= 10) continue;
    for (const BodyId puck : pucks)
      turning += 0.5 * moment_of_inertia(world, puck) * world.spin(puck) * world.spin(puck);
    ++samples;
  }
  EXPECT_GT(world.counters().disc_impacts, 50000u);
  EXPECT_NEAR(world.kinetic_energy() / energy, 1.0, 1e-13);
  EXPECT_NEAR(turning / samples / energy, 1.0 / 3.0, 0.02);
}

TEST(RoughGas, NeverGainsEnergy) {
  std::mt19937_64 random(33);
  for (int i = 0; i < 10; ++i) {
    World world(
        rough_surfaces(uniform(random, 0, 1), uniform(random, 0, 1), uniform(random, 0.3, 1), 2.0));
    scatter_pucks(world, random, 100, 0.1, 10.0);
    double energy = world.kinetic_energy();
    for (int step = 1; step <= 100; ++step) {
      world.advance(0.02 * step);
      EXPECT_LE(world.kinetic_energy(), energy * (1 + 1e-14));
      energy = world.kinetic_energy();
    }
  }
}

}  // namespace
}  // namespace rink::physics::test
