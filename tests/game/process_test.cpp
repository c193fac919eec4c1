// Processes that are started and watched: what they say, how they end, and that none is left over.
#include "game/process/process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <fstream>
#include <system_error>

#include "tests/temporary_folder.h"

namespace rink::game {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

std::vector<std::string> script(const std::string& words) { return {"-c", words}; }

void attend_to_its_end(Process& process) {
  while (!process.ending()) process.attend(10ms);
}

TEST(Process, SaysHowItEnded) {
  Process three("/bin/sh", script("exit 3"));
  attend_to_its_end(three);
  EXPECT_FALSE(three.ending()->is_success());
  EXPECT_EQ(three.ending()->text(), "ended with status 3");
  Process killed("/bin/sh", script("kill -s SEGV $$"));
  attend_to_its_end(killed);
  EXPECT_EQ(killed.ending()->text(), "was ended by signal 11 (Segmentation fault)");
}

TEST(Process, ThatCannotBeStartedIsNamed) {
  try {
    const Process none("/no/such/program", {});
    FAIL() << "it was started";
  } catch (const std::system_error& error) {
    EXPECT_STREQ(error.what(), "cannot start /no/such/program: No such file or directory");
  }
}

TEST(Process, TellsOutputAndErrorsApartUnlessTheyAreJoined) {
  const std::vector<std::string> words = script("echo one; echo two >&2; echo three");
  Process apart("/bin/sh", words);
  attend_to_its_end(apart);
  EXPECT_EQ(apart.line_after("th"), "ree");
  EXPECT_EQ(apart.stderr_tail(), "two");
  EXPECT_EQ(apart.take_output(), "one\nthree\n");
  Process joined("/bin/sh", words, {.joins_errors = true});
  attend_to_its_end(joined);
  EXPECT_EQ(joined.stderr_tail(), "");
  EXPECT_EQ(joined.take_output(), "one\ntwo\nthree\n");
  EXPECT_EQ(joined.take_output(), "");
}

TEST(Process, ThatSaysMoreThanAPipeHoldsIsNotHeldUp) {
  Process chatterer("/bin/sh", script("i=0; while [ $i -lt 9000 ]; do echo 0123456789 0123456789; "
                                      "i=$((i + 1)); done; echo the end"));
  attend_to_its_end(chatterer);
  EXPECT_TRUE(chatterer.ending()->is_success());
  EXPECT_THAT(chatterer.take_output(), HasSubstr("the end\n"));
}

TEST(Process, RunsOnTheProcessorsThatItIsGiven) {
  const int last = allowed_processors().back();
  Process process("/bin/sh", script("grep Cpus_allowed_list /proc/self/status"),
                  {.processors = {last}});
  attend_to_its_end(process);
  EXPECT_EQ(process.line_after("Cpus_allowed_list:\t"), std::to_string(last));
}

TEST(Process, IsGoneWithItsObject) {
  pid_t id = 0;
  {
    const Process sleeper("/bin/sleep", {"100"});
    id = sleeper.id();
    EXPECT_EQ(getpgid(id), id);
  }
  EXPECT_EQ(kill(id, 0), -1);
  EXPECT_EQ(errno, ESRCH);
}

TEST(Process, IsSentTheChosenSignalWhenItsOwnerDies) {
  const test::TemporaryFolder folder("process");
  const std::string note = (folder.path() / "note").string();
  const pid_t owner = fork();
  if (owner == 0) {
    Process heir("/bin/sh",
                 script("trap 'echo asked > " + note +
                        "; exit' TERM; echo ready; while true; do sleep 0.01; done"),
                 {.signal_when_orphaned = SIGTERM});
    while (!heir.line_after("ready")) heir.attend(10ms);
    _exit(0);  // as if killed: no destructor runs
  }
  ASSERT_GT(owner, 0);
  ASSERT_EQ(waitpid(owner, nullptr, 0), owner);
  std::string said;
  for (int look = 0; look < 1000 && said.empty(); ++look) {
    usleep(10'000);
    std::ifstream(note) >> said;
  }
  EXPECT_EQ(said, "asked");
}

}  // namespace
}  // namespace rink::game
