// Columns for numbers of nodes, and their ratios in words.
#include "loadgen/measure/tables/nodes_table.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "loadgen/measure/formatted.h"
#include "loadgen/measure/statistics/statistics.h"
#include "loadgen/measure/summary.h"
#include "loadgen/measure/tables/figure_columns.h"

namespace rink::loadgen {
namespace {

constexpr FigureColumn node_columns[] = {{"link", "busiest_link_bytes_per_s", 1e-3},
                                         {"between", "between_nodes_bytes_per_s", 1e-3},
                                         {"down", "down_bytes_per_client_per_s", 1e-3},
                                         {"wire", "wire_bytes_per_client_per_s", 1e-3},
                                         {"cpu s", "busiest_node_cpu_s"},
                                         {"all", "server_cpu_s"},
                                         {"effect", "key_to_effect_ms_p50"},
                                         {"p99", "key_to_effect_ms_p99"},
                                         {"age", "update_age_ms_p50"},
                                         {"on time", "ticks_on_time_fraction"}};

constexpr const char* table_words =
    "several nodes that share a simulation: the busiest link of a node to its clients and to the "
    "others, and all that nodes send each other, kB/s with headers and\n"
    "acknowledgements; each client's down, and both ways with headers, kB/s; processor time of the "
    "busiest node and of all; a key's effect, ms, median and p99; the age of updates, ms; ticks on "
    "time.\nMeans over replications, and below them t at 95 % times their standard errors; the "
    "intervals are in summary.csv\n";

std::uint32_t least_nodes(const std::vector<SummaryRow>& rows) {
  return std::ranges::min(rows, {}, [](const SummaryRow& row) { return row.parameters.nodes; })
      .parameters.nodes;
}

/// As `1.80 times (1.70 to 1.90)`; without an interval where one replication tells of none.
std::string times_text(const Ratio& ratio) {
  const std::string text = formatted("%.2f times", ratio.value);
  if (!ratio.interval) return text + " (one replication)";
  return text + formatted(" (%.2f to %.2f%s)", ratio.interval->low, ratio.interval->high,
                          ratio.difference() == Difference::insignificant
                              ? ", no significant difference"
                              : "");
}

struct Clause {
  const char *before, *figure, *after;
};

constexpr Clause clauses[] = {
    {"the busiest link carries ", "busiest_link_bytes_per_s", " as much"},
    {"the busiest node takes ", "busiest_node_cpu_s", " the processor time"},
    {"all nodes together take ", "server_cpu_s", " as much of it"},
    {"a key comes to its effect after ", "key_to_effect_ms_p50", " the time"}};

/// What was not measured is left out.
std::string sentence(const SummaryRow& row, std::uint32_t least) {
  std::string text = formatted("%u clients, %.30s, %.20s, %u nodes instead of %u: ", row.clients,
                               row.scheme.c_str(), row.policy.c_str(), row.parameters.nodes, least);
  bool is_first = true;
  for (const Clause& clause : clauses) {
    const std::optional<Ratio>& ratio = row.ratio(clause.figure);
    if (!ratio) continue;
    text += (is_first ? "" : "; ") + (clause.before + times_text(*ratio)) + clause.after;
    is_first = false;
  }
  return is_first ? text + "nothing was measured of both.\n" : text + ".\n";
}

}  // namespace

bool has_several_nodes(std::span<const RunRecord> runs) {
  return std::ranges::any_of(runs, [&](const RunRecord& run) {
    return run.cell.parameters.nodes != runs.front().cell.parameters.nodes;
  });
}

std::string nodes_table(std::span<const RunRecord> runs) {
  if (!has_several_nodes(runs)) return {};
  const std::uint32_t least = least_nodes(summarise(runs));
  const std::vector<SummaryRow> rows =
      summarise(runs, {.scheme = {}, .policy = {}, .others = {{"nodes", std::to_string(least)}}});
  std::size_t width = 7;
  for (const SummaryRow& row : rows) width = std::max(width, row.scheme.size());
  std::string text = table_words;
  text +=
      "clients scheme" + std::string(width - 6, ' ') + " policy    nodes" + titles_of(node_columns);
  std::string sentences;
  for (const SummaryRow& row : rows) {
    text += formatted("\n%7u %-*s %-9.9s %5u", row.clients, static_cast<int>(width),
                      row.scheme.c_str(), row.policy.c_str(), row.parameters.nodes) +
            means_of(row, node_columns);
    if (row.valid_runs > 1)
      text += formatted("\n%7s %-*s %-9s %5s", "", static_cast<int>(width), "",
                        ("+- n=" + std::to_string(row.valid_runs)).c_str(), "") +
              margins_of(row, node_columns);
    if (row.parameters.nodes != least) sentences += sentence(row, least);
  }
  return text + "\n" + sentences;
}

}  // namespace rink::loadgen
