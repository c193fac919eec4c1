// Columns for the modes.
#include "loadgen/measure/tables/modes_table.h"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "loadgen/measure/formatted.h"
#include "loadgen/measure/summary.h"
#include "loadgen/measure/tables/figure_columns.h"

namespace rink::loadgen {
namespace {

constexpr FigureColumn columns[] = {{"halo", "halo_bytes_per_client_per_s", 1e-3},
                                    {"claims", "claims_bytes_per_client_per_s", 1e-3},
                                    {"agree", "agreement_bytes_per_client_per_s", 1e-3},
                                    {"standby", "standby_bytes_per_client_per_s", 1e-3},
                                    {"inter.", "interest_bytes_per_client_per_s", 1e-3},
                                    {"update", "updates_bytes_per_client_per_s", 1e-3},
                                    {"keys", "keys_bytes_per_client_per_s", 1e-3},
                                    {"down", "down_bytes_per_client_per_s", 1e-3},
                                    {"up", "up_bytes_per_client_per_s", 1e-3},
                                    {"wire", "wire_bytes_per_client_per_s", 1e-3},
                                    {"busiest", "busiest_link_bytes_per_s", 1e-3},
                                    {"events", "busiest_node_events_per_s", 1.0},
                                    {"cpu s", "busiest_node_cpu_s", 1.0},
                                    {"mean", "mean_node_cpu_s", 1.0},
                                    {"effect", "key_to_effect_ms_p50", 1.0},
                                    {"recall", "delivered_recall", 1.0}};

bool is_less(const Statistic& a, const Statistic& b) {
  return a.interval && b.interval && a.interval->high < b.interval->low;
}

/// Which of two modes has less on its busiest link, as far as intervals tell; empty if they do not.
std::string winner_of(const SummaryRow& a, const SummaryRow& b) {
  const Statistic &of_a = a.of("busiest_link_bytes_per_s"),
                  &of_b = b.of("busiest_link_bytes_per_s");
  return is_less(of_a, of_b) ? a.mode : is_less(of_b, of_a) ? b.mode : "";
}

/// True if `b` is the same cell in another mode, whose name comes later.
bool are_rivals(const SummaryRow& a, const SummaryRow& b) {
  Cell other = b;
  other.mode = a.mode;
  return a.mode < b.mode && static_cast<const Cell&>(a) == other;
}

/// Which mode wins where, a line for each winner; one replication tells of none.
std::string winners_text(const std::vector<SummaryRow>& rows) {
  std::map<std::string, std::string> cells;  // by winner
  for (const SummaryRow& a : rows)
    for (const SummaryRow& b : rows) {
      if (!are_rivals(a, b) || a.valid_runs < 2 || b.valid_runs < 2) continue;
      std::string& list = cells[winner_of(a, b)];
      list += (list.empty() ? "" : ", ") + std::to_string(a.clients) + " under " + a.scheme;
    }
  std::string text;
  for (const auto& [winner, list] : cells)
    text += (winner.empty() ? "the modes' intervals for the busiest link overlap"
                            : "the busiest link carries less in mode " + winner) +
            " with clients: " + list + "\n";
  return text;
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
      "down, up and both ways with headers; the busiest link's kB/s both ways with headers and\n"
      "acknowledgements, the busiest node's events/s and processor time, the mean node's; a key's "
      "effect, ms; and the fraction of what concerns a player that it knows. Means over\n"
      "replications, and below them t at 95 % times their standard errors; the intervals are in "
      "summary.csv\n";
  std::vector<SummaryRow> rows = summarise(runs);
  std::size_t width = 7;
  for (const SummaryRow& row : rows) width = std::max(width, row.scheme.size());
  text += "clients scheme" + std::string(width - 6, ' ') + " policy    mode         ";
  text += titles_of(columns);
  std::stable_sort(rows.begin(), rows.end(),
                   [](const SummaryRow& a, const SummaryRow& b) { return a.clients < b.clients; });
  for (const SummaryRow& row : rows) {
    text += formatted("\n%7u %-*s %-9.9s %-13.13s", row.clients, static_cast<int>(width),
                      row.scheme.c_str(), row.policy.c_str(), row.mode.c_str());
    text += means_of(row, columns);
    if (row.valid_runs < 2) continue;
    text += formatted("\n%7s %-*s %-9s %-13s", "", static_cast<int>(width), "", "",
                      ("+- n=" + std::to_string(row.valid_runs)).c_str());
    text += margins_of(row, columns);
  }
  return text + "\n" + winners_text(rows);
}

}  // namespace rink::loadgen
