// What makes the window everybody's, against golden images: colours, hints, shapes of windows.
#include <gtest/gtest.h>

#include <algorithm>

#include "game/match/noises.h"
#include "tests/view/golden_images.h"

namespace rink::view {
namespace {

TEST_F(GoldenImages, OfOtherColoursWhoseNamesTheTeamsHave) {
  MatchSight sight = match_sight();
  sight.left_name = "left", sight.right_name = "right";
  Settings settings = shared_camera();
  settings.palette = PaletteKind::no_red_green;
  play(sight, settings);
  expect_golden("orange_blue");
  settings.palette = PaletteKind::no_blue_yellow;
  sight.phase = Phase::over;
  sight.winner = game::Team::right;
  play(sight, settings);
  expect_golden("red_green");
}

TEST_F(GoldenImages, OfTheFirstMinuteAllKeysAndABestOfThree) {
  MatchSight sight = match_sight();
  sight.phase = Phase::countdown;
  sight.remaining_s = 1.7;
  sight.own_team = game::Team::left;
  Settings settings;
  play(sight, settings);
  expect_golden("how_to_play");
  settings.hints_seen[0] = true;
  sight.phase = Phase::playing;
  play(sight, settings);
  expect_golden("hints");
  tap("f1");
  expect_golden("all_keys");
  tap("escape");
  EXPECT_EQ(application_->sight().phase, Phase::paused) << "as by Esc";
  tap("escape");
  expect_golden("hints_used");
  settings = shared_camera();
  settings.is_best_of_three = true;
  sight.phase = Phase::over;
  sight.own_team.reset();
  sight.winner = game::Team::left;
  play(sight, settings);
  expect_golden("best_of_three");
}

/// Music that goes on behind the menu hears of its volume there.
TEST_F(GoldenImages, AreBesideSoundsThatHearOfTheSettingsBehindTheMenuToo) {
  std::size_t heard = 0;
  application_ = std::make_unique<Application>(
      Surroundings{.make_match =
                       [](const MatchWish&) { return std::make_unique<StillMatch>(match_sight()); },
                   .sound = [&](const std::vector<Noise>& noises,
                                const Settings&) { heard += noises.empty() ? 1 : 100; }},
      known());
  ASSERT_TRUE(application_->is_in_menu());
  frame(false), frame(false);
  EXPECT_EQ(heard, 2u);
}

/// A window to watch in that is higher than wide shows the table from an end, along its length, and
/// more of it than of the floor.
TEST_F(GoldenImages, OfAnUprightWindow) {
  resize({300, 480, 1.0});
  MatchSight sight = match_sight();
  sight.score = {3, 1};
  play(sight);
  expect_golden("upright");
}

/// A puck comes from the wall, and a goal falls; the world goes on beside the goal that is shown
/// again. Without effects, or with less motion, the picture is that of a puck alone.
TEST_F(GoldenImages, OfAnImpactAndAGoalThatIsShownAgain) {
  struct Moving final : MatchSource {
    void advance(double now_s) override {
      seen.noises.clear();
      const double t = std::min(0.4, now_s - 10.0), turned_s = 0.25;
      Thing& puck = seen.things.back();
      puck.velocity = t < turned_s ? Vector2(1.6, 1.8) : Vector2(1.6, -1.8);
      puck.position = Vector2(1.3, 1.16) + (t - turned_s) * puck.velocity;
      ears.listen(seen);
    }
    const MatchSight& sight() const override { return seen; }
    std::uint32_t hand_count() const override { return 1; }
    void press(std::uint32_t, game::Key, bool) override {}
    void pause(bool) override {}
    void rematch() override {}
    MatchSight seen = match_sight();
    game::NoiseDetector ears;
  };
  Moving* moving = nullptr;
  Settings settings = shared_camera();
  const auto begin = [&](bool has_effects, bool has_less_motion) {
    settings.has_effects = has_effects, settings.has_less_motion = has_less_motion;
    const auto make = [&](const MatchWish&) {
      auto match = std::make_unique<Moving>();
      moving = match.get();
      return match;
    };
    application_ = std::make_unique<Application>(Surroundings{.make_match = make}, settings);
    now_ = 10.0;
    application_->play({.kind = MatchWish::Kind::bot, .address = {}});
    while (now_ < 10.37) frame();
  };
  const auto is_as = [&](const std::string& name) {
    still_ = true;
    expect_golden(name);
    still_ = false;
  };
  begin(true, false);
  is_as("impact");
  for (const bool has_effects : {true, false}) {
    begin(has_effects, has_effects);
    is_as("impact_plain");
  }
  begin(true, false);
  moving->seen.score.left = 1;
  while (now_ < 12.9) frame(now_ > 12.7);
  is_as("goal_again");
  tap("space");
  is_as("goal_skipped");
}

/// Two hosts of one name are told apart by their places.
TEST_F(GoldenImages, OfMatchesOnTheNetworkAndAddressesOfBefore) {
  resize({480, 360, 1.0});
  Settings settings = known();
  for (const char* place : {"10.0.0.7:4711", "192.168.1.5:4711"}) remember_address(settings, place);
  application_ = std::make_unique<Application>(
      Surroundings{.make_match =
                       [](const MatchWish&) { return std::make_unique<StillMatch>(match_sight()); },
                   .find_matches =
                       [] {
                         return std::vector<game::FoundMatch>{
                             {"Attic", "192.168.1.9:4711", 0.012, false},
                             {"Kitchen", "192.168.1.4:4711", 0.0031},
                             {"Kitchen", "192.168.1.5:4711", 0.0002}};
                       }},
      settings);
  for (int i = 0; i < 3; ++i) tap("down");
  tap("enter");
  expect_golden("found");
}

}  // namespace
}  // namespace rink::view
