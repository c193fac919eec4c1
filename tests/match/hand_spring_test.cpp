// The spring between hand and bat: it brings the bat there, soon, without shooting past, and within
// the thrust; and it says nothing that is not new.
#include "game/match/hand_spring.h"

#include <gtest/gtest.h>

#include <cmath>

#include "game/control/game.h"
#include "tests/match/match_scene.h"

namespace rink::game {
namespace {

/// The left bat of the match alone, pulled at 60 Hz.
struct APulledBat {
  explicit APulledBat(double frames_per_s = 60.0) : period_s(1.0 / frames_per_s) {
    scene.bodies.pucks.clear();
    game.emplace(scene);
    player = scene.bodies.bats[0];
  }
  Vector2 at() const { return game->position(*game->bat(0)); }
  Vector2 speed() const { return game->velocity(*game->bat(0)); }
  void frame(const Vector2& hand) {
    spring.reach(hand);
    const double now = game->now();
    if (const auto push = spring.next({at(), speed(), player.thrust, scene.world.bat_drag}, now)) {
      game->submit({.time = now, .player = 0, .kind = InputKind::push, .push = *push});
      ++told;
    }
    game->advance(now + period_s);
  }
  void pull(const Vector2& hand, double seconds) {
    for (const double until = game->now() + seconds; game->now() < until;) frame(hand);
  }

  Scene scene = match_scene();
  double period_s;
  std::optional<Game> game;
  Bat player;
  HandSpring spring;
  int told = 0;
};

TEST(HandSpring, BringsTheBatToTheHandWithoutShootingPast) {
  for (const double frames_per_s : {30.0, 60.0, 144.0})
    for (const Vector2& way : {Vector2(0.3, 0.0), Vector2(-0.1, 0.25), Vector2(0.01, -0.02)}) {
      APulledBat bat(frames_per_s);
      const Vector2 from(0.5, 0.6), hand = from + way;
      bat.pull(from, 2.0);
      Vector2 past(0.0, 0.0);
      for (double s = 0.0; s < 2.0; s += bat.period_s) {
        bat.frame(hand);
        for (int axis = 0; axis < 2; ++axis)
          past[axis] =
              std::max(past[axis], std::copysign(1.0, way[axis]) * (bat.at() - hand)[axis]);
      }
      EXPECT_LT((bat.at() - hand).norm(), 3e-3) << frames_per_s << " Hz, " << way.transpose();
      EXPECT_LT(past.maxCoeff(), 3e-3) << frames_per_s << " Hz, " << way.transpose();
    }
}

/// From rest the fastest way under thrust A, without drag, takes 2 sqrt(x/A).
TEST(HandSpring, IsThereInLittleMoreThanTheLeastTimeThatTheThrustAllows) {
  APulledBat bat;
  bat.pull({0.4, 0.6}, 2.0);
  const double begin = bat.game->now();
  while ((bat.at() - Vector2(0.8, 0.6)).norm() > 0.01 && bat.game->now() < begin + 5.0)
    bat.frame({0.8, 0.6});
  const double least = 2.0 * std::sqrt(0.4 / bat.player.thrust);
  EXPECT_LT(bat.game->now() - begin, 1.6 * least);
}

/// The critically damped spring within the thrust: w^2 x - 2 w v + g v.
TEST(HandSpring, IsTheDampedSpringNearTheHand) {
  const PulledBat bat{{1.0, 1.0}, {0.05, -0.02}, 8.0, 3.0};
  const Push push = spring_push(bat, {1.006, 0.999});
  const auto expected = [](double x, double v) {
    return std::lround((25.0 * 25.0 * x - 50.0 * v + 3.0 * v) / 8.0 * 127.0);
  };
  EXPECT_EQ(push.x, expected(0.006, 0.05));
  EXPECT_EQ(push.y, expected(-0.001, -0.02));
}

TEST(HandSpring, NeverAsksForMoreThanTheThrust) {
  for (const double far : {0.1, 10.0, 1e6, 1e300})
    for (const double speed : {-100.0, 0.0, 100.0}) {
      const Push push = spring_push({{0.0, 0.0}, {speed, -speed}, 8.0, 3.0}, {far, -far});
      EXPECT_TRUE(is_sound(push));
      if (speed == 0.0) {
        EXPECT_EQ(push, (Push{127, -127}));
      }
    }
  EXPECT_EQ(spring_push({{0.0, 0.0}, {1.0, 1.0}, 0.0, 0.0}, {1.0, 1.0}), Push{})
      << "a bat without thrust";
}

TEST(HandSpring, SaysNothingOfAHandThatRestsAtItsBatOrWhereItCannotGo) {
  APulledBat bat;
  bat.pull({0.5, 0.6}, 2.0);
  bat.told = 0;
  bat.pull(bat.at() + Vector2(0.0005, -0.0005), 2.0);
  EXPECT_EQ(bat.told, 0) << "within the dead zone";
  bat.pull({2.0, 0.6}, 2.0);
  EXPECT_NEAR(bat.at().x(), 1.2 - bat.player.body.half_extent.x(), 1e-9) << "at the halfway line";
  bat.told = 0;
  bat.pull({2.0, 0.6}, 2.0);
  EXPECT_EQ(bat.told, 0);
  EXPECT_EQ(bat.spring.told().x, 127);
}

TEST(HandSpring, LetsGoAtOnceAndSaysNoMoreThanTwoHundredPushesASecond) {
  HandSpring spring;
  int told = 0;
  for (int frame = 0; frame < 1000; ++frame) {
    spring.reach(Vector2(0.001 * frame, 0.3));
    told += spring.next({{0.0, 0.0}, {0.0, 0.002 * frame}, 8.0, 3.0}, 1e-3 * frame) ? 1 : 0;
  }
  EXPECT_LE(told, 201);
  spring.reach(std::nullopt);
  EXPECT_EQ(spring.next({{0.0, 0.0}, {1.0, 1.0}, 8.0, 3.0}, 1.0), Push{});
  EXPECT_EQ(spring.next({{0.0, 0.0}, {1.0, 1.0}, 8.0, 3.0}, 2.0), std::nullopt);
}

}  // namespace
}  // namespace rink::game
