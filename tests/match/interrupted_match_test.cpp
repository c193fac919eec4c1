// A network match whose host is stopped or killed, or whose player is, and that goes on: with
// servers in processes of their own.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <functional>
#include <memory>
#include <thread>
#include <utility>

#include "game/control/begun_match.h"
#include "game/control/key_log_file.h"
#include "game/control/replay.h"
#include "game/net/client/returning_match.h"
#include "game/process/process.h"
#include "tests/places.h"
#include "tests/reserved_port.h"
#include "tests/temporary_folder.h"

namespace rink::game {
namespace {

using namespace std::chrono_literals;

class AnInterruptedMatch : public testing::Test {
 protected:
  AnInterruptedMatch() {
    serve({});
    for (std::size_t player = 0; place_ && player < 2; ++player)
      windows_.push_back(std::make_unique<ReturningMatch>(
          *place_, NetworkMatchSettings{.name = "player-" + std::to_string(player)}));
  }
  void serve(const std::vector<std::string>& further) {
    std::vector<std::string> words{"match", "--port",   port_.text(),           "--countdown",
                                   "0.5",   "--record", folder_.path().string()};
    words.insert(words.end(), further.begin(), further.end());
    host_ = std::make_unique<Process>(test::binary_folder() + "/bin/rink-serve", words);
    place_.reset();
    for (int i = 0; i < 500 && !place_; ++i)
      host_->attend(10ms), place_ = host_->line_after("listening on ");
  }
  /// Both have come, and have played for a second.
  void play() {
    ASSERT_EQ(windows_.size(), 2u) << host_->stderr_tail();
    ASSERT_TRUE(draw_until([&] { return are_all_in(MatchPhase::playing); }, 20.0));
    draw_until([] { return false; }, 1.0);
    EXPECT_TRUE(are_interrupted(false));
  }

  static double now_s() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
  }
  /// Both windows draw until `is_done` or for so long.
  bool draw_until(const std::function<bool()>& is_done, double longest_s) {
    for (const double until_s = now_s() + longest_s; now_s() < until_s;) {
      for (const auto& window : windows_) window->advance(now_s());
      if (is_done()) return true;
      std::this_thread::sleep_for(5ms);
    }
    return false;
  }
  bool are_all_in(MatchPhase phase) const {
    return std::ranges::all_of(
        windows_, [phase](const auto& window) { return window->sight().phase == phase; });
  }
  bool are_interrupted(bool is_wanted) const {
    return std::ranges::all_of(windows_, [is_wanted](const auto& window) {
      return window->sight().interrupted_s.has_value() == is_wanted;
    });
  }

