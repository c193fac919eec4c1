// The table of parameters.
#include "loadgen/experiment/parameter.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

#include "game/net/peer/network/greetings.h"
#include "game/replication/update_policy.h"
#include "rti/federation_execution.h"

namespace rink::loadgen {

bool has_regions(const Cell& cell) { return !im::are_equivalent(cell.scheme, "none"); }

namespace {

bool always(const Cell&) { return true; }
bool has_cells(const Cell& cell) { return im::takes_cell_size(cell.scheme); }
bool reckons(const Cell& cell) { return game::takes_threshold(cell.policy); }
bool tells_positions(const Cell& cell) { return cell.policy == "periodic"; }
bool has_server(const Cell& cell) { return cell.mode != peer_mode; }
bool tells_at_a_rate(const Cell& cell) {
  return has_server(cell) && cell.policy != game::exact_policy;
}
static_assert(game::peers_max == 64, "as the words for `nodes` say");

constexpr std::array kinds{
    ParameterKind{"view_fraction", "numbers above 0 and at most 1",
                  [](double v) { return v > 0.0 && v <= 1.0; }, false,
                  [](const Parameters& p) { return p.view_fraction; },
                  [](Parameters& p, double v) { p.view_fraction = v; }, &Experiment::view_fractions,
                  always, "view", "view ", "", "area of the view [% of the field]", "view, %",
                  100.0},
    ParameterKind{
        "view_margin", "numbers from 0 to 1e6", [](double v) { return v >= 0.0 && v <= 1e6; },
        false, [](const Parameters& p) { return p.view_margin; },
        [](Parameters& p, double v) { p.view_margin = v; }, &Experiment::view_margins, has_regions,
        "margin", "margin ", " m", "margin around the view [m]", "margin, m", 1.0},
    ParameterKind{"sweep_ticks", "whole numbers from 0 to 1000",
                  [](double v) { return v >= 0.0 && v <= 1000.0; }, true,
                  [](const Parameters& p) { return static_cast<double>(p.sweep_ticks); },
                  [](Parameters& p, double v) { p.sweep_ticks = static_cast<std::uint32_t>(v); },
                  &Experiment::sweep_ticks, has_regions, "sweep", "swept ", " ticks",
                  "update regions swept over [ticks]", "swept", 1.0},
    ParameterKind{"cell_size", "numbers from 0.001 to 1e6, or 0 (the scheme chooses)",
                  [](double v) { return v == 0.0 || (v >= 1e-3 && v <= 1e6); }, false,
                  [](const Parameters& p) { return p.cell_size; },
                  [](Parameters& p, double v) { p.cell_size = v; }, &Experiment::cell_sizes,
                  has_cells, "cell", "cells ", " m", "side of a cell [m]", "cells, m", 1.0},
    ParameterKind{"tick_rate_hz", "numbers from 1 to 1000",
                  [](double v) { return v >= 1.0 && v <= 1000.0; }, false,
                  [](const Parameters& p) { return p.tick_rate_hz; },
                  [](Parameters& p, double v) { p.tick_rate_hz = v; }, &Experiment::tick_rates_hz,
                  always, "rate", "", " Hz", "ticks per second", "rate, Hz", 1.0},
    ParameterKind{
        "threshold", "numbers from 1e-4 to 10", [](double v) { return v >= 1e-4 && v <= 10.0; },
        false, [](const Parameters& p) { return p.threshold; },
        [](Parameters& p, double v) { p.threshold = v; }, &Experiment::thresholds, reckons,
        "threshold", "threshold ", " m", "threshold of dead reckoning [mm]", "thr., mm", 1000.0},
    ParameterKind{"extrapolate", "true, false or both",
                  [](double v) { return v == 0.0 || v == 1.0; }, true,
                  [](const Parameters& p) { return p.extrapolates ? 1.0 : 0.0; },
                  [](Parameters& p, double v) { p.extrapolates = v != 0.0; },
                  &Experiment::extrapolates, tells_positions, "extrapolate", "extrapolate ", "",
                  "positions are extrapolated", "ahead", 1.0, true},
    ParameterKind{"nodes", "whole numbers from 1 to 64",
                  [](double v) { return v >= 1.0 && v <= game::peers_max; }, true,
                  [](const Parameters& p) { return static_cast<double>(p.nodes); },
                  [](Parameters& p, double v) { p.nodes = static_cast<std::uint32_t>(v); },
                  &Experiment::nodes, has_server, "nodes", "", " nodes", "nodes", "nodes", 1.0},
    ParameterKind{"output_rate_hz", "numbers from 0.1 to 1000, or 0 (each tick is told)",
                  [](double v) { return v == 0.0 || (v >= 0.1 && v <= 1000.0); }, false,
                  [](const Parameters& p) { return p.output_rate_hz; },
                  [](Parameters& p, double v) { p.output_rate_hz = v; },
                  &Experiment::output_rates_hz, tells_at_a_rate, "told", "told at ", " Hz",
                  "times a second that a client is told", "told, Hz", 1.0}};

}  // namespace

std::span<const ParameterKind> parameter_kinds() { return kinds; }

std::string shortest(double value) {
  std::array<char, 32> digits;
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
}

std::vector<const ParameterKind*> swept_parameters(const Experiment& experiment) {
  std::vector<const ParameterKind*> swept;
  for (const ParameterKind& kind : kinds)
    if ((experiment.*kind.values).size() > 1) swept.push_back(&kind);
  return swept;
}

std::vector<Parameters> parameters_of(const Experiment& experiment) {
  std::vector<Parameters> all{{}};
  for (const ParameterKind& kind : kinds) {
    std::vector<Parameters> longer;
    for (Parameters parameters : all)
      for (const double value : experiment.*kind.values)
        kind.set(parameters, value), longer.push_back(parameters);
    all = std::move(longer);
  }
  return all;
}

bool is_at_first_values(const Experiment& experiment, const Cell& cell,
                        const ParameterKind* except) {
  return std::all_of(kinds.begin(), kinds.end(), [&](const ParameterKind& kind) {
    return (except && std::string_view(kind.key) == except->key) || !kind.has(cell) ||
           kind.of(cell.parameters) == (experiment.*kind.values).front();
  });
}

std::string value_text(const ParameterKind& kind, const Cell& cell) {
  const double value = kind.of(cell.parameters);
  return value == 0.0 && std::string_view(kind.key) == "cell_size" ? "chosen"
                                                                   : shortest(kind.scale * value);
}

int moved_parameters(const Experiment& experiment, const Parameters& own) {
  int moved = 0;
  for (const ParameterKind& kind : kinds)
    moved += kind.of(own) != (experiment.*kind.values).front();
  return moved;
}

}  // namespace rink::loadgen
