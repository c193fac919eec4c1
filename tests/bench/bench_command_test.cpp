// The command rink bench: its flags, one benchmark from choice to JSON, and its exit statuses.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/command.h"

namespace rink::bench {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class BenchCommand : public test::CommandTest {
 protected:
  BenchCommand() : CommandTest("bench") {}
  void SetUp() override {
    if (!std::filesystem::exists(test::binary_folder() + "/bin/rink-bench"))
      GTEST_SKIP() << "this build has no benchmarks";
  }
  int bench(const std::string& arguments) { return run("bench " + arguments); }
};

TEST_F(BenchCommand, RunsWhatTheFilterChoosesAndWritesItAsJson) {
  ASSERT_EQ(bench("--filter '^physics/collision/does_disc_overlap_box/' --json " +
                  file("out.json") + " --benchmark_min_time=0.001"),
            0)
      << said_;
  const nlohmann::json written = nlohmann::json::parse(content("out.json"));
  ASSERT_EQ(written.at("benchmarks").size(), 1u);
  const nlohmann::json& one = written.at("benchmarks")[0];
  EXPECT_THAT(one.at("name").get<std::string>(),
              HasSubstr("physics/collision/does_disc_overlap_box"));
  EXPECT_GT(one.at("real_time").get<double>(), 0.0);
  EXPECT_FALSE(one.contains("error_occurred"));
  EXPECT_THAT(printed_, HasSubstr("physics/collision/does_disc_overlap_box"));
}

TEST_F(BenchCommand, SetsTheCountersThatAreAskedForInColumns) {
  const std::string chosen =
      "--filter '^physics/collision/does_disc_overlap_box/' --benchmark_min_time=0.001 --columns ";
  ASSERT_EQ(bench(chosen + "time,error"), 0) << said_;
  EXPECT_THAT(printed_, testing::MatchesRegex(
                            "benchmark +time +error\nphysics/collision/does_disc_overlap_box "
                            "+[0-9.e+]+ ns +[0-9.e-]+\n"));
  EXPECT_EQ(bench(chosen + "error,harbours"), 2);
  EXPECT_THAT(said_, HasSubstr("--columns: none of these benchmarks counts harbours"));
}

TEST_F(BenchCommand, ListsWhatItHas) {
  ASSERT_EQ(bench("--benchmark_list_tests"), 0) << said_;
  for (const char* name : {"im/", "physics/", "rti/", "play/", "view/"})
    EXPECT_THAT(printed_, HasSubstr("\n" + std::string(name))) << "no benchmark of " << name;
}

TEST_F(BenchCommand, FailsWhereTheFilterChoosesNothing) {
  EXPECT_EQ(bench("--filter ^nothing_at_all$"), 1);
}

TEST_F(BenchCommand, RefusesAFlagWithoutItsValueAndOneThatItDoesNotKnow) {
  for (const char* flag : {"--filter", "--json", "--columns"}) {
    EXPECT_EQ(bench(flag), 2) << flag;
    EXPECT_THAT(said_, HasSubstr("--filter, --json and --columns need a value"));
  }
  EXPECT_EQ(bench("--fliter im"), 2);
  EXPECT_THAT(said_, HasSubstr("--fliter"));
}

TEST_F(BenchCommand, ExplainsItself) {
  for (const char* flag : {"--help", "-h"}) {
    EXPECT_EQ(bench(flag), 0);
    EXPECT_THAT(printed_, AllOf(HasSubstr("usage: rink bench"), HasSubstr("--filter REGEX"),
                                HasSubstr("Example:")));
  }
}

}  // namespace
}  // namespace rink::bench
