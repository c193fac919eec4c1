// What all sections share: figures, absences, and the columns that name a cell.
#include "loadgen/report/exhibit.h"

#include <iterator>

#include "loadgen/report/text.h"

namespace rink::loadgen {

void Exhibit::add(const std::string& svg, const std::string& caption, PlotTable table) {
  html += "<figure>\n" + svg + (caption.empty() ? "" : "<figcaption>" + escaped(caption) + "</figcaption>\n");
  if (!table.is_empty()) html += to_details(table);
  html += "</figure>\n";
  if (!table.is_empty()) tables.push_back(std::move(table));
}

void Exhibit::add_absence(const std::string& sentence) { html += "<p class=\"faint\">" + escaped(sentence) + "</p>\n"; }

void Exhibit::add(Exhibit other) {
  html += other.html;
  std::move(other.tables.begin(), other.tables.end(), std::back_inserter(tables));
}

std::vector<std::string> cell_columns() { return {"line", "mode", "scheme", "policy", "clients", "runs"}; }

std::vector<std::string> cell_values(const CellLine& line, const CellGroup& group) {
  return {line.name, group.cell.mode, group.cell.scheme, group.cell.policy, std::to_string(group.cell.clients), std::to_string(group.runs.size())};
}

void append_interval(std::vector<std::string>& row, const std::optional<MeanInterval>& mean) {
  row.push_back(mean ? exact_number(mean->mean) : "");
  row.push_back(mean && mean->interval ? exact_number(mean->interval->first) : "");
  row.push_back(mean && mean->interval ? exact_number(mean->interval->second) : "");
}

}  // namespace rink::loadgen
