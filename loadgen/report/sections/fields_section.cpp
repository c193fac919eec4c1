// Where the payload goes, by message and field: a table for each policy, a column for each filter.
#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "loadgen/report/plots/text.h"
#include "loadgen/report/sections/run_figures.h"
#include "loadgen/report/sections/section_content.h"

namespace rink::loadgen {
namespace {

struct FieldOf {
  std::string direction, channel, form, field;
  friend auto operator<=>(const FieldOf&, const FieldOf&) = default;
};
struct FieldMeans {
  double bytes_per_s = 0.0, times_per_s = 0.0;
};
using FieldTable = std::map<FieldOf, FieldMeans>;

/// Means over replications; nothing unless each has counted. A field that one lacks took none
/// there.
std::optional<FieldTable> fields_of(const CellGroup& group) {
  FieldTable table;
  for (const RunRecord* run : group.runs) {
    if (run->fields.empty()) return std::nullopt;
    const double share = 1.0 / static_cast<double>(group.runs.size());
    for (const FieldFigures& each : run->fields) {
      FieldMeans& means = table[{each.direction, each.channel, each.form, each.field}];
      means.bytes_per_s += share * each.bytes_per_client_per_s;
      means.times_per_s += share * each.times_per_client_per_s;
    }
  }
  return table.empty() ? std::nullopt : std::optional(std::move(table));
}

struct FieldColumn {
  std::string scheme;
  FieldTable fields;
};

std::string field_cell(double bytes_per_s) {
  return "<td>" + (bytes_per_s == 0.0 ? std::string() : plain_number(bytes_per_s, 3)) + "</td>";
}

/// The fields that take most in any column, those below a part of all payload together.
std::string html_of(const std::string& policy, const std::vector<FieldColumn>& columns) {
  constexpr double least_part = 0.005;
  std::map<FieldOf, double> largest;  // part of a column's payload
  std::vector<double> sums;
  for (const FieldColumn& column : columns) {
    double sum = 0.0;
    for (const auto& [field, means] : column.fields) sum += means.bytes_per_s;
    sums.push_back(sum);
    for (const auto& [field, means] : column.fields)
      largest[field] = std::max(largest[field], sum > 0.0 ? means.bytes_per_s / sum : 0.0);
  }
  std::string html = "<h4>" + escaped(policy) +
                     "</h4>\n<div class=\"scroll\"><table><thead><tr><th "
                     "class=\"text\">direction</th><th class=\"text\">form</th><th "
                     "class=\"text\">field</th>";
  for (const FieldColumn& column : columns) html += "<th>" + escaped(column.scheme) + "</th>";
  html += "</tr></thead><tbody>\n";
  std::vector<double> others(columns.size(), 0.0);
  for (const auto& [field, part] : largest) {
    const bool is_shown = part >= least_part;
    if (is_shown)
      html += "<tr><td class=\"text\">" + escaped(field.direction) +
              (field.channel == "stream" ? "" : ", " + escaped(field.channel)) +
              "</td><td class=\"text\">" + escaped(field.form) + "</td><td class=\"text\">" +
              escaped(field.field) + "</td>";
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const auto found = columns[i].fields.find(field);
      const double bytes = found == columns[i].fields.end() ? 0.0 : found->second.bytes_per_s;
      if (is_shown) html += field_cell(bytes);
      else others[i] += bytes;
    }
    if (is_shown) html += "</tr>\n";
  }
  const auto sum_row = [&](const char* name, const std::vector<double>& numbers) {
    html += std::string("<tr><td class=\"text\">") + name +
            "</td><td class=\"text\"></td><td class=\"text\"></td>";
    for (const double number : numbers) html += field_cell(number);
    html += "</tr>\n";
  };
  sum_row("all others", others);
  sum_row("payload", sums);
  return html + "</tbody></table></div>\n";
}

}  // namespace

SectionContent bytes_by_field_content(const Findings& findings) {
  PlotTable table{"bytes-by-field",
                  "Payload of both directions by channel, form and field (docs/wire.md), for each "
                  "client: means over replications",
                  cell_columns()};
  table.columns.insert(table.columns.end(), {"direction", "channel", "form", "field",
                                             "bytes_per_client_per_s", "times_per_client_per_s"});
  std::vector<std::pair<std::string, std::vector<FieldColumn>>> policies;
  for (const CellLine& line : largest_crowds(plotted_lines(findings))) {
    const CellGroup& group = line.groups.front();
    std::optional<FieldTable> fields = fields_of(group);
    if (!fields) continue;
    for (const auto& [of, means] : *fields) {
      auto row = cell_values(line, group);
      row.insert(row.end(), {of.direction, of.channel, of.form, of.field,
                             exact_number(means.bytes_per_s), exact_number(means.times_per_s)});
      table.rows.push_back(std::move(row));
    }
    const std::string policy = policy_name(group.cell);
    auto place = std::ranges::find(policies, policy, [](const auto& each) { return each.first; });
    if (place == policies.end()) place = policies.insert(place, {policy, {}});
    place->second.push_back({line.name, *std::move(fields)});
  }
  SectionContent content;
  if (policies.empty()) return content;
  content.html +=
      "<h3>Bytes by field</h3>\n<p class=\"faint\">Payload, bytes per second and client. Fields "
      "below 0.5 % of it are taken together; a field that is no whole byte counts its bits." +
      escaped(largest_crowd_words(findings)) + "</p>\n";
  for (const auto& [policy, columns] : policies) content.html += html_of(policy, columns);
  content.html += to_details(table);
  content.tables.push_back(std::move(table));
  return content;
}

}  // namespace rink::loadgen
