// Federates in processes of their own: one that is stopped for a while is not lost, one that is
// killed is noticed within a second.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>

#include "tests/rti/rig.h"

namespace rink::rti::testing {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using ::testing::Contains;
using ::testing::Not;

/// [s] since the first call, as the rig's clock begins at 0.
double now_s() {
  static const Clock::time_point start = Clock::now();
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The child: joins and lives until it is killed. Never returns.
[[noreturn]] void be_a_federate(std::uint16_t port) {
  alarm(30);  // an orphan ends by itself
  FederateAmbassador silent;
  Ambassador ambassador(harbour(), silent);
  TcpTransport tcp;
  FederateLink link(ambassador, tcp, tcp.connect("127.0.0.1", port));
  FederateLinks links;
  links.add(link);
  ambassador.join("rink", "child", "tester");
  while (!link.is_finished()) {
    links.flush(now_s());
    tcp.poll(10ms, links);
  }
  _exit(1);
}

struct LostFederate : ::testing::Test {
  Rig rig{Carrier::tcp};
  Station* watcher = nullptr;
  pid_t child = -1;

  void SetUp() override {
    rig.now = now_s();
    child = fork();
    if (child == 0) be_a_federate(rig.port());
    ASSERT_GT(child, 0);
    watcher = &rig.join("watcher");
    watcher->ambassador.watch_federates();
    ASSERT_TRUE(run_until([&] { return rig.execution().federate_count() == 2; }, 10.0));
  }
  void TearDown() override {
    if (child > 0) kill(child, SIGKILL), waitpid(child, nullptr, 0);
  }
  /// True as soon as `is_done`, false after `limit_s` [s].
  template <class Done>
  bool run_until(Done is_done, double limit_s) {
    for (const double end = now_s() + limit_s; now_s() < end; rig.round()) {
      rig.now = now_s();
      if (is_done()) return true;
    }
    return is_done();
  }
};

TEST_F(LostFederate, KilledIsNoticedWithinASecond) {
  const double killed_s = now_s();
  kill(child, SIGKILL);
  EXPECT_TRUE(run_until([&] { return rig.execution().federate_count() == 1; }, 5.0));
  EXPECT_LT(now_s() - killed_s, 1.0);
  run_until(
      [&] { return !watcher->heard.log.empty() && watcher->heard.log.back() == "child lost"; },
      1.0);
  EXPECT_THAT(watcher->heard.log, Contains("child lost"));
}

TEST_F(LostFederate, StoppedForTwoSecondsItIsStillThere) {
  kill(child, SIGSTOP);
  EXPECT_FALSE(run_until([&] { return rig.execution().federate_count() == 1; }, 2.0));
  kill(child, SIGCONT);
  EXPECT_FALSE(run_until([&] { return rig.execution().federate_count() == 1; }, 1.5))
      << "and it speaks again";
  EXPECT_THAT(watcher->heard.log, Not(Contains("child lost")));
  EXPECT_LT(rig.execution().report().federates.back().counts.silence_s, 1.5);
}

}  // namespace
}  // namespace rink::rti::testing
