// A recorded match as it is watched: its bar, what the players do, and that it stops after the win.
#include "game/view/overlays/replay_view.h"

#include <gmock/gmock.h>

#include <string>

#include "game/control/key_log_file.h"
#include "game/control/playing.h"
#include "game/model/scene_file.h"
#include "tests/temporary_folder.h"

namespace rink::view {
namespace {

using ::testing::Optional;

void replace(std::string& text, const std::string& what, const std::string& by) {
  const std::size_t place = text.find(what);
  ASSERT_NE(place, std::string::npos) << what;
  text.replace(place, what.size(), by);
}

/// One goal wins, and the puck flies into the left one: 1.2 m at 2 m/s. The record goes on to 8 s.
class WatchedReplay : public ::testing::Test {
 protected:
  WatchedReplay() {
    std::string text = game::scene_text("match");
    replace(text, "goals_to_win = 5", "goals_to_win = 1");
    replace(text, "velocity = [-1.6, 0.6]", "velocity = [-2.0, 0.0]");
    replace(text, "position = [0.25, 0.6]", "position = [0.25, 1.0]");
    const game::Scene scene = game::parse_scene(text, "win.toml");
    game::Playing playing(scene, {game::Playing::hand, game::Playing::hand}, 1, 0.0);
    playing.advance(0.125);
    playing.press(0, game::Key::up, true);
    playing.press(1, game::Key::left, true);
    playing.advance(0.25);
    playing.press(1, game::Key::left, false);
    playing.push(1, {.x = 0, .y = -64});
    playing.advance(8.0);
    file_ = (folder_ / "win.keys").string();
    game::write_key_log(file_, game::log_of(playing.game(), scene, text, playing.keys()));
    replay_ = std::make_unique<game::ReplayMatch>(file_);
    watch(0.02);
  }
  void watch(double duration_s) {
    for (double end = now_s_ + duration_s; now_s_ < end;) replay_->advance(now_s_ += 1.0 / 60.0);
  }
  void seek(double instant) {
    replay_->seek(instant);
    replay_->pause(true);
    watch(0.02);
  }

