// Pairs runs by seed and averages the logarithms of their ratios.
#include "loadgen/server_cores.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "loadgen/distributions.h"

namespace rink::loadgen {
namespace {

std::optional<double> total_us(const RunRecord& run) {
  if (!run.physics_us_per_tick || !run.filter_us_per_tick || !run.send_us_per_tick) return std::nullopt;
  return *run.physics_us_per_tick + *run.filter_us_per_tick + *run.send_us_per_tick;
}

struct Quantity {
  const char* name;
  std::optional<double> (*of)(const RunRecord&);
};
constexpr std::array quantities{
    Quantity{"total_us_per_tick", total_us},
    Quantity{"ticks_on_time_fraction", [](const RunRecord& run) { return run.ticks_on_time_fraction; }},
    Quantity{"update_age_ms_p50", [](const RunRecord& run) { return run.update_age_ms.p50; }},
    Quantity{"update_age_ms_p99", [](const RunRecord& run) { return run.update_age_ms.p99; }},
    Quantity{"server_cpu_s", [](const RunRecord& run) { return run.server_cpu_s; }},
};

struct Pair {
  const RunRecord *apart, *anywhere;
};

Cell without_seed(Cell cell) {
  cell.seed = 0;
  return cell;
}

/// The pairs of one cell in order of their first run, a group per cell.
std::vector<std::vector<Pair>> pairs_of(std::span<const RunRecord> runs) {
  std::vector<std::vector<Pair>> groups;
  for (const RunRecord& run : runs) {
    if (!run.valid || run.cell.server_cores != 1) continue;
    Cell wanted = run.cell;
    wanted.server_cores = 2;
    const auto partner = std::find_if(runs.begin(), runs.end(), [&wanted](const RunRecord& other) { return other.valid && other.cell == wanted; });
    if (partner == runs.end()) continue;
    const auto group = std::find_if(groups.begin(), groups.end(), [&run](const auto& g) { return without_seed(g.front().apart->cell) == without_seed(run.cell); });
    if (group == groups.end()) {
      groups.push_back({{&run, &*partner}});
    } else {
      group->push_back({&run, &*partner});
    }
  }
  return groups;
}

/// Nothing if some run lacks the figure or has 0, of which there is no ratio.
std::optional<CoresRatio> ratio_of(const std::vector<Pair>& pairs, const Quantity& quantity) {
  std::vector<double> logs;
  for (const Pair& pair : pairs) {
    const auto apart = quantity.of(*pair.apart), anywhere = quantity.of(*pair.anywhere);
    if (!apart || !anywhere || *apart <= 0.0 || *anywhere <= 0.0) return std::nullopt;
    logs.push_back(std::log(*anywhere / *apart));
  }
  const auto count = static_cast<double>(logs.size());
  double mean = 0.0, squares = 0.0;
  for (const double log : logs) mean += log / count;
  for (const double log : logs) squares += (log - mean) * (log - mean);
  CoresRatio result{pairs.front().apart->cell, quantity.name, pairs.size(), std::exp(mean), std::nullopt, std::nullopt};
  if (logs.size() > 1) {
    const double half = student_t_quantile(0.975, count - 1.0) * std::sqrt(squares / (count - 1.0) / count);
    result.low = std::exp(mean - half);
    result.high = std::exp(mean + half);
  }
  return result;
}

std::string number(std::optional<double> value) {
  if (!value) return {};
  std::array<char, 32> digits;
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), *value, std::chars_format::general, 6).ptr};
}

}  // namespace

std::vector<CoresRatio> cores_ratios_of(std::span<const RunRecord> runs) {
  std::vector<CoresRatio> ratios;
  for (const std::vector<Pair>& pairs : pairs_of(runs))
    for (const Quantity& quantity : quantities)
      if (const auto ratio = ratio_of(pairs, quantity)) ratios.push_back(*ratio);
  return ratios;
}

std::string to_csv(std::span<const CoresRatio> ratios) {
  std::string csv = "mode,scheme,policy,clients,pucks,bats,figure,pairs,ratio,ratio_low,ratio_high\n";
  for (const CoresRatio& ratio : ratios) {
    const Cell& cell = ratio.cell;
    csv += cell.mode + "," + cell.scheme + "," + cell.policy + "," + std::to_string(cell.clients) + "," + std::to_string(cell.pucks) + "," + std::to_string(cell.bats) + "," +
           ratio.figure + "," + std::to_string(ratio.pairs) + "," + number(ratio.ratio) + "," + number(ratio.low) + "," + number(ratio.high) + "\n";
  }
  return csv;
}

std::string cores_table(std::span<const CoresRatio> ratios) {
  if (ratios.empty()) return {};
  std::string text = "server and bots on any processor / each on its own, with 95 % interval\nscheme  policy        clients  figure                      ratio\n";
  std::array<char, 160> line;
  for (const CoresRatio& ratio : ratios) {
    std::snprintf(line.data(), line.size(), "%-7.7s %-13.13s %7u  %-24.24s %7.3f", ratio.cell.scheme.c_str(), ratio.cell.policy.c_str(), ratio.cell.clients, ratio.figure.c_str(),
                  ratio.ratio);
    text += line.data();
    if (ratio.low) {
      std::snprintf(line.data(), line.size(), "  %.3f to %.3f%s", *ratio.low, *ratio.high, ratio.is_significant() ? "" : "  no significant difference");
      text += line.data();
    } else {
      text += "  cannot be told from one replication";
    }
    text += "\n";
  }
  return text;
}

}  // namespace rink::loadgen
