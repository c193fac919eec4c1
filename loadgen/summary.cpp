// Means, deviations and ratios over valid runs, and their CSV.
#include "loadgen/summary.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <string_view>
#include <tuple>

namespace rink::loadgen {
namespace {

template <class Count>
std::optional<double> as_number(const std::optional<Count>& count) {
  if (!count) return std::nullopt;
  return static_cast<double>(*count);
}

constexpr std::array all_figures{
    Figure{"entities", [](const RunRecord& run) { return as_number(run.entities); }},
    Figure{"ticks", [](const RunRecord& run) { return as_number(run.ticks); }},
    Figure{"ticks_on_time_fraction", [](const RunRecord& run) { return run.ticks_on_time_fraction; }},
    Figure{"down_bytes_per_client_per_s", [](const RunRecord& run) { return run.down_bytes_per_client_per_s; }},
    Figure{"up_bytes_per_client_per_s", [](const RunRecord& run) { return run.up_bytes_per_client_per_s; }},
    Figure{"wire_bytes_per_client_per_s", [](const RunRecord& run) { return run.wire_bytes_per_client_per_s; }},
    Figure{"messages_per_s", [](const RunRecord& run) { return run.messages_per_s; }},
    Figure{"update_age_ms_p50", [](const RunRecord& run) { return run.update_age_ms.p50; }},
    Figure{"update_age_ms_p90", [](const RunRecord& run) { return run.update_age_ms.p90; }},
    Figure{"update_age_ms_p99", [](const RunRecord& run) { return run.update_age_ms.p99; }},
    Figure{"update_age_ms_p999", [](const RunRecord& run) { return run.update_age_ms.p999; }},
    Figure{"update_age_ms_max", [](const RunRecord& run) { return run.update_age_ms.max; }},
    Figure{"key_to_effect_ms_p50", [](const RunRecord& run) { return run.key_to_effect_ms.p50; }},
    Figure{"key_to_effect_ms_p90", [](const RunRecord& run) { return run.key_to_effect_ms.p90; }},
    Figure{"key_to_effect_ms_p99", [](const RunRecord& run) { return run.key_to_effect_ms.p99; }},
    Figure{"key_to_effect_ms_p999", [](const RunRecord& run) { return run.key_to_effect_ms.p999; }},
    Figure{"key_to_effect_ms_max", [](const RunRecord& run) { return run.key_to_effect_ms.max; }},
    Figure{"physics_us_per_tick", [](const RunRecord& run) { return run.physics_us_per_tick; }},
    Figure{"filter_us_per_tick", [](const RunRecord& run) { return run.filter_us_per_tick; }},
    Figure{"send_us_per_tick", [](const RunRecord& run) { return run.send_us_per_tick; }},
    Figure{"server_rss_bytes", [](const RunRecord& run) { return as_number(run.server_rss_bytes); }},
    Figure{"segments_per_s", [](const RunRecord& run) { return run.segments_per_s; }},
    Figure{"writes_per_s", [](const RunRecord& run) { return run.writes_per_s; }},
    Figure{"late_sends_fraction", [](const RunRecord& run) { return run.late_sends_fraction; }},
    Figure{"server_cpu_s", [](const RunRecord& run) { return run.server_cpu_s; }},
    Figure{"bots_cpu_s", [](const RunRecord& run) { return run.bots_cpu_s; }},
};

Statistic statistic_of(const Figure& figure, const std::vector<const RunRecord*>& valid_runs) {
  std::vector<double> values;
  for (const RunRecord* run : valid_runs) {
    if (const auto value = figure.of(*run)) values.push_back(*value);
  }
  if (values.empty() || values.size() < valid_runs.size()) return {};
  double sum = 0.0, squares = 0.0;
  for (const double value : values) sum += value;
  const double mean = sum / static_cast<double>(values.size());
  for (const double value : values) squares += (value - mean) * (value - mean);
  Statistic result{mean, std::nullopt, *std::min_element(values.begin(), values.end()), *std::max_element(values.begin(), values.end())};
  if (values.size() > 1) result.deviation = std::sqrt(squares / static_cast<double>(values.size() - 1));
  return result;
}

bool is_replication(const SummaryRow& row, const RunRecord& run) {
  return row.mode == run.cell.mode && row.scheme == run.cell.scheme && row.policy == run.cell.policy && row.clients == run.cell.clients;
}

std::vector<SummaryRow> empty_rows(std::span<const RunRecord> runs) {
  std::vector<SummaryRow> rows;
  for (const RunRecord& run : runs) {
    if (std::none_of(rows.begin(), rows.end(), [&run](const SummaryRow& row) { return is_replication(row, run); })) {
      rows.push_back({run.cell.mode, run.cell.scheme, run.cell.policy, run.cell.clients, 0, 0, {}, std::nullopt});
    }
  }
  const auto first_with = [&rows](auto member, const SummaryRow& row) {
    return std::find_if(rows.begin(), rows.end(), [&](const SummaryRow& other) { return other.*member == row.*member; }) - rows.begin();
  };
  using Place = std::tuple<std::ptrdiff_t, std::ptrdiff_t, std::uint32_t, std::ptrdiff_t>;
  std::vector<std::pair<Place, SummaryRow>> placed;
  for (const SummaryRow& row : rows) {
    placed.push_back({{first_with(&SummaryRow::mode, row), first_with(&SummaryRow::policy, row), row.clients, first_with(&SummaryRow::scheme, row)}, row});
  }
  std::stable_sort(placed.begin(), placed.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = std::move(placed[i].second);
  return rows;
}

void add_ratios(std::vector<SummaryRow>& rows) {
  for (SummaryRow& row : rows) {
    const auto baseline = std::find_if(rows.begin(), rows.end(), [&row](const SummaryRow& other) {
      return other.scheme == "none" && other.mode == row.mode && other.policy == row.policy && other.clients == row.clients;
    });
    if (baseline == rows.end()) continue;
    const auto own = row.of("down_bytes_per_client_per_s").mean, none = baseline->of("down_bytes_per_client_per_s").mean;
    if (own && none && *none > 0.0) row.down_bytes_ratio_to_none = *own / *none;
  }
}

std::string csv_number(std::optional<double> value) {
  if (!value) return {};
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), *value).ptr;
  return {digits.data(), end};
}

std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char letter : text) quoted += letter == '"' ? std::string("\"\"") : std::string(1, letter);
  return quoted + '"';
}

}  // namespace

