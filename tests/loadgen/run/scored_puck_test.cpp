// What truth makes of a puck that scores, lies away for a while and is put back elsewhere.
#include <gtest/gtest.h>

#include <cmath>

#include "loadgen/measure/truth/replay.h"
#include "loadgen/measure/truth/truth.h"
#include "tests/loadgen/run/judged_rink.h"

namespace rink::loadgen {
namespace {

/// A puck slides into the left goal, lies there for the delay, and is put back between two ticks,
/// far from where it was. Two bats watch at rest.
class ScoredPuck : public JudgedRink {
 protected:
  static constexpr std::uint32_t first_bat = 0, second_bat = 1,
                                 puck = 2;  // bodies in the order of their making

  void SetUp() override {
    lay({.field = "length = 4.0\nwidth = 2.0\ngoal_width = 1.0\n",
         .more = "[match]\ngoals_to_win = 5\nface_off_delay = 1.03\nface_off_distance = 0.25\n",
         .bats = {"3.5, 1.0", "3.5, 0.3"},
         .pucks = {{"1.0, 1.0", "-1.0, 0.0"}}});
    game::Game game(game::chosen_scene(server_.choice));
    for (int ms = 0; ms <= 4000 && back_s_ == 0.0; ++ms) {
      game.advance(1e-3 * ms);
      const bool is_away = !game.world().is_in_play({puck});
      if (is_away && scored_s_ == 0.0) scored_s_ = 1e-3 * ms, left_play_ = game.position({puck});
      if (!is_away && scored_s_ > 0.0) back_s_ = 1e-3 * ms;
    }
    face_off_ = game.position({puck});
    first_tick_s_ = std::ceil(back_s_ * server_.rate_hz) / server_.rate_hz;
    end_at(first_tick_s_ + 0.5);
    game.advance(server_.end_s);
    server_.state_hash = game.hash();
    ASSERT_NEAR(back_s_ - scored_s_, 1.03, 2e-3);
    ASSERT_GT((face_off_ - left_play_).norm(), 0.9);
    ASSERT_GT(first_tick_s_ - back_s_, 0.01) << "it comes back between two ticks";
    know({first_bat, second_bat, puck});
  }

  /// The first player sees the other bat `aside` of where it is, and takes the puck to be at
  /// `puck_at`.
  void see(double displayed_s, double matched_s, double aside, Vector2 puck_at,
           std::uint32_t puck_bytes) {
    const std::size_t first = bots_.replicas.size();
    const Vector2 other(3.5 + aside, 0.3);
    bots_.replicas.push_back({.object = 100 + second_bat,
                              .bytes = 9,
                              .is_in_scope = true,
                              .matched = other,
                              .displayed = other});
    bots_.replicas.push_back({.object = 100 + puck,
                              .bytes = puck_bytes,
                              .is_in_scope = true,
                              .matched = puck_at,
                              .displayed = puck_at});
    bots_.samples.push_back({.bot = 0,
                             .displayed_s = displayed_s,
                             .matched_s = matched_s,
                             .window_s = 0.05,
                             .first = first,
                             .last = first + 2});
  }
  TruthFigures judged() const {
    return truth_of(server_, bots_, {RelevanceArea::Shape::square, 10.0});
  }
  Vector2 puck_at(double instant_s) const {
    game::Game game(game::chosen_scene(server_.choice));
    game.advance(instant_s);
    return game.position({puck});
  }

