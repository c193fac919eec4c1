// A server and its bots over loopback, one of which the kernel does not run for a while: the stall
// is in every age that it lengthened, and no sample is missing.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "game/net/address.h"
#include "game/net/server/serve_status.h"
#include "game/process/process.h"
#include "rti/management/federation_report.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace rink::loadgen {
namespace {

using namespace std::chrono_literals;
using SteadyClock = std::chrono::steady_clock;

double now_s() {
  return std::chrono::duration<double>(SteadyClock::now().time_since_epoch()).count();
}

/// Four bats among forty pucks at 50 Hz, said to everybody at every tick: 120 ticks are counted.
class StallLong : public testing::Test {
 protected:
  static constexpr double rate_hz = 50.0, warm_up_s = 0.1, duration_s = 2.5;
  static constexpr std::uint32_t clients = 4, bodies = 44;
  static constexpr std::uint64_t ticks = 120;

  enum class Who { server, bots };

  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  /// Runs both to their ends, and `who` not at all for `stall_s` after the game has begun.
  void play(Who who, double stall_s) {
    const auto with = [](std::vector<std::string> flags) {
      for (const auto& [flag, value] :
           {std::pair{"--duration", duration_s}, {"--warm-up", warm_up_s}, {"--patience", 20.0}})
        flags.insert(flags.end(), {flag, std::to_string(value)});
      return flags;
    };
    game::Process server(test::binary_folder() + "/bin/rink-serve",
                         with({"--scene", "crowd", "--bat-count", "4", "--puck-count", "40",
                               "--clients", "4", "--rate", "50", "--scheme", "none", "--policy",
                               "periodic", "--port", "0", "--report", file("server.json")}),
                         {});
    std::optional<std::string> place;
    for (int i = 0; i < 1000 && !place; ++i)
      server.attend(10ms), place = server.line_after("listening on ");
    ASSERT_TRUE(place) << server.stderr_tail();
    game::Process bots(
        test::binary_folder() + "/bin/rink-bots",
        with({"--connect", *place, "--count", "4", "--seed", "7", "--report", file("bots.json")}),
        {});
    await_game(*place);
    game::Process& stopped = who == Who::server ? server : bots;
    ASSERT_EQ(kill(stopped.id(), SIGSTOP), 0);
    while (!is_stopped(stopped)) std::this_thread::sleep_for(1ms);
    const double from_s = now_s();
    std::this_thread::sleep_for(std::chrono::duration<double>(stall_s));
    stalled_s_ = now_s() - from_s;
    ASSERT_EQ(kill(stopped.id(), SIGCONT), 0);
    const auto limit = SteadyClock::now() + 20s;
    while ((!server.ending() || !bots.ending()) && SteadyClock::now() < limit)
      server.attend(5ms), bots.attend(5ms);
    ASSERT_TRUE(server.ending() && bots.ending());
    EXPECT_EQ(server.ending()->exit_status, 0) << server.stderr_tail();
    EXPECT_EQ(bots.ending()->exit_status, 0) << bots.stderr_tail();
    server_report_ = nlohmann::json::parse(std::ifstream(file("server.json")), nullptr, false);
    ages_ =
        nlohmann::json::parse(std::ifstream(file("bots.json")), nullptr, false)["update_age_ms"];
  }

  /// Returns when everybody is there and has been sent twenty more ticks, of which some may be from
  /// before the start: then warm-up is over.
  static void await_game(const std::string& place) {
    const auto [address, port] = game::address_and_port("--status", place);
    const auto limit = SteadyClock::now() + 20s;
    std::optional<std::uint64_t> at_first;
    for (; SteadyClock::now() < limit; std::this_thread::sleep_for(10ms)) {
      const game::StatusAnswer answer = game::ask_status({.address = address, .port = port}, now_s);
      if (!answer.reports || answer.reports->empty() ||
          answer.reports->front().federates.size() <= clients)
        continue;
      std::uint64_t heard = 0;
      for (const rti::FederateReport& federate : answer.reports->front().federates)
        heard = std::max(heard, federate.counts.reflections_received);
      if (!at_first) at_first = heard;
      if (heard >= *at_first + 20 * bodies) return;
    }
  }
  /// The state in /proc/PID/stat follows the command in brackets: T of a process that a signal
  /// stopped.
  static bool is_stopped(const game::Process& process) {
    const std::string stat = test::text_of("/proc/" + std::to_string(process.id()) + "/stat");
    return stat.substr(stat.rfind(')') + 1).starts_with(" T");
  }

  /// Of the ticks that were due while nobody could send or hear them, the n-th last is at least n -
  /// 1 periods old when it comes.
  void expect_the_stall_in_the_ages() const {
    const double period_s = 1.0 / rate_hz, n = std::floor(stalled_s_ / period_s + 1e-9);
    EXPECT_EQ(server_report_["ticks"], ticks);
    EXPECT_EQ(ages_["count"], clients * ticks);
    EXPECT_GE(ages_["max_s"].get<double>(), stalled_s_ - period_s);
    EXPECT_LE(ages_["max_s"].get<double>(), stalled_s_ + 1.0) << "the slack of a busy machine";
    EXPECT_GE(ages_["sum_s"].get<double>(), clients * period_s * n * (n - 1) / 2.0);
  }

  test::TemporaryFolder folder_{"stall"};
  double stalled_s_ = 0.0;
  nlohmann::json server_report_, ages_;
};

TEST_F(StallLong, OfTheBotsIsInTheAgeOfEveryTickThatTheyHeardLate) {
  for (const double stall_s : {0.06, 0.5}) {
    SCOPED_TRACE(stall_s);
    play(Who::bots, stall_s);
    if (HasFatalFailure()) return;
    expect_the_stall_in_the_ages();
  }
}

/// The ticks that it missed it makes up for, late; none but those due in the last period of the
/// stall can be finished before the next is due.
TEST_F(StallLong, OfTheServerIsInTheAgeOfEveryTickThatItPlayedLate) {
  for (const double stall_s : {0.06, 0.5}) {
    SCOPED_TRACE(stall_s);
    play(Who::server, stall_s);
    if (HasFatalFailure()) return;
    expect_the_stall_in_the_ages();
    const double late = std::floor(stalled_s_ * rate_hz + 1e-9) - 1.0;
    EXPECT_LE(server_report_["ticks_on_time_fraction"].get<double>(), 1.0 - late / ticks + 1e-12);
    EXPECT_GT(server_report_["ticks_on_time_fraction"].get<double>(), 0.2)
        << "the others are in time, but for what a busy machine makes late";
  }
}

}  // namespace
}  // namespace rink::loadgen
