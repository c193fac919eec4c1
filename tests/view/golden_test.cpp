// Every screen against its golden image: a match that stands still, so that no image depends on how bodies move.
#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>

#include "game/view/application.h"
#include "game/view/render/image_file.h"
#include "game/view/render/offscreen.h"

namespace rink::view {
namespace {

constexpr int width = 480, height = 270;

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

MatchSight match_sight() {
  MatchSight sight;
  sight.field = {.length = 2.4, .width = 1.2, .goal_width = 0.4};
  sight.goals_to_win = 5;
  sight.phase = Phase::playing;
  sight.left_name = "Red";
  sight.right_name = "Blue";
  using physics::BodyKind;
  sight.things = {{0, BodyKind::post, game::Team::none, {0.6, 0.85}, {0.0, 0.0}, {0.06, 0.06}},
                  {1, BodyKind::post, game::Team::none, {1.8, 0.35}, {0.0, 0.0}, {0.06, 0.06}},
                  {2, BodyKind::bat, game::Team::left, {0.42, 0.52}, {0.3, 0.1}, {0.03, 0.1}},
                  {3, BodyKind::bat, game::Team::right, {2.0, 0.7}, {0.0, 0.0}, {0.03, 0.1}},
                  {4, BodyKind::puck, game::Team::none, {1.35, 0.75}, {2.4, 0.9}, {0.04, 0.04}}};
  return sight;
}

/// A crowd on a lattice, with the overlay of an experiment.
MatchSight crowd_sight() {
  MatchSight sight;
  sight.field = {.length = 20.0, .width = 10.0, .goal_width = 0.6};
  for (std::uint32_t i = 0; i < 1000; ++i) sight.things.push_back({i, physics::BodyKind::puck, game::Team::none, {0.25 + 0.39 * (i % 50), 0.3 + 0.48 * (i / 50)}, {0.0, 0.0}, {0.04, 0.04}});
  for (std::uint32_t i = 0; i < 40; ++i)
    sight.things.push_back({1000 + i, physics::BodyKind::bat, i % 2 == 0 ? game::Team::left : game::Team::right, {1.0 + 2.4 * (i % 8), 1.07 + 1.92 * (i / 8)}, {0.0, 0.0}, {0.05, 0.15}});
  sight.phase = Phase::playing;
  return sight;
}

class GoldenImages : public ::testing::Test {
 protected:
  void SetUp() override {
    setenv("LP_NUM_THREADS", "1", 0);
    try {
      context_ = std::make_unique<OffscreenContext>();
    } catch (const GraphicsError& error) {
      GTEST_SKIP() << error.what();
    }
    interface_ = std::make_unique<Interface>();
    renderer_ = std::make_unique<Renderer>();
    target_ = Target(width, height, 0);
    open(match_sight());
  }

  void open(const MatchSight& sight) {
    application_ = std::make_unique<Application>(Surroundings{.make_match = [sight](const MatchWish&) { return std::make_unique<StillMatch>(sight); }}, Settings());
  }
  void play(const MatchSight& sight) {
    open(sight);
    application_->play({.kind = MatchWish::Kind::two, .address = {}});
  }

  void frame(bool is_seen = true) { application_->draw(*interface_, is_seen ? renderer_.get() : nullptr, {width, height, 1.0}, {target_.framebuffer(), 0, 0, width, height}, now_ += 1.0 / 60.0); }
  void tap(const char* key) {
    for (const bool is_down : {true, false}) {
      const WindowEvent event{.kind = WindowEvent::Kind::key, .key = key_code_from_name(key).value(), .is_down = is_down};
      interface_->hear(event);
      application_->hear(event);
      for (int i = 0; i < 3; ++i) frame(false);
    }
  }

  /// Other drivers round and sample otherwise: an edge here and there may differ, not a place or a colour.
  void expect_golden(const std::string& name) {
    for (int i = 0; i < 4; ++i) frame(i >= 2);  // the first frame after a cut may be drawn as of a camera that moves
    const Image seen = read_pixels(target_.framebuffer(), width, height);
    const std::string golden = std::string(RINK_SOURCE_DIR) + "/tests/view/golden/" + name + ".png";
    if (std::getenv("RINK_RENEW_GOLDEN") != nullptr) return write_png(golden, seen);
    const Difference apart = difference(seen, read_png(golden));
    EXPECT_LT(apart.mean, 1.5) << name;
    EXPECT_LT(apart.part_above_32, 0.01) << name;
    if (HasFailure()) write_png(::testing::TempDir() + "/" + name + ".png", seen);
  }

  std::unique_ptr<OffscreenContext> context_;
  std::unique_ptr<Interface> interface_;
  std::unique_ptr<Renderer> renderer_;
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

TEST_F(GoldenImages, OfAMatchFromEveryViewpoint) {
  MatchSight sight = match_sight();
  sight.score = {3, 1};
  for (const auto& [viewpoint, name] : {std::pair{Viewpoint::side, "side"}, {Viewpoint::left_end, "left_end"}, {Viewpoint::right_end, "right_end"}, {Viewpoint::above, "above"}}) {
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
  sight.link = LinkFigures{.ping_ms = 42.0, .jitter_ms = 1.7, .loss = 0.01, .tick = 12345, .payload_bytes_per_s = 412.0};
  sight.phase = Phase::away;
  sight.remaining_s = 17.3;
  play(sight);
  expect_golden("away");
  sight.phase = Phase::waiting;
  play(sight);
  expect_golden("waiting");
}

TEST_F(GoldenImages, OfACrowdWithItsOverlay) {
  play(crowd_sight());
  application_->set_interest({.cell_size = 1.25, .view_fraction = 0.05, .chosen = 12});
  expect_golden("crowd");
  for (int i = 0; i < 6; ++i) tap("equal");
  expect_golden("crowd_zoomed");
}

TEST_F(GoldenImages, GoBackToTheMenuWhenTheConnectionIsLost) {
  MatchSight sight = match_sight();
  sight.phase = Phase::lost;
  sight.notice = "the host is gone";
  std::string told;
  int made = 0;
  application_ = std::make_unique<Application>(Surroundings{.make_match = [&](const MatchWish&) { return std::make_unique<StillMatch>(made++ == 0 ? match_sight() : sight); },
                                                            .tell = [&](const std::string& words) { told = words; }},
                                               Settings());
  application_->play({.kind = MatchWish::Kind::join, .address = "localhost:1"});
  frame();
  EXPECT_TRUE(application_->is_in_menu());
  EXPECT_EQ(told, "The match cannot go on: the host is gone");
}

}  // namespace
}  // namespace rink::view
