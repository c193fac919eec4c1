// The common parts of sections: figures, absences, and the columns that name a cell.
#include "loadgen/report/sections/section_content.h"

#include <algorithm>
#include <cassert>
#include <iterator>

#include "loadgen/experiment/parameter.h"
#include "loadgen/report/plots/text.h"

namespace rink::loadgen {

namespace {

std::string figcaption(const std::string& caption) {
  return caption.empty() ? "" : "<figcaption>" + escaped(caption) + "</figcaption>\n";
}

}  // namespace

void SectionContent::add(const std::string& svg, const std::string& caption, PlotTable table) {
  assert(!table.name.empty() && "its file is called so");
  pictures.push_back({table.name, svg});
  html += "<figure>\n" + svg + figcaption(caption);
  if (!table.is_empty()) html += to_details(table);
  html += "</figure>\n";
  if (!table.is_empty()) tables.push_back(std::move(table));
}

void SectionContent::add_panel(const std::string& table_name, const std::string& svg,
                               const std::string& caption) {
  assert(!table_name.empty());
  pictures.push_back({table_name, svg});
  html += "<figure>\n" + svg + figcaption(caption) + "</figure>\n";
}

void SectionContent::add_absence(const std::string& sentence) {
  html += "<p class=\"faint\">" + escaped(sentence) + "</p>\n";
}

void SectionContent::add_absences(const std::string& titles) {
  if (!titles.empty())
    add_absence("Not measured in any cell's every run, so without a plot: " + titles + ".");
}

void SectionContent::add(SectionContent other) {
  html += other.html;
  std::move(other.tables.begin(), other.tables.end(), std::back_inserter(tables));
  std::move(other.pictures.begin(), other.pictures.end(), std::back_inserter(pictures));
}

std::vector<std::string> cell_columns() {
  return {"line", "mode", "scheme", "policy", "clients", "runs"};
}

std::vector<std::string> cell_values(const CellLine& line, const CellGroup& group) {
  return {line.name,
          group.cell.mode,
          group.cell.scheme,
          group.cell.policy,
          std::to_string(group.cell.clients),
          std::to_string(group.runs.size())};
}

std::vector<CellLine> plotted_lines(const Findings& findings) {
  if (findings.lines.empty()) return {};
  const auto counts = [](const CellLine& line) {
    return std::ranges::any_of(line.groups,
                               [](const CellGroup& group) { return !group.runs.empty(); });
  };
  const auto first = std::ranges::find_if(findings.lines, counts);
  return plotted_lines(
      findings,
      (first == findings.lines.end() ? findings.lines.front() : *first).groups.front().cell.part);
}

std::vector<CellLine> plotted_lines(const Findings& findings, const std::string& part) {
  constexpr std::size_t lines_max = 12;
  std::vector<CellLine> lines = findings.lines;
  if (!findings.experiment.parts.empty()) {
    std::erase_if(lines,
                  [&part](const CellLine& line) { return line.groups.front().cell.part != part; });
    name_and_style(lines);
  }
  if (lines.size() <= lines_max) return lines;
  std::erase_if(lines, [&findings](const CellLine& line) {
    return !is_at_first_values(findings.experiment, line.groups.front().cell);
  });
  name_and_style(lines);
  return lines;
}

std::string mean_cell(const CellGroup& group, FigureOf figure, double scale, int digits) {
  const auto mean = group.mean(figure);
  return "<td>" + plain_number(mean ? std::optional(scale * mean->mean) : std::nullopt, digits) +
         "</td>";
}

void add_lines(Chart& plot, PlotTable& table, const std::vector<CellLine>& lines,
               const PointOf& point_of) {
  for (const CellLine& line : lines) {
    PlotLine drawn{line.name, line.style, {}};
    for (const CellGroup& group : line.groups) {
      auto row = cell_values(line, group);
      std::optional<PlotPoint> point = point_of(group, row);
      if (!point) continue;
      point->title =
          line.name + ", " + std::to_string(group.cell.clients) + " clients: " + point->title;
      drawn.points.push_back(std::move(*point));
      table.rows.push_back(std::move(row));
    }
    if (!drawn.points.empty()) plot.lines.push_back(std::move(drawn));
  }
}

void append_interval(std::vector<std::string>& row, const std::optional<MeanInterval>& mean) {
  row.push_back(mean ? exact_number(mean->mean) : "");
  row.push_back(mean && mean->interval ? exact_number(mean->interval->first) : "");
  row.push_back(mean && mean->interval ? exact_number(mean->interval->second) : "");
}

}  // namespace rink::loadgen
