// The figures of a report, computed again from its evidence by a program that shares nothing with
// the one that wrote them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/command.h"

namespace rink::loadgen {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class RecomputeTest : public test::CommandTest {
 protected:
  RecomputeTest() : CommandTest("compare") {}

  void SetUp() override {
    if (std::system("python3 -c 'import tomllib' >/dev/null 2>&1") != 0)
      GTEST_SKIP() << "there is no python3 of version 3.11 or later";
  }

  void compare_by(const std::string& experiment) {
    std::ofstream(file("small.toml")) << experiment;
    ASSERT_EQ(run("compare " + file("small.toml") + " --force --out " + file("out")), 0) << said_;
  }

  /// Four clients in a small scene; runs take a second together.
  void compare_few(const std::string& what) {
    compare_by(
        "name = 'few'\nscene = 'arena'\nclients = 4\npopulation = 'per_client'\nview_area = 4.0\n"
        "policies = 'on-event'\nduration_s = 1\nwarm_up_s = 0.2\n" +
        what);
  }

  /// Changes the value of `figure` in the first line of the tidy table that has it by 1.
  void change(const std::string& figure) {
    std::string tidy = content("out/tidy.csv");
    const std::size_t at = tidy.find("," + figure + ",");
    ASSERT_NE(at, std::string::npos) << figure;
    const std::size_t end = tidy.find('\n', at), value = tidy.rfind(',', end) + 1;
    tidy.replace(value, end - value,
                 std::to_string(std::stod(tidy.substr(value, end - value)) + 1.0));
    std::ofstream(file("out/tidy.csv")) << tidy;
  }

  /// The exit status of recompute.py; what it prints is in `printed_`.
  int recompute() {
    const std::string script = test::source_folder() + "/docs/analysis/recompute.py";
    const int status = std::system(
        ("python3 " + script + " " + file("out") + " >" + file("printed") + " 2>&1").c_str());
    printed_ = content("printed");
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
};

class RecomputeLongTest : public RecomputeTest {
 protected:
  void SetUp() override {
    RecomputeTest::SetUp();
    if (!IsSkipped())
      compare(
          "schemes = ['none', 'aura with dwell(matches=3)', 'region']\nview_margin = [0, 0.3]\n"
          "extrapolate = [true, false]\n");
  }

