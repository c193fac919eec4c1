// Groups runs by everything but the seed, and groups by everything but the clients.
#include "loadgen/report/sections/cell_lines.h"

#include <algorithm>
#include <cassert>
#include <functional>
#include <set>

#include "loadgen/experiment/parameter.h"
#include "loadgen/report/plots/text.h"

namespace rink::loadgen {
namespace {

Cell without_clients(Cell cell) {
  cell.seed = 0;
  cell.clients = 0;
  return cell;
}

/// A number that lines may differ in beside scheme and policy, and its text in names.
struct Setting {
  std::function<double(const Cell&)> of;
  const char *before, *after;
};

const std::vector<Setting>& settings() {
  static const std::vector<Setting> all = [] {
    std::vector<Setting> list;
    for (const ParameterKind& kind : parameter_kinds())
      if (!kind.is_switch)
        list.push_back({[kind](const Cell& cell) { return kind.scale * kind.of(cell.parameters); },
                        kind.before, kind.scale == 100.0 ? " %" : kind.after});
    list.push_back(
        {[](const Cell& cell) { return static_cast<double>(cell.pucks); }, "", " pucks"});
    list.push_back({[](const Cell& cell) { return static_cast<double>(cell.bats); }, "", " bats"});
    list.push_back(
        {[](const Cell& cell) { return static_cast<double>(cell.server_cores); }, "", " cores"});
    return list;
  }();
  return all;
}

template <class Value>
bool differs(const std::vector<CellLine>& lines, const std::string& scheme, Value of) {
  std::set<std::decay_t<decltype(of(Cell{}))>> values;
  for (const CellLine& line : lines) {
    const Cell& cell = line.groups.front().cell;
    if (scheme.empty() || cell.scheme == scheme) values.insert(of(cell));
  }
  return values.size() > 1;
}

std::string name_among(const std::vector<CellLine>& lines, const Cell& cell) {
  std::string name = cell.scheme;
  if (differs(lines, "", policy_name)) name += ", " + policy_name(cell);
  for (const Setting& setting : settings()) {
    if (differs(lines, cell.scheme, setting.of))
      name += std::string(", ") + setting.before + short_number(setting.of(cell)) + setting.after;
  }
  if (differs(lines, "", [](const Cell& other) { return other.mode; })) name += ", " + cell.mode;
  if (differs(lines, "", [](const Cell& other) { return other.part; })) name += ", " + cell.part;
  return name;
}

}  // namespace

void name_and_style(std::vector<CellLine>& lines) {
  std::vector<std::string> schemes, policies;
  const auto place = [](std::vector<std::string>& seen, const std::string& value) {
    const auto found = std::find(seen.begin(), seen.end(), value);
    if (found != seen.end()) return static_cast<std::size_t>(found - seen.begin());
    seen.push_back(value);
    return seen.size() - 1;
  };
  for (std::size_t i = 0; i < lines.size(); ++i) {
    assert(!lines[i].groups.empty());
    const Cell& cell = lines[i].groups.front().cell;
    lines[i].name = name_among(lines, cell);
    lines[i].style = {place(schemes, cell.scheme), place(policies, policy_name(cell)), i};
  }
  if (schemes.size() > 1) return;
  for (std::size_t i = 0; i < lines.size(); ++i)
    lines[i].style.colour = i;  // of one scheme, colours show the differences
}

MeanInterval mean_interval(const std::vector<double>& values, Scale scale) {
  assert(!values.empty());
  double sum = 0.0;
  for (const double value : values) sum += value;
  MeanInterval result{sum / static_cast<double>(values.size())};
  if (const auto interval = interval_of_mean(values, scale))
    result.interval = {interval->low, interval->high};
  return result;
}

std::vector<double> CellGroup::values(FigureOf figure) const {
  std::vector<double> result;
  for (const RunRecord* run : runs) {
    if (const auto value = figure(*run)) result.push_back(*value);
  }
  if (result.size() < runs.size()) result.clear();
  return result;
}

std::optional<MeanInterval> CellGroup::mean(FigureOf figure) const {
  const std::vector<double> found = values(figure);
  if (found.empty()) return std::nullopt;
  return mean_interval(found, figure.scale);
}

std::vector<CellLine> lines_of(std::span<const RunRecord> runs) {
  std::vector<CellLine> lines;
  for (const RunRecord& run : runs) {
    auto line = std::find_if(lines.begin(), lines.end(), [&run](const CellLine& other) {
      return without_clients(other.groups.front().cell) == without_clients(run.cell);
    });
    if (line == lines.end())
      line = lines.insert(line, CellLine{"", {}, {CellGroup{run.cell, {}, 0}}});
    auto group =
        std::find_if(line->groups.begin(), line->groups.end(), [&run](const CellGroup& other) {
          return without_seed(other.cell) == without_seed(run.cell);
        });
    if (group == line->groups.end()) group = line->groups.insert(group, CellGroup{run.cell, {}, 0});
    if (run.valid) group->runs.push_back(&run);
    else ++group->invalid_runs;
  }
  for (CellLine& line : lines) {
    std::stable_sort(
        line.groups.begin(), line.groups.end(),
        [](const CellGroup& a, const CellGroup& b) { return a.cell.clients < b.cell.clients; });
    assert(std::ranges::adjacent_find(line.groups, [](const CellGroup& a, const CellGroup& b) {
             return a.cell.clients == b.cell.clients;
           }) == line.groups.end());
  }
  name_and_style(lines);
  return lines;
}

std::string line_name(std::span<const CellLine> lines, const Cell& cell) {
  const auto line = std::find_if(lines.begin(), lines.end(), [&cell](const CellLine& other) {
    return without_clients(other.groups.front().cell) == without_clients(cell);
  });
  return line == lines.end() ? "" : line->name;
}

std::vector<std::uint32_t> client_counts(std::span<const CellLine> lines) {
  std::set<std::uint32_t> counts;
  for (const CellLine& line : lines) {
    for (const CellGroup& group : line.groups) counts.insert(group.cell.clients);
  }
  return {counts.begin(), counts.end()};
}

std::vector<std::uint32_t> thinned(const std::vector<std::uint32_t>& values, std::size_t count) {
  assert(count >= 2);
  if (values.size() <= count) return values;
  std::vector<std::uint32_t> result;
  for (std::size_t i = 0; i < count; ++i)
    result.push_back(values[i * (values.size() - 1) / (count - 1)]);
  assert(result.front() == values.front() && result.back() == values.back());
  return result;
}

}  // namespace rink::loadgen
