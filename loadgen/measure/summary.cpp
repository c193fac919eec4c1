// Means, deviations and ratios over valid runs, and their CSV.
#include "loadgen/measure/summary.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include "loadgen/experiment/csv_number.h"
#include "loadgen/experiment/csv_text.h"
#include "loadgen/experiment/parameter.h"

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
    Figure{"measured_s", [](const RunRecord& run) { return run.measured_s; }},
    Figure{"ticks_on_time_fraction",
           [](const RunRecord& run) { return run.ticks_on_time_fraction; }, Scale::fraction},
    Figure{"down_bytes_per_client_per_s",
           [](const RunRecord& run) { return run.down_bytes_per_client_per_s; }},
    Figure{"up_bytes_per_client_per_s",
           [](const RunRecord& run) { return run.up_bytes_per_client_per_s; }},
    Figure{"wire_bytes_per_client_per_s",
           [](const RunRecord& run) { return run.wire_bytes_per_client_per_s; }},
    Figure{"messages_per_s", [](const RunRecord& run) { return run.messages_per_s; }},
    Figure{"update_age_ms_p50", [](const RunRecord& run) { return run.update_age_ms.p50; }},
    Figure{"update_age_ms_p90", [](const RunRecord& run) { return run.update_age_ms.p90; }},
    Figure{"update_age_ms_p95", [](const RunRecord& run) { return run.update_age_ms.p95; }},
    Figure{"update_age_ms_p99", [](const RunRecord& run) { return run.update_age_ms.p99; }},
    Figure{"update_age_ms_p999", [](const RunRecord& run) { return run.update_age_ms.p999; }},
    Figure{"update_age_ms_max", [](const RunRecord& run) { return run.update_age_ms.max; }},
    Figure{"update_age_samples",
           [](const RunRecord& run) { return as_number(run.update_age_samples); }},
    Figure{"key_to_effect_ms_p50", [](const RunRecord& run) { return run.key_to_effect_ms.p50; }},
    Figure{"key_to_effect_ms_p90", [](const RunRecord& run) { return run.key_to_effect_ms.p90; }},
    Figure{"key_to_effect_ms_p95", [](const RunRecord& run) { return run.key_to_effect_ms.p95; }},
    Figure{"key_to_effect_ms_p99", [](const RunRecord& run) { return run.key_to_effect_ms.p99; }},
    Figure{"key_to_effect_ms_p999", [](const RunRecord& run) { return run.key_to_effect_ms.p999; }},
    Figure{"key_to_effect_ms_max", [](const RunRecord& run) { return run.key_to_effect_ms.max; }},
    Figure{"physics_us_per_tick", [](const RunRecord& run) { return run.physics_us_per_tick; }},
    Figure{"filter_us_per_tick", [](const RunRecord& run) { return run.filter_us_per_tick; }},
    Figure{"send_us_per_tick", [](const RunRecord& run) { return run.send_us_per_tick; }},
    Figure{"server_rss_bytes",
           [](const RunRecord& run) { return as_number(run.server_rss_bytes); }},
    Figure{"segments_per_s", [](const RunRecord& run) { return run.segments_per_s; }},
    Figure{"acknowledgements_per_s",
           [](const RunRecord& run) { return run.acknowledgements_per_s; }},
    Figure{"writes_per_s", [](const RunRecord& run) { return run.writes_per_s; }},
    Figure{"keys_due", [](const RunRecord& run) { return as_number(run.keys_due); }},
    Figure{"keys_sent", [](const RunRecord& run) { return as_number(run.keys_sent); }},
    Figure{"late_sends_fraction", [](const RunRecord& run) { return run.late_sends_fraction; },
           Scale::fraction},
    Figure{"server_cpu_s", [](const RunRecord& run) { return run.server_cpu_s; }},
    Figure{"bots_cpu_s", [](const RunRecord& run) { return run.bots_cpu_s; }},
    Figure{"filter_precision", [](const RunRecord& run) { return run.truth.filter_precision; },
           Scale::fraction},
    Figure{"filter_recall", [](const RunRecord& run) { return run.truth.filter_recall; },
           Scale::fraction},
    Figure{"delivered_precision",
           [](const RunRecord& run) { return run.truth.delivered_precision; }, Scale::fraction},
    Figure{"delivered_recall", [](const RunRecord& run) { return run.truth.delivered_recall; },
           Scale::fraction},
    Figure{"interactions", [](const RunRecord& run) { return as_number(run.truth.interactions); }},
    Figure{"missed_interactions",
           [](const RunRecord& run) { return as_number(run.truth.missed_interactions); }},
    Figure{"late_entry_ms_p50", [](const RunRecord& run) { return run.truth.late_entry_ms.p50; }},
    Figure{"late_entry_ms_p90", [](const RunRecord& run) { return run.truth.late_entry_ms.p90; }},
    Figure{"late_entry_ms_p95", [](const RunRecord& run) { return run.truth.late_entry_ms.p95; }},
    Figure{"late_entry_ms_p99", [](const RunRecord& run) { return run.truth.late_entry_ms.p99; }},
    Figure{"late_entry_ms_p999", [](const RunRecord& run) { return run.truth.late_entry_ms.p999; }},
    Figure{"late_entry_ms_max", [](const RunRecord& run) { return run.truth.late_entry_ms.max; }},
    Figure{"position_error_mm_rms",
           [](const RunRecord& run) { return run.truth.position_error_mm.rms; }},
    Figure{"position_error_mm_p50",
           [](const RunRecord& run) { return run.truth.position_error_mm.p50; }},
    Figure{"position_error_mm_p90",
           [](const RunRecord& run) { return run.truth.position_error_mm.p90; }},
    Figure{"position_error_mm_p99",
           [](const RunRecord& run) { return run.truth.position_error_mm.p99; }},
    Figure{"position_error_mm_max",
           [](const RunRecord& run) { return run.truth.position_error_mm.max; }},
    Figure{"position_error_mm_replaced_samples",
           [](const RunRecord& run) {
             return as_number(run.truth.position_error_mm.replaced_samples);
           }},
    Figure{"position_error_mm_replaced_rms",
           [](const RunRecord& run) { return run.truth.position_error_mm.replaced_rms; }},
    Figure{"displayed_error_mm_rms",
           [](const RunRecord& run) { return run.truth.displayed_error_mm.rms; }},
    Figure{"displayed_error_mm_p50",
           [](const RunRecord& run) { return run.truth.displayed_error_mm.p50; }},
    Figure{"displayed_error_mm_p90",
           [](const RunRecord& run) { return run.truth.displayed_error_mm.p90; }},
    Figure{"displayed_error_mm_p99",
           [](const RunRecord& run) { return run.truth.displayed_error_mm.p99; }},
    Figure{"displayed_error_mm_max",
           [](const RunRecord& run) { return run.truth.displayed_error_mm.max; }},
    Figure{"displayed_error_mm_replaced_samples",
           [](const RunRecord& run) {
             return as_number(run.truth.displayed_error_mm.replaced_samples);
           }},
    Figure{"displayed_error_mm_replaced_rms",
           [](const RunRecord& run) { return run.truth.displayed_error_mm.replaced_rms; }},
    Figure{"churn_per_client_per_s",
           [](const RunRecord& run) { return run.truth.churn_per_client_per_s; }},
    Figure{"flapping_fraction", [](const RunRecord& run) { return run.truth.flapping_fraction; },
           Scale::fraction},
    Figure{"wasted_bytes_fraction",
           [](const RunRecord& run) { return run.truth.wasted_bytes_fraction; }, Scale::fraction},
    Figure{"control_bytes_fraction",
           [](const RunRecord& run) { return run.truth.control_bytes_fraction; }, Scale::fraction},
    Figure{"fairness_jain", [](const RunRecord& run) { return run.truth.fairness_jain; },
           Scale::fraction},
    Figure{"bots_cpu_share", [](const RunRecord& run) { return run.health.bots_cpu_share; },
           Scale::fraction},
    Figure{"histogram_ns_per_record",
           [](const RunRecord& run) { return run.health.histogram_ns_per_record; }},
    Figure{"tick_us_p50", [](const RunRecord& run) { return run.tick_us.p50; }},
    Figure{"tick_us_p90", [](const RunRecord& run) { return run.tick_us.p90; }},
    Figure{"tick_us_p95", [](const RunRecord& run) { return run.tick_us.p95; }},
    Figure{"tick_us_p99", [](const RunRecord& run) { return run.tick_us.p99; }},
    Figure{"tick_us_p999", [](const RunRecord& run) { return run.tick_us.p999; }},
    Figure{"tick_us_max", [](const RunRecord& run) { return run.tick_us.max; }},
    Figure{"halo_bytes_per_client_per_s", [](const RunRecord& run) { return run.traffic.halo; }},
    Figure{"claims_bytes_per_client_per_s",
           [](const RunRecord& run) { return run.traffic.claims; }},
    Figure{"agreement_bytes_per_client_per_s",
           [](const RunRecord& run) { return run.traffic.agreement; }},
    Figure{"interest_bytes_per_client_per_s",
           [](const RunRecord& run) { return run.traffic.interest; }},
    Figure{"updates_bytes_per_client_per_s",
           [](const RunRecord& run) { return run.traffic.updates; }},
    Figure{"keys_bytes_per_client_per_s", [](const RunRecord& run) { return run.traffic.keys; }},
    Figure{"busiest_node_bytes_per_s",
           [](const RunRecord& run) { return run.nodes.busiest_bytes_per_s; }},
    Figure{"busiest_node_events_per_s",
           [](const RunRecord& run) { return run.nodes.busiest_events_per_s; }},
    Figure{"busiest_node_cpu_s", [](const RunRecord& run) { return run.nodes.busiest_cpu_s; }},
    Figure{"mean_node_cpu_s", [](const RunRecord& run) { return run.nodes.mean_cpu_s; }},
    Figure{"standby_bytes_per_client_per_s",
           [](const RunRecord& run) { return run.traffic.standby; }},
    Figure{"busiest_link_bytes_per_s",
           [](const RunRecord& run) { return run.nodes.busiest_link_bytes_per_s; }},
    Figure{"between_nodes_bytes_per_s",
           [](const RunRecord& run) { return run.nodes.between_bytes_per_s; }},
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
  Statistic result{mean, std::nullopt, *std::min_element(values.begin(), values.end()),
                   *std::max_element(values.begin(), values.end()), std::nullopt};
  if (values.size() > 1)
    result.deviation = std::sqrt(squares / static_cast<double>(values.size() - 1));
  result.interval = interval_of_mean(values, figure.scale);
  return result;
}

