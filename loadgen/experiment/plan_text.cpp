// A line per cell.
#include "loadgen/experiment/plan_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

namespace rink::loadgen {
namespace {

std::string clock_text(double duration_s) {
  char text[32];
  const auto whole = std::lround(duration_s);
  std::snprintf(text, sizeof text, "%ld:%02ld", whole / 60, whole % 60);
  return text;
}

}  // namespace

/// Virtual time passes as fast as the machine computes, several cells beside each other.
double expected_cell_s(const Experiment& experiment, const Cell& cell) {
  const Experiment& part = part_of(experiment, cell.part);
  return part.transport == TransportKind::virtual_time ? 0.2
                                                       : part.warm_up_s + part.duration_s + 1.0;
}

double expected_cell_s(const Experiment& experiment) {
  double sum_s = 0.0;
  const std::vector<Cell> cells = cells_of(experiment);
  for (const Cell& cell : cells) sum_s += expected_cell_s(experiment, cell);
  return sum_s / static_cast<double>(cells.size());
}

std::string plan_text(const Experiment& experiment, std::size_t open_files_needed,
                      std::size_t open_files_max) {
  const std::vector<Cell> cells = running_order(experiment);
  const double cell_s = expected_cell_s(experiment);
  const bool is_virtual = std::ranges::all_of(cells, [&](const Cell& cell) {
    return part_of(experiment, cell.part).transport == TransportKind::virtual_time;
  });
  std::string text = "experiment " + experiment.name + ", scene " + experiment.scene + ": " +
                     std::to_string(cells.size()) + " cells";
  const std::string times = (experiment.parts.empty() ? ", each about " + clock_text(cell_s) : "") +
                            ", about " + clock_text(cell_s * static_cast<double>(cells.size())) +
                            " in all\n";
  text += is_virtual ? " in virtual time, each as fast as this machine computes\n" : times;
  std::set<std::string> games;
  double start_s = 0.0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::string start = is_virtual ? "" : "  at " + clock_text(start_s);
    start_s += expected_cell_s(experiment, cells[i]);
    text += "  " + std::to_string(i + 1) + start + "  " + name_of(cells[i]) + "\n";
    games.insert(game_of(cells[i], part_of(experiment, cells[i].part).population));
  }
  text += "ratios refer to " + experiment.baseline().words() + "\n";
  if (experiment.seeds.size() < 2)
    text += "one seed: without replications no difference can be told from chance\n";
  text += "files: " + std::to_string(games.size()) +
          " key logs, up to 4 per cell in cells/, runs.jsonl, summary.csv, comparisons.csv, "
          "report.html, provenance.json\n";
  text += "open files: " + std::to_string(open_files_needed) + " needed, " +
          std::to_string(open_files_max) + " allowed\n";
  return text;
}

}  // namespace rink::loadgen
