// How `rink test` runs ctest: what its last lines say, and which of the long tests have their turn.
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>

#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace rink::house {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

/// A folder of tests for ctest, run as the launcher runs the project's.
class RunningTests : public testing::Test {
 protected:
  void add(const std::string& name, const std::string& does, const std::string& properties = {}) {
    std::ofstream list(folder_ / "CTestTestfile.cmake", std::ios::app);
    list << "add_test([=[" << name << "]=] sh -c [=[" << does << "]=])\n";
    if (!properties.empty())
      list << "set_tests_properties([=[" << name << "]=] PROPERTIES " << properties << ")\n";
  }

  /// A history of so many commits, or none at all.
  void commits(int count) {
    std::filesystem::create_directories(folder_ / "stubs");
    std::ofstream(folder_ / "stubs/git")
        << "#!/bin/sh\n"
        << (count < 0 ? "echo 'fatal: not a git repository' >&2; exit 128"
                      : "echo " + std::to_string(count))
        << '\n';
    std::filesystem::permissions(folder_ / "stubs/git", std::filesystem::perms::owner_all);
  }

  int run(const std::string& arguments = {}, const std::string& surroundings = {}) {
    const std::string own = folder_.path().string();
    const int status = std::system(("cd " + own + " && env PATH=\"" + own + "/stubs:$PATH\" " +
                                    surroundings + " python3 " + test::source_folder() +
                                    "/tests/run_ctest.py . " + arguments + " >printed 2>said")
                                       .c_str());
    printed_ = test::text_of(folder_ / "printed");
    said_ = test::text_of(folder_ / "said");
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  /// The names of the tests that passed.
  std::vector<std::string> passed() const {
    static const std::regex line(R"(Test +#\d+: (\S+) \.+ +Passed)");
    std::vector<std::string> names;
    for (std::sregex_iterator found(printed_.begin(), printed_.end(), line), end; found != end;
         ++found)
      names.push_back((*found)[1]);
    return names;
  }

  test::TemporaryFolder folder_{"ctest"};
  std::string printed_, said_;
};

TEST_F(RunningTests, EndsInTheSkippedOnesTheirReasonsAndTheTotal) {
  add("sails", "true");
  add("Anchors.Hold/in_mud",
      "echo 'anchor_test.cpp:7: Skipped'; echo 'no mud here & now'; echo '[  SKIPPED ] "
      "Anchors.Hold/in_mud'",
      R"(SKIP_REGULAR_EXPRESSION "\\[  SKIPPED \\]")");
  add("hashes/g++", "echo 'skipped: there is no g++ <6>'",
      "SKIP_REGULAR_EXPRESSION \"^skipped: \"");
  EXPECT_EQ(run(), 0) << said_;
  EXPECT_THAT(printed_,
              EndsWith("\nSkipped:\n  Anchors.Hold/in_mud: no mud here & now\n  hashes/g++: there "
                       "is no g++ <6>\n\n100% tests passed, 0 tests failed out of 3\n"));
  EXPECT_EQ(run("-R sails"), 0);
  EXPECT_THAT(printed_, AllOf(Not(HasSubstr("Skipped")),
                              EndsWith("\n100% tests passed, 0 tests failed out of 1\n")));
}

TEST_F(RunningTests, KeepsTheStatusAndTheOutputOfWhatFails) {
  add("sails", "true");
  add("leaks", "echo 'water in the bilge'; false");
  EXPECT_EQ(run(), 8);
  EXPECT_THAT(printed_, AllOf(HasSubstr("water in the bilge"), HasSubstr("2 - leaks (Failed)"),
                              EndsWith("\n50% tests passed, 1 tests failed out of 2\n")));
  EXPECT_NE(run("-R nothing"), 0) << "a choice of no tests is a mistake";
}

TEST_F(RunningTests, SevenCommitsInARowRunEachLongTestOnceAndNoOther) {
  constexpr int tests = 60;
  for (int i = 0; i < tests; ++i) add("Long.N" + std::to_string(i) + "/a+b", "true", "LABELS long");
  add("quick", "true");
  std::map<std::string, int> runs;
  for (int count = 480; count < 487; ++count) {
    commits(count);
    ASSERT_EQ(run("--long-share"), 0) << said_;
    for (const std::string& name : passed()) ++runs[name];
  }
  EXPECT_EQ(runs.size(), static_cast<std::size_t>(tests));
  for (const auto& [name, count] : runs) EXPECT_EQ(count, 1) << name;
  EXPECT_FALSE(runs.contains("quick"));
}

TEST_F(RunningTests, WithoutAHistoryTheTurnIsThatOfNoCommits) {
  for (int i = 0; i < 30; ++i) add("Long.N" + std::to_string(i), "true", "LABELS long");
  commits(0);
  ASSERT_EQ(run("--long-share"), 0) << said_;
  const auto first = passed();
  EXPECT_FALSE(first.empty());
  commits(-1);
  ASSERT_EQ(run("--long-share"), 0) << said_;
  EXPECT_THAT(passed(), testing::UnorderedElementsAreArray(first));
}

TEST_F(RunningTests, AFailureInTheShareIsOne) {
  for (int i = 0; i < 30; ++i) add("Long.N" + std::to_string(i), "false", "LABELS long");
  commits(3);
  EXPECT_EQ(run("--long-share"), 8);
  EXPECT_THAT(printed_, HasSubstr("0% tests passed"));
}

/// These wait for the limit itself.
class RunningTestsLong : public RunningTests {
 protected:
  /// A long test whose turn comes after so many commits.
  void add_long(int count, const std::string& does) {
    commits(count);
    for (int i = 0; i < 100; ++i) {
      const std::string name = "Long.N" + std::to_string(added_++);
      std::ofstream(folder_ / "crc.py")
          << "import zlib\nprint(zlib.crc32(b'" << name << "') % 7)\n";
      ASSERT_EQ(std::system(
                    ("python3 " + (folder_ / "crc.py").string() + " >" + (folder_ / "crc").string())
                        .c_str()),
                0);
      if (std::stoi(test::text_of(folder_ / "crc")) == count % 7)
        return add(name, does, "LABELS long"), void(names_.push_back(name));
    }
    FAIL() << "no name has its turn then";
  }
  int added_ = 0;
  std::vector<std::string> names_;
};

TEST_F(RunningTestsLong, NamesWhatTheLimitCutsOffAndIsNoFailureForThat) {
  add_long(2, "sleep 3.4");
  add_long(2, "sleep 60");
  add_long(2, "true");
  EXPECT_EQ(run("--long-share -j 1", "RINK_LONG_SHARE_S=4"), 0) << printed_ << said_;
  EXPECT_THAT(passed(), testing::ElementsAre(names_[0]));
  EXPECT_THAT(printed_,
              AllOf(HasSubstr(names_[1] + ": cut off by the limit of 4 s, after "),
                    HasSubstr(names_[2] + ": cut off by the limit of 4 s before it began")));
}

TEST_F(RunningTestsLong, WhatTakesHalfOfTheTimeFails) {
  add_long(2, "sleep 60");
  EXPECT_NE(run("--long-share", "RINK_LONG_SHARE_S=2"), 0) << printed_;
  EXPECT_THAT(printed_, HasSubstr("hangs, or must be split"));
}

TEST_F(RunningTestsLong, AFailureBesideWhatIsCutOffIsOne) {
  add_long(2, "sleep 3.4; false");
  add_long(2, "sleep 60");
  EXPECT_EQ(run("--long-share -j 1", "RINK_LONG_SHARE_S=4"), 8) << printed_;
}

}  // namespace
}  // namespace rink::house
