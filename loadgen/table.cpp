// Lays the summary out in columns.
#include "loadgen/table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace rink::loadgen {
namespace {

template <class... Arguments>
std::string formatted(const char* format, Arguments... arguments) {
  char text[256];
  std::snprintf(text, sizeof text, format, arguments...);
  return text;
}

/// Three significant digits or all digits before the point, `-` if absent; `scale` turns the figure's unit into the column's.
std::string shown(const std::optional<double>& value, double scale = 1.0) {
  if (!value) return "-";
  const double scaled = *value * scale;
  const int decimals = scaled >= 99.95 ? 0 : scaled >= 9.995 ? 1 : 2;
  return formatted("%.*f", decimals, scaled);
}

std::string percent(const std::optional<double>& fraction) {
  if (!fraction) return "-";
  return formatted("%.*f%%", *fraction >= 0.99995 ? 0 : 1, std::floor(*fraction * 1e3) / 10.0);
}

constexpr const char* heading =
    "                  down   wire   all    of upd. age, ms key effect,ms    on      us per tick\n"
    "clients scheme   kB/s per cl.  MB/s  none   p50    p99   p50    p99  time physics filter   send   n\n";

std::string ratio(const SummaryRow& row) {
  if (!row.down_bytes_ratio_to_none) return "-";
  return row.scheme == "none" ? "1" : formatted("%.*f", *row.down_bytes_ratio_to_none < 0.0995 ? 3 : 2, *row.down_bytes_ratio_to_none);
}

std::string line_of(const SummaryRow& row) {
  const auto mean = [&row](const char* name, double scale = 1.0) { return shown(row.of(name).mean, scale); };
  const std::string runs = row.invalid_runs == 0 ? std::to_string(row.valid_runs)
                                                 : std::to_string(row.valid_runs) + "/" + std::to_string(row.valid_runs + row.invalid_runs);
  return formatted("%7u %-7.7s %6s %6s %5s %5s %5s %6s %5s %6s %5s %7s %6s %6s %3s", row.clients, row.scheme.c_str(),
                   mean("down_bytes_per_client_per_s", 1e-3).c_str(), mean("wire_bytes_per_client_per_s", 1e-3).c_str(),
                   mean("wire_bytes_per_client_per_s", 1e-6 * row.clients).c_str(), ratio(row).c_str(), mean("update_age_ms_p50").c_str(),
                   mean("update_age_ms_p99").c_str(), mean("key_to_effect_ms_p50").c_str(), mean("key_to_effect_ms_p99").c_str(),
                   percent(row.of("ticks_on_time_fraction").mean).c_str(), mean("physics_us_per_tick").c_str(), mean("filter_us_per_tick").c_str(),
                   mean("send_us_per_tick").c_str(), runs.c_str());
}

bool is_same_group(const SummaryRow& a, const SummaryRow& b) { return a.mode == b.mode && a.policy == b.policy && a.clients == b.clients; }

bool has_fewest_bytes(const SummaryRow& row, const std::vector<SummaryRow>& rows) {
  const auto own = row.of("wire_bytes_per_client_per_s").mean;
  if (!own) return false;
  std::size_t rivals = 0;
  for (const SummaryRow& other : rows) {
    const auto theirs = other.of("wire_bytes_per_client_per_s").mean;
    if (!is_same_group(row, other) || !theirs || &row == &other) continue;
    ++rivals;
    if (*theirs < *own) return false;
  }
  return rivals > 0;
}

std::string block_title(const SummaryRow& row, std::span<const RunRecord> runs) {
  const auto run = std::find_if(runs.begin(), runs.end(), [&row](const RunRecord& r) { return r.cell.mode == row.mode && r.cell.policy == row.policy; });
  return formatted("%.40s, %.24s at %g Hz, each client sees %g %% of the field", row.mode.c_str(), row.policy.c_str(), run->tick_rate_hz,
                   run->view_fraction * 100.0);
}

std::string agreement_text(std::span<const RunRecord> runs) {
  const Agreement agreement = agreement_of(runs);
  if (agreement.games == 0) return "state hash: no two runs were given the same keys\n";
  if (agreement.differing.empty()) return "all cells of one seed ended in the same state hash: yes\n";
  std::string text = "all cells of one seed ended in the same state hash: NO\n";
  for (const std::string& difference : agreement.differing) text += "  " + difference + "\n";
  return text;
}

std::string invalid_text(std::span<const RunRecord> runs) {
  std::string text;
  for (const RunRecord& run : runs) {
    if (!run.valid) text += "invalid, not averaged in: " + name_of(run.cell) + ": " + run.why_invalid + "\n";
  }
  return text;
}

}  // namespace

std::string table_of(std::span<const RunRecord> runs, bool is_coloured) {
  const std::vector<SummaryRow> rows = summarise(runs);
  std::string text;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool is_new_block = i == 0 || rows[i].mode != rows[i - 1].mode || rows[i].policy != rows[i - 1].policy;
    if (is_new_block) text += (i == 0 ? "" : "\n") + block_title(rows[i], runs) + "\n" + heading;
    if (!is_new_block && rows[i].clients != rows[i - 1].clients) text += "\n";
    const bool is_emphasised = is_coloured && has_fewest_bytes(rows[i], rows);
    text += (is_emphasised ? "\033[1;32m" : "") + line_of(rows[i]) + (is_emphasised ? "\033[0m" : "") + "\n";
  }
  text += "down: payload; wire: both directions with headers; all: wire bytes of all clients;\n";
  text += "of none: down bytes relative to no filter; n: runs averaged (valid/all); -: too few samples to say\n";
  return text + agreement_text(runs) + invalid_text(runs);
}

}  // namespace rink::loadgen