std::span<const Figure> figures() { return all_figures; }

const Statistic& SummaryRow::of(const char* name) const {
  const auto figure = std::find_if(all_figures.begin(), all_figures.end(), [name](const Figure& f) { return std::string_view(f.name) == name; });
  assert(figure != all_figures.end());
  return statistics[static_cast<std::size_t>(figure - all_figures.begin())];
}

std::vector<SummaryRow> summarise(std::span<const RunRecord> runs) {
  std::vector<SummaryRow> rows = empty_rows(runs);
  for (SummaryRow& row : rows) {
    std::vector<const RunRecord*> valid_runs;
    for (const RunRecord& run : runs) {
      if (!is_replication(row, run)) continue;
      ++(run.valid ? row.valid_runs : row.invalid_runs);
      if (run.valid) valid_runs.push_back(&run);
    }
    for (const Figure& figure : all_figures) row.statistics.push_back(statistic_of(figure, valid_runs));
  }
  add_ratios(rows);
  return rows;
}

Agreement agreement_of(std::span<const RunRecord> runs) {
  std::map<std::string, std::vector<std::string>> hashes_of_game;
  for (const RunRecord& run : runs) {
    if (!run.valid || run.keys != "replay") continue;
    std::string game = "seed " + std::to_string(run.cell.seed);
    if (run.population == "per_client") game += " with " + std::to_string(run.cell.clients) + " clients";
    hashes_of_game[game].push_back(run.state_hash);
  }
  Agreement result;
  for (const auto& [game, hashes] : hashes_of_game) {
    if (hashes.size() < 2) continue;
    ++result.games;
    const std::set<std::string> distinct(hashes.begin(), hashes.end());
    if (distinct.size() == 1) continue;
    std::string difference = game + ":";
    for (const std::string& hash : distinct) difference += " " + hash;
    result.differing.push_back(difference);
  }
  return result;
}

std::string to_csv(std::span<const SummaryRow> rows) {
  std::string csv = "mode,scheme,policy,clients,valid_runs,invalid_runs,down_bytes_ratio_to_none";
  for (const Figure& figure : all_figures) {
    for (const char* part : {"_mean", "_sd", "_min", "_max"}) csv += std::string(",") + figure.name + part;
  }
  csv += "\n";
  for (const SummaryRow& row : rows) {
    csv += csv_text(row.mode) + "," + csv_text(row.scheme) + "," + csv_text(row.policy) + "," + std::to_string(row.clients) + "," +
           std::to_string(row.valid_runs) + "," + std::to_string(row.invalid_runs) + "," + csv_number(row.down_bytes_ratio_to_none);
    for (const Statistic& statistic : row.statistics) {
      for (const auto& value : {statistic.mean, statistic.deviation, statistic.min, statistic.max}) csv += "," + csv_number(value);
    }
    csv += "\n";
  }
  return csv;
}

}  // namespace rink::loadgen
