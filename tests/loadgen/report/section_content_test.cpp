// What the report says: gains paired by seed, means only where every run has the figure, and a
// sentence where something was not measured.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "loadgen/report/report.h"
#include "loadgen/report/sections/gains.h"
#include "loadgen/report/sections/run_figures.h"
#include "loadgen/report/sections/saturation_section.h"
#include "loadgen/report/sections/section_content.h"
#include "tests/loadgen/report/canned_reports.h"
#include "tests/temporary_folder.h"

namespace rink::loadgen {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::Field;
using testing::HasSubstr;
using testing::Not;

/// A valid run that sends `bytes` and errs by `error_mm`.
RunRecord run_of(const std::string& scheme, const std::string& policy, std::uint32_t clients,
                 std::uint64_t seed, double bytes, double error_mm) {
  RunRecord run = record_for(small_experiment(), {"client-server", scheme, policy, clients, seed});
  run.valid = true;
  run.down_bytes_per_client_per_s = bytes;
  run.truth.displayed_error_mm = {error_mm, 3.0 * error_mm, 9.0 * error_mm};
  run.truth.filter_precision = run.truth.delivered_precision = 0.5;
  run.truth.filter_recall = run.truth.delivered_recall = 0.9;
  run.truth.relevance = "square of 3 m around the bat";
  return run;
}

/// The filter divides bytes by 10, the policy by 4; seeds differ by a factor of two that both cells
/// of a pair share.
std::vector<RunRecord> two_by_two() {
  std::vector<RunRecord> runs;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const double size = 1000.0 * std::pow(2.0, static_cast<double>(seed));
    runs.push_back(run_of("none", "periodic", 10, seed, size, 4.0));
    runs.push_back(run_of("region", "periodic", 10, seed, size / 10.0, 4.0));
    runs.push_back(run_of("none", "on-event", 10, seed, size / 4.0, 2.0));
    runs.push_back(run_of("region", "on-event", 10, seed, size / 40.0, 2.0));
  }
  return runs;
}

Findings findings_of(const Experiment& experiment, const std::vector<RunRecord>& runs) {
  return {experiment, runs, {}, lines_of(runs), "x"};
}

TEST(Gains, ArePairedBySeedSoThatWhatBothShareCancels) {
  const Experiment experiment = small_experiment();
  const auto runs = two_by_two();
  const Findings findings = findings_of(experiment, runs);
  const auto gains = gains_of(findings);
  ASSERT_EQ(gains.size(), 4u);
  const double expected[] = {1.0, 10.0, 4.0, 40.0};
  const Gain::Kind kinds[] = {Gain::Kind::baseline, Gain::Kind::filter_alone,
                              Gain::Kind::policy_alone, Gain::Kind::together};
  for (std::size_t i = 0; i < gains.size(); ++i) {
    EXPECT_EQ(gains[i].kind, kinds[i]);
    ASSERT_TRUE(gains[i].bytes && gains[i].bytes->interval);
    EXPECT_NEAR(gains[i].bytes->value, expected[i], 1e-9);
    EXPECT_NEAR(gains[i].bytes->interval->low, expected[i], 1e-6);  // no scatter is left
  }
  EXPECT_THAT(
      headline_of(findings),
      AllOf(HasSubstr("region, on-event sends 40.0 times fewer"),
            HasSubstr("2.00 mm RMS against 4.00 mm, which is no comparison at equal error.")));
}

