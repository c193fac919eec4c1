// The effect of stages' numbers: expressions that differ only in numbers form a curve, bytes
// against displayed error and against recall.
#include <algorithm>
#include <cctype>

#include "loadgen/report/plots/chart_svg.h"
#include "loadgen/report/plots/lines.h"
#include "loadgen/report/plots/share_range.h"
#include "loadgen/report/plots/text.h"
#include "loadgen/report/sections/run_figures.h"
#include "loadgen/report/sections/section_content.h"

namespace rink::loadgen {
namespace {

/// An expression without its numbers, and the numbers: "aura with tiers(at)" and "0.3 0.6".
struct Shape {
  std::string form, numbers;
};

Shape shape_of(const std::string& expression) {
  Shape shape;
  std::string key;
  for (std::size_t at = 0; at < expression.size();) {
    const auto is_of_key = [&](std::size_t place) {
      return place < expression.size() &&
             (std::isalnum(static_cast<unsigned char>(expression[place])) ||
              expression[place] == '_');
    };
    std::size_t end = at;
    while (is_of_key(end)) ++end;
    if (end == at || end == expression.size() || expression[end] != '=') {
      end = std::max(end, at + 1);
      shape.form += expression.substr(at, end - at);
      at = end;
      continue;
    }
    // A repeated key, as tiers have it, continues one list.
    const std::string name = expression.substr(at, end - at);
    const std::size_t last = expression.find_first_of(" )", end);
    shape.numbers +=
        (shape.numbers.empty() ? "" : " ") + expression.substr(end + 1, last - end - 1);
    if (name == key && shape.form.ends_with(key + " ")) shape.form.pop_back();
    else shape.form += name;
    key = name;
    at = std::min(last, expression.size());
  }
  return shape;
}

struct Curve {
  Cell cell;  ///< its scheme is replaced by the form
  CellLine line;
  std::vector<std::string> labels;
};

/// At the largest number of clients, in the experiment's order.
std::vector<Curve> curves_of(const Findings& findings) {
  std::vector<Curve> curves;
  const std::uint32_t most_clients = client_counts(findings.lines).back();
  for (const CellLine& line : plotted_lines(findings))
    for (const CellGroup& group : line.groups) {
      if (group.cell.clients != most_clients || !group.mean(payload)) continue;
      const Shape shape = shape_of(group.cell.scheme);
      Cell cell = group.cell;
      cell.scheme = shape.form, cell.seed = 0;
      auto curve = std::find_if(curves.begin(), curves.end(),
                                [&](const Curve& other) { return other.cell == cell; });
      if (curve == curves.end()) curve = curves.insert(curve, {cell, {}, {}});
      curve->line.groups.push_back(group);
      curve->labels.push_back(shape.numbers);
    }
  // Names and colours are those of the forms; the cells behind the points keep their expressions.
  std::vector<CellLine> forms;
  forms.reserve(curves.size());
  for (const Curve& curve : curves) forms.push_back({"", {}, {CellGroup{curve.cell, {}, 0}}});
  name_and_style(forms);
  for (std::size_t i = 0; i < curves.size(); ++i)
    curves[i].line.name = forms[i].name, curves[i].line.style = forms[i].style;
  return curves;
}

Chart plot_of(const std::vector<Curve>& curves, const std::string& title, const char* axis,
              FigureOf figure, bool is_logarithmic) {
  Chart plot{.title = title,
             .x = {axis, is_logarithmic},
             .y = {"payload, bytes per second and client", true}};
  double least = 1.0;
  for (const Curve& curve : curves) {
    PlotLine drawn{curve.line.name, curve.line.style, {}};
    for (std::size_t i = 0; i < curve.line.groups.size(); ++i) {
      const CellGroup& group = curve.line.groups[i];
      const auto x = group.mean(figure), bytes = group.mean(payload);
      if (!x || !bytes) continue;
      drawn.points.push_back({x->mean, bytes->mean, bytes->interval, x->interval,
                              group.cell.scheme + ": " + plain_number(x->mean, 4) + ", " +
                                  short_bytes_per_s(bytes->mean),
                              curve.labels[i]});
    }
    for (const PlotPoint& point : drawn.points) least = std::min(least, point.x);
    if (!drawn.points.empty()) plot.lines.push_back(std::move(drawn));
  }
  if (!is_logarithmic) plot.x.range = share_range(least);
  return plot;
}

PlotTable table_of(const std::vector<Curve>& curves) {
  PlotTable table{"stages",
                  "Payload, errors and recall of each expression, by form: means over replications "
                  "with their 95 % intervals",
                  cell_columns()};
  table.columns.insert(table.columns.end(), {"form", "numbers"});
  for (const char* figure : {"bytes_per_client_per_s", "displayed_error_mm_rms",
                             "displayed_error_mm_p99", "filter_recall", "delivered_recall"})
    for (const char* part : {"", "_low_95", "_high_95"})
      table.columns.push_back(std::string(figure) + part);
  for (const Curve& curve : curves)
    for (std::size_t i = 0; i < curve.line.groups.size(); ++i) {
      const CellGroup& group = curve.line.groups[i];
      auto row = cell_values(curve.line, group);
      row.insert(row.end(), {curve.cell.scheme, curve.labels[i]});
      for (const FigureOf figure :
           {payload, displayed_rms, displayed_p99, filter_recall, delivered_recall})
        append_interval(row, group.mean(figure));
      table.rows.push_back(std::move(row));
    }
  return table;
}

std::string html_of(const std::vector<Curve>& curves) {
  std::string html =
      "<div class=\"scroll\"><table><thead><tr><th class=\"text\">expression</th><th "
      "class=\"text\">numbers</th><th>payload<br/>kB/s/client</th><th>displayed error<br/>RMS "
      "mm</th>"
      "<th>p99 mm</th><th>recall "
      "of<br/>decisions</th><th>delivered<br/>recall</th></tr></thead><tbody>\n";
  for (const Curve& curve : curves)
    for (std::size_t i = 0; i < curve.line.groups.size(); ++i) {
      const CellGroup& group = curve.line.groups[i];
      html += std::string("<tr") + (i == 0 ? " class=\"first\"" : "") + "><td class=\"text\">" +
              escaped(curve.line.name) + "</td><td class=\"text\">" + escaped(curve.labels[i]) +
              "</td>" + mean_cell(group, payload, 1e-3, 3) +
              mean_cell(group, displayed_rms, 1.0, 3) + mean_cell(group, displayed_p99, 1.0, 3) +
              mean_cell(group, filter_recall, 1.0, 4) + mean_cell(group, delivered_recall, 1.0, 4) +
              "</tr>\n";
    }
  return html + "</tbody></table></div>\n<p class=\"data\">Data: plots/stages.csv</p>\n";
}

}  // namespace

bool has_expressions_of_one_form(const Findings& findings) {
  std::vector<Shape> seen;
  for (const CellLine& line : findings.lines) {
    const Shape shape = shape_of(line.groups.front().cell.scheme);
    if (std::any_of(seen.begin(), seen.end(), [&](const Shape& other) {
          return other.form == shape.form && other.numbers != shape.numbers;
        }))
      return true;
    seen.push_back(shape);
  }
  return false;
}

SectionContent stages_content(const Findings& findings) {
  SectionContent content;
  const std::vector<Curve> curves = curves_of(findings);
  Chart by_error = plot_of(curves, "Bytes against displayed error", "displayed error, RMS [mm]",
                           displayed_rms, true);
  Chart by_recall = plot_of(curves, "Bytes against delivered recall", "recall of what clients held",
                            delivered_recall, false);
  if (!has_points(by_error) && !has_points(by_recall)) {
    content.add_absence("No run was held against truth, so bytes cannot be drawn against error.");
    return content;
  }
  content.html +=
      "<p class=\"faint\">A curve joins expressions that differ in their numbers alone, which "
      "stand beside the marks, at " +
      std::to_string(client_counts(findings.lines).back()) +
      " clients. Entities that a client never discovered have no error: read recall beside "
      "it.</p>\n<div class=\"plots\">\n";
  by_error.alternative =
      "Lower left is better: fewer bytes and smaller error. A curve that lies left of and below "
      "another gives more for its bytes.";
  by_recall.alternative = "Lower right is better: nothing relevant missing for few bytes.";
  PlotTable table = table_of(curves);
  const std::string name = table.name;
  content.add(to_svg(by_error), by_error.alternative, std::move(table));
  content.add_panel(name, to_svg(by_recall), by_recall.alternative);
  content.html += "</div>\n" + html_of(curves);
  return content;
}

}  // namespace rink::loadgen
