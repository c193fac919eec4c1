// Box plots over replications, so that a mean is not taken for more than it is.
#include "game/model/listed.h"
#include "loadgen/report/plots/chart_svg.h"
#include "loadgen/report/plots/text.h"
#include "loadgen/report/sections/section_content.h"

namespace rink::loadgen {
namespace {

constexpr std::size_t groups_max = 3;

struct BoxedFigure {
  const char* name;
  const char* title;
  const char* unit;
  FigureOf of;
};

constexpr BoxedFigure boxed_figures[] = {
    {"replications-payload", "Payload to each client", "bytes per second and client",
     [](const RunRecord& run) { return run.down_bytes_per_client_per_s; }},
    {"replications-displayed-error", "Displayed error, RMS", "mm",
     [](const RunRecord& run) { return run.truth.displayed_error_mm.rms; }},
    {"replications-update-age", "Update age, 99th percentile", "ms",
     [](const RunRecord& run) { return run.update_age_ms.p99; }},
};

bool add_box_plot(SectionContent& content, const Findings& findings, const BoxedFigure& figure) {
  Chart plot{.title = figure.title,
             .x = {figure.unit, true},
             .alternative = "One row per filter and client count; every dot is a run."};
  PlotTable table{figure.name, std::string(figure.title) + " of every valid run", cell_columns()};
  table.columns.insert(table.columns.end(), {"seed", figure.unit});
  for (const std::uint32_t clients : thinned(client_counts(findings.lines), groups_max)) {
    BoxGroup drawn{std::to_string(clients) + (clients == 1 ? " client" : " clients"), {}};
    for (const CellLine& line : plotted_lines(findings)) {
      for (const CellGroup& group : line.groups) {
        const auto values =
            group.cell.clients == clients ? group.values(figure.of) : std::vector<double>{};
        if (values.empty()) continue;
        drawn.rows.push_back({line.name, line.style, values});
        for (std::size_t i = 0; i < values.size(); ++i) {
          auto row = cell_values(line, group);
          row.push_back(std::to_string(group.runs[i]->cell.seed));
          row.push_back(exact_number(values[i]));
          table.rows.push_back(std::move(row));
        }
      }
    }
    if (!drawn.rows.empty()) plot.groups.push_back(std::move(drawn));
  }
  if (plot.groups.empty()) return false;
  content.add(to_svg(plot), "", std::move(table));
  return true;
}

}  // namespace

SectionContent replication_content(const Findings& findings) {
  SectionContent content{
      "<p class=\"faint\">Every dot is a run. Around five or more stands Tukey's box (1977): the "
      "middle half between the hinges, the bar at the median, whiskers to the outermost runs "
      "within 1.5 hinge spreads. Boxes that overlap much are no ground to prefer either.</p>\n<div "
      "class=\"plots\">\n"};
  std::string absences;
  for (const BoxedFigure& figure : boxed_figures) {
    if (!add_box_plot(content, findings, figure)) game::add_to_list(absences, figure.title);
  }
  content.html += "</div>\n";
  content.add_absences(absences);
  return content;
}

}  // namespace rink::loadgen
