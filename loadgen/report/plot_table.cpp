// Quotes, comments and details.
#include "loadgen/report/plot_table.h"

#include <algorithm>
#include <cassert>

#include "loadgen/report/plots/text.h"

namespace rink::loadgen {
namespace {

constexpr std::size_t rows_on_page_max = 120;

[[maybe_unused]] bool is_rectangular(const PlotTable& table) {
  return std::ranges::all_of(table.rows,
                             [&](const auto& row) { return row.size() == table.columns.size(); });
}

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n#") == std::string::npos) return text;
  std::string result = "\"";
  for (const char letter : text)
    result += letter == '"' ? std::string("\"\"") : std::string(1, letter);
  return result + '"';
}

std::string csv_line(const std::vector<std::string>& values) {
  std::string line;
  for (std::size_t i = 0; i < values.size(); ++i) line += (i == 0 ? "" : ",") + quoted(values[i]);
  return line + "\n";
}

/// A comment must not break out of its line.
std::string comment(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char letter) { return letter == '\n' || letter == '\r'; }, ' ');
  return "# " + text + "\n";
}

}  // namespace

std::string to_csv(const PlotTable& table, const Provenance& provenance) {
  assert(is_rectangular(table));
  std::string csv = comment(table.about);
  for (const auto& [name, text] : provenance.facts) csv += comment(name + ": " + text);
  csv += csv_line(table.columns);
  for (const auto& row : table.rows) csv += csv_line(row);
  return csv;
}

std::string to_details(const PlotTable& table) {
  assert(is_rectangular(table) && !table.name.empty());
  const std::string file = "plots/" + escaped(table.name) + ".csv";
  if (table.rows.size() > rows_on_page_max)
    return "<p class=\"data\">Data: " + file + ", " + std::to_string(table.rows.size()) +
           " rows</p>\n";
  std::string html = "<details class=\"data\"><summary>Data: " + file +
                     "</summary><div class=\"scroll\"><table><thead><tr>";
  for (const std::string& column : table.columns) html += "<th>" + escaped(column) + "</th>";
  html += "</tr></thead><tbody>\n";
  for (const auto& row : table.rows) {
    html += "<tr>";
    for (const std::string& value : row) html += "<td>" + escaped(value) + "</td>";
    html += "</tr>\n";
  }
  return html + "</tbody></table></div></details>\n";
}

}  // namespace rink::loadgen
