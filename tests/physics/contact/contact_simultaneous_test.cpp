// Contacts that close at the same instant: cradles, breaks, rows before a bat, and what they must
// conserve.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "tests/physics/scenes.h"

namespace rink::physics::test {
namespace {

constexpr double dyadic_radius = 0.03125;  // a power of two, so that touching places are exact

PuckSpec dyadic_puck_at(const Vector2& position, const Vector2& velocity = {0.0, 0.0},
                        double mass = 1.0) {
  PuckSpec puck;
  puck.radius = dyadic_radius;
  puck.position = position;
  puck.velocity = velocity;
  puck.mass = mass;
  return puck;
}

/// A row of `count` pucks that touch, of which the first `moving` run into the others at 1 m/s from
/// 0.5 m away.
std::vector<double> speeds_after_cradle(int count, int moving, double restitution,
                                        bool is_reversed = false) {
  World world(rink_of(8, 1, restitution));
  std::vector<BodyId> pucks(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const int place = is_reversed ? count - 1 - i : i;
    const bool is_moving = place < moving;
    pucks[static_cast<std::size_t>(place)] =
        world.add(dyadic_puck_at({1.0 + 2.0 * dyadic_radius * place + (is_moving ? 0.0 : 0.5), 0.5},
                                 {is_moving ? 1.0 : 0.0, 0.0}));
  }
  world.advance(0.75);
  std::vector<double> speeds;
  for (const BodyId puck : pucks) {
    EXPECT_EQ(world.velocity(puck).y(), 0.0);
    speeds.push_back(world.velocity(puck).x());
  }
  EXPECT_LE(world.counters().events_at_once_max, 200u);
  return speeds;
}

TEST(Cradle, AsManyBallsLeaveAsArrive) {
  for (int count = 2; count <= 12; ++count)
    for (int moving = 1; moving < count; ++moving)
      for (const bool is_reversed : {false, true}) {
        const std::vector<double> speeds = speeds_after_cradle(count, moving, 1.0, is_reversed);
        for (int place = 0; place < count; ++place)
          EXPECT_NEAR(speeds[static_cast<std::size_t>(place)], place < count - moving ? 0.0 : 1.0,
                      1e-12)
              << moving << " of " << count << ", ball " << place;
      }
}

/// One ball passes (1 + e)/2 of its speed on and keeps (1 - e)/2; slower ones behind never catch up
/// in the instant, so the last has ((1 + e)/2)^(n - 1).
TEST(Cradle, LosesSpeedFromBallToBallByTheRestitution) {
  const double e = 0.8;
  const std::vector<double> speeds = speeds_after_cradle(5, 1, e);
  EXPECT_NEAR(std::accumulate(speeds.begin(), speeds.end(), 0.0), 1.0, 1e-14);
  EXPECT_NEAR(speeds.back(), std::pow(0.5 * (1.0 + e), 4), 1e-12);
  for (std::size_t i = 1; i < speeds.size(); ++i) EXPECT_LE(speeds[i - 1], speeds[i] + 1e-12);
}

TEST(Cradle, LeaningOnAWallThrowsTheBallBack) {
  World world(rink_of(4, 1));
  std::vector<BodyId> row;
  for (int i = 0; i < 4; ++i)
    row.push_back(world.add(dyadic_puck_at({dyadic_radius + 2.0 * dyadic_radius * i, 0.5})));
  const BodyId ball = world.add(dyadic_puck_at({1.0, 0.5}, {-1.0, 0.0}));
  world.advance(1.5);
  EXPECT_NEAR(world.velocity(ball).x(), 1.0, 1e-12);
  for (const BodyId puck : row) EXPECT_NEAR(world.velocity(puck).norm(), 0.0, 1e-12);
}

/// Both normals at 30 degrees to the way: each impulse is (1 + e) v cos(30) m/(2 + cos(60)).
TEST(Break, OneBallBetweenTwoFollowsTheFormula) {
  for (const double e : {0.0, 0.5, 1.0})
    for (const bool are_first : {false, true}) {
      World world(rink_of(4, 2, e));
      BodyId cue, above, below;
      const auto add_cue = [&] { cue = world.add(dyadic_puck_at({0.5, 1.0}, {1.0, 0.0})); };
      if (!are_first) add_cue();
      above = world.add(dyadic_puck_at({1.0, 1.0 + dyadic_radius})),
      below = world.add(dyadic_puck_at({1.0, 1.0 - dyadic_radius}));
      if (are_first) add_cue();
      world.advance(0.75);
      const double impulse = (1.0 + e) * std::sqrt(0.75) / 2.5;
      EXPECT_NEAR(world.velocity(cue).x(), 1.0 - 2.0 * impulse * std::sqrt(0.75), 1e-14);
      EXPECT_NEAR(world.velocity(cue).y(), 0.0, 1e-14);
      EXPECT_NEAR(world.velocity(above).x(), impulse * std::sqrt(0.75), 1e-14);
      EXPECT_NEAR(world.velocity(above).y(), 0.5 * impulse, 1e-14);
      EXPECT_NEAR(world.velocity(below).y(), -0.5 * impulse, 1e-14);
      EXPECT_EQ(world.counters().joint_impacts, 1u);
    }
}

/// A rack of `rows` rows, apex first, hit by a cue ball on its axis. Answers the pucks row by row,
/// from below upwards, and the cue ball last.
std::vector<BodyId> rack(World& world, int rows, double gap, std::mt19937_64* order = nullptr) {
  std::vector<std::pair<std::size_t, PuckSpec>> pucks;
  for (int row = 0; row < rows; ++row)
    for (int i = 0; i <= row; ++i)
      pucks.push_back(
          {pucks.size(), dyadic_puck_at({2.0 + row * std::sqrt(3.0) * (dyadic_radius + 0.5 * gap),
                                         1.0 + (2 * i - row) * (dyadic_radius + 0.5 * gap)})});
  pucks.push_back({pucks.size(), dyadic_puck_at({1.0, 1.0}, {2.0, 0.0})});
  if (order != nullptr) std::shuffle(pucks.begin(), pucks.end(), *order);
  std::vector<BodyId> ids(pucks.size());
  for (const auto& [place, puck] : pucks) ids[place] = world.add(puck);
  return ids;
}

TEST(Break, OfARackStaysSymmetric) {
  for (const double e : {0.0, 0.5, 0.9, 1.0})
    for (const int rows : {2, 3, 4, 5}) {
      SCOPED_TRACE(testing::Message() << "restitution " << e << ", rows " << rows);
      World world(rink_of(4, 2, e));
      const std::vector<BodyId> ids = rack(world, rows, 4e-16);
      const double energy = world.kinetic_energy();
      world.advance(0.6);
      for (int row = 0, first = 0; row < rows; first += ++row)
        for (int i = 0; i <= row; ++i) {
          const BodyId puck = ids[static_cast<std::size_t>(first + i)],
                       mirrored = ids[static_cast<std::size_t>(first + row - i)];
          EXPECT_NEAR(world.velocity(puck).x(), world.velocity(mirrored).x(), 1e-12)
              << row << " " << i;
          EXPECT_NEAR(world.velocity(puck).y(), -world.velocity(mirrored).y(), 1e-12)
              << row << " " << i;
          EXPECT_NEAR(world.position(puck).y() - 1.0, 1.0 - world.position(mirrored).y(), 1e-12)
              << row << " " << i;
        }
      EXPECT_NEAR(world.momentum().x(), 2.0, 1e-13);
      EXPECT_NEAR(world.momentum().y(), 0.0, 1e-13);
      if (e == 1.0) EXPECT_NEAR(world.kinetic_energy(), energy, 1e-12 * energy);
      else EXPECT_LT(world.kinetic_energy(), energy);
      EXPECT_LE(world.counters().events_at_once_max, 200u);
      EXPECT_LT(world.max_overlap(), 1e-13);
    }
}

TEST(Break, DoesNotDependOnTheOrderOfIds) {
  std::mt19937_64 random(5);
  for (const double e : {0.0, 0.7, 1.0}) {
    World reference(rink_of(4, 2, e));
    const std::vector<BodyId> expected = rack(reference, 4, 4e-16);
    reference.advance(0.55);
    for (int draw = 0; draw < 10; ++draw) {
      World world(rink_of(4, 2, e));
      const std::vector<BodyId> ids = rack(world, 4, 4e-16, &random);
      world.advance(0.55);
      for (std::size_t i = 0; i < ids.size(); ++i)
        EXPECT_LT((world.velocity(ids[i]) - reference.velocity(expected[i])).norm(), 1e-12) << i;
    }
  }
}

/// Two balls hit the ends of a row at the same instant. Alone, either impact would be over before
/// the other began; together they meet in the middle.
TEST(Break, HitsFarApartAtOneInstantMeetInTheMiddle) {
  for (const double e : {0.0, 0.6, 1.0}) {
    World world(rink_of(4, 1, e));
    std::vector<BodyId> row;
    const std::vector<double> masses{1.0, 3.0, 0.2, 5.0, 0.2, 3.0, 1.0};
    for (int i = 0; i < 7; ++i) {
      const bool is_end = i == 0 || i == 6;
      const double x = 2.0 + (i - 3) * (2.0 * dyadic_radius + (is_end ? 0.125 : 0.0)),
                   speed = is_end ? (3 - i) / 3.0 : 0.0;
      row.push_back(
          world.add(dyadic_puck_at({x, 0.5}, {speed, 0.0}, masses[static_cast<std::size_t>(i)])));
    }
    world.advance(0.5);
    for (std::size_t i = 0; i < 7; ++i)
      EXPECT_NEAR(world.velocity(row[i]).x(), -world.velocity(row[6 - i]).x(), 1e-13)
          << e << " " << i;
    EXPECT_NEAR(world.velocity(row[3]).x(), 0.0, 1e-13);
  }
}

TEST(Break, RestingBallHitFromThreeSidesAtOnceStays) {
  World world(rink_of(4, 4));
  const BodyId middle = world.add(dyadic_puck_at({2.0, 2.0}));
  std::vector<BodyId> others;
  for (int i = 0; i < 3; ++i) {
    const double angle = 2.0 * M_PI / 3.0 * i;
    others.push_back(
        world.add(dyadic_puck_at(Vector2(2.0, 2.0) + Vector2(std::cos(angle), std::sin(angle)),
                                 -Vector2(std::cos(angle), std::sin(angle)))));
  }
  world.advance(1.5);
  EXPECT_NEAR(world.velocity(middle).norm(), 0.0, 1e-12);
  for (const BodyId puck : others) EXPECT_NEAR(world.velocity(puck).norm(), 1.0, 1e-12);
}

/// Every impulse is (1 + e) V/(1/m + n/M).
TEST(Row, BeforeABatIsHitAsOne) {
  for (const double e : {0.0, 0.5, 1.0}) {
    World world(rink_of(4, 2, e));
    BatSpec bat;
    bat.half_extent = {0.125, 0.25};
    bat.position = {1.0, 1.0};
    bat.velocity = {1.0, 0.0};
    bat.mass = 4.0;
    const BodyId hitting = world.add(bat);
    std::vector<BodyId> row;
    for (int i = 0; i < 4; ++i)
      row.push_back(world.add(dyadic_puck_at({1.5, 1.0 + 0.125 * (i - 1.5)})));
    world.advance(0.5);
    const double impulse = (1.0 + e) / (1.0 + 4 / 4.0);
    EXPECT_NEAR(world.velocity(hitting).x(), 1.0 - 4 * impulse / 4.0, 1e-13) << e;
    for (const BodyId puck : row) EXPECT_NEAR(world.velocity(puck).x(), impulse, 1e-13) << e;
  }
}

TEST(Corner, OfTwoWallsSendsThePuckBackTheWayItCame) {
  World world(rink_of(4, 2));
  const BodyId puck =
      world.add(dyadic_puck_at({1.0 + dyadic_radius, 0.5 + dyadic_radius}, {-2.0, -1.0}));
  world.advance(1.0);
  EXPECT_NEAR((world.position(puck) - Vector2(1.0 + dyadic_radius, 0.5 + dyadic_radius)).norm(),
              0.0, 1e-14);
  EXPECT_NEAR((world.velocity(puck) - Vector2(2.0, 1.0)).norm(), 0.0, 1e-14);
}

/// Clusters of touching pucks of random masses, grown one by one, that a fast puck hits.
TEST(Cluster, OfAnyShapeAndMassesConservesMomentumAndGainsNoEnergy) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    std::mt19937_64 random(seed);
    const double e = std::vector{0.0, 0.3, 0.9, 1.0}[seed % 4], spread = seed % 3 == 0 ? 6.0 : 1.0;
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", restitution " << e);
    World world(rink_of(8, 8, e));
    std::vector<Vector2> places{{4.0, 4.0}};
    for (int tries = 0; places.size() < 15 && tries < 1000; ++tries) {
      // On the lattice of a rack, so that many touch several others.
      const double direction = M_PI / 3.0 * static_cast<double>(random() % 6);
      const Vector2 next =
          places[random() % places.size()] +
          (2.0 * dyadic_radius + 4e-16) * Vector2(std::cos(direction), std::sin(direction));
      if (!world.is_free(next, dyadic_radius)) continue;
      if (std::any_of(places.begin(), places.end(), [&](const Vector2& place) {
            return (place - next).norm() < 2.0 * dyadic_radius;
          }))
        continue;
      places.push_back(next);
    }
    for (const Vector2& place : places)
      world.add(
          dyadic_puck_at(place, {0.0, 0.0}, std::pow(10.0, uniform(random, -spread, spread))));
    const double angle = uniform(random, 0.0, 2.0 * M_PI);
    world.add(dyadic_puck_at(Vector2(4.0, 4.0) + 2.0 * Vector2(std::cos(angle), std::sin(angle)),
                             -3.0 * Vector2(std::cos(angle), std::sin(angle)), 1.0));
    const double energy = world.kinetic_energy();
    const Vector2 momentum = world.momentum();
    world.advance(0.8);
    if (world.counters().wall_impacts == 0) {
      EXPECT_LT((world.momentum() - momentum).norm(), 1e-12 * momentum.norm());
    }
    if (e == 1.0) EXPECT_NEAR(world.kinetic_energy(), energy, 1e-11 * energy);
    else EXPECT_LE(world.kinetic_energy(), energy * (1.0 + 1e-14));
    // A light ball among touching heavy ones that give back all bounces on and on, and each bounce
    // counts.
    if (e < 1.0 || spread < 6.0) {
      EXPECT_LE(world.counters().events_at_once_max, 200u);
    }
    EXPECT_LT(world.max_overlap(), 1e-12);
  }
}

