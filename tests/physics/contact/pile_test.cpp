// Bats as wide as the field squeeze pucks: the pile comes to rest and costs nothing more, at any
// restitution below 1.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "tests/physics/contact/contact_bounds.h"
#include "tests/physics/contact/pressed_bodies.h"
#include "tests/physics/scenes.h"
#include "tests/words.h"

namespace rink::physics::test {
namespace {

struct Pile {
  World world;
  BodyId left, right;
};

/// Pucks at random between two bats, each 5 kg, a metre wide, that drive at each other; all move
/// along at `drift` [m/s].
Pile pile_of(std::uint32_t pucks, double length, double restitution, double cell_size = 0.0,
             double drift = 0.0) {
  WorldSpec spec = rink_of(length, 1, restitution);
  spec.cell_size = cell_size;
  Pile pile{World(spec), {}, {}};
  BatSpec left = thin_bat_at(0.06, 0.5, 0.499, 5.0),
          right = thin_bat_at(length - 0.06, 0.5, 0.499, 5.0);
  left.velocity = right.velocity = {drift, 0.0};
  pile.left = pile.world.add(left), pile.right = pile.world.add(right);
  std::mt19937_64 random(1);
  for (std::uint32_t count = 0; count < pucks;) {
    PuckSpec puck =
        light_puck_at(uniform(random, 0.02, length - 0.02), uniform(random, 0.02, 0.98), 0.02);
    puck.radius = 0.02, puck.velocity = {drift, 0.0};
    if (pile.world.is_free(puck.position, puck.radius)) pile.world.add(puck), ++count;
  }
  return pile;
}

class Squeeze : public testing::TestWithParam<double> {
 protected:
  /// Squeezes for `duration` [s], of which nothing happens in the second half.
  void comes_to_rest(Pile&& pile, double duration, std::uint64_t events_per_puck) {
    Watch watch(pile.world, {pile.left, pile.right});
    watch.set_thrust(pile.left, {20, 0}), watch.set_thrust(pile.right, {-20, 0});
    watch.run(0.5 * duration);
    EXPECT_LT(pile.world.counters().events(), events_per_puck * (pile.world.body_count() - 2));
    EXPECT_LE(watch.events_in(0.5 * duration), 10u);
    const Vector2 drift = pile.world.velocity(pile.left);
    for (std::uint32_t body = 0; body < pile.world.body_count(); ++body)
      EXPECT_EQ(pile.world.velocity({body}), drift) << body;
  }
};

TEST_P(Squeeze, EightyPucksComeToRestBetweenTwoBats) {
  comes_to_rest(pile_of(80, 1, GetParam()), 10.0, 1000);
}

/// Fewer than a pile has, and of masses up to a thousand times apart: light ones rattle between
/// heavy ones, so that the hops of those who touch would not end.
TEST(Pile, OfFewAndUnevenPucksCostsFewEvents) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    World world(rink_of(1.0, 0.44, uniform(random, 0.0, 0.9)));
    const double mass = std::pow(10.0, uniform(random, 0.0, 1.3));
    const std::vector<BodyId> bats{world.add(thin_bat_at(0.06, 0.22, 0.219, mass)),
                                   world.add(thin_bat_at(0.94, 0.22, 0.219, mass))};
    for (int tries = 0; tries < 2000 && world.body_count() < 38; ++tries) {
      PuckSpec puck = light_puck_at(uniform(random, 0.15, 0.85), uniform(random, 0.04, 0.4),
                                    0.02 * std::pow(10.0, uniform(random, -1.5, 1.5)));
      puck.radius = 0.036;
      if (world.is_free(puck.position, puck.radius)) world.add(puck);
    }
    Watch watch(world, bats);
    watch.set_thrust(bats[0], {20, 0}), watch.set_thrust(bats[1], {-20, 0});
    watch.run(1.0);
    EXPECT_LT(world.counters().events(), 1000u * world.body_count());
  }
}

/// Nothing outside takes their momentum, slow as they may be: they come to rest against each other.
TEST_P(Squeeze, AsOneKeepsItsMomentum) {
  constexpr double drift = 4e-3;
  for (const std::uint32_t pucks : {30u, 80u}) {
    SCOPED_TRACE(testing::Message() << pucks << " pucks");
    Pile pile = pile_of(pucks, 1, GetParam(), 0.0, drift);
    pile.world.set_thrust(pile.left, {20, 0}), pile.world.set_thrust(pile.right, {-20, 0});
    const double momentum = pile.world.momentum().x();
    for (int stop = 1; stop <= 10; ++stop) {
      pile.world.advance(0.5 * stop);
      ASSERT_NEAR(pile.world.momentum().x(), momentum, 1e-3 * momentum) << pile.world.now();
    }
    for (std::uint32_t body = 0; body < pile.world.body_count(); ++body)
      EXPECT_NEAR(pile.world.velocity({body}).x(), drift, 1e-3 * drift) << body;
  }
}

