// Bats as wide as the field squeeze pucks from both ends: the pile comes to rest and costs nothing
// more, at any restitution below 1.
#include <gtest/gtest.h>

#include <cmath>

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

/// Pucks at random between two bats, each 5 kg, a metre wide, that drive at each other.
Pile pile_of(std::uint32_t pucks, double length, double restitution, double cell_size = 0.0) {
  WorldSpec spec = rink_of(length, 1, restitution);
  spec.cell_size = cell_size;
  Pile pile{World(spec), {}, {}};
  pile.left = pile.world.add(thin_bat_at(0.06, 0.5, 0.499, 5.0));
  pile.right = pile.world.add(thin_bat_at(length - 0.06, 0.5, 0.499, 5.0));
  std::mt19937_64 random(1);
  for (std::uint32_t count = 0; count < pucks;) {
    PuckSpec puck =
        light_puck_at(uniform(random, 0.02, length - 0.02), uniform(random, 0.02, 0.98), 0.02);
    puck.radius = 0.02;
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
