// Bats that press pucks into walls, corners and posts for ten seconds: everything settles, nothing
// overlaps, and all is free again when the key is released.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/physics/contact/contact_bounds.h"
#include "tests/physics/contact/pressed_bodies.h"
#include "tests/physics/scenes.h"
#include "tests/words.h"

namespace rink::physics::test {
namespace {

BatSpec wide_bat_at(double x, double y, double mass = 3.0) { return thin_bat_at(x, y, 0.3, mass); }

PostSpec post_at(double x, double y, double radius = 0.1) {
  PostSpec post;
  post.position = {x, y};
  post.radius = radius;
  return post;
}

class Pressed : public testing::TestWithParam<double> {
 protected:
  World world_{rink_of(4, 2, GetParam(), 0.2, 1.0)};
};

/// An impact leaves those that nothing holds a separation of 1e-14 of the speeds, which drag then
/// wears off.
bool are_all_at_rest(const World& world) {
  for (std::uint32_t body = 0; body < world.body_count(); ++body)
    if (!world.is_resting({body}) && world.velocity({body}).norm() > 1e-12) return false;
  return true;
}

/// Presses for ten seconds. Answers whether everybody came to rest; if so, nothing happens any
/// more.
bool comes_to_rest(const World& world, Watch& watch, BodyId bat, const Vector2& thrust) {
  watch.set_thrust(bat, thrust);
  watch.run(8.0);
  const bool is_at_rest = are_all_at_rest(world);
  const std::uint64_t events = watch.events_in(2.0);
  if (is_at_rest) {
    EXPECT_EQ(events, 0u);
  }
  return is_at_rest;
}

TEST_P(Pressed, PuckIntoAWall) {
  for (const double y : {0.8, 1.0, 1.25}) {
    World world(rink_of(4, 2, GetParam(), 0.2, 1.0));
    const BodyId puck = world.add(light_puck_at(0.5, y)), bat = world.add(wide_bat_at(1, 1));
    Watch watch(world, {bat});
    EXPECT_TRUE(comes_to_rest(world, watch, bat, {-6, 0}) || GetParam() == 1.0);
    if (GetParam() < 1.0) {
      EXPECT_NEAR(world.position(puck).x(), 0.04, 1e-5);
    }
    watch.set_thrust(bat, {6, 0});
    watch.run(0.5);
    EXPECT_GT(world.position(bat).x(), 0.5);
  }
}

TEST_P(Pressed, RowOfPucksIntoAWall) {
  const BodyId bat = world_.add(wide_bat_at(1, 1));
  std::vector<BodyId> row;
  for (int i = 0; i < 5; ++i) row.push_back(world_.add(light_puck_at(0.1 + 0.1 * i, 1)));
  Watch watch(world_, {bat});
  EXPECT_TRUE(comes_to_rest(world_, watch, bat, {-6, 0}) || GetParam() == 1.0);
  for (std::size_t i = 0; i < 5 && GetParam() < 1.0; ++i)
    EXPECT_NEAR(world_.position(row[i]).x(), 0.04 + 0.08 * static_cast<double>(i), 1e-5);
}

TEST_P(Pressed, RowOfPucksBeforeABatMovesAsOneToTheLastBit) {
  World world(rink_of(40, 2, GetParam(), 0.2, 1.0));
  const BodyId bat = world.add(wide_bat_at(1, 1));
  std::vector<BodyId> row;
  for (int i = 0; i < 4; ++i)
    row.push_back(world.add(light_puck_at(1.1 + 0.1 * i, 1, i % 2 == 0 ? 0.5 : 0.02)));
  Watch watch(world, {bat});
  watch.set_thrust(bat, {6, 0});
  watch.run(4.0);
  if (GetParam() > 0.5) return;  // bounces on
  for (const BodyId puck : row) {
    EXPECT_TRUE(world.is_held(puck));
    EXPECT_EQ(world.velocity(puck).x(), world.velocity(bat).x());
    EXPECT_EQ(world.motion(puck).acceleration.x(), world.motion(bat).acceleration.x());
    EXPECT_EQ(world.motion(puck).drag.x(), world.motion(bat).drag.x());
  }
  EXPECT_EQ(watch.events_in(0.5), 0u);
}

TEST_P(Pressed, PucksSideBySideIntoAWall) {
  const BodyId bat = world_.add(wide_bat_at(1, 1));
  for (int i = 0; i < 5; ++i)
    world_.add(light_puck_at(0.2 + 0.05 * i, 0.8 + 0.1 * i, 0.1 * (i + 1)));
  Watch watch(world_, {bat});
  EXPECT_TRUE(comes_to_rest(world_, watch, bat, {-6, 0}) || GetParam() == 1.0);
}

class PressedDiagonally : public testing::TestWithParam<double> {};

TEST_P(PressedDiagonally, PuckInACornerHasFewEvents) {
  for (const double drag : {0.0, 1.0})
    for (const double half : {0.05, 0.2, 0.3})
      for (const double start : {0.04, 0.1, 0.3}) {
        SCOPED_TRACE(testing::Message() << drag << ' ' << half << ' ' << start);
        World world(rink_of(2, 1, GetParam(), 0.2 * drag, drag));
        const double across = std::min(0.95 - half, std::max(half + 0.1, 0.4));
        const BodyId bat = world.add(thin_bat_at(0.4, across, half, 3.0));
        if (!world.is_free({start, start}, 0.04)) continue;
        world.add(light_puck_at(start, start));
        world.set_thrust(bat, {-6, -6});
        world.advance(20.0);
        EXPECT_LT(world.counters().events(), 2000u);
        EXPECT_LT(world.max_overlap(), 1e-9);
      }
}

/// In equilibrium on the diagonal: a glide that opened contacts wider than a cluster's gaps would
/// end in flight, and the bat come back too fast to stop, for ever.
TEST_P(PressedDiagonally, SquareBatOnTheDiagonalComesToRestOnAPuck) {
  for (const double half : {0.05, 0.1, 0.2})
    for (const double start : {0.04, 0.06, 0.1})
      for (const double mass : {1.0, 3.0, 5.0})
        for (const double thrust : {6.0, 20.0}) {
          SCOPED_TRACE(testing::Message() << half << ' ' << start << ' ' << mass << ' ' << thrust);
          World world(rink_of(2, 1, GetParam()));
          const BodyId bat =
              world.add(BatSpec{.position = {0.4, 0.4}, .half_extent = {half, half}, .mass = mass});
          world.add(light_puck_at(start, start, 0.5));
          world.set_thrust(bat, {-thrust, -thrust});
          world.advance(20.0);
          EXPECT_LT(world.counters().events(), 1000u);
          EXPECT_LT(world.max_overlap(), 1e-9);
        }
}

TEST_P(Pressed, PuckIntoACorner) {
  for (const double start : {0.1, 0.15, 0.2}) {
    World world(rink_of(4, 2, GetParam(), 0.2, 1.0));
    const BodyId bat = world.add(wide_bat_at(1, 0.5));
    world.add(light_puck_at(0.5, start));
    Watch watch(world, {bat});
    comes_to_rest(world, watch, bat, {-6, -6});
    watch.set_thrust(bat, {6, 6});
    watch.run(0.5);
    EXPECT_GT(world.position(bat).x(), 0.5);
  }
}

TEST_P(Pressed, ThreePucksIntoACorner) {
  const BodyId bat = world_.add(wide_bat_at(1, 0.5));
  for (int i = 0; i < 3; ++i)
    world_.add(light_puck_at(0.1 + 0.15 * i, 0.1 + 0.05 * i, i == 1 ? 3.0 : 0.1));
  Watch watch(world_, {bat});
  comes_to_rest(world_, watch, bat, {-6, -6});
}

TEST_P(Pressed, PuckIntoAPost) {
  for (const double offset : {0.0, 1e-12, 1e-6, 1e-3, 0.02, 0.1}) {
    SCOPED_TRACE(offset);
    World world(rink_of(4, 2, GetParam(), 0.2, 1.0));
    world.add(post_at(0.5, 1));
    const BodyId bat = world.add(wide_bat_at(1, 1));
    world.add(light_puck_at(0.8, 1 + offset));
    Watch watch(world, {bat});
    comes_to_rest(world, watch, bat, {-6, 0});
  }
}

TEST_P(Pressed, RowOfPucksIntoAPost) {
  for (const double offset : {0.0, 1e-9, 0.01}) {
    SCOPED_TRACE(offset);
    World world(rink_of(4, 2, GetParam(), 0.2, 1.0));
    world.add(post_at(0.3, 1));
    const BodyId bat = world.add(wide_bat_at(1.5, 1));
    for (int i = 0; i < 4; ++i) world.add(light_puck_at(0.5 + 0.15 * i, 1 + offset * (i % 2)));
    Watch watch(world, {bat});
    comes_to_rest(world, watch, bat, {-6, 0});
  }
}

/// The bat squeezes two pucks against a post, symmetrically or not.
TEST_P(Pressed, TwoPucksIntoAPost) {
  for (const double shift : {0.0, 1e-9, 1e-4, 0.01, 0.03})
    for (const double mass : {0.05, 0.5, 20.0}) {
      SCOPED_TRACE(testing::Message() << "shift " << shift << ", mass " << mass);
      World world(rink_of(4, 2, GetParam(), 0.2, 1.0));
      world.add(post_at(0.5, 1, 0.15));
      const BodyId bat = world.add(wide_bat_at(1.2, 1));
      world.add(light_puck_at(0.8, 1.045 + shift, mass)),
          world.add(light_puck_at(0.8, 0.955 + shift));
      Watch watch(world, {bat});
      comes_to_rest(world, watch, bat, {-6, 0});
    }
}

/// Between two posts, a wall and the bat there is no way out.
TEST_P(Pressed, TrappedPuckStaysAndIsReleasedWhenTheBatWithdraws) {
  world_.add(post_at(0.1, 0.9)), world_.add(post_at(0.1, 1.1));
  const BodyId bat = world_.add(wide_bat_at(1, 1)), puck = world_.add(light_puck_at(0.5, 1.0));
  Watch watch(world_, {bat});
  EXPECT_TRUE(comes_to_rest(world_, watch, bat, {-6, 0}) || GetParam() == 1.0);
  if (GetParam() == 1.0) return;
  EXPECT_TRUE(world_.is_held(puck));
  const Vector2 place = world_.position(puck);
  watch.set_thrust(bat, {6, 0});
  watch.run(0.3);
  EXPECT_FALSE(world_.is_held(puck));
  EXPECT_NEAR((world_.position(puck) - place).norm(), 0.0,
              1e-3);  // free, but nothing drives it away
  PuckSpec striker = light_puck_at(
      place.x() + 0.045, place.y() + 0.25);  // past the upper post, to drive it round the lower one
  striker.velocity = {0, -2};
  world_.add(striker);
  watch.run(1.0);
  EXPECT_GT((world_.position(puck) - place).norm(), 1e-2);
}

TEST_P(Pressed, WholeRackIntoACorner) {
  const BodyId bat = world_.add(wide_bat_at(1.5, 0.4)), other = world_.add(wide_bat_at(1.5, 1.4));
  std::mt19937_64 random(9);
  for (int i = 0; i < 20; ++i)
    world_.add(light_puck_at(0.1 + 0.1 * (i % 5), 0.1 + 0.1 * (i / 5),
                             std::pow(10.0, uniform(random, -2.0, 1.0))));
  Watch watch(world_, {bat, other});
  watch.set_thrust(bat, {-6, -6});
  watch.set_thrust(other, {-6, -6});
  watch.run(10.0);
}

const auto of_restitution = [](const auto& restitution) {
  return "of_" + rink::test::words(restitution.param);
};
INSTANTIATE_TEST_SUITE_P(Restitution, Pressed, testing::Values(0.0, 0.1, 0.5, 0.9, 1.0),
                         of_restitution);
INSTANTIATE_TEST_SUITE_P(Restitution, PressedDiagonally, testing::Values(0.0, 0.5, 0.9),
                         of_restitution);

}  // namespace
}  // namespace rink::physics::test
