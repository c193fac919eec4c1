// Coulomb friction with the table: stopping, impacts on the way, and rest for good; the answers
// from closed forms and from bisection in extended precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/physics/scenes.h"

namespace rink::physics::test {
namespace {

using Real = long double;

WorldSpec rough_rink(double length, double width, double friction, double puck_drag = 0.0,
                     double restitution = 1.0) {
  WorldSpec spec = rink_of(length, width, restitution, puck_drag, 1.5);
  spec.puck_friction = friction;
  return spec;
}

PuckSpec sliding(double x, double y, double vx, double vy) {
  PuckSpec puck;
  puck.position = {x, y};
  puck.velocity = {vx, vy};
  return puck;
}

/// dv/dt = -g v - k in extended precision, along a straight line: written down from the textbook
/// solution (v + k/g) exp(-g t) - k/g.
struct Slide {
  Real speed, friction, drag;
  Real stopping_time() const {
    return speed == 0  ? 0
           : drag == 0 ? speed / friction
                       : std::log1p(drag * speed / friction) / drag;
  }
  Real distance_at(Real time) const {
    const Real t = std::min(time, stopping_time());
    if (drag == 0) return speed * t - friction * t * t / 2;
    return -(speed + friction / drag) * std::expm1(-drag * t) / drag - friction / drag * t;
  }
  Real stopping_distance() const { return distance_at(stopping_time()); }
};

TEST(SlidingPuck, StopsAfterTheDistanceAndTimeOfCoulombsLaw) {
  std::mt19937_64 random(21);
  for (int i = 0; i < 2000; ++i) {
    SCOPED_TRACE(i);
    const double friction = std::exp(uniform(random, -3, 2)),
                 speed = uniform(random, 0.1, 1.0) * std::sqrt(2 * friction * 0.9),
                 angle = uniform(random, 0.2, 1.3);
    World world(rough_rink(10, 10, friction));
    const BodyId puck = world.add(sliding(1, 1, speed * std::cos(angle), speed * std::sin(angle)));
    const double time = speed / friction, distance = speed * speed / (2 * friction);
    EXPECT_NEAR(world.motion(puck).rest_time / time, 1.0, 1e-14);
    world.advance(0.5 * time);
    EXPECT_NEAR((world.position(puck) - Vector2(1, 1)).norm(), 0.75 * distance, 1e-14);
    EXPECT_NEAR(world.velocity(puck).norm() / (0.5 * speed), 1.0, 1e-14);
    world.advance(2.0 * time);
    EXPECT_NEAR((world.position(puck) - Vector2(1, 1)).norm(), distance, 1e-14);
    EXPECT_EQ(world.velocity(puck), Vector2(0.0, 0.0));
    EXPECT_TRUE(world.is_resting(puck));
    EXPECT_NEAR(world.motion(puck).time / time, 1.0, 1e-14);
    EXPECT_EQ(world.counters().stops, 1u);
  }
}

TEST(SlidingPuck, StopsInFiniteTimeUnderDragAndFrictionTogether) {
  std::mt19937_64 random(22);
  for (int i = 0; i < 2000; ++i) {
    SCOPED_TRACE(i);
    const double friction = std::exp(uniform(random, -6, 2)),
                 drag = std::exp(uniform(random, -9, 2)), angle = uniform(random, 0.2, 1.3);
    const double speed = uniform(random, 0.1, 1.0) * std::max(drag, std::sqrt(2 * friction));
    World world(rough_rink(20, 20, friction, drag));
    const BodyId puck = world.add(sliding(1, 1, speed * std::cos(angle), speed * std::sin(angle)));
    const Slide truth{speed, friction, drag};
    const double time = static_cast<double>(truth.stopping_time());
    EXPECT_NEAR(world.motion(puck).rest_time / time, 1.0, 1e-14);
    world.advance(0.3 * time);
    EXPECT_NEAR((world.position(puck) - Vector2(1, 1)).norm(),
                static_cast<double>(truth.distance_at(0.3L * time)), 1e-14);
    world.advance(2.0 * time);
    EXPECT_NEAR((world.position(puck) - Vector2(1, 1)).norm(),
                static_cast<double>(truth.stopping_distance()), 2e-14);
    EXPECT_EQ(world.velocity(puck), Vector2(0.0, 0.0));
  }
}

TEST(SlidingPuck, RestsWithoutAnEventEverAfter) {
  World world(rough_rink(10, 10, 0.5));
  const BodyId puck = world.add(sliding(1, 5, 1.5, 0));
  world.advance(4.0);
  const std::uint64_t hash = world.hash(), touched = world.counters().bodies_touched,
                      events = world.counters().events();
  const Vector2 place = world.position(puck);
  EXPECT_EQ(events, 1u);
  world.advance(1e6);
  EXPECT_EQ(world.position(puck), place);
  EXPECT_EQ(world.hash(), hash);
  EXPECT_EQ(world.counters().events(), events);
  EXPECT_EQ(world.counters().bodies_touched, touched);
}

TEST(SlidingPuck, ThatIsStoppedJustShortLeavesTheOtherAloneAndOneThatJustReachesDoesNot) {
  const double friction = 0.4, speed = 1.2, distance = speed * speed / (2 * friction);
  for (const double drag : {0.0, 0.3}) {
    const double reach =
        drag == 0.0 ? distance
                    : static_cast<double>(Slide{speed, friction, drag}.stopping_distance());
    for (const double relative : {-1e-3, -1e-9, -1e-13, 1e-13, 1e-9, 1e-3}) {
      SCOPED_TRACE(relative);
      World world(rough_rink(10, 10, friction, drag));
      const BodyId a = world.add(sliding(1, 5, speed, 0)),
                   b = world.add(sliding(1.08 + reach * (1 + relative), 5, 0, 0));
      world.advance(100.0);
      EXPECT_EQ(world.counters().disc_impacts, relative < 0 ? 1u : 0u);
      EXPECT_EQ(world.position(b).x() > 1.08 + reach * (1 + relative), relative < 0);
      EXPECT_TRUE(world.is_resting(a));
      EXPECT_TRUE(world.is_resting(b));
      EXPECT_LT(world.max_overlap(), 2e-15);
    }
  }
}

TEST(SlidingPuck, MeetsAWallAtTheSpeedThatFrictionLeft) {
  const double friction = 0.4;
  World world(rough_rink(10, 10, friction));
  const BodyId puck = world.add(sliding(8.96, 5, 1.2, 0));  // 1 m to the wall
  const double left = std::sqrt(1.2 * 1.2 - 2 * friction * 1.0), hit = (1.2 - left) / friction;
  world.advance(hit + 0.1);
  EXPECT_EQ(world.counters().wall_impacts, 1u);
  EXPECT_NEAR(world.motion(puck).time, hit, 1e-14);
  EXPECT_NEAR(world.velocity(puck).x(), -(left - friction * 0.1), 1e-14);
  world.advance(100.0);
  EXPECT_NEAR(world.position(puck).x(), 9.96 - left * left / (2 * friction), 1e-14);
}

/// The first instant at which two sliding pucks are `reach` apart: stepping until the sign changes,
/// then bisection; -1 if they never are.
struct Pair {
  Vector2 position[2], velocity[2];
  Real friction, drag;
  Real gap(Real time, Real reach) const {
    Real place[2][2];
    for (int i = 0; i < 2; ++i) {
      const Real vx = velocity[i].x(), vy = velocity[i].y(), speed = std::sqrt(vx * vx + vy * vy);
      const Real distance = Slide{speed, friction, drag}.distance_at(time);
      place[i][0] = position[i].x() + (speed == 0 ? 0 : vx / speed * distance);
      place[i][1] = position[i].y() + (speed == 0 ? 0 : vy / speed * distance);
    }
    return std::hypot(place[1][0] - place[0][0], place[1][1] - place[0][1]) - reach;
  }
  Real stopping_time() const {
    return std::max(Slide{velocity[0].norm(), friction, drag}.stopping_time(),
                    Slide{velocity[1].norm(), friction, drag}.stopping_time());
  }
  Real first_touch(Real reach, int steps) const {
    const Real end = stopping_time();
    for (int i = 1; i <= steps; ++i) {
      Real low = end * (i - 1) / steps, high = end * i / steps;
      if (gap(high, reach) > 0) continue;
      for (int halving = 0; halving < 80; ++halving) {
        const Real middle = (low + high) / 2;
        (gap(middle, reach) > 0 ? low : high) = middle;
      }
      return high;
    }
    return -1;
  }
  Real closing_speed(Real time, Real reach) const {
    const Real h = 1e-6L;
    return (gap(time - h, reach) - gap(time, reach)) / h;
  }
};

TEST(SlidingPuck, MeetsAnotherWhenBisectionSaysSo) {
  std::mt19937_64 random(23);
  int hits = 0, misses = 0;
  for (int i = 0; i < 400; ++i) {
    SCOPED_TRACE(i);
    Pair pair{{{uniform(random, 4, 6), uniform(random, 4, 6)},
               {uniform(random, 4, 6), uniform(random, 4, 6)}},
              {},
              std::exp(uniform(random, -2, 0)),
              i % 2 == 0 ? 0.0L : std::exp(uniform(random, -3, 0))};
    // Aimed at each other, more or less, so that some meet, some stop short and some pass.
    const Vector2 way = (pair.position[1] - pair.position[0]).normalized(), side(-way.y(), way.x());
    pair.velocity[0] = uniform(random, 0.0, 1.2) * way + uniform(random, -0.1, 0.1) * side;
    pair.velocity[1] =
        i % 5 == 0 ? Vector2(0.0, 0.0)
                   : Vector2(uniform(random, -1.2, 0.3) * way + uniform(random, -0.1, 0.1) * side);
    if ((pair.position[1] - pair.position[0]).norm() < 0.1) continue;
    World world(
        rough_rink(10, 10, static_cast<double>(pair.friction), static_cast<double>(pair.drag)));
    world.record_events(true);
    for (int k = 0; k < 2; ++k)
      world.add(sliding(pair.position[k].x(), pair.position[k].y(), pair.velocity[k].x(),
                        pair.velocity[k].y()));
    const Real truth = pair.first_touch(0.08L, 4000);
    world.advance(static_cast<double>(pair.stopping_time()));
    const auto meeting = std::ranges::find(world.events(), EventKind::puck_puck, &Event::kind);
    const bool has_met = meeting != world.events().end();
    if (truth < 0) {
      ++misses;
      EXPECT_TRUE(!has_met || std::abs(pair.gap(meeting->time, 0.08L)) < 1e-14L)
          << "stepping may overlook a graze, but nothing else";
      continue;
    }
    ++hits;
    ASSERT_TRUE(has_met);
    EXPECT_NEAR(meeting->time, static_cast<double>(truth),
                3e-15 * 10 / static_cast<double>(pair.closing_speed(truth, 0.08L)));
  }
  EXPECT_GT(hits, 100);
  EXPECT_GT(misses, 100);
}

TEST(SlidingPuck, FliesOnAfterAnImpactAsIfItHadBeenThrownThere) {
  World world(rough_rink(10, 10, 0.3, 0.2));
  const BodyId a = world.add(sliding(4, 5, 1.5, 0)), b = world.add(sliding(5, 5.04, 0, 0));
  world.record_events(true);
  world.advance(1.0);
  ASSERT_EQ(world.counters().disc_impacts, 1u);
  const double hit = std::ranges::find(world.events(), EventKind::puck_puck, &Event::kind)->time;
  World other(rough_rink(10, 10, 0.3, 0.2));
  for (const BodyId body : {a, b}) {
    EXPECT_EQ(world.motion(body).time, hit);
    const Motion parted = world.motion(body).at(hit + 0.05);
    other.add(sliding(parted.position.x(), parted.position.y(), parted.velocity.x(),
                      parted.velocity.y()));
  }
  world.advance(100.0), other.advance(100.0);
  for (const BodyId body : {a, b})
    EXPECT_LT((world.position(body) - other.position(body)).norm(), 1e-14);
}

TEST(SlidingGas, ComesToRestEntirelyAndThenHasNoEvents) {
  for (const double restitution : {1.0, 0.5, 0.0}) {
    SCOPED_TRACE(restitution);
    World world(rough_rink(3, 3, 0.5, 0.1, restitution));
    std::mt19937_64 random(24);
    const std::vector<BodyId> pucks = scatter_pucks(world, random, 400, 0.3, 3.0);
    scatter_posts(world, random, 5);
    double energy = world.kinetic_energy();
    for (int i = 1; i <= 50; ++i) {
      world.advance(0.1 * i);
      EXPECT_LE(world.kinetic_energy(), energy);
      energy = world.kinetic_energy();
    }
    EXPECT_EQ(energy, 0.0);
    EXPECT_GT(world.counters().disc_impacts, 400u);
    EXPECT_LT(world.max_overlap(), 1e-12);
    for (const BodyId puck : pucks) EXPECT_TRUE(world.is_resting(puck));
    const Counters before = world.counters();
    world.advance(1e4);
    EXPECT_EQ(world.counters().events(), before.events());
    EXPECT_EQ(world.counters().predictions, before.predictions);
  }
}

TEST(SlidingGas, OverlapsNowhereBetweenEvents) {
  World world(rough_rink(2, 2, 0.1, 0.0, 0.9));
  std::mt19937_64 random(25);
  scatter_pucks(world, random, 60);
  for (int step = 1; step <= 10000; ++step) {
    world.advance(5e-4 * step);
    ASSERT_LT(world.max_overlap(), 1e-12) << step;
  }
  EXPECT_GT(world.counters().disc_impacts, 50u);
}

TEST(SlidingPuck, UnderABatIsPushedAgainstItsFriction) {
  // Together they obey (m + M) dv/dt = M (a - g v) - m k; the pushing is a quick sequence of small
  // impacts, right within the time scale of pressed contact.
  const double friction = 2.0, a = 4.0, g = 1.5, mass = 0.5, bat_mass = 1.0;
  for (const double restitution : {0.0, 0.5, 1.0}) {
    SCOPED_TRACE(restitution);
    World world(rough_rink(10, 10, friction, 0.0, restitution));
    BatSpec bat;
    bat.position = {2, 5};
    bat.mass = bat_mass;
    PuckSpec puck = sliding(2.0900001, 5.01, 0, 0);
    puck.mass = mass;
    const BodyId pushing = world.add(bat), pushed = world.add(puck);
    world.set_thrust(pushing, {a, 0});
    world.advance(1.5);
    const double total = mass + bat_mass, driving = (bat_mass * a - mass * friction) / total,
                 drag = bat_mass * g / total;
    const double speed = driving * -std::expm1(-drag * 1.5) / drag,
                 way = driving / drag * (1.5 - -std::expm1(-drag * 1.5) / drag);
    EXPECT_NEAR(world.velocity(pushed).x(), speed, 0.01 * speed);
    EXPECT_NEAR(world.position(pushed).x() - 2.09, way, 0.01 * way);
    EXPECT_NEAR(world.position(pushing).x() - 2.0, way, 0.01 * way);
    EXPECT_LT(world.max_overlap(), 1e-9);
    EXPECT_LT(world.counters().events(), 2u * 10000u);
    world.set_thrust(pushing, {-a, 0});
    world.advance(2.0);
    EXPECT_GT(world.position(pushed).x() - world.position(pushing).x(), 0.1);
  }
}

TEST(SlidingPuck, PinnedToAWallSlidesAlongItUntilFrictionStopsItAndThenCostsNothing) {
  for (const double restitution : {0.0, 0.6, 1.0}) {
    SCOPED_TRACE(restitution);
    World world(rough_rink(4, 4, 0.5, 0.0, restitution));
    BatSpec bat;
    bat.position = {3.87 - 2e-6, 2};
    bat.half_extent = {0.05, 0.5};
    const BodyId pressing = world.add(bat);
    const BodyId puck = world.add(sliding(3.96 - 1e-6, 1.8, 0.0, 0.4));
    world.set_thrust(pressing, {6, 0});
    world.advance(5.0);
    EXPECT_NEAR(world.position(puck).y(), 1.8 + 0.4 * 0.4 / (2 * 0.5), 1e-3);
    EXPECT_NEAR(world.position(puck).x(), 3.96, 3e-6);
    EXPECT_EQ(world.velocity(puck), Vector2(0.0, 0.0));
    EXPECT_LT(world.max_overlap(), 1e-9);
    const std::uint64_t events = world.counters().events();
    world.advance(20.0);
    EXPECT_EQ(world.counters().events(), events);
  }
}

TEST(SlidingMatch, GivesTheSameBitsForEveryCellSizeAndOutputRate) {
  for (const double restitution : {0.0, 0.7, 1.0}) {
    std::uint64_t hashes[3];
    for (int variant = 0; variant < 3; ++variant) {
      WorldSpec spec = rough_rink(2.5, 1.5, 0.4, 0.1, restitution);
      spec.cell_size = variant == 0 ? 0.0 : variant == 1 ? 0.5 : 2.0;
      spec.surface_friction = SurfaceFriction{PairTable(1, 0.2), RestitutionTable(1, 0.3)};
      World world(spec);
      std::mt19937_64 random(26);
      const std::vector<BodyId> bats = scatter_bats(world, random, 3);
      scatter_posts(world, random, 2);
      scatter_pucks(world, random, 25, 0.3, 3.0);
      RandomKeys keys{std::mt19937_64(27), 0.1};
      for (int step = 1; step <= (variant == 2 ? 500 : 1); ++step)
        keys.play(world, bats, variant == 2 ? 0.01 * step : 5.0);
      EXPECT_LT(world.max_overlap(), 1e-9);
      hashes[variant] = world.hash();
    }
    EXPECT_EQ(hashes[0], hashes[1]);
    EXPECT_EQ(hashes[0], hashes[2]);
  }
}

TEST(SlidingMatch, AdvancesUnderRandomKeysWhateverTheRestitution) {
  for (int seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(static_cast<std::uint64_t>(100 + seed));
    World world(rough_rink(1.2, 0.8, uniform(random, 0.05, 2.0), seed % 3 == 0 ? 0.3 : 0.0,
                           (seed % 4) / 3.0));
    const std::vector<BodyId> bats = scatter_bats(world, random, 2);
    scatter_posts(world, random, 1);
    scatter_pucks(world, random, 8, 0.05, 5.0);
    RandomKeys keys{std::mt19937_64(static_cast<std::uint64_t>(seed)), 0.2};
    for (int step = 1; step <= 40; ++step) {
      const std::uint64_t before = world.counters().events();
      keys.play(world, bats, 0.1 * step);
      EXPECT_LT(world.counters().events() - before, 10u * 1000u);
      EXPECT_LT(world.max_overlap(), 1e-9);
    }
  }
}

TEST(Motion, OfWhomFrictionHasStoppedIsThatOfOneAtRestForEver) {
  World world(rough_rink(10, 10, 0.5));
  const Motion sliding_on = world.motion(world.add(sliding(1, 1, 0.6, 0.8)));
  EXPECT_NEAR(sliding_on.rest_time, 2.0, 1e-15);
  const Motion stopped = sliding_on.at(2.5), later = stopped.at(7.0);
  EXPECT_NEAR((stopped.position - Vector2(1.6, 1.8)).norm(), 0.0, 1e-14);
  EXPECT_EQ(later.position, stopped.position);
  EXPECT_EQ(later.velocity, Vector2(0.0, 0.0));
  EXPECT_EQ(stopped.acceleration, Vector2(0.0, 0.0));
}

}  // namespace
}  // namespace rink::physics::test
