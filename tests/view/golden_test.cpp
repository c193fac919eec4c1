// Every screen against its golden image: a match that stands still, so that no image depends on how
// bodies move.
#include <gmock/gmock.h>

#include <cmath>

#include "game/control/key_log_file.h"
#include "game/control/playing.h"
#include "game/match/local_match.h"
#include "game/match/replay_match.h"
#include "game/model/scene_file.h"
#include "tests/temporary_folder.h"
#include "tests/view/golden_images.h"

namespace rink::view {
namespace {

constexpr WindowSize old_shape{400, 300, 1.0};

/// Decisions that a filter could have made of the crowd: bat 1012 and its like hear of what is
/// within 2.5 m of their middle.
game::InterestSeen decided(const MatchSight& sight, std::uint32_t asked) {
  game::InterestSeen seen{.asked = asked, .cell_size = 1.25f, .views = {}, .heard = {}};
  const auto gap = [](const Thing& a, const Thing& b) {
    return (a.position - b.position).cwiseAbs().maxCoeff();
  };
  const Thing& there = sight.things[asked];
  for (const Thing& thing : sight.things) {
    if (thing.id != asked && gap(thing, there) < 2.5) seen.heard.push_back(thing.id);
    if (thing.kind != physics::BodyKind::bat) continue;
    const auto x = static_cast<float>(thing.position.x()),
               y = static_cast<float>(thing.position.y());
    seen.views.push_back(
        {thing.id, gap(thing, there) < 2.5, x - 2.5f, y - 2.5f, x + 2.5f, y + 2.5f});
    if (seen.views.back().hears && thing.id != asked) ++seen.hearer_count;
  }
  seen.view_count = static_cast<std::uint32_t>(seen.views.size());
  seen.heard_count = static_cast<std::uint32_t>(seen.heard.size());
  return seen;
}

TEST_F(GoldenImages, OfTheMenu) {
  expect_golden("menu");
  tap("down");
  tap("enter");
  expect_golden("strength");
  tap("escape");
  for (int i = 0; i < 3; ++i) tap("down");
  tap("enter");
  expect_golden("join");
  tap("escape");
  for (int i = 0; i < 5; ++i) tap("down");
  tap("enter");
  expect_golden("settings");
  application_->explain("play.toml:3: there is no key 'hyper' for up; it stays 'w'");
  expect_golden("trouble");
}

/// All is done between two frames; the frames after it see one thing after the other.
TEST_F(GoldenImages, OfScreensThatAreReachedByTapsWithinOneFrame) {
  const auto tap_all = [this](std::initializer_list<const char*> keys) {
    for (const char* key : keys) tap_within_a_frame(key);
    for (int i = 0; i < 30; ++i) frame(false);
  };
  for (int i = 0; i < 3; ++i) frame(false);
  tap_all({"down", "enter"});
  expect_golden("strength");
  tap_all({"escape", "down", "down", "down", "enter"});
  expect_golden("join");
  tap_all({"escape", "down", "down", "down", "down", "down", "enter"});
  expect_golden("settings");
}

TEST_F(GoldenImages, AreLeftForAMatchByAClickWithinOneFrame) {
  for (int i = 0; i < 3; ++i) frame(false);
  receive({.kind = WindowEvent::Kind::mouse_move, .x = 240.0, .y = 96.0});  // "Two players"
  receive({.kind = WindowEvent::Kind::mouse_button, .is_down = true});
  receive({.kind = WindowEvent::Kind::mouse_button, .is_down = false});
  receive({.kind = WindowEvent::Kind::mouse_move, .x = 5.0, .y = 5.0});
  for (int i = 0; i < 3; ++i) frame(false);
  EXPECT_FALSE(application_->is_in_menu());
}

/// A frame's time of thrust a from rest makes at least half of a dt of velocity, whatever the drag.
TEST_F(GoldenImages, MoveTheBatOfAKeyThatIsTappedWithinOneFrame) {
  const game::Scene scene = game::load_scene("match");
  const game::LocalMatchSettings settings{.times = {.countdown_s = 0.0}};
  const auto make_match = [&](const MatchWish&) {
    return std::make_unique<game::LocalMatch>(scene, settings);
  };
  application_ =
      std::make_unique<Application>(Surroundings{.make_match = make_match}, shared_camera());
  application_->play({.kind = MatchWish::Kind::two, .address = {}});
  application_->set_viewpoint(Viewpoint::side);
  for (int i = 0; i < 3; ++i) frame(false);
  tap_within_a_frame("d");
  for (int i = 0; i < 2; ++i) frame(false);
  const auto bat = std::ranges::find(application_->sight().things, game::Team::left, &Thing::team);
  ASSERT_NE(bat, application_->sight().things.end());
  EXPECT_GT(bat->velocity.x(), 0.5 * scene.bodies.bats[0].thrust / 60.0);
}

TEST_F(GoldenImages, OfAMatchFromEveryViewpoint) {
  MatchSight sight = match_sight();
  sight.score = {3, 1};
  for (const auto& [viewpoint, name] : {std::pair{Viewpoint::side, "side"},
                                        {Viewpoint::left_end, "left_end"},
                                        {Viewpoint::right_end, "right_end"},
                                        {Viewpoint::above, "above"}}) {
    play(sight);
    application_->set_viewpoint(viewpoint);
    expect_golden(name);
  }
}

TEST_F(GoldenImages, OfTheCountdown) {
  MatchSight sight = match_sight();
  sight.phase = Phase::countdown;
  sight.remaining_s = 1.7;
  play(sight);
  expect_golden("countdown");
}

TEST_F(GoldenImages, OfAGoal) {
  MatchSight sight = match_sight();
  sight.score = {4, 2};
  sight.scorer = game::Team::left;
  sight.since_goal_s = 0.15;
  sight.things.pop_back();
  play(sight);
  expect_golden("goal");
}

TEST_F(GoldenImages, OfTheLastSecondsOfAPossession) {
  MatchSight sight = match_sight();
  sight.own_team = game::Team::left;
  sight.left_name = "You", sight.right_name = "Bot";
  sight.holder = game::Team::left;
  sight.possession_s = 2.4;
  play(sight);
  expect_golden("shoot");
  sight.own_team.reset();
  sight.left_name = "left", sight.right_name = "right";
  play(sight, known());
  expect_golden("shoot_split");
  sight.holder.reset();
  sight.served = game::Team::right;
  play(sight);
  application_->set_viewpoint(Viewpoint::above);
  expect_golden("served");
}

TEST_F(GoldenImages, OfAPause) {
  play(match_sight());
  frame();
  tap("escape");
  expect_golden("paused");
}

TEST_F(GoldenImages, OfTheEnd) {
  MatchSight sight = match_sight();
  sight.score = {5, 3};
  sight.phase = Phase::over;
  sight.winner = game::Team::left;
  play(sight);
  expect_golden("won");
  tap("enter");
  expect_golden("rematch");
}

TEST_F(GoldenImages, OfANetworkMatch) {
  MatchSight sight = match_sight();
  sight.own_team = game::Team::right;
  sight.link = LinkFigures{
      .ping_ms = 42.0, .jitter_ms = 1.7, .loss = 0.01, .tick = 12345, .payload_bytes_per_s = 412.0};
  sight.phase = Phase::away;
  sight.remaining_s = 17.3;
  play(sight);
  expect_golden("away");
  sight.phase = Phase::waiting;
  play(sight);
  expect_golden("waiting");
  sight.phase = Phase::playing;
  sight.interrupted_s = 7.9;
  play(sight);
  expect_golden("interrupted");
}

TEST_F(GoldenImages, OfACrowdWithItsOverlay) {
  MatchSight sight = crowd_sight();
  sight.interest = decided(sight, 1012);
  play(sight);
  expect_golden("crowd");
  for (int i = 0; i < 6; ++i) tap("equal");
  expect_golden("crowd_zoomed");
  tap("i");
  expect_golden("crowd_plain");
}

TEST_F(GoldenImages, OfTwoWhoShareAKeyboardEachFromTheOwnEnd) {
  MatchSight sight = match_sight();
  sight.score = {3, 1};
  play(sight, known());
  expect_golden("split");
  tap("v");
  expect_golden("side");
  tap("v");
  tap("c");
  expect_golden("side");
  application_->set_viewpoint(Viewpoint::above);  // as --camera does
  tap("v");
  expect_golden("split");
  tap("v");
  expect_golden("above");
}

TEST_F(GoldenImages, OfOtherWindowsAndScales) {
  resize(old_shape);
  open(match_sight());
  expect_golden("menu_old_shape");
  for (int i = 0; i < 5; ++i) tap("down");
  tap("enter");
  expect_golden("settings_old_shape");
  play(match_sight(), known());
  expect_golden("split_old_shape");
  resize({640, 360, 2.0});
  MatchSight sight = match_sight();
  sight.phase = Phase::countdown;
  sight.remaining_s = 1.7;
  play(sight);
  expect_golden("countdown_double");
}

/// Nobody pressed a key, so the puck lies where it lay.
TEST_F(GoldenImages, OfAReplay) {
  const game::Scene scene = game::load_scene("paper");
  game::Playing playing(scene, {game::Playing::hand, game::Playing::hand}, 1, 0.0);
  playing.advance(8.0);
  const test::TemporaryFolder folder("replay");
  const std::string file = (folder / "still.keys").string();
  game::write_key_log(
      file, game::log_of(playing.game(), scene, game::scene_text("paper"), playing.keys()));
  application_ = std::make_unique<Application>(
      Surroundings{.make_match =
                       [&](const MatchWish&) { return std::make_unique<game::ReplayMatch>(file); }},
      known());
  application_->play({.kind = MatchWish::Kind::replay, .address = file});
  frame(false);
  tap("right");
  tap("space");
  tap("up");
  expect_golden("replay");
}

TEST_F(GoldenImages, GoBackToTheMenuWhenTheConnectionIsLost) {
  MatchSight sight = match_sight();
  sight.phase = Phase::lost;
  sight.notice = "the host is gone";
  std::string told;
  int made = 0, joins = 0;
  application_ = std::make_unique<Application>(
      Surroundings{.make_match =
                       [&](const MatchWish& wish) {
                         joins += wish.kind == MatchWish::Kind::join;
                         return std::make_unique<StillMatch>(made++ == 0 ? match_sight() : sight);
                       },
                   .notify = [&](const std::string& words) { told = words; }},
      known());
  application_->play({.kind = MatchWish::Kind::join, .address = "localhost:1"});
  frame();
  EXPECT_TRUE(application_->is_in_menu());
  EXPECT_EQ(told, "The match cannot go on: the host is gone");
  expect_golden("lost");
  tap("enter");  // Try again
  EXPECT_EQ(joins, 2);
}

}  // namespace
}  // namespace rink::view