  double scored_s_ = 0.0, back_s_ = 0.0, first_tick_s_ = 0.0;
  Vector2 left_play_{0.0, 0.0}, face_off_{0.0, 0.0};
};

TEST_F(ScoredPuck, CountsWhereItLeftPlayUntilTheFirstTickAfterItsFaceOff) {
  Replay replay(server_, {RelevanceArea::Shape::square, 1.0});
  const auto centre_at = [&](double instant_s) {
    replay.advance(instant_s);
    replay.look_around();
    return replay.centre(puck);
  };
  EXPECT_NEAR((centre_at(scored_s_ + 0.01) - left_play_).norm(), 0.0, 1e-9);
  EXPECT_NEAR((centre_at(back_s_ + 1e-3) - left_play_).norm(), 0.0, 1e-9)
      << "put back, and not announced";
  EXPECT_NEAR((centre_at(first_tick_s_ - 1e-3) - left_play_).norm(), 0.0, 1e-9);
  EXPECT_FALSE(replay.replaced_s(puck));
  EXPECT_NEAR((centre_at(first_tick_s_) - face_off_).norm(), 0.0, 0.1)
      << "the first tick that can tell of it";
  EXPECT_NEAR(replay.replaced_s(puck).value(), first_tick_s_, 1e-9);
}

TEST_F(ScoredPuck, IsNoErrorOfDisplayUntilTheNewsOfItsFaceOffCanHaveCome) {
  const double shown_s = first_tick_s_ + 0.03;
  see(shown_s, first_tick_s_ - 0.1, 0.002, left_play_,
      9);  // the mirror has yet to hear of the tick
  TruthFigures truth = judged();
  EXPECT_NEAR(truth.displayed_error_mm.max.value(), 2.0, 1e-6) << "the other bat";
  EXPECT_NEAR(truth.displayed_error_mm.rms.value(), 2.0, 1e-6);
  EXPECT_EQ(truth.displayed_error_mm.replaced_samples, 1u);
  EXPECT_NEAR(truth.displayed_error_mm.replaced_rms.value(),
              1e3 * (puck_at(shown_s) - left_play_).norm(), 1e-3);
  EXPECT_EQ(truth.position_error_mm.replaced_samples, 0u)
      << "at the matched instant it lay where it left play";
  EXPECT_NEAR(truth.position_error_mm.max.value(), 2.0, 1e-6);
}

TEST_F(ScoredPuck, IsNoErrorWhileItsOwnNewsOfATickLagBehindThatOfOthers) {
  see(first_tick_s_ + 0.03, first_tick_s_, 0.0, left_play_, 0);
  const TruthFigures truth = judged();
  EXPECT_EQ(truth.displayed_error_mm.replaced_samples, 1u);
  EXPECT_EQ(truth.position_error_mm.replaced_samples, 1u);
  EXPECT_NEAR(truth.displayed_error_mm.max.value(), 0.0, 1e-6);
}

TEST_F(ScoredPuck, IsHeardOfByComingIntoScopeToo) {
  bots_.bots[0].changes.back() = {first_tick_s_ + 0.01, 100 + puck, true};
  see(first_tick_s_ + 0.03, first_tick_s_, 0.002, puck_at(first_tick_s_ + 0.03), 0);
  const TruthFigures truth = judged();
  EXPECT_EQ(truth.displayed_error_mm.replaced_samples, 0u);
  EXPECT_NEAR(truth.displayed_error_mm.rms.value(), 2.0 / std::sqrt(2.0), 1e-3)
      << "of the other bat and of the puck, which is shown right";
}

TEST_F(ScoredPuck, IsAnErrorLikeAnyOtherOnceTheMirrorHasHeardOrLongSinceShouldHave) {
  see(first_tick_s_ + 0.03, first_tick_s_, 0.0, left_play_,
      9);  // told of in that tick, and still shown in the goal
  see(first_tick_s_ + 0.3, first_tick_s_ + 0.2, 0.0, left_play_,
      0);  // never told: the filter or the budget kept it from the player
  const TruthFigures truth = judged();
  EXPECT_EQ(truth.displayed_error_mm.replaced_samples, 0u);
  EXPECT_FALSE(truth.displayed_error_mm.replaced_rms);
  EXPECT_GT(truth.displayed_error_mm.max.value(), 900.0);
  EXPECT_GT(truth.position_error_mm.max.value(), 900.0);
}

}  // namespace
}  // namespace rink::loadgen
