// The cost of a server's tick by part, beside the time available.
#include <algorithm>

#include "loadgen/report/plots/chart_svg.h"
#include "loadgen/report/plots/text.h"
#include "loadgen/report/sections/section_content.h"

namespace rink::loadgen {
namespace {

constexpr double on_time_least = 0.99;
constexpr double mark_share_least = 0.3;  // below that the budget would press the bars flat

std::optional<double> physics(const RunRecord& run) { return run.physics_us_per_tick; }
std::optional<double> filter(const RunRecord& run) { return run.filter_us_per_tick; }
std::optional<double> send(const RunRecord& run) { return run.send_us_per_tick; }
constexpr FigureOf on_time{[](const RunRecord& run) { return run.ticks_on_time_fraction; },
                           Scale::fraction};

constexpr FigureOf parts[] = {physics, filter, send};

std::optional<Bar> bar_of(const CellGroup& group) {
  Bar bar{std::to_string(group.cell.clients), {}, ""};
  for (const FigureOf part : parts) {
    const auto mean = group.mean(part);
    if (!mean) return std::nullopt;
    bar.parts.push_back(mean->mean);
  }
  const auto share = group.mean(on_time);
  if (share && share->mean < on_time_least)
    bar.flag = plain_number(100.0 * share->mean) + " % on time";
  return bar;
}

}  // namespace

SectionContent cost_content(const Findings& findings) {
  SectionContent content;
  const double budget_us = 1e6 / *std::max_element(findings.experiment.tick_rates_hz.begin(),
                                                   findings.experiment.tick_rates_hz.end());
  PlotTable table{
      "cost-per-tick",
      "Wall time of the server's parts per tick: means over replications with their 95 % intervals",
      cell_columns()};
  for (const char* part : {"physics", "filter", "send"}) {
    for (const char* suffix : {"_us_per_tick", "_low_95", "_high_95"})
      table.columns.push_back(std::string(part) + suffix);
  }
  table.columns.emplace_back("ticks_on_time_fraction");
  std::vector<Chart> plots;
  double highest = 0.0;
  for (const CellLine& line : plotted_lines(findings)) {
    Chart plot{.title = line.name,
               .x = {"clients"},
               .y = {"us per tick"},
               .alternative = "Physics, filter and send, stacked, for each client count.",
               .width = 380.0,
               .frame_height = 190.0,
               .part_names = {"physics", "filter", "send"},
               .mark = {{budget_us, "budget of a tick"}}};
    for (const CellGroup& group : line.groups) {
      const auto bar = bar_of(group);
      if (!bar) continue;
      highest = std::max(highest, bar->parts[0] + bar->parts[1] + bar->parts[2]);
      plot.bars.push_back(*bar);
      auto row = cell_values(line, group);
      for (const FigureOf part : parts) append_interval(row, group.mean(part));
      const auto share = group.mean(on_time);
      row.push_back(share ? exact_number(share->mean) : "");
      table.rows.push_back(std::move(row));
    }
    if (!plot.bars.empty()) plots.push_back(std::move(plot));
  }
  if (plots.empty()) {
    content.add_absence(
        "No run has processor costs (in virtual time none are taken), so there is no plot.");
    return content;
  }
  const bool has_mark = highest >= mark_share_least * budget_us;
  content.html += "<p class=\"faint\">Lower is better; all panels share one scale. A tick has " +
                  plain_number(budget_us / 1e3) + " ms: the fullest bar takes " +
                  plain_number(100.0 * highest / budget_us) + " % of it" +
                  (has_mark ? "; the dashed line is where the server saturates."
                            : ", so the line where the server saturates lies beyond these plots.") +
                  " A note above a bar means that fewer than 99 % of its ticks were on "
                  "time.</p>\n<div class=\"plots small\">\n";
  const Axis shared = axis_around(0.0, has_mark ? std::max(highest, budget_us) : highest, false);
  for (Chart& plot : plots) {
    plot.y.range = {shared.low, shared.high};
    content.add_panel(table.name, to_svg(plot), "");
  }
  content.html += "</div>\n" + to_details(table);
  content.tables.push_back(std::move(table));
  return content;
}

}  // namespace rink::loadgen
