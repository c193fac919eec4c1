// What rink serve bears of a client that sends too much: by default, and with limits of its own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <utility>

#include "game/net/server/server.h"
#include "tests/net/guest.h"
#include "tests/temporary_folder.h"

namespace rink::game {
namespace {

using testing::HasSubstr;
using namespace std::chrono_literals;

/// What came of a server for one player who does as the test says, and leaves when the run is over.
struct Held {
  Ended ended{};
  nlohmann::json report{};
  bool is_dropped = false;  ///< before that
  std::uint32_t acknowledged = 0;
};
Held held_by(std::vector<std::string> flags, const std::function<void(Guest&)>& act) {
  constexpr double duration_s = 0.3, lead_s = 0.1, room_s = 0.05;
  const test::TemporaryFolder folder("serve-limits");
  const std::string report = (folder / "report.json").string();
  flags.insert(flags.begin(), {"--scene", "match", "--clients", "1", "--port", "0", "--duration",
                               "0.3", "--report", report});
  Process server(test::binary_folder() + "/bin/rink-serve", flags, {});
  const std::optional<std::string> place = place_of(server);
  if (!place) return {.ended = {.status = -1, .words = server.stderr_tail()}};
  Guest guest(*place, {.name = "bat-0"});
  for (int i = 0; i < 5000 && guest.client.state() != Client::State::playing; ++i)
    guest.exchange(), server.attend(0ms);
  const double started_s = Guest::now_s();
  act(guest);
  Held held;
  while (Guest::now_s() < started_s + lead_s + duration_s + room_s &&
         guest.client.state() == Client::State::playing) {
    guest.exchange();
    server.attend(0ms);
    if (guest.client.bat() != nullptr) held.acknowledged = guest.client.bat()->input.count;
  }
  held.is_dropped = guest.client.state() != Client::State::playing;
  guest.leave();
  for (int i = 0; i < 500 && !server.ending(); ++i) server.attend(10ms);
  if (server.ending())
    held.ended = {.status = server.ending()->exit_status, .words = server.stderr_tail()};
  held.report = nlohmann::json::parse(std::ifstream(report), nullptr, false);
  return held;
}

void press_keys(Guest& guest, int count) {
  for (int i = 0; i < count / 2; ++i) guest.client.press(Key::up), guest.client.release(Key::up);
}

/// 150 frames of two key changes each, one after the other.
void send_frames(Guest& guest) {
  for (int i = 0; i < 150; ++i) press_keys(guest, 2), guest.flush();
}

TEST(ServeLimits, AFloodOfKeysIsNotFeltAndWhoSendsItIsNamed) {
  const Held held = held_by({}, [](Guest& guest) { press_keys(guest, 2000); });
  EXPECT_EQ(held.ended.status, 0) << held.ended.words;
  EXPECT_FALSE(held.is_dropped);
  EXPECT_EQ(held.report.at("keys_received"), 2000);
  EXPECT_NEAR(held.report.at("keys_over_limit").get<double>(), 2000.0 - key_limit_default, 60.0)
      << "they came within a quarter of a second";
  EXPECT_EQ(held.acknowledged, 2000u);
  EXPECT_THAT(
      held.ended.words,
      HasSubstr("the player of bat-0 sends more than 240 key changes a second (--key-limit)"));
  EXPECT_THAT(held.ended.words, HasSubstr("key changes above --key-limit were not felt"));
}

/// Pucks without room from wall to wall, and a bat beside them.
std::string row_in(const test::TemporaryFolder& folder) {
  std::ofstream scene(folder / "row.toml");
  scene << "[field]\nlength = 0.9375000000001\nwidth = 0.5\n"
           "[[bat]]\nposition = [0.45, 0.4]\nhalf_extent = [0.05, 0.05]\n";
  for (int k = 0; k < 15; ++k)
    scene << "[[puck]]\nposition = [" << 0.03125 * (2 * k + 1)
          << ", 0.125]\nradius = 0.03125\nvelocity = [" << (k == 7 ? 50.0 : 0.0) << ", 0.0]\n";
  return (folder / "row.toml").string();
}

TEST(ServeLimits, AGameWithMoreEventsThanItsBudgetGoesOnMoreSlowlyAndSaysWhy) {
  const test::TemporaryFolder folder("serve-budget");
  const std::string report = (folder / "report.json").string();
  Process server(test::binary_folder() + "/bin/rink-serve",
                 {"--scene", row_in(folder), "--port", "0", "--duration", "0.5", "--budget",
                  "20000", "--report", report},
                 {});
  for (int i = 0; i < 2000 && !server.ending(); ++i) server.attend(10ms);
  ASSERT_TRUE(server.ending()) << "it hangs";
  EXPECT_EQ(server.ending()->exit_status, 0);
  const std::string words = server.stderr_tail();
  EXPECT_THAT(words, HasSubstr("--budget: 20001 events within a simulated second"));
  EXPECT_THAT(words, HasSubstr("with no room"));
  EXPECT_THAT(words, HasSubstr("more slowly, by at most 166 events a tick"));
  EXPECT_THAT(words, HasSubstr("of its pace: 10 ticks were cut short"));
  const auto result = nlohmann::json::parse(std::ifstream(report), nullptr, false);
  EXPECT_EQ(result.at("ticks_cut_short"), 15) << "all but that of 0 s";
  EXPECT_NEAR(result.at("behind_s").get<double>(), 0.5, 1e-3);
  EXPECT_EQ(result.at("valid"), false);
  EXPECT_EQ(result.at("why_invalid"),
            "the physics exceeded --budget: 15 ticks were cut short, and the game fell 0.5 s "
            "behind");
}

/// Half a second of the row at a server whose one player takes turns whenever it may.
struct SlowTurns {
  Ended ended{};
  double reached_s = 0.0;  ///< by what the player was told
  nlohmann::json report{};
};
SlowTurns slow_turns(const std::vector<std::string>& pace) {
  const test::TemporaryFolder folder("serve-slow-turns");
  const std::string report = (folder / "report.json").string();
  std::vector<std::string> flags{"--scene",  row_in(folder), "--clients", "1",        "--port",
                                 "0",        "--duration",   "0.5",       "--budget", "20000",
                                 "--report", report};
  flags.insert(flags.end(), pace.begin(), pace.end());
  Process server(test::binary_folder() + "/bin/rink-serve", flags, {});
  const std::optional<std::string> place = place_of(server);
  if (!place) return {.ended = {.status = -1, .words = server.stderr_tail()}};
  Guest guest(*place, {.name = "bat-0"});
  SlowTurns slow;
  for (const double give_up_s = Guest::now_s() + 15.0;
       !server.ending() && Guest::now_s() < give_up_s;) {
    guest.exchange();
    server.attend(0ms);
    slow.reached_s = std::max(slow.reached_s, guest.client.turns().turn_s());
    if (guest.client.state() == Client::State::playing && guest.client.turns().has_turn())
      guest.client.end_turn();
  }
  if (server.ending())
    slow.ended = {.status = server.ending()->exit_status, .words = server.stderr_tail()};
  slow.report = nlohmann::json::parse(std::ifstream(report), nullptr, false);
  return slow;
}

TEST(ServeLimits, NeitherTurnsNorLogicalTimeHangWhereAGameHasMoreEventsThanItsBudget) {
  using Flags = std::vector<std::string>;
  for (const Flags& pace : {Flags{"--pace", "synchronous"}, Flags{"--time-management"},
                            Flags{"--pace", "synchronous", "--time-management"}}) {
    const bool is_time_managed = pace.back() == "--time-management";
    SCOPED_TRACE(testing::PrintToString(pace));
    const SlowTurns slow = slow_turns(pace);
    ASSERT_EQ(slow.ended.status, 0) << slow.ended.words;
    EXPECT_THAT(slow.ended.words, HasSubstr("--budget: 20001 events within a simulated second"));
    EXPECT_THAT(slow.ended.words, HasSubstr("by at most 166 events a tick"));
    EXPECT_EQ(slow.ended.words.find("shows ticks only once they are played") != std::string::npos,
              is_time_managed);
    EXPECT_EQ(slow.report.at("ticks_cut_short"), 15) << "all but that of 0 s";
    EXPECT_NEAR(slow.report.at("behind_s").get<double>(), 0.5, 1e-3);
    EXPECT_EQ(slow.report.at("valid"), false);
    EXPECT_LT(slow.reached_s, 1e-3);
  }
}

TEST(ServeLimits, AreAsWideAsTheyAreSaidToBe) {
  const Held held =
      held_by({"--key-limit", "0", "--rate-limit", "100000", "--frame-limit", "1000"}, send_frames);
  EXPECT_EQ(held.ended.status, 0) << held.ended.words;
  EXPECT_FALSE(held.is_dropped);
  EXPECT_EQ(held.report.at("lost_federates"), 0);
  EXPECT_EQ(held.report.at("keys_over_limit"), 0);
  EXPECT_EQ(held.report.at("keys_received"), 300);
  EXPECT_EQ(held.acknowledged, 300u);
  EXPECT_THAT(held.ended.words, testing::Not(HasSubstr("limit")));
  EXPECT_THAT(serve({"--key-limit", "0.5"}).words,
              HasSubstr("--key-limit: 0.5 is not a number from 1"));
}

TEST(ServeLimits, DropWhoSendsMoreBytesOrFramesPerSecond) {
  for (const auto& [flag, limit] : {std::pair{"--rate-limit", "1500"}, {"--frame-limit", "100"}}) {
    const Held held = held_by({flag, limit}, send_frames);
    EXPECT_TRUE(held.is_dropped) << flag;
    EXPECT_EQ(held.report.at("lost_federates"), 1) << flag;
    EXPECT_LT(held.report.at("keys_received"), 300) << flag;
    EXPECT_THAT(held.ended.words, HasSubstr("1 federates were lost")) << flag;
  }
}

}  // namespace
}  // namespace rink::game
