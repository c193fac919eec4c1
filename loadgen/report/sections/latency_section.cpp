// Latency percentiles as whole curves, on an axis that gives each further nine the same room.
#include <algorithm>
#include <cmath>
#include <limits>

#include "loadgen/report/plots/chart_svg.h"
#include "loadgen/report/plots/lines.h"
#include "loadgen/report/plots/text.h"
#include "loadgen/report/sections/section_content.h"

namespace rink::loadgen {
namespace {

constexpr std::size_t panels_max = 3;
constexpr int steps_per_nine = 16;

struct Latency {
  const char* name;
  const char* title;
  const char* heading;  ///< the field's term, and the column's
  const char* meaning;
  const Histogram CellLatencies::*of;
  Percentiles (*summary)(const RunRecord&);  ///< where only a run's percentiles are kept; else null
};

constexpr Latency kinds[] = {
    {"update-age", "Update age", "Update latency (update age)",
     "From the instant at which a tick was due to its batch being applied to the client's replica "
     "set; "
     "one sample per client and tick.",
     &CellLatencies::update_latency, nullptr},
    {"key-to-effect", "Key to effect", "Input latency (key to effect)",
     "From the instant a key was due to the client's own bat answering in its replica set, so a "
     "server "
     "that stalls cannot hide it.",
     &CellLatencies::input_latency, nullptr},
    {"late-entry", "Late entry", "Discovery latency (late entry)",
     "From the true instant at which an entity became relevant to the first state of it that the "
     "player received.",
     &CellLatencies::discovery_latency,
     [](const RunRecord& run) { return run.truth.late_entry_ms; }},
};

bool is_same_cell(Cell a, Cell b) {
  a.seed = b.seed = 0;
  return a == b;
}

Ticks nines(double most) {
  Ticks ticks{{{0.0, "0"}, {std::log10(2.0), "50 %"}, {1.0, "90 %"}}, {}};
  std::string text = "99";
  for (int nine = 2; nine <= static_cast<int>(most + 1e-9);
       ++nine, text += text.size() == 2 ? ".9" : "9")
    ticks.major.emplace_back(nine, text + " %");
  return ticks;
}

/// The curve as far as the sample supports it: x = log10(1 / (1 - fraction)), y in ms.
std::vector<PlotPoint> curve_of(const Histogram& histogram) {
  std::vector<PlotPoint> points;
  for (int step = 0; step < 7 * steps_per_nine; ++step) {
    const double x = static_cast<double>(step) / steps_per_nine;
    const auto value = histogram.percentile_s(1.0 - std::pow(10.0, -x));
    if (!value) break;
    points.push_back({x, *value * 1e3, {}, {}, ""});
  }
  return points;
}

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = 0.0, most_nines = 1.0;
};

/// Means over the runs of the percentiles that each of them has.
std::vector<PlotPoint> points_of(const CellGroup& group, Percentiles (*summary)(const RunRecord&)) {
  static constexpr std::pair<double, std::optional<double> Percentiles::*> places[] = {
      {0.5, &Percentiles::p50},
      {0.9, &Percentiles::p90},
      {0.95, &Percentiles::p95},
      {0.99, &Percentiles::p99},
      {0.999, &Percentiles::p999}};
  std::vector<PlotPoint> points;
  for (const auto& [fraction, member] : places) {
    std::vector<double> values;
    for (const RunRecord* run : group.runs) {
      if (const auto value = summary(*run).*member) values.push_back(*value);
    }
    if (values.empty() || values.size() < group.runs.size()) break;
    const MeanInterval mean = mean_interval(values);
    points.push_back({-std::log10(1.0 - fraction), mean.mean, mean.interval, {}, ""});
  }
  return points;
}

PlotLine line_of(const CellLine& line, std::vector<PlotPoint> points, std::size_t mark_stride,
                 Range& range) {
  PlotLine drawn{line.name, line.style, std::move(points), mark_stride};
  for (const PlotPoint& point : drawn.points) {
    if (point.y > 0.0) range.low = std::min(range.low, point.y);
    range.high = std::max(range.high, point.y);
    range.most_nines = std::max(range.most_nines, point.x);
  }
  return drawn;
}

/// Null if nothing was counted.
const Histogram* histogram_of(const Findings& findings, const Cell& cell, const Latency& kind) {
  for (const CellLatencies& latencies : findings.latencies) {
    if (is_same_cell(latencies.cell, cell) && (latencies.*kind.of).count() > 0)
      return &(latencies.*kind.of);
  }
  return nullptr;
}

Chart panel(const Findings& findings, const Latency& kind, std::uint32_t clients, PlotTable& table,
            Range& range) {
  Chart plot{.title = std::string(kind.title) + ", " + std::to_string(clients) +
                      (clients == 1 ? " client" : " clients"),
             .x = {"percentile"},
             .y = {"ms", true}};
  plot.width = 400.0;
  plot.frame_height = 210.0;
  plot.alternative = kind.meaning;
  for (const CellLine& line : plotted_lines(findings)) {
    for (const CellGroup& group : line.groups) {
      if (group.cell.clients != clients) continue;
      const Histogram* histogram = histogram_of(findings, group.cell, kind);
      if (!histogram && !kind.summary) continue;
      plot.lines.push_back(
          line_of(line, histogram ? curve_of(*histogram) : points_of(group, kind.summary),
                  histogram ? steps_per_nine / 2 : 1, range));
      for (const PlotPoint& point : plot.lines.back().points) {
        auto row = cell_values(line, group);
        row.push_back(exact_number(1.0 - std::pow(10.0, -point.x)));
        row.push_back(exact_number(point.y));
        row.push_back(histogram ? std::to_string(histogram->count()) : "");
        table.rows.push_back(std::move(row));
      }
      if (plot.lines.back().points.empty()) plot.lines.pop_back();
    }
  }
  return plot;
}

bool add_latency(SectionContent& content, const Findings& findings, const Latency& kind) {
  PlotTable table{
      kind.name,
      std::string(kind.title) +
          ": percentiles over all valid replications together, as far as ten samples lie beyond",
      cell_columns()};
  table.columns.insert(table.columns.end(), {"fraction", "ms", "samples"});
  Range range;
  std::vector<Chart> plots;
  for (const std::uint32_t clients : thinned(client_counts(findings.lines), panels_max)) {
    Chart plot = panel(findings, kind, clients, table, range);
    if (has_points(plot)) plots.push_back(std::move(plot));
  }
  if (plots.empty()) return false;
  const Axis shared = axis_around(range.low, range.high, true);
  SectionContent figures;
  for (Chart& plot : plots) {
    plot.y.range = {shared.low, shared.high};
    plot.x.range = {0.0, range.most_nines + 0.05};
    plot.x.ticks = nines(range.most_nines);
    figures.add_panel(table.name, to_svg(plot), "");
  }
  content.html += std::string("<h3>") + kind.heading + "</h3>\n<p class=\"faint\">" + kind.meaning +
                  " Lower is better; a curve that turns up at its right end has a tail that means "
                  "hide.</p>\n<div class=\"plots small\">\n" +
                  figures.html + "</div>\n" + to_details(table);
  std::move(figures.pictures.begin(), figures.pictures.end(), std::back_inserter(content.pictures));
  content.tables.push_back(std::move(table));
  return true;
}

}  // namespace

SectionContent latency_content(const Findings& findings) {
  SectionContent content;
  content.html +=
      "<p class=\"faint\">Each curve ends where fewer than ten samples lie beyond, since the "
      "sample supports nothing beyond. All valid replications of a cell are taken together; where "
      "only percentiles of each run are kept, marks are their means over replications.</p>\n";
  for (const Latency& kind : kinds) {
    if (!add_latency(content, findings, kind))
      content.add_absence(std::string(kind.title) +
                          ": no sample is large enough, so there is no curve.");
  }
  return content;
}

}  // namespace rink::loadgen