/// A client that sees more is sent more, under any policy.
TEST(Gains, AreOverTheBaselineOfTheSameView) {
  const Experiment experiment = small_experiment();
  std::vector<RunRecord> runs;
  for (const double view : {0.2, 0.1, 0.4})
    for (const char* policy : {"periodic", "on-event"})
      for (const std::uint64_t seed : {1, 2}) {
        runs.push_back(
            run_of("none", policy, 10, seed,
                   1000.0 * view / (std::string(policy) == "periodic" ? 1.0 : 10.0 * view), 1.0));
        runs.back().cell.parameters.view_fraction = view;
      }
  const Findings findings = findings_of(experiment, runs);
  int compared = 0;
  for (const Gain& gain : gains_of(findings)) {
    ASSERT_TRUE(gain.bytes);
    if (gain.kind != Gain::Kind::policy_alone) continue;
    const double view = gain.group->cell.parameters.view_fraction;
    EXPECT_NEAR(gain.bytes->value, 10.0 * view, 1e-9) << view;
    ++compared;
  }
  EXPECT_EQ(compared, 3);
}

TEST(BytesByField, AreATableWhoseLastRowIsThePayload) {
  const Experiment experiment = small_experiment();
  std::vector<RunRecord> runs = two_by_two();
  EXPECT_TRUE(bytes_by_field_content(findings_of(experiment, runs)).tables.empty())
      << "nobody has counted";
  for (RunRecord& run : runs)
    run.fields = {{"down", "stream", "updates", "position", 1000.25, 60.0},
                  {"up", "datagram", "modify_regions", "<regions>", 500.5, 20.0},
                  {"down", "stream", "frame", "head", 0.25, 20.0}};
  const SectionContent content = bytes_by_field_content(findings_of(experiment, runs));
  EXPECT_THAT(content.html,
              AllOf(HasSubstr("<td class=\"text\">payload</td><td class=\"text\"></td><td "
                              "class=\"text\"></td><td>1501</td>"),
                    HasSubstr("all others"), HasSubstr("up, datagram"),
                    HasSubstr("&lt;regions&gt;"), Not(HasSubstr("<td class=\"text\">head</td>"))));
  ASSERT_EQ(content.tables.size(), 1u);
  EXPECT_EQ(content.tables[0].rows.size(), 4u * 3) << "every field of every cell";
}

TEST(Gains, ADifferenceWithinTheScatterIsCalledNotSignificant) {
  const Experiment experiment = small_experiment();
  std::vector<RunRecord> runs;
  for (const std::uint64_t seed : {1, 2}) {
    runs.push_back(run_of("none", "periodic", 10, seed, 1000.0, 1.0));
    runs.push_back(run_of("region", "periodic", 10, seed, seed == 1 ? 500.0 : 1500.0, 1.0));
  }
  const Report report = report_of(experiment, runs, {});
  EXPECT_THAT(report.html, HasSubstr("no significant difference"));
  runs.resize(2);
  EXPECT_THAT(report_of(experiment, runs, {}).html,
              HasSubstr("one replication: cannot be told from chance"));
}

TEST(MeanInterval, IsStudentsOverReplications) {
  const MeanInterval mean = mean_interval({1.0, 2.0, 3.0}, Scale::unbounded);
  EXPECT_DOUBLE_EQ(mean.mean, 2.0);
  ASSERT_TRUE(mean.interval);
  EXPECT_NEAR(mean.interval->second - 2.0, 4.302652729911275 / std::sqrt(3.0),
              1e-9);  // t at 0.975 with two degrees of freedom, tables
  EXPECT_FALSE(mean_interval({1.0}).interval);
}

TEST(MeanInterval, OfAFigureKeepsWithinWhatTheFigureCanBe) {
  auto runs = two_by_two();
  runs.push_back(runs[0]), runs[0].truth.filter_recall = 1.0,
                           runs.back().truth.filter_recall = 0.98;
  runs[0].down_bytes_per_client_per_s = 10.0, runs.back().down_bytes_per_client_per_s = 30.0;
  const auto lines = lines_of(runs);
  const MeanInterval recall = lines[0].groups[0].mean(filter_recall).value(),
                     bytes = lines[0].groups[0].mean(payload).value();
  EXPECT_LT(recall.interval.value().second, 1.0);
  EXPECT_GT(recall.interval->second, recall.mean);
  EXPECT_GT(bytes.interval.value().first, 0.0);
}

