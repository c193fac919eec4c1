// Draws for the largest number of clients alone: bytes by purpose, the displayed error, and recall
// by delay.
#include <algorithm>
#include <cmath>
#include <string>

#include "loadgen/report/plots/chart_svg.h"
#include "loadgen/report/plots/lines.h"
#include "loadgen/report/plots/text.h"
#include "loadgen/report/sections/run_figures.h"
#include "loadgen/report/sections/section_content.h"

namespace rink::loadgen {
namespace {

struct ByteKind {
  const char *name, *column;
  FigureOf of;
};

std::optional<double> header_bytes(const RunRecord& run) {
  const auto wire = run.wire_bytes_per_client_per_s, down = run.down_bytes_per_client_per_s,
             up = run.up_bytes_per_client_per_s;
  return wire && down && up ? std::optional(*wire - *down - *up) : std::nullopt;
}

constexpr ByteKind byte_kinds[] = {
    {"states", "states_bytes_per_client_per_s",
     [](const RunRecord& run) { return run.traffic.updates; }},
    {"interest, control", "interest_bytes_per_client_per_s",
     [](const RunRecord& run) { return run.traffic.interest; }},
    {"keys", "keys_bytes_per_client_per_s", [](const RunRecord& run) { return run.traffic.keys; }},
    {"headers, acknowledgements", "headers_bytes_per_client_per_s", header_bytes}};

std::optional<Bar> bytes_bar_of(const CellGroup& group) {
  Bar bar{group.cell.scheme, {}, ""};
  double sum = 0.0;
  for (const ByteKind& kind : byte_kinds) {
    const auto mean = group.mean(kind.of);
    if (!mean) return std::nullopt;
    bar.parts.push_back(std::max(0.0, mean->mean));
    sum += bar.parts.back();
  }
  bar.flag = short_number(sum);
  return bar;
}

}  // namespace

std::vector<CellLine> largest_crowds(std::vector<CellLine> lines) {
  const std::vector<std::uint32_t> counts = client_counts(lines);
  for (CellLine& line : lines)
    std::erase_if(line.groups, [&counts](const CellGroup& group) {
      return group.cell.clients != counts.back();
    });
  std::erase_if(lines, [](const CellLine& line) { return line.groups.empty(); });
  return lines;
}

std::string largest_crowd_words(const Findings& findings) {
  const std::vector<std::uint32_t> counts = client_counts(plotted_lines(findings));
  if (counts.size() < 2) return "";
  return " Of several numbers of clients the largest, " + std::to_string(counts.back()) +
         ", is drawn.";
}

SectionContent bytes_by_kind_content(const Findings& findings) {
  PlotTable table{"bytes-by-kind",
                  "Bytes of both directions by what they are about, for each client: means over "
                  "replications with their 95 % intervals",
                  cell_columns()};
  for (const ByteKind& kind : byte_kinds)
    for (const char* suffix : {"", "_low_95", "_high_95"})
      table.columns.push_back(std::string(kind.column) + suffix);
  std::vector<Chart> panels;
  std::vector<std::string> policies;
  for (const CellLine& line : largest_crowds(plotted_lines(findings))) {
    const CellGroup& group = line.groups.front();
    const auto bar = bytes_bar_of(group);
    if (group.cell.mode == "peer-to-peer" || !bar) continue;
    const std::string policy = policy_name(group.cell);
    auto place = std::ranges::find(policies, policy);
    if (place == policies.end()) {
      place = policies.insert(place, policy);
      panels.push_back(
          {.title = policy + ", " + std::to_string(group.cell.clients) + " clients",
           .x = {"filter"},
           .y = {"bytes per second and client"},
           .alternative = "Bytes on the wire by what they are about, stacked, for each filter.",
           .width = 380.0,
           .frame_height = 190.0});
      for (const ByteKind& kind : byte_kinds) panels.back().part_names.emplace_back(kind.name);
    }
    panels[static_cast<std::size_t>(place - policies.begin())].bars.push_back(*bar);
    auto row = cell_values(line, group);
    for (const ByteKind& kind : byte_kinds) append_interval(row, group.mean(kind.of));
    table.rows.push_back(std::move(row));
  }
  SectionContent content;
  if (panels.empty()) return content;
  content.html +=
      "<h3>Bytes by what they are about</h3>\n<p class=\"faint\">Both directions, headers of "
      "Ethernet, IPv4 and TCP and acknowledgements included; the number above a bar is its sum. "
      "Each panel has a scale of its own." +
      escaped(largest_crowd_words(findings)) + "</p>\n<div class=\"plots small\">\n";
  for (const Chart& panel : panels) content.add_panel(table.name, to_svg(panel), "");
  content.html += "</div>\n" + to_details(table);
  content.tables.push_back(std::move(table));
  return content;
}

void add_error_distribution(SectionContent& content, const Findings& findings) {
  constexpr double least_mm = 0.1;
  double high = 10.0 * least_mm;
  Chart plot{.title = "Displayed error as a distribution",
             .x = {"displayed error, mm", true},
             .y = {.title = "fraction within", .range = {{0.0, 1.03}}}};
  PlotTable table{"displayed-error-distribution",
                  "The fraction of displayed positions that err by at most so much, all valid "
                  "replications together",
                  cell_columns()};
  table.columns.insert(table.columns.end(), {"displayed_error_mm", "fraction", "samples"});
  for (const CellLine& line : largest_crowds(plotted_lines(findings))) {
    const CellGroup& group = line.groups.front();
    const auto found =
        std::ranges::find(findings.discoveries, without_seed(group.cell), &CellDiscoveries::cell);
    if (found == findings.discoveries.end()) continue;
    const SampleDistribution& errors = found->discoveries.displayed_error;
    PlotLine drawn{line.name, line.style, {}, 40};
    for (const auto& [millimetres, fraction] : errors.distribution(discovery_points_max)) {
      drawn.points.push_back({std::max(least_mm, millimetres),
                              fraction,
                              {},
                              {},
                              line.name + ": " + plain_number(100.0 * fraction) + " % within " +
                                  plain_number(millimetres) + " mm"});
      high = std::max(high, 1.2 * millimetres);
      auto row = cell_values(line, group);
      for (const std::string& text :
           {exact_number(millimetres), exact_number(fraction), std::to_string(errors.samples())})
        row.push_back(text);
      table.rows.push_back(std::move(row));
    }
    if (!drawn.points.empty()) plot.lines.push_back(std::move(drawn));
  }
  if (!has_points(plot)) return;
  plot.x.range = {least_mm, high};
  plot.alternative = "Higher and farther left is better. Errors below " + plain_number(least_mm) +
                     " mm stand at the left edge; pucks put back at a face-off that the client had "
                     "no news of are left out." +
                     largest_crowd_words(findings);
  content.add(to_svg(plot), plot.alternative, std::move(table));
}

void add_recall_against_delay(SectionContent& content, const Findings& findings) {
  Chart plot{.title = "Recall against delay",
             .x = {"delay from end to end, ms"},
             .y = {"recall of what clients held"}};
  PlotTable table{"recall-against-delay",
                  "Recall of what clients held by the delay of the experiment's parts, in virtual "
                  "time: means over replications with their 95 % intervals",
                  cell_columns()};
  table.columns.insert(table.columns.end(),
                       {"delay_ms", "recall", "recall_low_95", "recall_high_95"});
  const auto is_virtual = [&](const CellLine& line) {
    return part_of(findings.experiment, line.groups.front().cell.part).transport ==
           TransportKind::virtual_time;
  };
  std::vector<CellLine> lines = findings.lines;
  std::erase_if(lines, [&](const CellLine& line) { return !is_virtual(line); });
  lines = largest_crowds(lines);
  double lowest = 1.0;
  for (const CellLine& line : lines) {
    Cell cell = line.groups.front().cell;
    const double delay_ms = part_of(findings.experiment, cell.part).delay_ms;
    const auto recall = line.groups.front().mean(delivered_recall);
    if (!recall || std::ranges::none_of(lines, [&](const CellLine& other) {
          const Cell& twin = other.groups.front().cell;
          return twin.scheme == cell.scheme && twin.policy == cell.policy &&
                 twin.parameters == cell.parameters &&
                 part_of(findings.experiment, twin.part).delay_ms != delay_ms;
        }))
      continue;
    const std::string name = cell.scheme + ", " + policy_name(cell);
    auto drawn = std::ranges::find(plot.lines, name, &PlotLine::name);
    if (drawn == plot.lines.end()) drawn = plot.lines.insert(drawn, PlotLine{name, line.style, {}});
    drawn->points.push_back(
        {delay_ms,
         recall->mean,
         recall->interval,
         {},
         name + " at " + plain_number(delay_ms) + " ms: " + plain_number(recall->mean, 5)});
    lowest = std::min({lowest, recall->mean, recall->interval ? recall->interval->first : 1.0});
    auto row = cell_values(line, line.groups.front());
    row.push_back(exact_number(delay_ms));
    append_interval(row, recall);
    table.rows.push_back(std::move(row));
  }
  if (!has_points(plot)) return;
  for (PlotLine& line : plot.lines) std::ranges::stable_sort(line.points, {}, &PlotPoint::x);
  plot.y.range = zoomed(lowest, 1.0);
  plot.alternative =
      "What a region declares is old by the delay when it takes effect, and so is what it lets "
      "through. The axis of recall begins at " +
      plain_number(plot.y.range->first, 4) + ".";
  content.add(to_svg(plot), plot.alternative, std::move(table));
}

std::pair<double, double> zoomed(double low, double high) {
  constexpr double span_least = 0.02;  // a difference of a thousandth is no gap
  const double span = std::max(high - low, span_least);
  return {std::max(0.0, high - 1.1 * span), high + 0.1 * span};
}

}  // namespace rink::loadgen
