// Colour says the engine, dash and shape the integrator or the setting.
#include "bench/accuracy/accuracy_report.h"

#include <algorithm>
#include <cmath>

#include "bench/accuracy/tables.h"
#include "game/physics/simulator_choice.h"
#include "loadgen/report/page.h"
#include "loadgen/report/plots/chart_svg.h"
#include "loadgen/report/plots/text.h"

namespace rink::accuracy {
namespace {

using loadgen::escaped;
using loadgen::SectionContent;

constexpr double error_floor =
    1e-17;  ///< where an error of exactly 0 is drawn, since the axis is logarithmic [m]

std::size_t place_of(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
}

loadgen::Style style_of(const Contender& contender) {
  if (contender.engine == "box2d3") return {5, 0, 1};
  if (contender.engine.starts_with("box2d"))
    return contender.engine == "box2d" ? loadgen::Style{4, 0, 4} : loadgen::Style{4, 1, 5};
  if (contender.engine == "chipmunk") return {3, 0, 3};
  if (contender.integrator.empty()) return {0, 0, 0};
  const std::size_t integrator = place_of(physics::integrator_names(), contender.integrator);
  return {contender.engine == "paper" ? std::size_t{1} : std::size_t{2}, integrator,
          integrator + 1};
}

std::string title_of(const Series& series, const Point& point) {
  const std::string step =
      point.dt > 0.0 ? ", step " + loadgen::plain_number(1e6 * point.dt) + " us" : "";
  return series.contender.name() + step + ": " + loadgen::plain_number(1e3 * point.run_s) +
         " ms, p90 " + metres(point.error.p90) + " m, max " + metres(point.error.max) + " m";
}

loadgen::Chart plot_of(const Panel& panel) {
  loadgen::Chart plot;
  plot.title = panel.trial.trial.name;
  plot.x = {"run time, ms (median; bars: fastest and slowest)", true};
  plot.y = {"position error, 90th percentile, m", true};
  plot.alternative =
      "Run time against position error for each engine: " + panel.trial.trial.about + ".";
  plot.width = 620.0, plot.frame_height = 340.0;
  for (const Series& series : panel.series) {
    loadgen::PlotLine line{series.contender.name(), style_of(series.contender), {}};
    for (const Point& point : series.points)
      line.points.push_back({1e3 * point.run_s,
                             std::max(point.error.p90, error_floor),
                             {},
                             {{1e3 * point.fastest_s, 1e3 * point.slowest_s}},
                             title_of(series, point)});
    plot.lines.push_back(std::move(line));
  }
  return plot;
}

std::string cells(const std::vector<std::string>& values) {
  std::string html = "<tr>";
  for (std::size_t i = 0; i < values.size(); ++i)
    html += (i == 0 ? "<td class=\"text\">" : "<td>") + escaped(values[i]) + "</td>";
  return html + "</tr>\n";
}

/// The table of the terminal, as a table.
std::string summary_of(const Panel& panel) {
  std::string html =
      "<div class=\"scroll\"><table>\n<thead><tr><th class=\"text\">engine</th><th>run at 1/60 s, "
      "ms</th><th>p90, m</th><th>finest step, us</th><th>run, ms</th><th>p90, m</th><th>max, m</th>"
      "<th>order</th><th>run to err by " +
      loadgen::plain_number(1e3 * panel.trial.target) +
      " mm, ms</th><th>times the exact engine's</th></tr></thead>\n<tbody>\n";
  for (const Series& series : panel.series) {
    if (series.points.empty()) {
      html += cells({series.contender.name(), series.why_not_finer});
      continue;
    }
    const Point &first = series.points.front(), &last = series.points.back();
    const Standing standing = standing_of(panel, series);
    const bool is_stepped = series.contender.is_stepped();
    const auto number = [](double value) { return loadgen::plain_number(value); };
    const auto order = order_of(series.points);
    std::vector<std::string> values{series.contender.name(), "-", "-", "-"};
    if (is_stepped)
      values = {series.contender.name(), number(1e3 * first.run_s), metres(first.error.p90),
                number(1e6 * last.dt)};
    for (const std::string& value :
         {number(1e3 * last.run_s), metres(last.error.p90), metres(last.error.max),
          order ? number(*order) : "-", standing.run_ms, standing.ratio})
      values.push_back(value);
    html += cells(values);
  }
  return html + "</tbody></table></div>\n";
}

SectionContent content_of(const Panel& panel) {
  SectionContent content;
  const Trial& trial = panel.trial.trial;
  content.html = "<p>" + escaped(trial.about) + "; after " + loadgen::plain_number(trial.horizon) +
                 " s. Truth: " + escaped(panel.trial.truth) + ".</p>\n";
  if (const std::string headline = headline_of(panel); !headline.empty())
    content.html += "<p>" + escaped(headline) + ".</p>\n";
  content.add(to_svg(plot_of(panel)),
              "Lower and further left is better. Each mark is one step, a half of the one before; "
              "the exact engine has no step.",
              points_table(trial.name, std::span(&panel, 1)));
  content.html += summary_of(panel);
  return content;
}

SectionContent content_of(const std::vector<Ordeal>& ordeals) {
  SectionContent content;
  for (const Ordeal& ordeal : ordeals) {
    content.html += "<h3>" + escaped(ordeal.trial.name) + "</h3>\n<p>" +
                    escaped(ordeal.trial.about) + "; for " +
                    loadgen::plain_number(ordeal.trial.horizon) + " s.</p>\n";
    content.html +=
        "<div class=\"scroll\"><table>\n<thead><tr><th class=\"text\">engine</th><th "
        "class=\"text\">survived</th><th>deepest overlap, m</th><th>escapes</th><th>energy "
        "error</th><th>events per s</th>"
        "<th>run, ms per s</th></tr></thead>\n<tbody>\n";
    for (const Survival& survival : ordeal.survivals) {
      const std::string verdict = survival.verdict();
      content.html += "<tr><td class=\"text\">" + escaped(survival.contender.name()) +
                      "</td><td class=\"text" + (verdict == "yes" ? "" : " warn") + "\">" +
                      escaped(verdict) + "</td>";
      if (survival.is_done) {
        const Wear& wear = survival.wear;
        const std::string events = loadgen::plain_number(wear.events_per_s),
                          run_ms = loadgen::plain_number(1e3 * wear.run_s);
        for (const std::string& value : {metres(wear.overlap), std::to_string(wear.escapes),
                                         metres(wear.energy_error), events, run_ms})
          content.html += "<td>" + value + "</td>";
      }
      content.html += "</tr>\n";
    }
    content.html += "</tbody></table></div>\n";
  }
  loadgen::PlotTable table = stability_table(ordeals);
  content.html += to_details(table);
  content.tables.push_back(std::move(table));
  return content;
}

constexpr const char* definitions =
    "<p class=\"faint\">Position error: distance of a moving body from its true place at the end; "
    "90th percentile by nearest rank, and the largest. Run time: processor time of advancing to "
    "the "
    "end and reading every place once, the median of repeats in a process of their own; runs in "
    "which real time differs by more than 10 % are refused, since somebody else had the core; "
    "making the bodies "
    "is not counted, finding the first events is. A stepping engine's error at equal run time, and "
    "its run time at equal "
    "error, are read off straight lines between its points on logarithmic axes. The cost of an "
    "event engine grows with the number of impacts, that of a stepping engine does not: compare "
    "the dense scene with the "
    "dilute one. Overlap is the deepest of any two bodies, or of a body and a wall, at any "
    "sixtieth of a second, by one measure for all engines. Energy error is the largest gain over "
    "what "
    "thrust put in (in elastic scenes without drag also the largest loss), relative to all energy "
    "there was or was put in. Survived: ended in time, every place a number, nobody outside the "
    "field.</p>\n";

}  // namespace

loadgen::Report report_of(const Findings& findings, const loadgen::Provenance& provenance) {
  loadgen::Page page;
  for (const Panel& panel : findings.panels)
    page.add(panel.trial.trial.name, panel.trial.trial.name, content_of(panel));
  if (!findings.ordeals.empty()) page.add("stability", "Stability", content_of(findings.ordeals));
  page.add("definitions", "Definitions", {definitions});
  page.add("provenance", "Provenance", loadgen::provenance_list(provenance));
  std::string introduction;
  for (const Panel& panel : findings.panels)
    if (panel.trial.trial.name == "gas")
      introduction += "<p class=\"headline\">" + escaped(headline_of(panel)) + "</p>\n";
  if (findings.is_interrupted)
    introduction += "<p class=\"warn\">Interrupted: this holds what had been measured.</p>\n";
  for (const std::string& absence : findings.absences)
    introduction += "<p class=\"warn\">" + escaped(absence) + "</p>\n";
  return std::move(page).finished(findings.panels.empty()
                                      ? "Stability of physics engines"
                                      : "Run time against error of physics engines",
                                  introduction);
}

}  // namespace rink::accuracy