  test::TemporaryFolder folder_{"replay-view"};
  std::string file_;
  std::unique_ptr<game::ReplayMatch> replay_;
  double now_s_ = 3.0;
};

TEST_F(WatchedReplay, StopsTwoSecondsAfterTheWinAndResumedPlaysToItsEnd) {
  watch(6.0);
  EXPECT_TRUE(replay_->is_paused());
  EXPECT_NEAR(replay_->sight().time, 1.2 / 2.0 + game::ReplayMatch::after_win_s, 0.1);
  EXPECT_EQ(replay_->sight().winner, game::Team::right);
  EXPECT_EQ(replay_->sight().phase, Phase::over) << "who has won is said there";
  replay_->pause(false);
  watch(0.1);
  EXPECT_EQ(replay_->sight().phase, Phase::playing);
  watch(7.0);
  EXPECT_EQ(replay_->sight().time, 8.0);
  EXPECT_THAT(replay_->is_as_recorded(), Optional(true));
  replay_->rematch();
  watch(6.0);
  EXPECT_TRUE(replay_->is_paused()) << "and again";
}

/// 64 of 127 steps are half a key, nearly.
TEST_F(WatchedReplay, ShowsAtTheBatsWhatIsHeldAndPushedAtItsInstant) {
  const auto bars = [this] {
    Overlay overlay;
    add_inputs(*replay_, palette_of(PaletteKind::standard), overlay);
    return overlay.rectangles;
  };
  seek(0.05);
  EXPECT_TRUE(bars().empty());
  seek(0.2);
  ASSERT_EQ(bars().size(), 2u);
  const auto bat = [this](game::Team team) {
    return *std::ranges::find(replay_->sight().things, team, &Thing::team);
  };
  EXPECT_GT(bars()[0].low_y, bat(game::Team::left).position.y() + 0.1) << "above the left bat";
  EXPECT_NEAR(bars()[0].high_y - bars()[0].low_y, 0.03, 1e-12);
  EXPECT_LT(bars()[1].high_x, bat(game::Team::right).position.x() - 0.03) << "left of the right";
  seek(0.3);
  ASSERT_EQ(bars().size(), 2u);
  EXPECT_LT(bars()[1].high_y, bat(game::Team::right).position.y() - 0.1);
  EXPECT_NEAR(bars()[1].high_y - bars()[1].low_y, 0.03 * 64.0 / 127.0, 1e-12);
}

/// The record is walked once, not anew at each picture: whatever one seeks, it is what the events
/// so far add up to.
TEST_F(WatchedReplay, KnowsWhatIsHeldWhereverItIsSought) {
  const game::KeyLog log = game::read_key_log(file_);
  for (const double instant : {0.3, 0.2, 0.05, 8.0, 0.26, 0.0, 0.13, 5.0}) {
    seek(instant);
    std::vector<game::ReplayMatch::Input> expected(2);
    for (const game::InputEvent& event : log.events) {
      if (event.time > replay_->sight().time) break;
      game::ReplayMatch::Input& input = expected.at(event.player);
      if (event.kind == game::InputKind::push) input.push = event.push;
      else if (event.kind != game::InputKind::key_down && event.kind != game::InputKind::key_up)
        input = {};
      else input.keys.set(event.key, event.kind == game::InputKind::key_down);
    }
    for (std::size_t player = 0; player < 2; ++player) {
      EXPECT_EQ(replay_->inputs().at(player).push, expected[player].push) << instant;
      EXPECT_EQ(replay_->inputs().at(player).keys, expected[player].keys) << instant;
    }
  }
}

TEST_F(WatchedReplay, MarksAGoalHoweverFewPicturesThereAreButNoneThatWasPassedOver) {
  const auto marks = [](const ReplayBar& bar, const game::ReplayMatch& replay) {
    Picture words;
    bar.add_to(replay, palette_of(PaletteKind::standard), words);
    return std::ranges::count(words.panels, palette_of(PaletteKind::standard).right, &Panel::fill);
  };
  ReplayBar seen, sought;
  replay_->set_speed(8.0);
  for (int k = 0; k < 8; ++k) replay_->advance(now_s_ += 0.1), seen.look(*replay_);
  EXPECT_EQ(marks(seen, *replay_), 1);
  seek(0.1);
  sought.look(*replay_);
  replay_->seek(2.0);
  replay_->advance(now_s_ += 0.1);
  sought.look(*replay_);
  EXPECT_EQ(marks(sought, *replay_), 0) << "when it fell is not known";
}

TEST_F(WatchedReplay, IsSoughtInByABarThatAlsoShowsTheGoalThatWasSeen) {
  constexpr WindowSize size{1000, 500, 1.0};
  ReplayBar bar;
  using Kind = WindowEvent::Kind;
  const auto at = [&](double x, double y) {
    return bar.hear({.kind = Kind::mouse_move, .x = x * size.width, .y = y * size.height}, size,
                    replay_->end());
  };
  const auto button = [&](bool is_down) {
    return bar.hear({.kind = Kind::mouse_button, .is_down = is_down}, size, replay_->end());
  };
  EXPECT_FALSE(at(0.5, 0.5));
  EXPECT_FALSE(button(true)) << "not on the bar";
  EXPECT_FALSE(at(0.5, ReplayBar::middle)) << "what began elsewhere is none of the bar's";
  button(false);
  EXPECT_THAT(button(true), Optional(::testing::DoubleNear(4.0, 1e-9)));
  EXPECT_THAT(at(ReplayBar::left + 0.25 * (ReplayBar::right - ReplayBar::left), 0.2),
              Optional(::testing::DoubleNear(2.0, 1e-9)))
      << "dragged off the bar it is held still";
  EXPECT_THAT(at(-0.2, 0.9), Optional(0.0));
  EXPECT_THAT(at(1.2, 0.9), Optional(8.0));
  EXPECT_TRUE(bar.is_held());
  EXPECT_FALSE(bar.hear({.kind = Kind::key, .key = 65, .is_down = true}, size, replay_->end()))
      << "a key is none of the bar's";
  EXPECT_FALSE(button(false));
  button(true);
  bar.let_go();
  EXPECT_FALSE(at(0.3, ReplayBar::middle)) << "a menu was opened meanwhile";
  EXPECT_FALSE(at(0.5, ReplayBar::middle));

  const Palette& palette = palette_of(PaletteKind::standard);
  for (int k = 0; k < 60; ++k) watch(0.02), bar.look(*replay_);
  Picture words;
  bar.add_to(*replay_, palette, words);
  const auto mark = std::ranges::find(words.panels, palette.right, &Panel::fill);
  ASSERT_NE(mark, words.panels.end());
  EXPECT_NEAR(static_cast<double>(mark->x),
              ReplayBar::left + (ReplayBar::right - ReplayBar::left) * 0.6 / 8.0, 0.01);
}

TEST_F(WatchedReplay, ShowsTheSpeedOfItsPuckBesideIt) {
  seek(0.1);
  Picture words;
  add_speeds(replay_->sight(), {}, 16.0 / 9.0, words);
  ASSERT_EQ(words.texts.size(), 1u);
  EXPECT_EQ(words.texts[0].words, "2.0 m/s");
}

}  // namespace
}  // namespace rink::view