/// Between a wall and a ball 1e8 times heavier, a light ball that touches both would bounce 31,415
/// times in no time.
TEST(Cluster, LightBallBetweenAHeavyOneAndTheWallTakesOneInstant) {
  World world(rink_of(8, 1));
  const BodyId light = world.add(dyadic_puck_at({dyadic_radius, 0.5})),
               heavy = world.add(dyadic_puck_at({1.0, 0.5}, {-1.0, 0.0}, 1e8));
  const double energy = world.kinetic_energy();
  world.advance(2.0);
  EXPECT_NEAR(world.velocity(heavy).x(), 1.0, 1e-4);
  EXPECT_NEAR(world.kinetic_energy(), energy, 1e-9 * energy);
  EXPECT_LE(world.counters().events_at_once_max, 200u);
  EXPECT_GE(world.position(light).x(), dyadic_radius - 1e-12);
}

TEST(Gas, WithoutSimultaneousContactsSolvesNone) {
  World world(rink_of(4, 4));
  std::mt19937_64 random(3);
  scatter_pucks(world, random, 400);
  world.advance(5.0);
  EXPECT_GT(world.counters().disc_impacts, 5'000u);
  EXPECT_EQ(world.counters().joint_impacts, 0u);
  EXPECT_LE(world.counters().events_at_once_max, 3u);
}

}  // namespace
}  // namespace rink::physics::test