TEST(CellLines, AFigureThatOneRunLacksHasNoMean) {
  auto runs = two_by_two();
  runs[0].truth.displayed_error_mm.rms.reset();
  const auto lines = lines_of(runs);
  const FigureOf error = [](const RunRecord& run) { return run.truth.displayed_error_mm.rms; };
  EXPECT_FALSE(lines[0].groups[0].mean(error));
  EXPECT_TRUE(lines[1].groups[0].mean(error));
}

TEST(CellLines, NamesSayOnlyWhatDiffersWithinAScheme) {
  std::vector<RunRecord> runs{run_of("none", "periodic", 10, 1, 9, 1),
                              run_of("grid", "periodic", 10, 1, 9, 1),
                              run_of("grid", "periodic", 10, 1, 9, 1)};
  runs[2].cell.parameters.cell_size = 2.0;
  const auto lines = lines_of(runs);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0].name, "none");
  EXPECT_EQ(lines[2].name, "grid, cells 2 m");
  EXPECT_EQ(lines[1].style.colour, lines[2].style.colour);
  EXPECT_NE(lines[1].style.shape, lines[2].style.shape);
}

/// Numbers of clients that ran in parts of their own.
TEST(Exhibits, TrafficAgainstClientsPutsPartsInVirtualTimeTogether) {
  Experiment experiment = small_experiment();
  for (const char* name : {"sockets", "prompt", "smaller", "late"}) {
    experiment.parts.push_back(experiment);
    Experiment& part = experiment.parts.back();
    part.parts.clear(), part.part = name;
    part.transport = part.part == "sockets" ? TransportKind::tcp : TransportKind::virtual_time;
    part.delay_ms = part.part == "late" ? 50.0 : 0.0;
  }
  std::vector<RunRecord> runs;
  for (const auto& [part, clients, bytes] : {std::tuple{"sockets", 100u, 7.0},
                                             {"prompt", 100u, 100.0},
                                             {"smaller", 10u, 10.0},
                                             {"smaller", 30u, 30.0},
                                             {"late", 30u, 5.0}})
    for (const char* scheme : {"none", "region"}) {
      runs.push_back(run_of(scheme, "periodic", clients, 1, bytes, 1.0));
      runs.back().cell.part = part;
    }
  const Report report = report_of(experiment, runs, {});
  const auto table = std::ranges::find(report.tables, "payload-against-clients", &PlotTable::name);
  ASSERT_NE(table, report.tables.end());
  const auto column = static_cast<std::size_t>(
      std::ranges::find(table->columns, "bytes_per_client_per_s") - table->columns.begin());
  std::vector<std::string> bytes;
  for (const auto& row : table->rows) bytes.push_back(row.at(0) + " " + row.at(column));
  EXPECT_THAT(bytes, testing::ElementsAre("none 10", "none 30", "none 100", "region 10",
                                          "region 30", "region 100"));
  EXPECT_THAT(report.html, HasSubstr("All in virtual time without delay."));
}

TEST(Exhibits, EachPlotHasItsDataAndTheSameRunsGiveTheSameBytes) {
  const auto runs = two_by_two();
  const Report report = report_of(small_experiment(), runs, {}),
               again = report_of(small_experiment(), runs, {});
  EXPECT_EQ(report.html, again.html);
  for (const char* name :
       {"payload-against-clients", "bytes-against-error", "gains", "precision-recall-filter",
        "precision-recall-delivered", "replications-payload"}) {
    EXPECT_THAT(report.tables, Contains(Field(&PlotTable::name, name)));
  }
  for (const PlotTable& table : report.tables)
    EXPECT_THAT(table.rows, Each(testing::SizeIs(table.columns.size()))) << table.name;
  EXPECT_THAT(report.html, HasSubstr("Relevant to a player: square of 3 m around the bat"));
}

