// The table of docs/metrics.md beside the lines of runs.jsonl: each column is defined once, and
// nothing else is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "loadgen/measure/judge_run.h"
#include "loadgen/measure/run_fields.h"
#include "loadgen/measure/run_record.h"
#include "loadgen/measure/statistics/histogram.h"
#include "tests/loadgen/report/canned_reports.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace rink::loadgen {
namespace {

std::string document() { return test::text_of(test::source_folder() + "/docs/metrics.md"); }

/// What stands as code in `text`, in its order.
std::vector<std::string> names_in(const std::string& text) {
  static const std::regex name("`([^`]+)`");
  std::vector<std::string> names;
  for (std::sregex_iterator found(text.begin(), text.end(), name), end; found != end; ++found)
    names.push_back((*found)[1]);
  return names;
}

/// The cells of the rows of the table whose first cell is `field`, but for its head.
std::vector<std::vector<std::string>> rows_of_fields() {
  std::istringstream lines(document());
  std::vector<std::vector<std::string>> rows;
  bool is_within = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("| field ")) is_within = true;
    else if (!line.starts_with("|")) is_within = false;
    if (!is_within || !line.starts_with("| `")) continue;
    std::vector<std::string>& row = rows.emplace_back();
    std::istringstream cells(line.substr(1));
    for (std::string cell; std::getline(cells, cell, '|');) row.push_back(cell);
  }
  return rows;
}

nlohmann::ordered_json some_line() {
  const Cell cell{"client-server", "grid", "periodic", 10, 4};
  RunRecord run = record_for(small_experiment(), cell);
  judge(run, canned_server_report(cell), canned_bots_report(cell));
  return to_json(run);
}

TEST(MetricsDocument, DefinesEachColumnOfTheJournalOnceAndNoOther) {
  std::vector<std::string> defined, columns;
  for (const auto& row : rows_of_fields()) {
    ASSERT_EQ(row.size(), 3u) << row.front();
    EXPECT_GT(row[2].size(), 10u) << row.front() << " is not defined";
    for (const std::string& name : names_in(row.front())) defined.push_back(name);
  }
  const nlohmann::ordered_json line = some_line();
  for (const auto& [name, value] : line.items()) columns.push_back(name);
  ASSERT_GT(columns.size(), 50u);
  EXPECT_THAT(defined, testing::UnorderedElementsAreArray(columns));
}

/// A distribution of latencies has its percentiles and maximum, one of errors what its row lists.
TEST(MetricsDocument, NamesTheMembersOfEachDistribution) {
  const nlohmann::ordered_json line = some_line();
  const auto members = [&line](const char* column) {
    std::vector<std::string> names;
    for (const auto& [name, value] : line[column].items()) names.push_back(name);
    return names;
  };
  for (const char* latency : {"update_age_ms", "key_to_effect_ms", "late_entry_ms", "tick_us"})
    EXPECT_THAT(members(latency), testing::ElementsAre("p50", "p90", "p95", "p99", "p999", "max"))
        << latency;
  const auto rows = rows_of_fields();
  const auto errors = std::ranges::find_if(rows, [](const auto& row) {
    return row.front().find("`displayed_error_mm`") != std::string::npos;
  });
  ASSERT_NE(errors, rows.end());
  for (const char* error : {"position_error_mm", "displayed_error_mm"})
    for (const std::string& member : members(error))
      EXPECT_THAT((*errors)[2], testing::ContainsRegex("[ `]" + member + "[`,;]")) << error;
}

/// Each percentile with the number of samples from which on it is given, as the section on latency
/// has it.
TEST(MetricsDocument, SaysFromHowManySamplesOnEachPercentileIsGiven) {
  const std::string text = std::regex_replace(document(), std::regex("[\n,]"), " ");
  const struct {
    std::uint64_t samples;
    const char* words;
    std::optional<double> Percentiles::*percentile;
  } limits[] = {{20, "p50 from 20 samples on", &Percentiles::p50},
                {100, "p90 from 100 ", &Percentiles::p90},
                {200, "p95 from 200 ", &Percentiles::p95},
                {1'000, "p99 from 1 000 ", &Percentiles::p99},
                {10'000, "p99.9 from 10 000", &Percentiles::p999}};
  for (const auto& limit : limits) {
    EXPECT_THAT(text, testing::HasSubstr(limit.words));
    for (const bool is_enough : {false, true}) {
      Histogram histogram;
      histogram.record(0.01, limit.samples - (is_enough ? 0 : 1));
      EXPECT_EQ((histogram.percentiles_ms().*limit.percentile).has_value(), is_enough)
          << limit.words;
    }
  }
}

}  // namespace
}  // namespace rink::loadgen
