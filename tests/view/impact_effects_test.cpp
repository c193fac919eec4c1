// What lets impacts be felt: trails along the ways themselves, sparks by speed, turning pucks, and
// the goal shown again, all from sights alone.
#include "game/view/feel/impact_effects.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "game/match/noises.h"
#include "game/view/feel/goal_replay.h"
#include "game/view/feel/less_motion.h"
#include "game/view/feel/music.h"
#include "game/view/picture_of.h"
#include "game/view/sounds.h"
#include "tests/temporary_folder.h"
#include "tests/view/sights.h"

namespace rink::view {
namespace {

constexpr double flown_frame_s = 1.0 / 120.0;

/// A puck on its way, seen flown_frame_s by flown_frame_s.
class FlownPuck {
 public:
  explicit FlownPuck(const Vector2& velocity = {2.0, 0.0}) {
    sight_.things.erase(sight_.things.begin(), sight_.things.end() - 1);
    puck().position = {0.6, 0.3};
    puck().velocity = velocity;
    look();
  }
  Thing& puck() { return sight_.things.front(); }
  MatchSight& sight() { return sight_; }
  double now_s() const { return now_s_; }
  void fly(double duration_s) {
    for (double end = now_s_ + duration_s - 1e-9; now_s_ < end;) {
      now_s_ += flown_frame_s;
      puck().position += flown_frame_s * puck().velocity;
      look();
    }
  }
  Picture picture() const {
    Picture picture = picture_of(sight_, {}, {}, 16.0 / 9.0);
    effects_.add_to(picture);
    return picture;
  }
  GoalReplay& replay() { return replay_; }
  void look() {
    ears_.listen(sight_);
    effects_.look(sight_, now_s_);
    replay_.look(sight_, now_s_);
  }