/// A lattice between two bats, of which the left one is a millimetre from a wall and leaves it: a
/// wall pulls nobody back.
TEST(Pile, DriftsAwayFromAWall) {
  constexpr double drift = 4e-3, left = 0.051, first = left + 0.0501 + 0.0201;
  World world(rink_of(0.6, 0.4, 0.5));
  for (const double x : {left, first + 8 * 0.03466 + 0.0201 + 0.0501}) {
    BatSpec bat = thin_bat_at(x, 0.2, 0.199, 5.0);
    bat.velocity = {drift, 0.0};
    world.add(bat);
  }
  std::mt19937_64 random(3);
  for (int column = 0; column < 9; ++column)
    for (int row = 0; row < 9; ++row) {
      PuckSpec puck = light_puck_at(first + 0.03466 * column + uniform(random, 0.0, 1e-5),
                                    0.0201 + 0.0402 * row + 0.0201 * (column % 2), 0.02);
      puck.radius = 0.02, puck.velocity = {drift, 0.0};
      if (world.is_free(puck.position, puck.radius)) world.add(puck);
    }
  world.set_thrust({0}, {20, 0}), world.set_thrust({1}, {-20, 0});
  const double momentum = world.momentum().x();
  for (int stop = 1; stop <= 10; ++stop) {
    world.advance(0.05 * stop);
    ASSERT_NEAR(world.momentum().x(), momentum, 1e-3 * momentum) << world.now();
  }
  EXPECT_GT(world.counters().freezes, 0u);
}

/// Who may come into contact is looked for further away than a cell is wide.
TEST(Pile, IsTheSameWhateverTheCellsAndHoweverOftenItIsStopped) {
  std::vector<std::uint64_t> hashes;
  for (const double cell_size : {0.0, 0.2, 0.5}) {
    Pile pile = pile_of(150, 1, 0.5, cell_size);
    pile.world.set_thrust(pile.left, {20, 0}), pile.world.set_thrust(pile.right, {-20, 0});
    for (int stop = 1; stop <= 40; ++stop)
      if (cell_size > 0.0 || stop % 20 == 0) pile.world.advance(0.01 * stop);
    EXPECT_GT(pile.world.counters().hops, 0u);
    hashes.push_back(pile.world.hash());
  }
  EXPECT_EQ(hashes[1], hashes[0]);
  EXPECT_EQ(hashes[2], hashes[0]);
}

/// A lattice of pucks between a wall and a bat, behind which another bat comes to rest on a side
/// wall, so near that it belongs to the pile. What the two give back is lossless, so that the pile
/// may not flow.
TEST(Pile, ThatCannotFlowKeepsItsRestContacts) {
  WorldSpec spec = rink_of(0.6, 0.4, 0.5);
  spec.restitution = RestitutionTable(3, 0.5);
  spec.restitution.set(1, 2, 1.0);
  World world(spec);
  BatSpec pressing = thin_bat_at(0.17, 0.2, 0.199, 5.0), resting = thin_bat_at(0, 0, 0.02, 5.0);
  pressing.material = 1, resting.material = 2;
  const BodyId bat = world.add(pressing);
  const double left = pressing.position.x() + pressing.half_extent.x() + 0.0201;
  std::mt19937_64 random(3);
  for (int column = 0; column < 9; ++column)
    for (int row = 0; row < 9; ++row) {
      PuckSpec puck = light_puck_at(left + 0.03466 * column + uniform(random, 0.0, 1e-5),
                                    0.0201 + 0.0402 * row + 0.0201 * (column % 2), 0.02);
      puck.radius = 0.02;
      if (world.is_free(puck.position, puck.radius)) world.add(puck);
    }
  world.set_thrust(bat, {20, 0});
  world.advance(0.1);
  resting.half_extent.x() = 0.02;
  resting.position = {world.position(bat).x() - pressing.half_extent.x() - 0.024, 0.0200001};
  const BodyId other = world.add(resting);
  world.set_thrust(other, {0, -5});
  world.advance(0.11);
  ASSERT_EQ(world.velocity(other).norm(), 0.0);
  const std::uint64_t hops = world.counters().hops;
  world.record_events(true);
  world.advance(0.12);
  EXPECT_GT(world.counters().hops, hops);
  EXPECT_EQ(std::count_if(world.events().begin(), world.events().end(),
                          [&](const Event& event) { return event.body == other; }),
            0);
}

class SqueezeLong : public Squeeze {};

TEST_P(SqueezeLong, FourHundredPucksComeToRestBetweenTwoBats) {
  comes_to_rest(pile_of(400, 3, GetParam()), 10.0, 1000);
}

const auto name = [](const auto& restitution) {
  return "of_" + rink::test::words(restitution.param);
};
INSTANTIATE_TEST_SUITE_P(Restitution, Squeeze, testing::Values(0.0, 0.5, 0.9), name);
INSTANTIATE_TEST_SUITE_P(Restitution, SqueezeLong, testing::Values(0.0, 0.5, 0.9), name);

}  // namespace
}  // namespace rink::physics::test
