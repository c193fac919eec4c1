// The long table and its dictionary: nothing is lost, nothing is undefined.
#include "loadgen/report/tidy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <utility>

#include "loadgen/experiment/parameter.h"
#include "loadgen/measure/equal_error.h"
#include "loadgen/measure/growth.h"
#include "loadgen/measure/judge_run.h"
#include "loadgen/measure/run_fields.h"
#include "loadgen/measure/server_cores.h"
#include "loadgen/measure/summary.h"
#include "loadgen/measure/tables/discovery_table.h"
#include "loadgen/report/dictionary.h"
#include "loadgen/run/saturation/saturate_command.h"
#include "tests/loadgen/report/canned_reports.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace rink::loadgen {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

/// The fields of each line of `csv`, quotes taken off.
std::vector<std::vector<std::string>> rows_of(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> row(1);
    bool is_quoted = false;
    for (const char letter : line) {
      if (letter == '"') is_quoted = !is_quoted;
      else if (letter == ',' && !is_quoted) row.emplace_back();
      else row.back() += letter;
    }
    rows.push_back(row);
  }
  return rows;
}

RunRecord some_run(const std::string& scheme, std::uint64_t seed) {
  Cell cell{"client-server", scheme, "periodic", 10, seed};
  cell.part = "late";
  cell.parameters.view_margin = 0.25;
  RunRecord run = record_for(small_experiment(), cell);
  judge(run, canned_server_report(cell), canned_bots_report(cell));
  return run;
}

TEST(Tidy, EveryFigureOfEveryRunIsALineWithTheValueThatTheRunHas) {
  std::vector<RunRecord> runs{some_run("none", 1),
                              some_run("aura with priority(budget=400, age=1)", 2)};
  runs[1].valid = false;
  runs[1].truth.filter_recall = 1.0 / 3.0;
  const auto rows = rows_of(tidy_csv(runs));
  std::size_t present = 0;
  for (const RunRecord& run : runs)
    for (const Figure& figure : figures()) present += figure.of(run).has_value();
  ASSERT_EQ(rows.size(), 1 + present);
  EXPECT_THAT(rows[0], ElementsAre("part", "mode", "scheme", "policy", "clients", "pucks", "bats",
                                   "server_cores", "view_fraction", "view_margin", "sweep_ticks",
                                   "cell_size", "tick_rate_hz", "threshold", "extrapolate", "nodes",
                                   "output_rate_hz", "seed", "valid", "figure", "unit", "value"));
  std::size_t at = 1;
  for (const RunRecord& run : runs)
    for (const Figure& figure : figures()) {
      const auto value = figure.of(run);
      if (!value) continue;
      const auto& row = rows[at++];
      ASSERT_THAT(row, SizeIs(rows[0].size()));
      EXPECT_THAT((std::vector(row.begin(), row.begin() + 4)),
                  ElementsAre("late", "client-server", run.cell.scheme, "periodic"));
      EXPECT_EQ(row[9], "0.25");
      EXPECT_EQ(row[17], std::to_string(run.cell.seed));
      EXPECT_EQ(row[18], run.valid ? "true" : "false");
      EXPECT_EQ(row[19], figure.name);
      EXPECT_EQ(std::stod(row[21]), *value) << figure.name << " must come back as the very number";
    }
}

TEST(Tidy, WhatWasNotMeasuredHasNoLine) {
  RunRecord run = some_run("none", 1);
  run.physics_us_per_tick.reset();
  const std::string csv = tidy_csv(std::span(&run, 1));
  EXPECT_THAT(csv, AllOf(HasSubstr("filter_us_per_tick"), Not(HasSubstr("physics_us_per_tick"))));
  EXPECT_THAT(csv, AllOf(Not(HasSubstr("nan")), Not(HasSubstr("null"))));
  EXPECT_THAT(rows_of(tidy_csv({})), SizeIs(1));
}

