// A network match whose host is stopped and goes on, with a server in a process of its own.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <thread>

#include "game/control/key_log_file.h"
#include "game/net/client/joined_match.h"
#include "game/process/process.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace rink::game {
namespace {

using namespace std::chrono_literals;

class AnInterruptedMatch : public testing::Test {
 protected:
  AnInterruptedMatch()
      : host_(test::binary_folder() + "/bin/rink-serve",
              {"match", "--port", "0", "--countdown", "0.5", "--record", folder_.path().string()}) {
    std::optional<std::string> place;
    for (int i = 0; i < 500 && !place; ++i)
      host_.attend(10ms), place = host_.line_after("listening on ");
    for (std::size_t player = 0; place && player < 2; ++player)
      windows_.push_back(std::make_unique<JoinedMatch>(
          *place, NetworkMatchSettings{.name = "player-" + std::to_string(player)}));
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
  Process host_;
  std::vector<std::unique_ptr<JoinedMatch>> windows_;
};

/// Longer than the RTI lets others be silent.
TEST_F(AnInterruptedMatch, GoesOnFromWhereItsHostWasStopped) {
  ASSERT_EQ(windows_.size(), 2u) << host_.stderr_tail();
  ASSERT_TRUE(draw_until([&] { return are_all_in(MatchPhase::playing); }, 20.0));
  draw_until([] { return false; }, 1.0);
  EXPECT_TRUE(are_interrupted(false));
  const double stopped_at = windows_[0]->sight().time, stopped_s = now_s();
  ASSERT_EQ(kill(host_.id(), SIGSTOP), 0);
  ASSERT_TRUE(draw_until([&] { return are_interrupted(true); }, 20.0));
  EXPECT_GT(now_s() - stopped_s, 0.45);
  draw_until([] { return false; }, 6.5 - (now_s() - stopped_s));
  ASSERT_TRUE(are_interrupted(true));
  EXPECT_NEAR(*windows_[0]->sight().interrupted_s, now_s() - stopped_s, 0.5);
  EXPECT_LT(windows_[0]->sight().time, stopped_at + 1.5) << "nobody knows how it goes on";
  ASSERT_EQ(kill(host_.id(), SIGCONT), 0);
  ASSERT_TRUE(draw_until([&] { return are_all_in(MatchPhase::countdown); }, 20.0));
  EXPECT_TRUE(are_interrupted(false));
  ASSERT_TRUE(draw_until([&] { return are_all_in(MatchPhase::playing); }, 20.0));
  EXPECT_NEAR(windows_[0]->sight().time, stopped_at, 1.0) << "what stood still does not count";
  const double goes_on_at = windows_[0]->sight().time;
  draw_until([] { return false; }, 1.0);
  EXPECT_GT(windows_[0]->sight().time, goes_on_at + 0.5);
  for (const auto& window : windows_) EXPECT_EQ(window->sight().notice, "");
}

}  // namespace
}  // namespace rink::game
