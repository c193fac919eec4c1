// Windows of rink play that share a match without a server, each with a node of its own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <deque>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "game/control/key_log_file.h"
#include "game/control/replay.h"
#include "game/process/process.h"
#include "game/view/render/offscreen.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace rink::view {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using Words = std::vector<std::string>;

class PlayAmongPeers : public testing::Test {
 protected:
  void SetUp() override {
    try {
      const OffscreenContext context;
    } catch (const GraphicsError&) {
      GTEST_SKIP() << "no EGL with Mesa's surfaceless platform here";
    }
  }

  /// A window whose player presses keys by `script`, which also ends it.
  game::Process& play(const std::string& name, const std::string& script, Words further) {
    std::ofstream(file(name)) << script;
    const Words words{"--offscreen",
                      "--size",
                      "320x240",
                      "--script",
                      file(name),
                      "--records",
                      file(name) + "-records",
                      "--settings",
                      file(name) + ".toml"};
    further.insert(further.end(), words.begin(), words.end());
    return *windows_.emplace_back(
        std::make_unique<game::Process>(test::binary_folder() + "/bin/rink-play", further));
  }
  game::Process& found(const std::string& script, Words further = {}) {
    further.insert(further.end(), {"--peer-listen", "127.0.0.1:0"});
    game::Process& window = play("first", script, further);
    until([&] { return window.line_after("listening on ") || window.ending(); });
    return window;
  }
  game::Process& join(const std::string& name, const game::Process& other,
                      const std::string& script) {
    const std::string place = other.line_after("listening on ").value_or("nowhere:1");
    return play(name, script, {"--peer", place});
  }
  bool until(const std::function<bool()>& is_reached, std::chrono::seconds limit = 60s) {
    const auto end = std::chrono::steady_clock::now() + limit;
    while (!is_reached() && std::chrono::steady_clock::now() < end)
      for (const auto& window : windows_) window->attend(5ms);
    return is_reached();
  }
  bool ends(const game::Process& window) {
    return until([&] { return window.ending().has_value(); });
  }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  /// The only record of that window's node, which one engine replays to its hash.
  game::KeyLog record(const std::string& name) const {
    const std::string path = file(name) + "-records/match-1.keys";
    game::KeyLog log = game::read_key_log(std::filesystem::path(path));
    EXPECT_EQ(game::replay(log, game::recorded_scene(log, path)), log.hash.value_or(0));
    EXPECT_FALSE(std::filesystem::exists(file(name) + "-records/match-2.keys"));
    return log;
  }
  static std::ptrdiff_t count_of(const game::KeyLog& log, std::uint32_t player) {
    return std::ranges::count(log.events, player, &game::InputEvent::player);
  }

  test::TemporaryFolder folder_{"among-peers"};
  std::deque<std::unique_ptr<game::Process>> windows_;
};

/// Who plays on the left is the one whose wish comes first.
TEST_F(PlayAmongPeers, SharesAMatchThatEachRecordsHoweverItLeaves) {
  game::Process& one = found("10 down w\n11 up w\n60 end\n");
  game::Process& two =
      join("second", one, "10 down s\n11 up s\n13 tap escape\n14 tap escape\n17 end\n");
  ASSERT_TRUE(ends(two)) << two.stderr_tail();
  EXPECT_EQ(two.ending()->exit_status, 0) << two.stderr_tail();
  until([] { return false; }, 1s);
  ASSERT_EQ(kill(one.id(), SIGKILL), 0) << "its node ends by itself, and its record is there";
  ASSERT_TRUE(until([&] {
    try {
      game::read_key_log(std::filesystem::path(file("first-records/match-1.keys")));
    } catch (const game::SceneError&) {
      return false;
    }
    return true;  // it is written whole
  }));
  for (const char* name : {"first", "second"})
    for (const std::uint32_t player : {0u, 1u})
      EXPECT_EQ(count_of(record(name), player), 2) << name << " " << player;
}

TEST_F(PlayAmongPeers, TakesAPlayerBackIntoTheSameMatchThatWasKilled) {
  game::Process& one = found("60 end\n");
  game::Process& two = join("second", one, "9 down w\n60 end\n");
  ASSERT_TRUE(until([&] { return two.line_after("this is node 1 of 2").has_value(); }));
  until([] { return false; }, 12s);
  ASSERT_EQ(kill(two.id(), SIGKILL), 0);
  until([] { return false; }, 1s);
  game::Process& back = join("third", one, "8 down s\n9 up s\n12 end\n");
  ASSERT_TRUE(ends(back)) << back.stderr_tail();
  EXPECT_EQ(back.ending()->exit_status, 0);
  EXPECT_FALSE(std::filesystem::exists(file("third-records/match-1.keys")))
      << "it is played at the other's node";
  one.stop(10s);
  const game::KeyLog log = record("first");
  EXPECT_EQ(log.events.size(), 4u) << "released when it was lost, and pressed again";
}

TEST_F(PlayAmongPeers, SaysWhoNeverCame) {
  const game::Process& one = found("6 end\n", {"--wait", "1"});
  ASSERT_TRUE(ends(one));
  EXPECT_THAT(one.stderr_tail(), HasSubstr("1 of 2 came within 1 s"));
}

TEST_F(PlayAmongPeers, RefusesFlagsOfGamesThatAreDivided) {
  for (const Words& flags :
       {Words{"--until", "5"}, Words{"--record", file("a.keys")}, Words{"--scheme", "region"}}) {
    const game::Process& one = found("0.5 end\n", flags);
    ASSERT_TRUE(ends(one));
    EXPECT_THAT(one.stderr_tail(), HasSubstr(flags[0] + ": "));
    EXPECT_THAT(one.stderr_tail(), HasSubstr("expected none for scene 'match'"));
  }
}

}  // namespace
}  // namespace rink::view
