// Columns for the modes.
#include "loadgen/measure/modes_table.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "loadgen/measure/formatted.h"
#include "loadgen/measure/statistics/distributions.h"
#include "loadgen/measure/summary.h"
#include "loadgen/measure/table_number.h"

namespace rink::loadgen {
namespace {

struct Column {
  const char* title;
  const char* figure;
  double scale;
};

constexpr Column columns[] = {{"halo", "halo_bytes_per_client_per_s", 1e-3},
                              {"claims", "claims_bytes_per_client_per_s", 1e-3},
                              {"agree", "agreement_bytes_per_client_per_s", 1e-3},
                              {"inter.", "interest_bytes_per_client_per_s", 1e-3},
                              {"update", "updates_bytes_per_client_per_s", 1e-3},
                              {"keys", "keys_bytes_per_client_per_s", 1e-3},
                              {"down", "down_bytes_per_client_per_s", 1e-3},
                              {"up", "up_bytes_per_client_per_s", 1e-3},
                              {"wire", "wire_bytes_per_client_per_s", 1e-3},
                              {"busiest", "busiest_node_bytes_per_s", 1e-3},
                              {"events", "busiest_node_events_per_s", 1.0},
                              {"cpu s", "busiest_node_cpu_s", 1.0},
                              {"mean", "mean_node_cpu_s", 1.0},
                              {"effect", "key_to_effect_ms_p50", 1.0},
                              {"recall", "delivered_recall", 1.0}};

/// Student's t times the standard error: about half the width of the interval, which keeps above 0
/// and is not symmetric.
std::optional<double> margin(const Statistic& statistic, std::size_t runs) {
  if (!statistic.deviation) return std::nullopt;
  assert(runs > 1);
  const auto count = static_cast<double>(runs);
  return student_t_quantile(0.5 + 0.5 * interval_confidence, count - 1.0) * *statistic.deviation /
         std::sqrt(count);
}

std::string padded(const std::string& text, std::size_t width) {
  return std::string(text.size() < width ? width - text.size() : 0, ' ') + text;
}

}  // namespace

bool has_several_modes(std::span<const RunRecord> runs) {
  return std::any_of(runs.begin(), runs.end(),
                     [&](const RunRecord& run) { return run.cell.mode != runs.front().cell.mode; });
}

std::string modes_table(std::span<const RunRecord> runs) {
  if (!has_several_modes(runs)) return {};
  std::string text =
      "nodes with a server and without: kB/s for each client by what they are about, then all "
      "down, up and both ways with headers; the busiest node's kB/s of payload both ways,\n"
      "events/s and processor time, the mean node's; a key's effect, ms; and the fraction of what "
      "concerns a player that it knows. Means over replications, and below them t\n"
      "at 95 % times their standard errors; the intervals are in summary.csv\n";
  std::vector<SummaryRow> rows = summarise(runs);
  std::size_t width = 7;
  for (const SummaryRow& row : rows) width = std::max(width, row.scheme.size());
  text += "clients scheme" + std::string(width - 6, ' ') + " policy    mode         ";
  for (const Column& column : columns) text += " " + padded(column.title, 7);
  std::stable_sort(rows.begin(), rows.end(),
                   [](const SummaryRow& a, const SummaryRow& b) { return a.clients < b.clients; });
  for (const SummaryRow& row : rows) {
    text += formatted("\n%7u %-*s %-9.9s %-13.13s", row.clients, static_cast<int>(width),
                      row.scheme.c_str(), row.policy.c_str(), row.mode.c_str());
    for (const Column& column : columns)
      text += " " + padded(table_number(row.of(column.figure).mean, column.scale), 7);
    if (row.valid_runs < 2) continue;
    text += formatted("\n%7s %-*s %-9s %-13s", "", static_cast<int>(width), "", "",
                      ("+- n=" + std::to_string(row.valid_runs)).c_str());
    for (const Column& column : columns)
      text += " " +
              padded(table_number(margin(row.of(column.figure), row.valid_runs), column.scale), 7);
  }
  return text + "\n";
}

}  // namespace rink::loadgen