// update_age_samples, interactions, the keys, measured_s, replaced pucks and some 95th percentiles
// were missing.
TEST(Tidy, EveryNumberThatARunHasIsAFigureOrASetting) {
  std::set<std::string> known{"duration_s", "warm_up_s", "start_s", "delay_ms", "view_area"};
  for (const Definition& cell : cell_definitions()) known.insert(cell.field);
  for (const Figure& figure : figures()) known.insert(figure.name);
  const std::set<std::string> texts{"state_hash", "why_invalid",  "scene",     "population",
                                    "keys",       "players",      "transport", "keys_trouble",
                                    "relevance",  "truth_trouble"};
  const auto line = to_json(some_run("none", 1));
  for (const auto& [field, value] : line.items()) {
    if (value.is_object()) {
      for (const auto& member : value.items())
        EXPECT_THAT(known, Contains(field + "_" + member.key()));
    } else if (!texts.contains(field) && field != "bytes_by_field") {  // it has a file of its own
      EXPECT_THAT(known, Contains(field));
    }
  }
}

TEST(Dictionary, DefinesEveryFigureInASentenceWithAUnit) {
  for (const Figure& figure : figures()) {
    const Definition* definition = definition_of(figure.name);
    ASSERT_NE(definition, nullptr) << figure.name;
    EXPECT_GT(std::string(definition->meaning).size(), 25u) << figure.name;
    EXPECT_NE(unit_of(figure.name), "") << figure.name;
  }
  EXPECT_EQ(unit_of("displayed_error_mm_replaced_rms"), "mm");
  EXPECT_EQ(unit_of("displayed_error_mm_replaced_samples"), "1")
      << "a number of samples is no distance";
  const std::map<std::string, std::string> units{{"_ms", "ms"},
                                                 {"_mm", "mm"},
                                                 {"_us", "us"},
                                                 {"_us_per_tick", "us"},
                                                 {"_cpu_s", "s"},
                                                 {"_fraction", "1"},
                                                 {"bytes_per_client_per_s", "B/s"}};
  for (const Definition& definition : figure_definitions())
    for (const auto& [ending, unit] : units) {
      if (std::string(definition.field).ends_with(ending)) {
        EXPECT_EQ(definition.unit, unit) << definition.field;
      }
    }
}

TEST(Dictionary, DefinesNothingThatNoTableHas) {
  std::set<std::string> used;
  for (const Figure& figure : figures()) used.insert(definition_of(figure.name)->field);
  for (const Definition& definition : figure_definitions())
    EXPECT_THAT(used, Contains(definition.field));
}

TEST(Dictionary, HasALineForEveryColumnAndEveryFigureOfTheLongTable) {
  const RunRecord run = some_run("none", 1);
  const auto dictionary = rows_of(data_dictionary_csv());
  EXPECT_THAT(dictionary[0], ElementsAre("name", "kind", "unit", "alias", "field", "definition"));
  std::map<std::string, std::vector<std::string>> lines;
  for (std::size_t i = 1; i < dictionary.size(); ++i) {
    ASSERT_THAT(dictionary[i], SizeIs(6));
    if (dictionary[i][1] != "cell" && dictionary[i][1] != "figure") continue;
    EXPECT_TRUE(lines.emplace(dictionary[i][0], dictionary[i]).second)
        << dictionary[i][0] << " is defined twice";
  }
  const auto rows = rows_of(tidy_csv(std::span(&run, 1)));
  ASSERT_THAT((std::vector(rows[0].end() - 3, rows[0].end())),
              ElementsAre("figure", "unit", "value"));
  for (auto column = rows[0].begin(); column != rows[0].end() - 3; ++column)
    EXPECT_EQ(lines[*column].at(1), "cell") << *column;
  for (const Figure& figure : figures()) EXPECT_EQ(lines[figure.name].at(1), "figure");
  const std::size_t figure = rows[0].size() - 3;
  for (std::size_t i = 1; i < rows.size(); ++i)
    EXPECT_EQ(rows[i][figure + 1], lines[rows[i][figure]].at(2));
}