  void compare(const std::string& what) {
    compare_by(
        "name = 'small'\nscene = 'crowd'\npolicies = ['periodic', 'on-event']\ntick_rate_hz = 20\n"
        "clients = 30\nduration_s = 2\ntransport = 'virtual'\n" +
        what);
  }
};

// It said that a column agreed, and that another one was skipped, for whatever reason the first run
// gave.
TEST_F(RecomputeTest, EachColumnSaysHowManyRunsWereCheckedAndWhyTheOthersWereNot) {
  compare_few(
      "transport = 'virtual'\nschemes = ['none', 'region']\n[[parts]]\nname = 'plain'\n"
      "[[parts]]\nname = 'points'\ncurves = true\nseeds = [1, 2]\n");
  EXPECT_EQ(recompute(), 0) << printed_;
  EXPECT_THAT(
      printed_,
      AllOf(
          HasSubstr("agrees   down_bytes_per_client_per_s (6 of 6 runs)\n"),
          HasSubstr("agrees   ticks (2 of 6 runs): points of curves without evidence (4)\n"),
          HasSubstr("skipped  filter_recall (0 of 6 runs): points of curves without evidence (4), "
                    "needs the game played again (rink compare --trace) (2)\n")));
  ASSERT_EQ(run("compare --trace " + file("out")), 0) << said_;
  EXPECT_EQ(recompute(), 0) << printed_;
  EXPECT_THAT(
      printed_,
      HasSubstr("agrees   filter_recall (2 of 6 runs): points of curves without evidence (4)\n"));
  ASSERT_EQ(run("compare " + file("small.toml") + " --keep-evidence --force --out " + file("out")),
            0);
  ASSERT_EQ(run("compare --trace " + file("out")), 0) << said_;
  EXPECT_EQ(recompute(), 0) << "points of curves have no late entries: " << printed_;
  EXPECT_THAT(printed_, HasSubstr("agrees   filter_recall (6 of 6 runs)\n"));
}

TEST_F(RecomputeTest, WhatIsRelevantByContactIsSaidNotToBeComputedAndContactsAreCounted) {
  compare_few("transport = 'virtual'\nschemes = ['none', 'region']\nrelevance = 'contact'\n");
  ASSERT_EQ(run("compare --trace " + file("out")), 0) << said_;
  EXPECT_EQ(recompute(), 0) << printed_;
  for (const char* figure :
       {"filter_recall", "delivered_precision", "displayed_error_mm_rms", "wasted_bytes_fraction"})
    EXPECT_THAT(printed_, HasSubstr(std::string("skipped  ") + figure +
                                    " (0 of 2 runs): relevance by contact is not computed here\n"));
  EXPECT_THAT(printed_, AllOf(HasSubstr("agrees   interactions (2 of 2 runs)\n"),
                              HasSubstr("agrees   missed_interactions (2 of 2 runs)\n"),
                              Not(HasSubstr("--trace"))));
}

// The means were read from the report that they were held against.
TEST_F(RecomputeTest, CostsOfATickFollowFromTheEvidenceAndWhatIsCopiedIsSaidToBe) {
  compare_few("schemes = ['region']\n");
  EXPECT_EQ(recompute(), 0) << printed_;
  for (const char* cost : {"physics_us_per_tick", "filter_us_per_tick", "send_us_per_tick"})
    EXPECT_THAT(printed_,
                HasSubstr(std::string("agrees   ") + cost + " (1 of 1 runs) within 0.0005 us"));
  for (const char* figure :
       {"ticks_on_time_fraction", "server_rss_bytes", "measured_s", "bots_cpu_share",
        "histogram_ns_per_record", "keys_sent", "late_sends_fraction"})
    EXPECT_THAT(printed_, HasSubstr(std::string("copied   ") + figure +
                                    " (1 runs): in the report of a process alone"));
  for (const char* figure : {"server_cpu_s", "bots_cpu_s", "busiest_node_cpu_s", "mean_node_cpu_s"})
    EXPECT_THAT(
        printed_,
        HasSubstr(std::string("skipped  ") + figure +
                  " (0 of 1 runs): what the kernel counted for a process, in runs.jsonl alone\n"));
  const std::string file_name = file("out/cells/client-server-region-on-event-4-seed1.server.json");
  std::string report = test::text_of(file_name);
  const std::size_t at = report.find("\"filter_us_per_tick\": ");
  ASSERT_NE(at, std::string::npos);
  report.insert(at + 22, "1");
  std::ofstream(file_name) << report;
  EXPECT_EQ(recompute(), 0) << "the report of the server is not what costs are computed from: "
                            << printed_;
  change("filter_us_per_tick");
  EXPECT_EQ(recompute(), 1) << printed_;
  EXPECT_THAT(printed_, HasSubstr("differs  filter_us_per_tick (1 of 1 runs)"));
}

// Their halo, claims and agreement were called the kernel's count.
TEST_F(RecomputeTest, WhatPeersSentAndWhatTheirPlayersSawIsComputedFromTheirReportAndEvidence) {
  compare_few(
      "transport = 'virtual'\nschemes = ['region']\nmodes = ['client-server', 'peer-to-peer']\n");
  ASSERT_EQ(run("compare --trace " + file("out")), 0) << said_;
  EXPECT_EQ(recompute(), 0) << printed_;
  for (const char* figure : {"halo_bytes_per_client_per_s", "claims_bytes_per_client_per_s",
                             "agreement_bytes_per_client_per_s"})
    EXPECT_THAT(printed_, HasSubstr(std::string("agrees   ") + figure + " (1 of 1 runs)\n"));
  EXPECT_THAT(
      printed_,
      AllOf(
          HasSubstr("agrees   delivered_recall (2 of 2 runs)\n"),
          HasSubstr(
              "agrees   wire_bytes_per_client_per_s (1 of 2 runs): not worked out for peers (1)\n"),
          HasSubstr("copied   ticks_on_time_fraction (1 runs)"), Not(HasSubstr("kernel"))));
}

TEST_F(RecomputeLongTest, EveryFigureComesOutTheSameFromTheEvidenceAndWhereEverythingWas) {
  ASSERT_EQ(run("compare --trace " + file("out")), 0) << said_;
  EXPECT_EQ(recompute(), 0) << printed_;
  for (const char* figure :
       {"filter_precision", "filter_recall", "delivered_precision", "delivered_recall",
        "missed_interactions", "late_entry_ms_p50", "position_error_mm_rms",
        "position_error_mm_p99", "displayed_error_mm_rms", "displayed_error_mm_p50",
        "displayed_error_mm_max", "wasted_bytes_fraction"})
    EXPECT_THAT(printed_, HasSubstr(std::string("agrees   ") + figure + " ("));
  EXPECT_THAT(printed_, AllOf(Not(HasSubstr("DIFFERS")), Not(HasSubstr("skipped"))))
      << "nothing is left unchecked";
  for (const char* figure :
       {"interactions", "update_age_samples", "displayed_error_mm_replaced_samples", "entities"})
    EXPECT_THAT(printed_, HasSubstr(std::string("agrees   ") + figure + " (15 of 15 runs)\n"));
}

// Mirrors that nothing has been said to yet stand at 0 s, which is before the run.
TEST_F(RecomputeLongTest, FiguresOfARunThatStartsWarmComeOutTheSameFromTheSavedGameOn) {
  compare("schemes = ['region']\nstart_s = 5\nwarm_up_s = 0\ndelay_ms = 50\nseeds = [1, 2]\n");
  ASSERT_EQ(run("compare --trace " + file("out")), 0) << said_;
  EXPECT_EQ(recompute(), 0) << printed_;
  EXPECT_THAT(printed_,
              AllOf(HasSubstr("agrees   delivered_recall (4 of 4 runs)"),
                    HasSubstr("agrees   displayed_error_mm_rms (4 of 4 runs)"),
                    HasSubstr("agrees   late_entry_ms_p50 ("), Not(HasSubstr("skipped"))));
}

TEST_F(RecomputeLongTest, EveryFigureThatNeedsNoPhysicsComesOutTheSameFromTheEvidence) {
  EXPECT_EQ(recompute(), 0) << printed_;
  for (const char* figure :
       {"down_bytes_per_client_per_s", "wire_bytes_per_client_per_s", "messages_per_s",
        "churn_per_client_per_s", "flapping_fraction", "fairness_jain", "control_bytes_fraction",
        "update_age_ms_p50", "ticks"})
    EXPECT_THAT(printed_, HasSubstr(std::string("agrees   ") + figure + " ("));
  EXPECT_THAT(printed_, HasSubstr("agrees   ticks (15 of 15 runs)\n"))
      << "1 + 2 x 2 schemes with margins, 2 + 1 policies with what they extrapolate";
  for (const char* figure : {"wasted_bytes_fraction", "filter_recall", "displayed_error_mm_rms"})
    EXPECT_THAT(printed_,
                HasSubstr(std::string("skipped  ") + figure +
                          " (0 of 15 runs): needs the game played again (rink compare --trace)\n"));
  EXPECT_THAT(printed_, AllOf(Not(HasSubstr("DIFFERS")), Not(HasSubstr("no whole evidence"))));
}

TEST_F(RecomputeLongTest, AFolderWithoutATidyTableIsNamedAndNotCalledDifferent) {
  std::filesystem::remove(file("out/tidy.csv"));
  EXPECT_EQ(recompute(), 2) << "nothing could be checked";
  EXPECT_THAT(printed_, AllOf(HasSubstr("recompute.py: " + file("out/tidy.csv") + ": No such file"),
                              Not(HasSubstr("Traceback"))));
}

TEST_F(RecomputeLongTest, ANumberThatSomebodyChangedIsNamed) {
  change("churn_per_client_per_s");
  const int status = recompute();
  EXPECT_EQ(status, 1) << printed_;
  EXPECT_THAT(printed_, AllOf(HasSubstr("DIFFERS  client-server-"),
                              HasSubstr("differs  churn_per_client_per_s"),
                              HasSubstr("agrees   fairness_jain")));
}

}  // namespace
}  // namespace rink::loadgen
