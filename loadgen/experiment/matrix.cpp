// The matrix that an experiment spans, and the names of its points.
#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

#include "game/model/listed.h"
#include "im/basics/seeded_stream.h"
#include "loadgen/experiment/cell_key.h"
#include "loadgen/experiment/experiment.h"
#include "loadgen/experiment/parameter.h"
#include "rti/federation_execution.h"

namespace rink::loadgen {
namespace {

/// Called before the parameters that the scheme ignores are removed from the cell, or a cell would
/// occur once for every value of an ignored parameter.
bool is_in_design(const Experiment& experiment, const Cell& cell) {
  const int moved =
      moved_parameters(experiment, cell.parameters) + (cell.clients != experiment.clients.front()) +
      (cell.pucks != experiment.pucks.front()) + (cell.bats != experiment.bats.front());
  return experiment.design == Design::matrix || moved <= 1;
}

/// Publishers of DDS know partitions and send every state at every tick: nothing else to combine.
bool is_of_mode(const Cell& cell) {
  if (cell.mode != dds_mode) return true;
  return cell.policy == "periodic" && (cell.scheme == "none" || cell.scheme == "grid");
}

/// A difference of a cell from the default, as (short name, value, words around the value).
struct Variation {
  const char* name;
  std::string value;
  const char *before, *after;
};

/// True if positions are shown as received, as in the paper, which the policy's name shows.
bool is_paper(const Cell& cell) {
  return cell.policy == "periodic" && !cell.parameters.extrapolates;
}

std::vector<Variation> variations_of(const Cell& cell) {
  const Parameters& own = cell.parameters;
  const Parameters standard;
  std::vector<Variation> all;
  if (cell.pucks > 0) all.push_back({"pucks", std::to_string(cell.pucks), "", " pucks"});
  if (cell.bats > 0) all.push_back({"bats", std::to_string(cell.bats), "", " bats"});
  for (const ParameterKind& kind : parameter_kinds())
    if (kind.of(own) != kind.of(standard) &&
        !(is_paper(cell) && std::string_view(kind.key) == "extrapolate"))
      all.push_back({kind.short_name, shortest(kind.of(own)), kind.before, kind.after});
  if (cell.server_cores != 1)
    all.push_back({"cores", std::to_string(cell.server_cores), "", " cores"});
  return all;
}

}  // namespace

Cell without_idle_parameters(Cell cell) {
  const Parameters standard;
  for (const ParameterKind& kind : parameter_kinds())
    if (!kind.has(cell)) kind.set(cell.parameters, kind.of(standard));
  return cell;
}

Cell baseline_of(Cell cell, const std::string& scheme, const std::string& policy) {
  if (!scheme.empty()) cell.scheme = scheme;
  if (!policy.empty()) cell.policy = policy, cell.parameters.extrapolates = true;
  return without_idle_parameters(std::move(cell));
}

Cell baseline_of(Cell cell, const Baseline& baseline) {
  cell = baseline_of(std::move(cell), baseline.scheme, baseline.policy);
  for (const auto& [name, value] : baseline.others)
    if (const CellKey* key = key_called(name)) key->set(cell, value);
  return without_idle_parameters(std::move(cell));
}

std::optional<Cell> baseline_among(std::span<const Cell> cells, const Cell& cell,
                                   const Baseline& baseline) {
  Cell wanted = baseline_of(cell, baseline);
  if (std::ranges::find(cells, wanted) != cells.end()) return wanted;
  for (const Cell& other : cells) {
    for (const ParameterKind& kind : parameter_kinds())
      if (!kind.has(cell) && kind.has(wanted))
        kind.set(wanted.parameters, kind.of(other.parameters));
    if (wanted == other) return other;
  }
  return std::nullopt;
}

std::string Baseline::words() const {
  std::string text =
      scheme.empty() || policy.empty() ? scheme + policy : scheme + " with " + policy;
  for (const auto& [name, value] : others) game::add_to_list(text, name + " " + value);
  return text;
}

std::string policy_name(const Cell& cell) {
  return is_paper(cell) ? "periodic (paper)" : cell.policy;
}

const Experiment& part_of(const Experiment& experiment, const std::string& part) {
  const auto found = std::find_if(experiment.parts.begin(), experiment.parts.end(),
                                  [&part](const Experiment& each) { return each.part == part; });
  return found == experiment.parts.end() ? experiment : *found;
}

std::vector<Cell> cells_of(const Experiment& experiment) {
  if (!experiment.parts.empty()) {
    std::vector<Cell> all;
    for (const Experiment& part : experiment.parts)
      std::ranges::copy(cells_of(part), std::back_inserter(all));
    return all;
  }
  std::vector<Cell> games;  // all keys that are not compared
  for (const std::uint64_t seed : experiment.seeds)
    for (const std::uint32_t clients : experiment.clients)
      for (const std::uint32_t pucks : experiment.pucks)
        for (const std::uint32_t bats : experiment.bats)
          for (const std::string& mode : experiment.modes)
            for (const std::uint32_t cores : experiment.server_cores)
              games.push_back(
                  {mode, {}, {}, clients, seed, {}, pucks, bats, cores, experiment.part});
  std::vector<Cell> cells;
  for (Cell cell : games) {
    const auto first_of_game = static_cast<std::ptrdiff_t>(cells.size());
    for (const std::string& policy : experiment.policies)
      for (const Parameters& parameters : parameters_of(experiment))
        for (const std::string& scheme : experiment.schemes) {
          cell.policy = policy, cell.parameters = parameters, cell.scheme = scheme;
          if (!is_in_design(experiment, cell) || !is_of_mode(cell)) continue;
          const Cell candidate = without_idle_parameters(cell);
          if (std::find(cells.begin() + first_of_game, cells.end(), candidate) == cells.end())
            cells.push_back(candidate);
        }
  }
  return cells;
}

std::vector<Cell> running_order(const Experiment& experiment) {
  std::vector<Cell> cells = cells_of(experiment);
  const auto replication = [](const Cell& cell) { return std::pair(cell.part, cell.seed); };
  for (auto first = cells.begin(); first != cells.end();) {
    const auto last = std::find_if(first, cells.end(), [&](const Cell& cell) {
      return replication(cell) != replication(*first);
    });
    SeededStream random(first->seed);
    for (auto place = last - first; place > 1; --place)
      std::iter_swap(
          first + (place - 1),
          first + static_cast<std::ptrdiff_t>(random.below(static_cast<std::uint32_t>(place))));
    first = last;
  }
  return cells;
}

std::string name_of(const Cell& cell) {
  std::string name = cell.part.empty() ? "" : cell.part + "-";
  name += cell.mode + "-" + im::file_name_of(cell.scheme) + "-" + cell.policy +
          (is_paper(cell) ? "-paper-" : "-") + std::to_string(cell.clients);
  for (const Variation& variation : variations_of(cell))
    name += std::string("-") + variation.name + variation.value;
  return name + "-seed" + std::to_string(cell.seed);
}

std::string variant_of(const Cell& cell) {
  return game::listed(variations_of(cell), [](const Variation& variation) {
    return variation.before + variation.value + variation.after;
  });
}

std::string game_of(const Cell& cell, Population population) {
  std::string game = "seed" + std::to_string(cell.seed);
  if (population == Population::per_client) game += "-" + std::to_string(cell.clients);
  if (cell.pucks > 0) game += "-pucks" + std::to_string(cell.pucks);
  if (cell.bats > 0) game += "-bats" + std::to_string(cell.bats);
  return game;
}

}  // namespace rink::loadgen