  test::TemporaryFolder folder_{"interrupted"};
  test::ReservedPort port_;
  std::unique_ptr<Process> host_;
  std::optional<std::string> place_;
  std::vector<std::unique_ptr<ReturningMatch>> windows_;
};

/// Longer than the RTI lets others be silent.
TEST_F(AnInterruptedMatch, GoesOnFromWhereItsHostWasStopped) {
  play();
  const double stopped_at = windows_[0]->sight().time, stopped_s = now_s();
  ASSERT_EQ(kill(host_->id(), SIGSTOP), 0);
  ASSERT_TRUE(draw_until([&] { return are_interrupted(true); }, 20.0));
  constexpr double beat_s = 0.25;  // it may have spoken that long before it was stopped
  EXPECT_GT(now_s() - stopped_s, interrupted_after_s - beat_s);
  draw_until([] { return false; }, 6.5 - (now_s() - stopped_s));
  ASSERT_TRUE(are_interrupted(true));
  EXPECT_NEAR(*windows_[0]->sight().interrupted_s, now_s() - stopped_s, 0.5);
  EXPECT_LT(windows_[0]->sight().time, stopped_at + 1.5) << "nobody knows how it goes on";
  ASSERT_EQ(kill(host_->id(), SIGCONT), 0);
  ASSERT_TRUE(draw_until([&] { return are_all_in(MatchPhase::countdown); }, 20.0));
  EXPECT_TRUE(are_interrupted(false));
  ASSERT_TRUE(draw_until([&] { return are_all_in(MatchPhase::playing); }, 20.0));
  EXPECT_NEAR(windows_[0]->sight().time, stopped_at, 1.0) << "what stood still does not count";
  const double goes_on_at = windows_[0]->sight().time;
  draw_until([] { return false; }, 1.0);
  EXPECT_GT(windows_[0]->sight().time, goes_on_at + 0.5);
  for (const auto& window : windows_) EXPECT_EQ(window->sight().notice, "");
}

/// The server drops who says nothing for five seconds, and keeps the seat.
TEST_F(AnInterruptedMatch, TakesBackAPlayerWhoseWindowStoodStill) {
  play();
  const std::optional<Team> seat = windows_[1]->sight().own_team;
  std::vector<std::unique_ptr<ReturningMatch>> still;
  still.push_back(std::move(windows_[1]));
  windows_.pop_back();
  ASSERT_TRUE(draw_until([&] { return are_all_in(MatchPhase::away); }, 20.0));
  const double left_at = windows_[0]->sight().time;
  windows_.push_back(std::move(still[0]));
  ASSERT_TRUE(draw_until([&] { return are_all_in(MatchPhase::playing); }, 20.0));
  EXPECT_EQ(windows_[1]->sight().own_team, seat);
  EXPECT_NEAR(windows_[0]->sight().time, left_at, 1.0);
}

TEST_F(AnInterruptedMatch, GoesOnFromItsRecordOnceItsHostWasKilled) {
  play();
  windows_[0]->press(0, Key::up, true);
  draw_until([] { return false; }, 1.5);
  const std::array seats{windows_[0]->sight().own_team, windows_[1]->sight().own_team};
  const double killed_at = windows_[0]->sight().time;
  ASSERT_EQ(kill(host_->id(), SIGKILL), 0);
  ASSERT_TRUE(draw_until([&] { return are_interrupted(true); }, 20.0));
  windows_[0]->press(0, Key::up, false);
  std::swap(windows_[0], windows_[1]);  // who came second comes back first
  const auto record = newest_record(folder_.path());
  ASSERT_TRUE(record);
  serve({"--continue", record->string()});
  ASSERT_TRUE(place_) << host_->stderr_tail();
  ASSERT_TRUE(
      draw_until([&] { return are_interrupted(false) && are_all_in(MatchPhase::playing); }, 20.0));
  EXPECT_EQ(windows_[1]->sight().own_team, seats[0]);
  EXPECT_EQ(windows_[0]->sight().own_team, seats[1]);
  EXPECT_NEAR(windows_[0]->sight().time, killed_at, 1.6) << "a record lacks a second at most";
  draw_until([] { return false; }, 1.5);
  windows_.clear();
  host_->stop(5s);
  const KeyLog whole = read_key_log(newest_record(folder_.path()).value());
  EXPECT_GT(*whole.until, killed_at);
  EXPECT_EQ(replay(whole, recorded_scene(whole, "whole")), *whole.hash);
}

/// Real time is what the caller says, so it passes quickly.
TEST_F(AnInterruptedMatch, IsLostAfterThirtySecondsWithoutAHost) {
  play();
  const double killed_s = now_s();
  host_.reset();
  double later_s = killed_s;
  const auto is_lost = [&] { return windows_[0]->sight().phase == MatchPhase::lost; };
  for (; !is_lost() && later_s < killed_s + 60.0; later_s += 0.25) windows_[0]->advance(later_s);
  EXPECT_NEAR(later_s - killed_s, interruption_max_s, 1.0);
  EXPECT_EQ(windows_[0]->sight().notice, "the host has ended or left");
  EXPECT_FALSE(windows_[0]->sight().interrupted_s);
}

}  // namespace
}  // namespace rink::game