std::vector<SummaryRow> empty_rows(std::span<const RunRecord> runs) {
  std::vector<SummaryRow> rows;
  for (const RunRecord& run : runs) {
    const Cell cell = without_seed(run.cell);
    if (std::find(rows.begin(), rows.end(), cell) == rows.end())
      static_cast<Cell&>(rows.emplace_back()) = cell;
  }
  std::vector<std::string> modes;  // of parts
  modes.reserve(rows.size());
  for (const SummaryRow& row : rows) modes.push_back(row.part + row.mode);
  const auto place = [&modes](const SummaryRow& row) {
    return std::tuple(std::find(modes.begin(), modes.end(), row.part + row.mode) - modes.begin(),
                      row.clients, row.pucks, row.bats, row.server_cores);
  };
  std::stable_sort(rows.begin(), rows.end(), [&place](const SummaryRow& a, const SummaryRow& b) {
    return place(a) < place(b);
  });
  return rows;
}

/// (own, baseline) for each seed of which both have one valid run.
std::vector<std::pair<double, double>> pairs_of(const Figure& figure, const Cell& own,
                                                const Cell& baseline,
                                                std::span<const RunRecord> runs) {
  std::map<std::uint64_t, double> baseline_of_seed;
  for (const RunRecord& run : runs) {
    const auto value =
        run.valid && without_seed(run.cell) == baseline ? figure.of(run) : std::nullopt;
    if (value) baseline_of_seed.emplace(run.cell.seed, *value);
  }
  std::vector<std::pair<double, double>> pairs;
  for (const RunRecord& run : runs) {
    const auto partner = baseline_of_seed.find(run.cell.seed);
    if (!run.valid || without_seed(run.cell) != own || partner == baseline_of_seed.end()) continue;
    if (const auto value = figure.of(run)) pairs.emplace_back(*value, partner->second);
  }
  return pairs;
}

