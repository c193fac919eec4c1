// The page and its plots: well-formed, complete, and safe against text from outside.
#include "loadgen/report/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "loadgen/measure/judge_run.h"
#include "tests/loadgen/report/canned_reports.h"
#include "tests/loadgen/report/markup.h"

namespace rink::loadgen {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::vector<RunRecord> some_runs() {
  std::vector<RunRecord> runs;
  for (const std::uint64_t seed : {1, 2}) {
    for (const std::uint32_t clients : {10u, 100u}) {
      for (const char* scheme : {"none", "grid", "region"}) {
        const Cell cell{"client-server", scheme, "periodic", clients, seed};
        RunRecord run = record_for(small_experiment(), cell);
        judge(run, canned_server_report(cell), canned_bots_report(cell));
        run.state_hash = "hash" + std::to_string(seed) + scheme + std::to_string(clients);
        runs.push_back(run);
      }
    }
  }
  return runs;
}

const Provenance provenance{{{"kernel", "Linux <6>"}, {"command", "rink-compare 'a & b'"}}};

TEST(Report, IsWellFormedAndHoldsEveryCell) {
  const auto runs = some_runs();
  const std::string html = report_of(small_experiment(), runs, provenance).html;
  EXPECT_EQ(unbalanced(html), "");
  for (const RunRecord& run : runs) EXPECT_THAT(html, HasSubstr(run.state_hash));
}

TEST(Report, NeedsNeitherNetworkNorScript) {
  const std::string html = report_of(small_experiment(), some_runs(), provenance).html;
  EXPECT_THAT(html,
              AllOf(Not(HasSubstr("<script")), Not(HasSubstr("src=")), Not(HasSubstr("href=\"h")),
                    Not(HasSubstr("url(")), Not(HasSubstr("@import"))));
}

TEST(Report, TextFromOutsideIsEscaped) {
  auto runs = some_runs();
  runs[0].valid = false;
  runs[0].why_invalid = "said: <script>alert('x')</script> & died\x1b[31m";
  runs[1].cell.scheme = "<b>\"grid\"";
  Experiment experiment = small_experiment();
  experiment.name = "</title><i>";
  experiment.text = "name = \"</pre>\"";
  const std::string html = report_of(experiment, runs, provenance).html;
  EXPECT_EQ(unbalanced(html), "");
  EXPECT_THAT(html,
              AllOf(Not(HasSubstr("<script")), Not(HasSubstr("<b>\"")), Not(HasSubstr("\x1b"))));
  EXPECT_THAT(html, AllOf(HasSubstr("&lt;script&gt;alert(&#39;x&#39;)"),
                          HasSubstr("Linux &lt;6&gt;"), HasSubstr("a &amp; b")));
}

TEST(Report, InvalidRunsAreListedWithTheirReasonAndDisagreementIsShown) {
  auto runs = some_runs();
  runs[3].valid = false;
  runs[3].why_invalid = "the bots fell asleep";
  const std::string html = report_of(small_experiment(), runs, provenance).html;
  EXPECT_THAT(html, AllOf(HasSubstr("Runs that do not count"), HasSubstr("the bots fell asleep"),
                          HasSubstr("same state hash: NO")));
  for (RunRecord& run : runs) run.state_hash = "one-and-the-same";
  EXPECT_THAT(report_of(small_experiment(), runs, provenance).html,
              HasSubstr("same state hash: <b>yes</b>"));
}

TEST(Report, HeadsItsFiguresWithTheTermsOfTheField) {
  const auto runs = some_runs();
  CellLatencies latencies{runs[0].cell, {}, {}, {}};
  for (int i = 1; i <= 100; ++i) {
    latencies.update_latency.record(i * 1e-3);
    latencies.input_latency.record(i * 1e-3);
    latencies.discovery_latency.record(i * 1e-3);
  }
  const std::string html =
      report_of(small_experiment(), runs, provenance, {.latencies = std::span(&latencies, 1)}).html;
  for (const char* heading :
       {"<h3>Update latency (update age)</h3>", "<h3>Input latency (key to effect)</h3>",
        "<h3>Discovery latency (late entry)</h3>", "<h2>Bytes against dead-reckoning error</h2>",
        "<h3>Reduction factors (gains)</h3>", "<h2>Cost of a tick (wall time)</h2>",
        "dead-reckoning error<br/>now (displayed)", "at the time stamp<br/>(matched)"})
    EXPECT_THAT(html, HasSubstr(heading));
  for (const char* term : {"A replica is", "area fraction is", "CPU time is"})
    EXPECT_THAT(html, HasSubstr(term));
}

TEST(Report, WithoutAnyFigureThereIsStillAPage) {
  EXPECT_EQ(unbalanced(report_of(small_experiment(), {}, provenance).html), "");
  std::vector<RunRecord> runs{
      record_for(small_experiment(), {"client-server", "none", "periodic", 1, 1})};
  runs[0].why_invalid = "crashed";
  const std::string html = report_of(small_experiment(), runs, provenance).html;
  EXPECT_EQ(unbalanced(html), "");
  EXPECT_THAT(html, AllOf(HasSubstr("crashed"), Not(HasSubstr("=\"nan")), Not(HasSubstr("=\"-nan")),
                          Not(HasSubstr("=\"inf"))));
}

}  // namespace
}  // namespace rink::loadgen
