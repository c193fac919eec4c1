// The command rink replay: a recorded game comes to the same hash from its log alone, and what is
// wrong with a log is said.
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "game/control/key_log_file.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace rink::game {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

using test::text_of;

class ReplayCommand : public ::testing::Test {
 protected:
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  /// The exit status of `rink COMMAND`; all that it says is in `said_`, but for what goes to
  /// another standard output.
  int run(const std::string& command, const std::string& output = "&2") {
    const int status = std::system(
        (test::binary_folder() + "/bin/rink-" + command + " 2>" + file("out") + " >" + output)
            .c_str());
    said_ = text_of(file("out"));
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  void record() {
    ASSERT_EQ(run("simulate match --players chaser,random --seed 3 --until 20 --record " +
                  file("keys") + " --summary " + file("summary")),
              0)
        << said_;
  }
  int replay() { return run("replay " + file("keys")); }

  test::TemporaryFolder folder_{"replay"};
  std::string said_;
};

TEST_F(ReplayCommand, ComesToTheHashOfTheRecordedGame) {
  record();
  const std::optional<std::uint64_t> hash = read_key_log(std::filesystem::path(file("keys"))).hash;
  ASSERT_TRUE(hash);
  std::ostringstream text;
  text << std::hex << *hash;
  EXPECT_THAT(text_of(file("summary")), HasSubstr(text.str()));
  EXPECT_EQ(replay(), 0) << said_;
  EXPECT_THAT(said_, AllOf(HasSubstr("scene match, seed 3, 2 bats"),
                           HasSubstr(text.str() + " as recorded")));
}

TEST_F(ReplayCommand, SaysThatItsWordsCouldNotBeWritten) {
  record();
  EXPECT_EQ(run("replay " + file("keys"), "/dev/full"), 2);
  EXPECT_THAT(
      said_,
      HasSubstr("the standard output: cannot be written to its end: No space left on device"));
}

TEST_F(ReplayCommand, NeedsNothingButTheLog) {
  std::ofstream(file("arena.toml"))
      << "[field]\nlength = 6.0\nwidth = 4.0\n\n[friction]\npucks = 0.4\n[materials]\nfriction = "
         "0.2\n[[population]]\nkind = \"bat\"\ncount = 4\n[[population]]\nkind = \"puck\"\ncount = "
         "30\nmean_speed = 1.0\n";
  ASSERT_EQ(run("simulate " + file("arena.toml") +
                " --bats 8 --seed 5 --players random --until 5 --record " + file("keys")),
            0)
      << said_;
  std::filesystem::remove(file("arena.toml"));
  EXPECT_EQ(replay(), 0) << said_;
  EXPECT_THAT(said_, HasSubstr("scene arena, seed 5, 8 bats"));
}

TEST_F(ReplayCommand, SaysWhatStandsInAFileThatIsNoLogWithoutItsControlCharacters) {
  std::ofstream(file("keys")) << "\x1b[31m\x01\xff" << std::string(5000, 'x') << '\n';
  EXPECT_EQ(replay(), 2);
  EXPECT_THAT(said_, AllOf(HasSubstr(file("keys") + ":1: found \"?[31m??xxx"),
                           HasSubstr("expected the line \"rink-keys 1\"")));
  EXPECT_LT(said_.size(), 300u);
  std::ofstream(file("keys")) << "rink-keys 1\nscene match\nuntil 1e300\n";
  EXPECT_EQ(replay(), 2);
  EXPECT_THAT(said_, AllOf(HasSubstr(":3: found \"1e300\""), HasSubstr("a time from 0 to 1e9 s")));
}

TEST_F(ReplayCommand, EndsWithStatus1IfTheGameEndsInAnotherHash) {
  record();
  KeyLog log = read_key_log(std::filesystem::path(file("keys")));
  log.events.erase(log.events.begin());
  write_key_log(std::filesystem::path(file("keys")), log);
  EXPECT_EQ(replay(), 1);
  EXPECT_THAT(said_,
              AllOf(HasSubstr(file("keys")), HasSubstr("after 20 s the game ends in the hash")));
}

TEST_F(ReplayCommand, EndsWithStatus2AndNamesTheLineOfAnAlteredOrCutLog) {
  record();
  const std::string text = text_of(file("keys"));
  const auto lines = std::count(text.begin(), text.end(), '\n');
  std::string altered = text;
  altered[text.find("restitution")] = 'R';
  std::ofstream(file("keys")) << altered;
  EXPECT_EQ(replay(), 2);
  EXPECT_THAT(said_,
              AllOf(HasSubstr(file("keys") + ":" + std::to_string(lines)), HasSubstr("altered")));
  std::ofstream(file("keys")) << text.substr(0, text.rfind("end "));
  EXPECT_EQ(replay(), 2);
  EXPECT_THAT(said_, HasSubstr("lacks its last line"));
  std::ofstream(file("keys")) << "rink-keys 1\nscene match\n";
  EXPECT_EQ(replay(), 2);
  EXPECT_THAT(said_, AllOf(HasSubstr("until"), HasSubstr("hash"), HasSubstr("end")));
  std::ofstream(file("keys")) << "scene match\n";
  EXPECT_EQ(replay(), 2);
  EXPECT_THAT(said_, HasSubstr(file("keys") + ":1"));
  EXPECT_EQ(run("replay " + file("missing")), 2);
  EXPECT_EQ(run("replay"), 2);
}

}  // namespace
}  // namespace rink::game