void add_ratios(std::vector<SummaryRow>& rows, std::span<const RunRecord> runs,
                const Baseline& named) {
  const std::vector<Cell> cells(rows.begin(), rows.end());
  for (SummaryRow& row : rows) {
    const std::optional<Cell> baseline = baseline_among(cells, row, named);
    for (const Figure& figure : all_figures)
      row.ratios.push_back(!baseline || *baseline == row
                               ? std::nullopt
                               : ratio_of(pairs_of(figure, row, *baseline, runs)));
  }
}

std::size_t index_of(const char* name) {
  const auto figure = std::find_if(all_figures.begin(), all_figures.end(), [name](const Figure& f) {
    return std::string_view(f.name) == name;
  });
  assert(figure != all_figures.end());
  return static_cast<std::size_t>(figure - all_figures.begin());
}

std::string cell_columns() {
  std::string columns = "mode,scheme,policy,clients,pucks,bats,server_cores";
  for (const ParameterKind& kind : parameter_kinds()) columns += std::string(",") + kind.key;
  return columns + ",part";
}

std::string cell_values(const Cell& cell) {
  std::string values = csv_text(cell.mode) + "," + csv_text(cell.scheme) + "," +
                       csv_text(cell.policy) + "," + std::to_string(cell.clients) + "," +
                       std::to_string(cell.pucks) + "," + std::to_string(cell.bats) + "," +
                       std::to_string(cell.server_cores);
  for (const ParameterKind& kind : parameter_kinds())
    values += "," + csv_number(kind.of(cell.parameters));
  return values + "," + cell.part;
}

