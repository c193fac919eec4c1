// rink serve match, two bots over TCP, and the record of what they played, as commands.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>

#include "game/control/key_log_file.h"
#include "game/process/process.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace rink::game {
namespace {

using testing::HasSubstr;
using namespace std::chrono_literals;

std::filesystem::path command(const std::string& name) {
  return test::binary_folder() + "/bin/rink-" + name;
}

int status_of(Process& process, std::chrono::seconds patience) {
  const auto limit = std::chrono::steady_clock::now() + patience;
  while (!process.ending() && std::chrono::steady_clock::now() < limit) process.attend(20ms);
  return process.ending() ? process.ending()->exit_status : -1;
}

/// Whether the server at `place` has so many federates, its own among them, within `patience`.
bool has_federates(const std::string& place, int count, std::chrono::seconds patience) {
  Process status(command("serve"), {"--status", place, "--every", "0.05"}, {});
  const std::string words = std::to_string(count) + " federates";
  const auto limit = std::chrono::steady_clock::now() + patience;
  while (!status.ending() && std::chrono::steady_clock::now() < limit) {
    status.attend(20ms);
    if (status.take_output().find(words) != std::string::npos) return true;
  }
  return false;
}

struct AHost : testing::Test {
  AHost() {
    host = std::make_unique<Process>(
        command("serve"), std::vector<std::string>{"match", "--port", "0", "--countdown", "0.2",
                                                   "--record", folder.path().string()});
    for (int i = 0; i < 500 && !place; ++i)
      host->attend(10ms), place = host->line_after("listening on ");
  }

  test::TemporaryFolder folder{"matches"};
  std::unique_ptr<Process> host;
  std::optional<std::string> place;
};

TEST_F(AHost, RecordsAMatchThatItsPlayersLeaveAndTheRecordReplaysToTheSameHash) {
  ASSERT_TRUE(place) << host->stderr_tail();
  Process duel(command("duel"), {"--connect", *place, "--duration", "2.5"}, {});
  EXPECT_EQ(status_of(duel, 20s), 0) << duel.stderr_tail();
  host->stop(5s);
  EXPECT_EQ(host->ending()->exit_status, 130) << host->stderr_tail();
  Process replay(command("replay"), {(folder / "match-1.keys").string()}, {});
  EXPECT_EQ(status_of(replay, 20s), 0) << replay.stderr_tail();
}

TEST_F(AHost, ThatIsKilledIsMissedByItsPlayersAtOnce) {
  ASSERT_TRUE(place) << host->stderr_tail();
  Process duel(command("duel"), {"--connect", *place, "--duration", "60"}, {});
  ASSERT_TRUE(has_federates(*place, 3, 20s)) << duel.stderr_tail();
  ASSERT_FALSE(duel.ending()) << duel.stderr_tail();
  host.reset();
  EXPECT_EQ(status_of(duel, 3s), 16) << duel.stderr_tail();
  EXPECT_THAT(duel.stderr_tail(), HasSubstr("the host has ended or left"));
}

TEST_F(AHost, ThatIsKilledLeavesTheRecordOfAllButTheLastSecond) {
  ASSERT_TRUE(place) << host->stderr_tail();
  Process duel(command("duel"), {"--connect", *place, "--duration", "60"}, {});
  const std::filesystem::path file = folder / "match-1.keys";
  const auto recorded_s = [&] {
    return std::filesystem::exists(file) ? read_key_log(file).until.value_or(0.0) : 0.0;
  };
  const auto limit = std::chrono::steady_clock::now() + 20s;
  while (recorded_s() < 2.0 && std::chrono::steady_clock::now() < limit) duel.attend(20ms);
  host.reset();  // by SIGKILL
  EXPECT_GE(recorded_s(), 2.0) << duel.stderr_tail();
  Process replay(command("replay"), {file.string()}, {});
  EXPECT_EQ(status_of(replay, 20s), 0) << replay.stderr_tail();
}

TEST(ServeMatch, RefusesASceneThatIsNoMatch) {
  Process crowd(command("serve"), {"crowd", "--port", "0"}, {});
  EXPECT_EQ(status_of(crowd, 10s), 2);
  EXPECT_THAT(crowd.stderr_tail(), HasSubstr("cannot be hosted: it has populations"));
}

TEST(ServeMatch, GoesOnWhereNoRecordCanBeWrittenAndSaysItOnce) {
  Process host(command("serve"),
               {"match", "--port", "0", "--countdown", "0.2", "--record", "/proc/nowhere"}, {});
  std::optional<std::string> place;
  for (int i = 0; i < 500 && !place; ++i)
    host.attend(10ms), place = host.line_after("listening on ");
  ASSERT_TRUE(place) << host.stderr_tail();
  for (int round = 0; round < 2; ++round) {
    Process duel(command("duel"), {"--connect", *place, "--duration", "1"}, {});
    EXPECT_EQ(status_of(duel, 20s), 0) << duel.stderr_tail();
  }
  host.attend(20ms);
  EXPECT_FALSE(host.ending());
  host.stop(5s);
  const std::string said = host.stderr_tail();
  EXPECT_THAT(said, HasSubstr("/proc/nowhere: this folder for records of matches cannot be made"));
  EXPECT_EQ(said.find("/proc/nowhere"), said.rfind("/proc/nowhere")) << said;
}

}  // namespace
}  // namespace rink::game