/// (name, kind) of each line of the dictionary.
std::set<std::pair<std::string, std::string>> names_and_kinds() {
  std::set<std::pair<std::string, std::string>> all;
  auto rows = rows_of(data_dictionary_csv());
  rows.erase(rows.begin());
  for (const auto& row : rows)
    EXPECT_TRUE(all.emplace(row[0], row[1]).second) << row[1] << " " << row[0] << " is there twice";
  return all;
}

TEST(Dictionary, HasALineForEveryColumnOfEveryTable) {
  const std::map<std::string, std::string> tables{
      {"tidy", tidy_csv({})},
      {"summary", to_csv(std::span<const SummaryRow>())},
      {"comparisons", comparisons_csv({}, {})},
      {"equal_error", to_csv(std::span<const EqualError>())},
      {"growth", to_csv(std::span<const Growth>())},
      {"saturation", to_csv(std::span<const Saturation>())},
      {"server_cores", to_csv(std::span<const CoresRatio>())},
      {"discovery", discovery_csv({})}};
  const auto defined = names_and_kinds();
  std::set<std::pair<std::string, std::string>> used;
  for (const auto& [table, csv] : tables) {
    const auto rows = rows_of(csv);
    for (std::string column : rows.front()) {
      for (const Figure& figure : figures())
        if (table == "summary" && column.starts_with(std::string(figure.name) + "_"))
          column = "FIGURE" + column.substr(column.rfind('_'));
      used.emplace(column, table);
      EXPECT_TRUE(defined.contains({column, table}) || defined.contains({column, "cell"}) ||
                  defined.contains({column, "figure"}))
          << table << ".csv: " << column;
    }
  }
  for (const auto& each : defined) {
    if (each.second == "cell" || each.second == "figure") continue;
    EXPECT_TRUE(used.contains(each)) << each.second << ".csv has no column " << each.first;
  }
}

TEST(Dictionary, CallsNoWallTimeProcessorTime) {
  for (const auto& row : rows_of(data_dictionary_csv()))
    EXPECT_TRUE(row[3].find("CPU time") == std::string::npos ||
                row[5].starts_with("Processor time"))
        << row[0];
}

TEST(Dictionary, CallsWhatRivalsSendMoreAReductionFactor) {
  std::map<std::pair<std::string, std::string>, std::string> aliases;
  for (const auto& row : rows_of(data_dictionary_csv())) aliases[{row[1], row[0]}] = row[3];
  EXPECT_EQ((aliases[{"equal_error", "payload_ratio"}]), "reduction factor");
  EXPECT_EQ((aliases[{"equal_error", "wire_ratio"}]), "reduction factor");
  EXPECT_EQ((aliases[{"comparisons", "ratio"}]), "reciprocal of the reduction factor");
}

TEST(Dictionary, GivesTheNamesOfTheLiterature) {
  const std::map<std::string, std::string> aliases{
      {"update_age_ms_p99", "update latency"},
      {"key_to_effect_ms_p50", "input latency"},
      {"late_entry_ms_p95", "discovery latency"},
      {"displayed_error_mm_rms", "dead-reckoning error now"},
      {"position_error_mm_rms", "at the time stamp"},
      {"position_error_mm_max", "replica error"},
      {"server_cpu_s", "CPU time"},
      {"view_fraction", "area fraction"}};
  std::map<std::string, std::string> found;
  for (const auto& row : rows_of(data_dictionary_csv())) found[row[0]] = row[3];
  for (const auto& [name, alias] : aliases) EXPECT_THAT(found[name], HasSubstr(alias)) << name;
}

TEST(Dictionary, NamesFieldsOfTheJournalThatTheDocumentDefines) {
  const std::string document = test::text_of(test::source_folder() + "/docs/metrics.md");
  const auto line = to_json(some_run("none", 1));
  for (const auto definitions : {cell_definitions(), figure_definitions()})
    for (const Definition& definition : definitions) {
      EXPECT_TRUE(line.contains(definition.field)) << definition.field;
      EXPECT_THAT(document, HasSubstr("`" + std::string(definition.field) + "`"));
    }
}

}  // namespace
}  // namespace rink::loadgen