std::pair<std::optional<double>, std::optional<double>> ends_of(
    const std::optional<Interval>& interval) {
  if (!interval) return {};
  return {interval->low, interval->high};
}

}  // namespace

std::span<const Figure> figures() { return all_figures; }

const Statistic& SummaryRow::of(const char* name) const {
  assert(statistics.size() == all_figures.size());
  return statistics[index_of(name)];
}

const std::optional<Ratio>& SummaryRow::ratio(const char* name) const {
  assert(ratios.size() == all_figures.size());
  return ratios[index_of(name)];
}

std::vector<SummaryRow> summarise(std::span<const RunRecord> runs, const Baseline& baseline) {
  std::vector<SummaryRow> rows = empty_rows(runs);
  for (SummaryRow& row : rows) {
    std::vector<const RunRecord*> valid_runs;
    for (const RunRecord& run : runs) {
      if (without_seed(run.cell) != static_cast<const Cell&>(row)) continue;
      ++(run.valid ? row.valid_runs : row.invalid_runs);
      if (!run.valid) continue;
      valid_runs.push_back(&run);
      if (row.relevance.empty()) row.relevance = run.truth.relevance;
    }
    for (const Figure& figure : all_figures)
      row.statistics.push_back(statistic_of(figure, valid_runs));
  }
  add_ratios(rows, runs, baseline);
  assert(std::ranges::all_of(
      rows, [](const SummaryRow& row) { return row.valid_runs + row.invalid_runs > 0; }));
  return rows;
}

Agreement agreement_of(std::span<const RunRecord> runs) {
  std::map<std::pair<std::string, double>, std::vector<std::string>>
      hashes_of_game;  // and of when it ended: not every number of ticks per second ends with the
                       // last of the seconds
  for (const RunRecord& run : runs) {
    if (!run.valid || run.keys != "replay") continue;
    const Population population =
        run.population == "per_client" ? Population::per_client : Population::fixed;
    const std::string game = game_of(run.cell, population);
    const double rate_hz = run.cell.parameters.tick_rate_hz,
                 end_s = run.start_s +
                         std::floor((run.warm_up_s + run.duration_s) * rate_hz + 1e-9) / rate_hz;
    hashes_of_game[{game, end_s}].push_back(run.state_hash);
  }
  Agreement result;
  for (const auto& [game, hashes] : hashes_of_game) {
    if (hashes.size() < 2) continue;
    ++result.games;
    const std::set<std::string> distinct(hashes.begin(), hashes.end());
    if (distinct.size() == 1) continue;
    std::string difference = game.first + ":";
    for (const std::string& hash : distinct) difference += " " + hash;
    result.differing.push_back(difference);
  }
  return result;
}

std::string to_csv(std::span<const SummaryRow> rows) {
  std::string csv = cell_columns() + std::string(",valid_runs,invalid_runs,relevance");
  for (const Figure& figure : all_figures) {
    for (const char* part : {"_mean", "_sd", "_low", "_high", "_min", "_max"})
      csv += std::string(",") + figure.name + part;
  }
  csv += "\n";
  for (const SummaryRow& row : rows) {
    csv += cell_values(row) + "," + std::to_string(row.valid_runs) + "," +
           std::to_string(row.invalid_runs) + "," + csv_text(row.relevance);
    assert(row.statistics.size() == all_figures.size());
    for (const Statistic& statistic : row.statistics) {
      const auto [low, high] = ends_of(statistic.interval);
      for (const auto& value :
           {statistic.mean, statistic.deviation, low, high, statistic.min, statistic.max})
        csv += "," + csv_number(value);
    }
    csv += "\n";
  }
  return csv;
}

std::string comparisons_csv(std::span<const SummaryRow> rows, const Baseline& baseline) {
  std::string csv = cell_columns() + std::string(
                                         ",baseline_scheme,baseline_policy,figure,ratio,ratio_low,"
                                         "ratio_high,pairs,difference,baseline\n");
  for (const SummaryRow& row : rows) {
    assert(row.ratios.size() == all_figures.size());
    for (std::size_t i = 0; i < all_figures.size(); ++i) {
      const std::optional<Ratio>& ratio = row.ratios[i];
      if (!ratio) continue;
      const auto [low, high] = ends_of(ratio->interval);
      csv += cell_values(row) + "," + csv_text(baseline.scheme) + "," + csv_text(baseline.policy) +
             "," + all_figures[i].name + "," + csv_number(ratio->value) + "," + csv_number(low) +
             "," + csv_number(high) + "," + std::to_string(ratio->pairs) + "," +
             words_for(ratio->difference()) + "," + csv_text(baseline.words()) + "\n";
    }
  }
  return csv;
}

}  // namespace rink::loadgen
