// Draws distribution functions as stairs: a curve ends at the fraction that was ever discovered.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "game/model/listed.h"
#include "loadgen/report/plots/chart_svg.h"
#include "loadgen/report/plots/text.h"
#include "loadgen/report/sections/section_content.h"

namespace rink::loadgen {
namespace {

struct Discovered {
  const char *name, *title, *meaning, *none;
  SampleDistribution Discoveries::*of;
};

constexpr Discovered discovered_kinds[] = {
    {"late-discovery", "Late discoveries",
     "From the true instant at which an entity became relevant to its first delivered state, of "
     "all that became relevant; what was in scope already is at the left edge. ",
     "nothing became relevant", &Discoveries::late_discovery},
    {"missed-contact", "Missed contacts",
     "From a contact of the player's bat with a body that the player did not know of to the next "
     "state of it, of all such contacts. ",
     "no player touched a body that it did not know of", &Discoveries::missed_contact}};

/// The drawn delays of one cell.
struct DrawnDelays {
  CellLine line;
  CellGroup group;
  const SampleDistribution* delays;
  std::vector<SampleDistribution::Point> points;
};

/// The parts that have the largest number of clients of all, in the order of the experiment; one
/// without a name if it has no parts.
std::vector<std::string> parts_of_largest_crowds(const Findings& findings) {
  std::vector<std::string> parts;
  for (const CellLine& line : largest_crowds(findings.lines)) {
    const std::string& part = line.groups.front().cell.part;
    if (std::ranges::find(parts, part) == parts.end()) parts.push_back(part);
  }
  return parts;
}

std::vector<DrawnDelays> drawn_of(const Findings& findings, const std::string& part,
                                  const Discovered& kind) {
  std::vector<DrawnDelays> all;
  for (const CellLine& line : largest_crowds(plotted_lines(findings, part)))
    for (const CellGroup& group : line.groups) {
      const auto found =
          std::ranges::find(findings.discoveries, without_seed(group.cell), &CellDiscoveries::cell);
      if (found == findings.discoveries.end()) continue;
      const SampleDistribution& delays = found->discoveries.*kind.of;
      if (delays.samples() > 0)
        all.push_back({line, group, &delays, delays.distribution(discovery_points_max)});
    }
  return all;
}

/// From `low` [ms], which a logarithmic axis needs, to `high`, where the curve shows how many were
/// never discovered.
std::vector<PlotPoint> stairs(const DrawnDelays& drawn, double low, double high) {
  std::vector<PlotPoint> points{{low, 0.0, {}, {}, ""}};
  for (const auto& [delay_ms, fraction] : drawn.points) {
    if (delay_ms > low) points.push_back({delay_ms, points.back().y, {}, {}, ""});
    points.push_back({std::max(low, delay_ms), fraction, {}, {}, ""});
    if (delay_ms <= low) points.front().y = fraction;
  }
  const std::uint64_t never = drawn.delays->never(), samples = drawn.delays->samples();
  const std::string gap =
      plain_number(100.0 * static_cast<double>(never) / static_cast<double>(samples)) + " % never";
  points.push_back({high,
                    points.back().y,
                    {},
                    {},
                    drawn.line.name + ": " + std::to_string(never) + " of " +
                        std::to_string(samples) + " never discovered (" + gap + ")"});
  return points;
}

/// From 0, or where all curves begin high up, from the tenth below them.
std::pair<double, double> fractions_shown(const std::vector<PlotLine>& lines) {
  double least = 0.95;
  for (const PlotLine& line : lines) least = std::min(least, line.points.front().y);
  const double low = least < 0.5 ? 0.0 : 0.1 * std::floor(10.0 * least);
  return {low, 1.0 + 0.03 * (1.0 - low)};
}

void add_plot(SectionContent& content, const Discovered& kind,
              const std::vector<DrawnDelays>& drawn) {
  const std::string& part = drawn.front().group.cell.part;
  constexpr double least_ms = 1.0;
  double low = 1e9, high = 10.0 * least_ms;
  for (const DrawnDelays& each : drawn)
    for (const SampleDistribution::Point& point : each.points) {
      if (point.thousandths > 0.0) low = std::min(low, std::max(least_ms, point.thousandths));
      high = std::max(high, 1.2 * point.thousandths);
    }
  low = std::min(0.9 * low, 0.1 * high);
  const std::uint32_t clients = drawn.front().group.cell.clients;
  Chart plot{.title = std::string(kind.title) + ", " + std::to_string(clients) +
                      (clients == 1 ? " client" : " clients") + (part.empty() ? "" : ", " + part),
             .x = {.title = "delay, ms", .is_logarithmic = true, .range = {{low, high}}},
             .y = {"fraction discovered within"}};
  PlotTable table{kind.name + (part.empty() ? "" : "-" + part),
                  std::string(kind.title) +
                      ": the fraction of the sample that was discovered within the delay, all "
                      "valid replications together",
                  cell_columns()};
  table.columns.insert(table.columns.end(), {"delay_ms", "fraction", "samples", "never"});
  std::string never;
  for (const DrawnDelays& each : drawn) {
    std::vector<PlotPoint> points = stairs(each, low, high);
    const std::size_t last = points.size();
    if (each.delays->never() > 0)
      game::add_to_list(never, each.line.name + " " + std::to_string(each.delays->never()) +
                                   " of " + std::to_string(each.delays->samples()));
    plot.lines.push_back({each.line.name, each.line.style, std::move(points), last});
    for (const SampleDistribution::Point& point : each.points) {
      auto row = cell_values(each.line, each.group);
      for (const std::string& text :
           {exact_number(point.thousandths), exact_number(point.fraction),
            std::to_string(each.delays->samples()), std::to_string(each.delays->never())})
        row.push_back(text);
      table.rows.push_back(std::move(row));
    }
  }
  plot.y.range = fractions_shown(plot.lines);
  plot.alternative = std::string(kind.meaning) +
                     "Higher and farther left is better; the gap between a curve's right end and 1 "
                     "is what was never discovered" +
                     (never.empty() ? ", here nothing." : ": " + never + ".");
  content.add(to_svg(plot), plot.alternative, std::move(table));
}

void add_kind(SectionContent& content, const Findings& findings, const Discovered& kind) {
  bool has_any = false;
  for (const std::string& part : parts_of_largest_crowds(findings)) {
    const std::vector<DrawnDelays> drawn = drawn_of(findings, part, kind);
    if (!drawn.empty()) add_plot(content, kind, drawn);
    has_any = has_any || !drawn.empty();
  }
  if (!has_any)
    content.add_absence(std::string(kind.title) + ": " + kind.none + ", so there is no plot.");
}

}  // namespace

SectionContent discovery_content(const Findings& findings) {
  SectionContent content{
      "<p class=\"faint\">Discovery latency by truth: from the instant at which an entity became "
      "relevant to "
      "its first delivered state. All cells are in discovery.csv.</p>\n<div class=\"plots\">\n"};
  for (const Discovered& kind : discovered_kinds) add_kind(content, findings, kind);
  content.html += "</div>\n";
  return content;
}

}  // namespace rink::loadgen
