// The figures of a report in virtual time, computed again from its evidence by a program that shares nothing with the one that wrote them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/command.h"

namespace rink::loadgen {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class RecomputeLongTest : public test::CommandTest {
 protected:
  RecomputeLongTest() : CommandTest("compare") {}

  void SetUp() override {
    if (std::system("python3 -c 'import json' >/dev/null 2>&1") != 0) GTEST_SKIP() << "there is no python3";
    compare("schemes = ['none', 'aura with dwell(matches=3)', 'region']\nview_margin = [0, 0.3]\nextrapolate = [true, false]\n");
  }

  void compare(const std::string& what) {
    std::ofstream(file("small.toml")) << "name = 'small'\nscene = 'crowd'\npolicies = ['periodic', 'on-event']\ntick_rate_hz = 20\nclients = 30\n"
                                         "duration_s = 2\ntransport = 'virtual'\n"
                                      << what;
    ASSERT_EQ(run("compare " + file("small.toml") + " --force --out " + file("out")), 0) << said_;
  }

  /// The exit status of recompute.py; what it prints is in `printed_`.
  int recompute() {
    const std::string script = test::source_folder() + "/docs/analysis/recompute.py";
    const int status = std::system(("python3 " + script + " " + file("out") + " >" + file("printed") + " 2>&1").c_str());
    printed_ = content("printed");
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
};

TEST_F(RecomputeLongTest, EveryFigureComesOutTheSameFromTheEvidenceAndWhereEverythingWas) {
  ASSERT_EQ(run("compare --trace " + file("out")), 0) << said_;
  EXPECT_EQ(recompute(), 0) << printed_;
  for (const char* figure : {"filter_precision", "filter_recall", "delivered_precision", "delivered_recall", "missed_interactions", "late_entry_ms_p50", "position_error_mm_rms",
                             "position_error_mm_p99", "displayed_error_mm_rms", "displayed_error_mm_p50", "displayed_error_mm_max", "wasted_bytes_fraction"})
    EXPECT_THAT(printed_, HasSubstr(std::string("agrees   ") + figure + " ("));
  EXPECT_THAT(printed_, AllOf(Not(HasSubstr("DIFFERS")), Not(HasSubstr("skipped")))) << "nothing is left unchecked";
}

// Mirrors that nothing has been said to yet stand at 0 s, which is before the run.
TEST_F(RecomputeLongTest, FiguresOfARunThatStartsWarmComeOutTheSameFromTheSavedGameOn) {
  compare("schemes = ['region']\nstart_s = 5\nwarm_up_s = 0\ndelay_ms = 50\nseeds = [1, 2]\n");
  ASSERT_EQ(run("compare --trace " + file("out")), 0) << said_;
  EXPECT_EQ(recompute(), 0) << printed_;
  EXPECT_THAT(printed_, AllOf(HasSubstr("agrees   delivered_recall (4 runs)"), HasSubstr("agrees   displayed_error_mm_rms (4 runs)"), HasSubstr("agrees   late_entry_ms_p50 ("), Not(HasSubstr("skipped"))));
}

TEST_F(RecomputeLongTest, EveryFigureThatNeedsNoPhysicsComesOutTheSameFromTheEvidence) {
  EXPECT_EQ(recompute(), 0) << printed_;
  for (const char* figure : {"down_bytes_per_client_per_s", "wire_bytes_per_client_per_s", "messages_per_s", "churn_per_client_per_s", "flapping_fraction",
                             "fairness_jain", "control_bytes_fraction", "update_age_ms_p50", "ticks"})
    EXPECT_THAT(printed_, HasSubstr(std::string("agrees   ") + figure + " ("));
  EXPECT_THAT(printed_, HasSubstr("agrees   ticks (15 runs)")) << "1 + 2 x 2 schemes with margins, 2 + 1 policies with what they extrapolate";
  for (const char* figure : {"wasted_bytes_fraction", "filter_recall", "displayed_error_mm_rms"})
    EXPECT_THAT(printed_, HasSubstr(std::string("skipped  ") + figure + ": needs the game played again (rink compare --trace)"));
  EXPECT_THAT(printed_, AllOf(Not(HasSubstr("DIFFERS")), Not(HasSubstr("no whole evidence"))));
}

TEST_F(RecomputeLongTest, AFolderWithoutATidyTableIsNamedAndNotCalledDifferent) {
  std::filesystem::remove(file("out/tidy.csv"));
  EXPECT_EQ(recompute(), 2) << "nothing could be checked";
  EXPECT_THAT(printed_, AllOf(HasSubstr("recompute.py: " + file("out/tidy.csv") + ": No such file"), Not(HasSubstr("Traceback"))));
}

TEST_F(RecomputeLongTest, ANumberThatSomebodyChangedIsNamed) {
  std::string tidy = content("out/tidy.csv");
  const std::size_t at = tidy.find(",churn_per_client_per_s,1/s,");
  ASSERT_NE(at, std::string::npos);
  tidy.insert(tidy.find('\n', at), "1");  // a digit more
  std::ofstream(file("out/tidy.csv")) << tidy;
  const int status = recompute();
  EXPECT_EQ(status, 1) << printed_;
  EXPECT_THAT(printed_, AllOf(HasSubstr("DIFFERS  client-server-"), HasSubstr("differs  churn_per_client_per_s"), HasSubstr("agrees   fairness_jain")));
}

}  // namespace
}  // namespace rink::loadgen