TEST(Exhibits, AreOfTheFirstPartThatHasValidRuns) {
  Experiment experiment = small_experiment();
  experiment.parts = {experiment, experiment};
  experiment.parts[0].part = "sockets", experiment.parts[1].part = "prompt";
  auto runs = two_by_two();
  const auto prompt = runs;
  for (RunRecord& run : runs) run.cell.part = "sockets";
  for (RunRecord run : prompt) run.cell.part = "prompt", runs.push_back(run);
  const auto part_drawn = [&] {
    return plotted_lines(findings_of(experiment, runs)).front().groups.front().cell.part;
  };
  EXPECT_EQ(part_drawn(), "sockets");
  for (std::size_t i = 0; i < prompt.size(); ++i) runs[i].valid = false;
  EXPECT_EQ(part_drawn(), "prompt") << "the server of the other could not be started";
}

TEST(Exhibits, WhatWasNotMeasuredIsLeftOutWithASentence) {
  auto runs = two_by_two();
  for (RunRecord& run : runs) run.truth = {};
  const Report report = report_of(small_experiment(), runs, {});
  EXPECT_THAT(report.html, AllOf(HasSubstr("No run has processor costs"),
                                 HasSubstr("No run was held against truth"),
                                 HasSubstr("No run has a displayed error")));
  EXPECT_THAT(report.html,
              AllOf(Not(HasSubstr("cost-per-tick")), Not(HasSubstr("precision-recall"))));
}

TEST(Exhibits, LatencyCurvesEndWhereTheSampleDoes) {
  const auto runs = two_by_two();
  CellLatencies latencies{runs[0].cell, {}, {}, {}};
  for (int i = 1; i <= 1000; ++i) latencies.update_latency.record(i * 1e-3);
  const Report report =
      report_of(small_experiment(), runs, {}, {.latencies = std::span(&latencies, 1)});
  const auto table =
      std::find_if(report.tables.begin(), report.tables.end(),
                   [](const PlotTable& other) { return other.name == "update-age"; });
  ASSERT_NE(table, report.tables.end());
  const auto fraction = [&](const std::vector<std::string>& row) {
    return std::stod(row[row.size() - 3]);
  };
  EXPECT_NEAR(fraction(table->rows.back()), 0.99, 1e-9);  // ten of a thousand lie beyond
  for (const auto& row : table->rows)
    EXPECT_NEAR(std::stod(row[row.size() - 2]), std::max(1.0, 1000.0 * fraction(row)), 3.0);
}

TEST(Exhibits, HistogramsOfAllValidReplicationsAreTakenTogetherAndBadFilesPassedOver) {
  const test::TemporaryFolder folder("latencies");
  auto runs = two_by_two();
  for (const RunRecord& run : runs)
    std::ofstream(folder / (name_of(run.cell) + ".bots.json")) << canned_bots_report(run.cell);
  std::ofstream(folder / (name_of(runs[1].cell) + ".bots.json")) << "{\"update_age_ms\": 3";
  runs[0].valid = false;
  const auto latencies = latencies_in(folder, runs);
  ASSERT_EQ(latencies.size(), 4u);
  for (const CellLatencies& entry : latencies) {
    const bool lacks_one = entry.cell.policy == "periodic";
    EXPECT_EQ(entry.update_latency.count(), lacks_one ? 4'000u : 6'000u);
  }
}

TEST(Exhibits, ASaturationThatWasNotReachedIsAtLeastThatMuch) {
  Saturation found;
  found.cell = {"client-server", "region", "on-event", 0, 0};
  found.search.end = SearchEnd::most_holds;
  found.search.held = 400;
  const ReportSection section = saturation_section(std::span(&found, 1), {});
  EXPECT_THAT(section.content.html,
              AllOf(HasSubstr("at least 400"), HasSubstr("99.00 % of the ticks")));
}

}  // namespace
}  // namespace rink::loadgen
