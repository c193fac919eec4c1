// Every screen against its golden image: a match that stands still, so that no image depends on how
// bodies move.
#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "game/control/key_log_file.h"
#include "game/control/playing.h"
#include "game/match/local_match.h"
#include "game/match/replay_match.h"
#include "game/model/scene_file.h"
#include "game/view/application.h"
#include "game/view/render/image_file.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"
#include "tests/view/offscreen_test.h"
#include "tests/view/sights.h"
#include "tests/view/tiles.h"

namespace rink::view {
namespace {

constexpr WindowSize small{480, 270, 1.0}, old_shape{400, 300, 1.0};

/// A match of which the test says how it looks.
class StillMatch final : public MatchSource {
 public:
  explicit StillMatch(const MatchSight& sight) : sight_(sight) {}
  void advance(double) override {}
  const MatchSight& sight() const override { return sight_; }
  std::uint32_t hand_count() const override { return sight_.own_team ? 1 : 2; }
  void press(std::uint32_t, game::Key, bool) override {}
  void pause(bool is_wanted) override { sight_.phase = is_wanted ? Phase::paused : Phase::playing; }
  void rematch() override { sight_.wants_rematch = true; }

 private:
  MatchSight sight_;
};

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

/// All tests share what takes long to make, compiled shaders too.
class GoldenImages : public OffscreenTest {
 protected:
  static void SetUpTestSuite() {
    OffscreenTest::SetUpTestSuite();
    if (!can_draw()) return;
    interface_ = std::make_unique<Interface>();
    renderer_ = std::make_unique<Renderer>();
  }
  static void TearDownTestSuite() {
    renderer_.reset();
    interface_.reset();
    OffscreenTest::TearDownTestSuite();
  }
  void SetUp() override {
    OffscreenTest::SetUp();
    if (IsSkipped()) return;
    resize(small);
    open(match_sight());
  }

  void resize(const WindowSize& size) {
    size_ = size;
    target_ = Target(size.width, size.height, 0);
  }
  void open(const MatchSight& sight, const Settings& settings = shared_camera()) {
    application_ = std::make_unique<Application>(
        Surroundings{.make_match =
                         [sight](const MatchWish&) { return std::make_unique<StillMatch>(sight); }},
        settings);
  }
  void play(const MatchSight& sight, const Settings& settings = shared_camera()) {
    open(sight, settings);
    application_->play({.kind = MatchWish::Kind::two, .address = {}});
  }
  static Settings shared_camera() {
    Settings settings;
    settings.is_split = false;
    return settings;
  }

  void frame(bool is_seen = true) {
    application_->draw(*interface_, is_seen ? renderer_.get() : nullptr, size_,
                       {target_.framebuffer(), 0, 0, size_.width, size_.height},
                       now_ += 1.0 / 60.0);
  }
  void tap(const char* key) {
    for (const bool is_down : {true, false}) {
      receive({.kind = WindowEvent::Kind::key,
               .key = key_code_from_name(key).value(),
               .is_down = is_down});
      for (int i = 0; i < 3; ++i) frame(false);
    }
  }
  void receive(const WindowEvent& event) { application_->receive(event); }
  /// Down and up before anything is drawn, as a person's tap is where a frame takes long.
  void tap_within_a_frame(const char* key) {
    for (const bool is_down : {true, false})
      receive({.kind = WindowEvent::Kind::key,
               .key = key_code_from_name(key).value(),
               .is_down = is_down});
  }

  /// Other drivers round and sample otherwise: an edge here and there may differ, not a place or a
  /// colour.
  void expect_golden(const std::string& name) {
    frame(false), frame(false);
    do
      frame();  // the first after a cut may be drawn as of a camera that moves, and what stands
                // still becomes smooth by and by
    while (!renderer_->is_settled());
    frame();
    const Image seen = read_pixels(target_.framebuffer(), size_.width, size_.height);
    const std::string golden = test::source_folder() + "/tests/view/golden/" + name + ".png";
    if (std::getenv("RINK_RENEW_GOLDEN") != nullptr) return write_png(golden, seen);
    const Image wanted = std::filesystem::exists(golden) ? read_png(golden) : Image{};
    const Difference apart = difference(seen, wanted);
    const Tile worst = worst_tile(seen, wanted);
    if (apart.mean < 1.5 && apart.part_above_32 < 0.01 && worst.is_alike()) return;
    const std::string folder = test::binary_folder() + "/golden-images-that-differ/";
    std::filesystem::create_directories(folder);
    write_png(folder + name + ".actual.png", seen);
    write_png(folder + name + ".difference.png", difference_image(seen, wanted));
    ADD_FAILURE() << name << ": mean difference " << apart.mean
                  << " (below 1.5), part of the pixels off by more than 32 is "
                  << apart.part_above_32 << " (below 0.01), in the worst tile " << worst
                  << "\nis      " << folder << name << ".actual.png\nmust be " << golden
                  << "\napart   " << folder << name << ".difference.png";
  }

  static inline std::unique_ptr<Interface> interface_;
  static inline std::unique_ptr<Renderer> renderer_;
  WindowSize size_;
  Target target_;
  std::unique_ptr<Application> application_;
  double now_ = 10.0;
};

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
  play(sight, Settings());
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
  play(sight, Settings());
  expect_golden("split");
  tap("v");
  expect_golden("side");
  tap("v");
  tap("c");
  expect_golden("side");
}

TEST_F(GoldenImages, OfOtherWindowsAndScales) {
  resize(old_shape);
  open(match_sight());
  expect_golden("menu_old_shape");
  for (int i = 0; i < 5; ++i) tap("down");
  tap("enter");
  expect_golden("settings_old_shape");
  play(match_sight(), Settings());
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
      Settings());
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
  int made = 0;
  application_ = std::make_unique<Application>(
      Surroundings{.make_match =
                       [&](const MatchWish&) {
                         return std::make_unique<StillMatch>(made++ == 0 ? match_sight() : sight);
                       },
                   .notify = [&](const std::string& words) { told = words; }},
      Settings());
  application_->play({.kind = MatchWish::Kind::join, .address = "localhost:1"});
  frame();
  EXPECT_TRUE(application_->is_in_menu());
  EXPECT_EQ(told, "The match cannot go on: the host is gone");
  expect_golden("lost");
}

}  // namespace
}  // namespace rink::view
