// Ratios paired by seed, and the choice of what is compared.
#include "loadgen/report/sections/gains.h"

#include <algorithm>

#include "loadgen/report/plots/text.h"
#include "loadgen/report/sections/run_figures.h"

namespace rink::loadgen {
namespace {

/// True if the two play the same game for the same crowd.
bool is_comparable(const Cell& a, const Cell& b) {
  return a.mode == b.mode && a.part == b.part && a.clients == b.clients && a.pucks == b.pucks &&
         a.bats == b.bats && a.server_cores == b.server_cores;
}

const CellGroup* baseline_for(const Findings& findings, const Cell& cell) {
  const CellGroup* found = nullptr;
  const Cell named = baseline_of(without_seed(cell), findings.experiment.baseline());
  for (const CellLine& line : findings.lines)
    for (const CellGroup& group : line.groups)
      if (without_seed(group.cell) == named) return &group;
  for (const CellLine& line : findings.lines) {
    for (const CellGroup& group : line.groups) {
      const bool is_baseline = group.cell.scheme == findings.experiment.baseline_scheme &&
                               group.cell.policy == findings.experiment.baseline_policy;
      if (!is_baseline || !is_comparable(group.cell, cell)) continue;
      if (!found || group.cell.parameters.view_fraction == cell.parameters.view_fraction)
        found = &group;
    }
  }
  return found;
}

Gain::Kind kind_of(const Cell& baseline, const CellGroup& group, const CellGroup* base) {
  if (&group == base) return Gain::Kind::baseline;
  const bool other_scheme = group.cell.scheme != baseline.scheme,
             other_policy = group.cell.policy != baseline.policy;
  if (other_scheme && other_policy) return Gain::Kind::together;
  if (other_scheme) return Gain::Kind::filter_alone;
  return other_policy ? Gain::Kind::policy_alone : Gain::Kind::parameters;
}

}  // namespace

std::optional<Ratio> paired_ratio(const CellGroup& baseline, const CellGroup& own,
                                  FigureOf figure) {
  std::vector<std::pair<double, double>> pairs;
  for (const RunRecord* run : own.runs) {
    const auto twin =
        std::find_if(baseline.runs.begin(), baseline.runs.end(),
                     [run](const RunRecord* other) { return other->cell.seed == run->cell.seed; });
    if (twin == baseline.runs.end()) continue;
    const auto above = figure(**twin), below = figure(*run);
    if (!above || !below) return std::nullopt;
    pairs.emplace_back(*above, *below);
  }
  return ratio_of(pairs);
}

std::vector<Gain> gains_of(const Findings& findings) {
  std::vector<Gain> gains;
  for (const std::uint32_t clients : client_counts(findings.lines)) {
    for (const CellLine& line : findings.lines) {
      for (const CellGroup& group : line.groups) {
        const CellGroup* base =
            group.cell.clients == clients ? baseline_for(findings, group.cell) : nullptr;
        if (!base || group.runs.empty()) continue;
        gains.push_back(
            {kind_of(base->cell, group, base), &line, &group, paired_ratio(*base, group, payload)});
      }
    }
  }
  return gains;
}

std::string headline_of(const Findings& findings) {
  const std::vector<Gain> gains = gains_of(findings);
  if (gains.empty()) return "";
  const std::uint32_t most_clients = gains.back().group->cell.clients;
  const Gain* best = nullptr;
  for (const Gain& gain : gains) {
    if (gain.kind == Gain::Kind::baseline || gain.group->cell.clients != most_clients ||
        !gain.bytes)
      continue;
    if (!best || gain.bytes->value > best->bytes->value) best = &gain;
  }
  if (!best || best->bytes->value <= 1.0) return "";
  const CellGroup* base = baseline_for(findings, best->group->cell);
  std::string text = "At " + std::to_string(most_clients) + " clients " + best->line->name +
                     " sends " + plain_number(best->bytes->value) +
                     " times fewer payload bytes than " + line_name(findings.lines, base->cell);
  if (best->bytes->interval)
    text += " (95 % interval " + plain_number(best->bytes->interval->low) + " to " +
            plain_number(best->bytes->interval->high) + ")";
  const auto own_error = best->group->mean(displayed_rms), base_error = base->mean(displayed_rms);
  if (own_error && base_error)
    text += ", with a displayed error of " + plain_number(own_error->mean) + " mm RMS against " +
            plain_number(base_error->mean) + " mm, which is no comparison at equal error";
  return text + (best->bytes->difference() == Difference::insignificant
                     ? "; no significant difference."
                     : ".");
}

}  // namespace rink::loadgen