 private:
  MatchSight sight_ = match_sight();
  game::NoiseDetector ears_;
  ImpactEffects effects_;
  GoalReplay replay_;
  double now_s_ = 5.0;
};

double length_of(const Picture& picture) {
  double length = 0.0;
  for (const Streak& streak : picture.streaks)
    length += static_cast<double>(std::hypot(streak.end_x - streak.x, streak.end_y - streak.y));
  return length;
}

TEST(ATrail, IsTheWayOfTheLastThirdOfASecondAndOneLineWhereThePuckFliesStraight) {
  FlownPuck table;
  table.fly(0.5);
  const Picture picture = table.picture();
  EXPECT_NEAR(length_of(picture), 2.0 * ImpactEffects::trail_s, 2.0 * flown_frame_s);
  EXPECT_LE(picture.streaks.size(), 5u);
  for (const Streak& streak : picture.streaks) EXPECT_FLOAT_EQ(streak.y, 0.3f);
}

TEST(ATrail, TurnsWithThePuckIsNoneOfASlowOneAndEndsWhereThePuckWasPutElsewhere) {
  FlownPuck table;
  table.fly(0.3);
  table.puck().velocity = {0.0, 2.0};
  table.fly(0.1);
  const Picture turned = table.picture();
  ASSERT_GE(turned.streaks.size(), 2u);
  EXPECT_FLOAT_EQ(turned.streaks.front().y, 0.3f);
  EXPECT_TRUE(std::ranges::any_of(turned.streaks, [](const Streak& streak) {
    return streak.half_width > 0.01f && streak.x == streak.end_x && streak.y > 0.4f;
  }));
  table.puck().position = {2.0, 1.0};
  table.fly(0.02);
  for (const Streak& streak : table.picture().streaks)
    if (streak.half_width > 0.01f) {
      EXPECT_GT(streak.x, 1.9f);
    }
  FlownPuck slow({0.3, 0.0});
  slow.fly(0.4);
  EXPECT_TRUE(slow.picture().streaks.empty());
}

TEST(ATrail, ReachesTheWallFromWhichAPuckReturnsOnItsOwnWay) {
  FlownPuck table({0.0, -2.0});
  table.fly(0.1);
  const auto contact = static_cast<float>(table.puck().position.y());
  table.puck().velocity.y() = 2.0;
  table.fly(0.1);
  double length = 0.0;
  bool reaches_the_wall = false;
  for (const Streak& streak : table.picture().streaks) {
    if (streak.half_width < 0.01f) continue;  // a spark
    length += static_cast<double>(std::abs(streak.end_y - streak.y));
    reaches_the_wall |= std::abs(streak.y - contact) < 1e-4f;
  }
  EXPECT_NEAR(length, 0.4, 0.02) << "there and back";
  EXPECT_TRUE(reaches_the_wall);
}

std::size_t sparks_after(double change) {
  FlownPuck table({0.0, -0.5 * change});
  table.fly(0.05);
  table.puck().velocity.y() *= -1.0;
  table.fly(flown_frame_s);
  std::size_t count = 0;
  for (const Streak& streak : table.picture().streaks) count += streak.half_width == 0.006f;
  return count;
}

TEST(Sparks, FlyFromHardImpactsAloneMoreFromHarderOnesAndAreGoneSoon) {
  EXPECT_EQ(sparks_after(0.8), 0u);
  EXPECT_GT(sparks_after(1.5), 3u);
  EXPECT_GT(sparks_after(4.0), sparks_after(1.5));
  FlownPuck table({0.0, -2.0});
  table.puck().velocity.y() = 2.0;
  table.fly(flown_frame_s);
  EXPECT_FALSE(table.picture().streaks.empty());
  table.puck().velocity.setZero();
  table.fly(ImpactEffects::spark_s + ImpactEffects::trail_s);
  EXPECT_TRUE(table.picture().streaks.empty());
}

/// Momenta of a uniform disc whose contact stops sliding: m dv = J and m r^2/2 dw = J r, and after
/// it v - dv = w r. So w r is two thirds of v. To the right over something below: clockwise.
TEST(APuck, TurnsAsOneThatGripsWouldUntilItIsTheSimulationThatTurnsIt) {
  FlownPuck table({0.6, -1.0});
  table.fly(0.02);
  table.puck().velocity.y() = 1.0;
  table.fly(flown_frame_s);
  const auto angle = [&] { return static_cast<double>(table.picture().pieces.front().angle); };
  const double before = angle();
  table.fly(flown_frame_s);
  EXPECT_NEAR(std::remainder(angle() - before, 6.283185307179586),
              -2.0 / 3.0 * 0.6 / 0.04 * flown_frame_s, 0.02 * 10.0 * flown_frame_s);
  table.puck().spin = 5.0;
  table.fly(flown_frame_s);
  const double then = angle();
  table.fly(flown_frame_s);
  EXPECT_NEAR(std::remainder(angle() - then, 6.283185307179586), 5.0 * flown_frame_s, 1e-5);
}

TEST(ANudge, FollowsAGoalIsSmallAndShort) {
  FlownPuck table;
  table.fly(0.1);
  EXPECT_EQ(table.picture().nudge_x, 0.0f);
  table.sight().score.left = 1;
  float most = 0.0f;
  for (double end = table.now_s() + 0.3; table.now_s() < end;) {
    table.fly(flown_frame_s);
    const Picture picture = table.picture();
    most = std::max(most, std::hypot(picture.nudge_x, picture.nudge_y));
  }
  EXPECT_GT(most, 0.003f);
  EXPECT_LT(most, 0.015f) << "11 pixels of 720";
  table.fly(0.1);
  EXPECT_EQ(table.picture().nudge_x, 0.0f);
}

/// 1.1 s at 2.5 times its length, from 0.3 s after the goal on.
TEST(AGoal, IsShownAgainSlowlyWhereverThePuckWasUntilItIsSkipped) {
  FlownPuck table({1.0, 0.0});
  table.fly(1.3);
  const double goal_s = table.now_s() + flown_frame_s, goal_x = table.puck().position.x();
  table.sight().score.left = 1;
  table.fly(flown_frame_s);
  EXPECT_EQ(table.replay().shown(), nullptr);
  table.puck().position = {1.2, 0.6}, table.puck().velocity.setZero();
  while (table.replay().shown() == nullptr && table.now_s() < goal_s + 1.0)
    table.fly(flown_frame_s);
  EXPECT_NEAR(table.now_s() - goal_s, GoalReplay::begins_after_s, 0.05);
  double last_x = 0.0, last_s = 0.0;
  while (table.replay().shown() != nullptr) {
    const double x = table.replay().shown()->things.front().position.x();
    if (last_s > 0.0) {
      EXPECT_NEAR((x - last_x) / (table.now_s() - last_s), 1.0 / GoalReplay::slowness, 1e-3);
    }
    last_x = x, last_s = table.now_s();
    table.fly(flown_frame_s);
  }
  EXPECT_NEAR(last_s - goal_s, GoalReplay::begins_after_s + GoalReplay::shown_s, 0.05);
  EXPECT_NEAR(last_x, goal_x, 0.02);
  table.fly(1.2);
  table.sight().score.left = 2;
  table.fly(1.0);
  ASSERT_NE(table.replay().shown(), nullptr);
  table.replay().skip();
  table.fly(flown_frame_s);
  EXPECT_EQ(table.replay().shown(), nullptr);
}

TEST(Effects, AreNoneInACrowd) {
  ImpactEffects effects;
  MatchSight crowd = crowd_sight();
  for (Thing& thing : crowd.things) thing.velocity = {2.0, 0.0};
  crowd.noises = {
      {.kind = Noise::Kind::puck_on_wall, .at = crowd.things[0].position, .change = {3.0, 0.0}}};
  for (int k = 0; k < 9; ++k) effects.look(crowd, flown_frame_s * k);
  Picture picture = picture_of(crowd, {}, {}, 2.0);
  effects.add_to(picture);
  EXPECT_TRUE(picture.streaks.empty());
  EXPECT_EQ(picture.pieces.front().angle, Piece::even);
}

TEST(Impacts, SoundHigherWhereTheyAreHarder) {
  const auto pitch = [](Noise::Kind kind, double strength) {
    return pitch_of({.kind = kind, .strength = strength});
  };
  EXPECT_LT(pitch(Noise::Kind::puck_on_bat, 0.1), pitch(Noise::Kind::puck_on_bat, 0.9));
  EXPECT_EQ(pitch(Noise::Kind::win, 0.1), 1.0);
}

TEST(Sounds, OfHornAndMusicAreLoudEnoughUnclippedAndMusicGoesRoundWithoutAClick) {
  const std::vector<std::int16_t> horn = horn_sound(), music = music_loop(sound_rate);
  for (const auto* samples : {&horn, &music}) {
    const auto [low, high] = std::ranges::minmax(*samples);
    EXPECT_GT(high, 3'000);
    EXPECT_LT(std::max<int>(high, -low), 32'001);
  }
  int most = 0;  // from one sample to the next
  for (std::size_t k = 1; k < music.size(); ++k)
    most = std::max(most, std::abs(music[k] - music[k - 1]));
  EXPECT_LE(std::abs(music.front() - music.back()), most);
  EXPECT_GT(music.size(), 10u * static_cast<std::size_t>(sound_rate));
}

TEST(LessMotion, IsWantedWhereTheDesktopSaysSo) {
  const test::TemporaryFolder folder("desktop");
  EXPECT_FALSE(wants_less_motion(folder.path().string()));
  EXPECT_FALSE(wants_less_motion(""));
  std::filesystem::create_directories(folder / "gtk-3.0");
  std::ofstream(folder / "gtk-3.0/settings.ini") << "[Settings]\ngtk-enable-animations=true\n";
  EXPECT_FALSE(wants_less_motion(folder.path().string()));
  std::ofstream(folder / "gtk-3.0/settings.ini") << "[Settings]\ngtk-enable-animations = FALSE\n";
  EXPECT_TRUE(wants_less_motion(folder.path().string()));
  std::filesystem::remove_all(folder / "gtk-3.0");
  std::ofstream(folder / "kdeglobals") << "[KDE]\nAnimationDurationFactor=0\n";
  EXPECT_TRUE(wants_less_motion(folder.path().string()));
}

}  // namespace
}  // namespace rink::view
