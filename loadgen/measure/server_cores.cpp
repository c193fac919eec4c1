// Pairs runs by seed and averages the logarithms of their ratios.
#include "loadgen/measure/server_cores.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "loadgen/experiment/csv_number.h"
#include "loadgen/measure/formatted.h"
#include "loadgen/measure/summary.h"

namespace rink::loadgen {
namespace {

constexpr std::array compared_figures{
    Figure{"total_us_per_tick", [](const RunRecord& run) { return run.total_us_per_tick(); }},
    Figure{"ticks_on_time_fraction",
           [](const RunRecord& run) { return run.ticks_on_time_fraction; }},
    Figure{"update_age_ms_p50", [](const RunRecord& run) { return run.update_age_ms.p50; }},
    Figure{"update_age_ms_p99", [](const RunRecord& run) { return run.update_age_ms.p99; }},
    Figure{"server_cpu_s", [](const RunRecord& run) { return run.server_cpu_s; }},
};

struct Pair {
  const RunRecord *apart, *anywhere;
};

/// The pairs of one cell in order of their first run, a group per cell.
std::vector<std::vector<Pair>> pairs_of(std::span<const RunRecord> runs) {
  std::vector<std::vector<Pair>> groups;
  for (const RunRecord& run : runs) {
    if (!run.valid || run.cell.server_cores != 1) continue;
    Cell wanted = run.cell;
    wanted.server_cores = 2;
    const auto partner = std::find_if(runs.begin(), runs.end(), [&wanted](const RunRecord& other) {
      return other.valid && other.cell == wanted;
    });
    if (partner == runs.end()) continue;
    const auto group = std::find_if(groups.begin(), groups.end(), [&run](const auto& g) {
      return without_seed(g.front().apart->cell) == without_seed(run.cell);
    });
    if (group == groups.end()) {
      groups.push_back({{&run, &*partner}});
    } else {
      group->push_back({&run, &*partner});
    }
  }
  return groups;
}

/// Nothing if some run lacks the figure or has 0, of which there is no ratio.
std::optional<CoresRatio> cores_ratio(const std::vector<Pair>& pairs, const Figure& figure) {
  assert(!pairs.empty());
  std::vector<std::pair<double, double>> values;
  for (const Pair& pair : pairs) {
    const auto apart = figure.of(*pair.apart), anywhere = figure.of(*pair.anywhere);
    if (!apart || !anywhere) return std::nullopt;
    values.emplace_back(*anywhere, *apart);
  }
  const auto ratio = ratio_of(values);
  if (!ratio) return std::nullopt;
  return CoresRatio{pairs.front().apart->cell, figure.name, *ratio};
}

}  // namespace

std::vector<CoresRatio> cores_ratios_of(std::span<const RunRecord> runs) {
  std::vector<CoresRatio> ratios;
  for (const std::vector<Pair>& pairs : pairs_of(runs))
    for (const Figure& figure : compared_figures)
      if (const auto ratio = cores_ratio(pairs, figure)) ratios.push_back(*ratio);
  return ratios;
}

std::string to_csv(std::span<const CoresRatio> ratios) {
  std::string csv =
      "mode,scheme,policy,clients,pucks,bats,figure,pairs,ratio,ratio_low,ratio_high\n";
  for (const CoresRatio& ratio : ratios) {
    const Cell& cell = ratio.cell;
    const auto& interval = ratio.ratio.interval;
    csv += cell.mode + "," + cell.scheme + "," + cell.policy + "," + std::to_string(cell.clients) +
           "," + std::to_string(cell.pucks) + "," + std::to_string(cell.bats) + "," + ratio.figure +
           "," + std::to_string(ratio.ratio.pairs) + "," + six_digits(ratio.ratio.value) + "," +
           (interval ? six_digits(interval->low) + "," + six_digits(interval->high) : ",") + "\n";
  }
  return csv;
}

std::string cores_table(std::span<const CoresRatio> ratios) {
  if (ratios.empty()) return {};
  std::string text =
      "server and bots on any processor / each on its own, with 95 % interval\nscheme  policy      "
      "  clients  figure                      ratio\n";
  for (const CoresRatio& ratio : ratios) {
    text += formatted("%-7.7s %-13.13s %7u  %-24.24s %7.3f", ratio.cell.scheme.c_str(),
                      ratio.cell.policy.c_str(), ratio.cell.clients, ratio.figure.c_str(),
                      ratio.ratio.value);
    const Difference difference = ratio.ratio.difference();
    if (const auto& interval = ratio.ratio.interval)
      text += formatted("  %.3f to %.3f", interval->low, interval->high);
    if (difference == Difference::insignificant || difference == Difference::unknown)
      text += std::string("  ") + words_for(difference);
    text += "\n";
  }
  return text;
}

}  // namespace rink::loadgen
