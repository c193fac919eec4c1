// Columns of fixed width; three digits, since more would be noise.
#include "bench/accuracy/tables.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdarg>
#include <cstdio>

#include "bench/peers/peers.h"
#include "game/model/listed.h"
#include "loadgen/report/plots/text.h"

namespace rink::accuracy {
namespace {

using loadgen::exact_number;

#if defined(__GNUC__)
__attribute__((format(printf, 1, 2)))
#endif
std::string
formatted(const char* format, ...) {
  char text[400];
  va_list values;
  va_start(values, format);
  [[maybe_unused]] const int size = std::vsnprintf(text, sizeof text, format, values);
  assert(0 <= size && size < static_cast<int>(sizeof text));  // nothing is cut off
  va_end(values);
  return text;
}

std::string three_digits(double value) {
  if (!std::isfinite(value)) return "-";
  return value >= 1000.0 ? formatted("%.0f", value) : formatted("%.3g", value);
}

const Point* exact_point(const Panel& panel) {
  for (const Series& series : panel.series)
    if (!series.contender.is_stepped() && !series.points.empty()) return &series.points.front();
  return nullptr;
}

std::string target_text(double target) { return three_digits(1e3 * target) + " mm"; }

bool is_peer(const Contender& contender) {
  return std::ranges::find(peers::peer_names(), contender.engine) != peers::peer_names().end();
}

std::string line_of(const Panel& panel, const Series& series) {
  const std::string name = series.contender.name();
  if (series.points.empty())
    return formatted("%-20s %s\n", name.c_str(), series.why_not_finer.c_str());
  const Point &first = series.points.front(), &last = series.points.back();
  const Standing standing = standing_of(panel, series);
  const bool is_stepped = series.contender.is_stepped();
  const auto order = order_of(series.points);
  std::string line =
      formatted("%-20s %9s %9s %10s %9s %9s %9s %6s %9s %9s\n", name.c_str(),
                is_stepped ? three_digits(1e3 * first.run_s).c_str() : "-",
                is_stepped ? metres(first.error.p90).c_str() : "-",
                is_stepped ? three_digits(1e6 * last.dt).c_str() : "-",
                three_digits(1e3 * last.run_s).c_str(), metres(last.error.p90).c_str(),
                metres(last.error.max).c_str(), order ? formatted("%.2f", *order).c_str() : "-",
                standing.run_ms.c_str(), standing.ratio.c_str());
  if (!series.why_not_finer.empty())
    line += formatted("%-20s no finer step: %s\n", "", series.why_not_finer.c_str());
  return line;
}

}  // namespace

const char* const panel_legend =
    "run: processor time of the simulated time, median, refused where real time differs by more "
    "than "
    "10 %; p90, max: distance of the moving bodies from "
    "their true places; finest: the shortest step within the time for a run;\n"
    "order: of convergence; times: run time over the exact engine's; >: no step got there; <: the "
    "longest step is better already\n";
const char* const ordeal_legend =
    "overlap: the deepest seen at any sixtieth of a second; energy: largest error (gain, without "
    "drag and loss also loss) relative to all energy there was or was put in;\n"
    "events: physical events, for others than exact new contacts, per simulated second; run: "
    "processor time per simulated second\n";

std::string metres(double value) {
  return !std::isfinite(value) ? "-" : value == 0.0 ? "0" : formatted("%.1e", value);
}

Standing standing_of(const Panel& panel, const Series& series) {
  const auto time = time_at_error(series.points, panel.trial.target);
  if (!time) return {"-", "-", {}};
  const char* sign = time->kind == TimeAtError::Kind::met || !series.contender.is_stepped() ? ""
                     : time->kind == TimeAtError::Kind::faster                              ? "< "
                                                                                            : "> ";
  Standing standing{
      sign + three_digits(1e3 * time->run_s), "-", {}, time->kind == TimeAtError::Kind::never};
  const Point* exact = exact_point(panel);
  if (exact == nullptr || exact->error.p90 > panel.trial.target) return standing;
  assert(exact->run_s > 0.0);
  standing.least_ratio = time->run_s / exact->run_s;
  standing.ratio = sign + three_digits(*standing.least_ratio);
  return standing;
}

std::string text_of(const Panel& panel) {
  const Trial& trial = panel.trial.trial;
  std::string text = trial.name + ": " + trial.about + "; after " + three_digits(trial.horizon) +
                     " s; truth: " + panel.trial.truth + "\n";
  text += formatted("%-20s %19s %40s %6s %19s\n", "", "step 1/60 s", "finest step", "",
                    ("to err by " + target_text(panel.trial.target)).c_str());
  text += formatted("%-20s %9s %9s %10s %9s %9s %9s %6s %9s %9s\n", "engine", "run, ms", "p90, m",
                    "step, us", "run, ms", "p90, m", "max, m", "order", "run, ms", "times");
  for (const Series& series : panel.series) text += line_of(panel, series);
  if (const std::string best = best_stepper_of(panel); !best.empty()) text += best + "\n";
  return text;
}

std::string text_of(const Ordeal& ordeal) {
  std::string text = ordeal.trial.name + ": " + ordeal.trial.about + "; for " +
                     three_digits(ordeal.trial.horizon) + " s\n";
  text += formatted("%-20s %-34s %10s %8s %10s %10s %12s\n", "engine", "survived", "overlap, m",
                    "escapes", "energy", "events/s", "run, ms/s");
  for (const Survival& survival : ordeal.survivals) {
    const Wear& wear = survival.wear;
    text += formatted("%-20s %-34s", survival.contender.name().c_str(), survival.verdict().c_str());
    if (survival.is_done)
      text += formatted(" %10s %8u %10s %10s %12s", metres(wear.overlap).c_str(), wear.escapes,
                        metres(wear.energy_error).c_str(), three_digits(wear.events_per_s).c_str(),
                        three_digits(1e3 * wear.run_s).c_str());
    text += "\n";
  }
  return text;
}

std::string best_stepper_of(const Panel& panel) {
  const Series *best = nullptr, *cheapest = nullptr;
  double least = 0.0;
  bool has_box2d3 = false;
  for (const Series& series : panel.series) {
    if (!is_peer(series.contender) || series.points.empty()) continue;
    const Standing standing = standing_of(panel, series);
    if (!standing.least_ratio) return "";
    if (!standing.is_bound && (best == nullptr || *standing.least_ratio < least))
      best = &series, least = *standing.least_ratio;
    if (cheapest == nullptr || series.points.front().run_s < cheapest->points.front().run_s)
      cheapest = &series;
    has_box2d3 = has_box2d3 || series.contender.engine == "box2d3";
  }
  if (cheapest == nullptr) return "";
  const Point& longest = cheapest->points.front();
  return (best == nullptr ? "no other library errs by so little"
                          : "best of the other libraries: " + best->contender.name() + ", " +
                                standing_of(panel, *best).ratio + " times the exact engine") +
         "; cheapest at 1/60 s: " + cheapest->contender.name() + ", " +
         three_digits(longest.run_s / exact_point(panel)->run_s) + " times, which errs by " +
         metres(longest.error.p90) + " m" +
         (has_box2d3 ? "" : "; the best stepper is missing, for box2d3 was not run");
}

std::string headline_of(const Panel& panel) {
  const Point* exact = exact_point(panel);
  std::string rivals;
  for (const Series& series : panel.series) {
    const Standing standing = standing_of(panel, series);
    if (is_peer(series.contender) && standing.least_ratio)
      game::add_to_list(rivals, series.contender.name() + " " + standing.ratio);
  }
  if (exact == nullptr || rivals.empty()) return "";
  return panel.trial.trial.name + ": to place nine tenths of all bodies within " +
         target_text(panel.trial.target) + " after " + three_digits(panel.trial.trial.horizon) +
         " s takes, in run times of the exact engine (which errs by " + metres(exact->error.p90) +
         " m): " + rivals + "; " + best_stepper_of(panel);
}

loadgen::PlotTable points_table(const std::string& name, std::span<const Panel> panels) {
  loadgen::PlotTable table{name,
                           "Run time against error: a row per scene, engine, integrator and step; "
                           "errors are distances from the true places at the horizon",
                           {"scene", "engine", "integrator", "dt_s", "horizon_s", "run_s_median",
                            "run_s_min", "run_s_max", "repeats", "error_p90_m", "error_max_m",
                            "energy_error", "overlap_m", "escapes", "refused"}};
  for (const Panel& panel : panels)
    for (const Series& series : panel.series)
      for (const Point& point : series.points)
        table.rows.push_back(
            {panel.trial.trial.name, series.contender.engine, series.contender.integrator,
             exact_number(point.dt), exact_number(panel.trial.trial.horizon),
             exact_number(point.run_s), exact_number(point.fastest_s),
             exact_number(point.slowest_s), std::to_string(point.repeats),
             exact_number(point.error.p90), exact_number(point.error.max),
             panel.trial.trial.is_conservative() ? exact_number(point.energy_error) : "",
             exact_number(point.overlap), std::to_string(point.escapes),
             std::to_string(point.refused)});
  return table;
}

loadgen::PlotTable stability_table(std::span<const Ordeal> ordeals) {
  loadgen::PlotTable table{
      "stability",
      "Whether engines come through what is hard: a row per scene and engine",
      {"scene", "engine", "integrator", "dt_s", "survived", "overlap_m", "start_overlap_m",
       "escapes", "energy_error", "events_per_s", "run_s_per_s"}};
  for (const Ordeal& ordeal : ordeals)
    for (const Survival& survival : ordeal.survivals) {
      const Wear& wear = survival.wear;
      std::vector<std::string> row{ordeal.trial.name, survival.contender.engine,
                                   survival.contender.integrator, exact_number(survival.dt),
                                   survival.verdict()};
      if (survival.is_done)
        for (const std::string& value :
             {exact_number(wear.overlap), exact_number(wear.start_overlap),
              std::to_string(wear.escapes), exact_number(wear.energy_error),
              exact_number(wear.events_per_s), exact_number(wear.run_s)})
          row.push_back(value);
      row.resize(table.columns.size());
      table.rows.push_back(std::move(row));
    }
  return table;
}

}  // namespace rink::accuracy
