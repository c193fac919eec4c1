// The effect of each swept parameter: precision against recall and bytes against both, a curve per
// scheme along the parameter's values.
#include <algorithm>
#include <functional>

#include "loadgen/experiment/parameter.h"
#include "loadgen/report/plots/chart_svg.h"
#include "loadgen/report/plots/share_range.h"
#include "loadgen/report/plots/text.h"
#include "loadgen/report/sections/run_figures.h"
#include "loadgen/report/sections/section_content.h"

namespace rink::loadgen {
namespace {

constexpr std::size_t curves_max = 12;

constexpr FigureOf churn = [](const RunRecord& run) { return run.truth.churn_per_client_per_s; };
constexpr FigureOf filter_cost = [](const RunRecord& run) { return run.filter_us_per_tick; };

bool is_judged(const CellGroup& group) {
  return group.mean(filter_precision) && group.mean(filter_recall) && group.mean(payload);
}

Cell key_of(Cell cell, const ParameterKind& kind) {
  kind.set(cell.parameters, kind.of(Parameters{}));
  cell.seed = 0;
  return cell;
}

/// Each curve a line whose groups differ in `kind` alone, ascending, at the largest number of
/// clients. A scheme that lacks the parameter is a single point.
std::vector<CellLine> curves_along(const Findings& findings, const ParameterKind& kind) {
  const std::uint32_t most_clients = client_counts(findings.lines).back();
  std::vector<CellLine> curves;
  for (const CellLine& line : findings.lines)
    for (const CellGroup& group : line.groups) {
      if (group.cell.clients != most_clients || !is_judged(group)) continue;
      const auto same = [&](const CellLine& other) {
        return key_of(other.groups.front().cell, kind) == key_of(group.cell, kind);
      };
      const auto curve = std::find_if(curves.begin(), curves.end(), same);
      if (curve == curves.end()) curves.push_back({"", {}, {group}});
      else curve->groups.push_back(group);
    }
  const auto is_standard = [&](const CellLine& curve) {
    return is_at_first_values(findings.experiment, curve.groups.front().cell, &kind);
  };
  std::erase_if(curves, [&](const CellLine& curve) {
    return curve.groups.size() < 2 && (kind.has(curve.groups.front().cell) || !is_standard(curve));
  });
  if (curves.size() > curves_max)
    std::erase_if(curves, [&](const CellLine& curve) { return !is_standard(curve); });
  for (CellLine& curve : curves)
    std::stable_sort(curve.groups.begin(), curve.groups.end(),
                     [&](const CellGroup& a, const CellGroup& b) {
                       return kind.of(a.cell.parameters) < kind.of(b.cell.parameters);
                     });
  name_and_style(curves);
  return curves;
}

struct Quantity {
  const char* name;
  FigureOf of;
  bool is_share;  ///< from 0 to 1
};
constexpr Quantity precision_of_decisions{"precision of the filter's decisions", filter_precision,
                                          true},
    recall_of_decisions{"recall of the filter's decisions", filter_recall, true},
    bytes{"payload, bytes per second and client", payload, false};

std::pair<double, double> range_of(const std::vector<CellLine>& curves, FigureOf figure) {
  double least = 1.0;
  for (const CellLine& curve : curves)
    for (const CellGroup& group : curve.groups) least = std::min(least, group.mean(figure)->mean);
  return share_range(least);
}

using Label = std::function<std::string(const Cell&)>;

Chart plot_of(const std::vector<CellLine>& curves, const Quantity& x, const Quantity& y,
              const std::string& title, const Label& label) {
  Chart plot{.title = title, .x = {x.name}, .y = {y.name, !y.is_share}};
  plot.x.range = range_of(curves, x.of);
  if (y.is_share) plot.y.range = range_of(curves, y.of);
  for (const CellLine& curve : curves) {
    PlotLine drawn{curve.name, curve.style, {}};
    for (const CellGroup& group : curve.groups) {
      const MeanInterval at_x = *group.mean(x.of), at_y = *group.mean(y.of);
      const std::string value = label(group.cell);
      const std::string title = curve.name + (value.empty() ? "" : ", " + value) + ": " +
                                plain_number(at_x.mean, 4) + ", " + plain_number(at_y.mean, 4);
      drawn.points.push_back({at_x.mean, at_y.mean, at_y.interval, at_x.interval, title, value});
    }
    plot.lines.push_back(std::move(drawn));
  }
  return plot;
}

/// The values behind the plots, with a column for the parameter.
PlotTable table_of(const std::vector<CellLine>& curves, const std::string& name,
                   const std::string& about, const ParameterKind* kind) {
  PlotTable table{name, about + ": means over replications with their 95 % intervals",
                  cell_columns()};
  if (kind) table.columns.emplace_back(kind->key);
  for (const char* figure : {"precision", "recall", "bytes_per_client_per_s",
                             "changes_per_client_per_s", "filter_us_per_tick"})
    for (const char* part : {"", "_low_95", "_high_95"})
      table.columns.push_back(std::string(figure) + part);
  for (const CellLine& curve : curves)
    for (const CellGroup& group : curve.groups) {
      auto row = cell_values(curve, group);
      if (kind)
        row.push_back(kind->has(group.cell) ? exact_number(kind->of(group.cell.parameters)) : "");
      for (const FigureOf figure : {filter_precision, filter_recall, payload, churn, filter_cost})
        append_interval(row, group.mean(figure));
      table.rows.push_back(std::move(row));
    }
  return table;
}

/// The values as a table on the page.
std::string html_of(const std::vector<CellLine>& curves, const ParameterKind& kind) {
  std::string html = "<div class=\"scroll\"><table><thead><tr><th class=\"text\">filter</th><th>" +
                     escaped(kind.axis) +
                     "</th><th>precision</th><th>recall</th><th>payload<br/>kB/s/client</"
                     "th><th>changes of scope<br/>per client and s</th></tr></thead><tbody>\n";
  for (const CellLine& curve : curves)
    for (std::size_t i = 0; i < curve.groups.size(); ++i) {
      const CellGroup& group = curve.groups[i];
      html += std::string("<tr") + (i == 0 ? " class=\"first\"" : "") + "><td class=\"text\">" +
              escaped(curve.name) + "</td><td>" +
              (kind.has(group.cell) ? value_text(kind, group.cell) : "\xE2\x80\x93") + "</td>" +
              mean_cell(group, filter_precision, 1.0, 3) + mean_cell(group, filter_recall, 1.0, 4) +
              mean_cell(group, payload, 1e-3, 3) + mean_cell(group, churn, 1.0, 3) + "</tr>\n";
    }
  return html + "</tbody></table></div>\n";
}

void add_bytes(SectionContent& content, const std::vector<CellLine>& curves,
               const std::string& along, const Label& label, PlotTable table) {
  Chart by_recall =
      plot_of(curves, recall_of_decisions, bytes, "Bytes against recall" + along, label);
  by_recall.alternative = "Lower right is better: nothing relevant missing for few bytes.";
  Chart by_precision =
      plot_of(curves, precision_of_decisions, bytes, "Bytes against precision" + along, label);
  by_precision.alternative =
      "What is sent beside what is wanted costs bytes; a scheme that lies below another at the "
      "same precision leaves out what is relevant.";
  const std::string name = table.name;
  content.add(to_svg(by_recall), by_recall.alternative, std::move(table));
  content.add_panel(name, to_svg(by_precision), by_precision.alternative);
}

void add_sweep(SectionContent& content, const Findings& findings, const ParameterKind& kind) {
  const std::vector<CellLine> curves = curves_along(findings, kind);
  if (curves.empty())
    return content.add_absence(std::string(kind.axis) +
                               ": no cell along it was held against truth.");
  const std::string along = std::string(", by ") + kind.axis;
  const Label label = [&kind](const Cell& cell) {
    return kind.has(cell) ? value_text(kind, cell) : std::string();
  };
  Chart both = plot_of(curves, recall_of_decisions, precision_of_decisions,
                       "Precision against recall" + along, label);
  both.alternative =
      "The upper right corner is perfect. A curve is a scheme, its marks the parameter's values; a "
      "lone mark is a scheme that has no such parameter.";
  PlotTable table =
      table_of(curves, std::string("sweep-") + kind.key,
               "Precision, recall and bytes of each scheme along " + std::string(kind.axis), &kind);
  content.html += "<h3>" + escaped(kind.axis) + "</h3>\n<div class=\"plots small\">\n";
  content.add_panel(table.name, to_svg(both), both.alternative);
  add_bytes(content, curves, along, label, std::move(table));
  content.html += "</div>\n" + html_of(curves, kind);
}

}  // namespace

void add_bytes_against_relevance(SectionContent& content, const Findings& findings) {
  std::vector<CellLine> curves = plotted_lines(findings);
  for (CellLine& curve : curves)
    std::erase_if(curve.groups, [](const CellGroup& group) { return !is_judged(group); });
  std::erase_if(curves, [](const CellLine& curve) { return curve.groups.empty(); });
  if (curves.empty()) return;
  add_bytes(
      content, curves, "", [](const Cell&) { return std::string(); },
      table_of(curves, "bytes-against-relevance", "Precision, recall and bytes of each filter",
               nullptr));
}

SectionContent sweep_content(const Findings& findings) {
  SectionContent content;
  const auto swept = swept_parameters(findings.experiment);
  if (swept.empty() || findings.lines.empty()) {
    content.add_absence(
        findings.experiment.parts.empty()
            ? "The experiment lists no parameter with several values (docs/experiments.md, Sweeps)."
            : "What all parts share has no parameter with several values; rivals at equal error "
              "show those of curves.");
    return content;
  }
  content.html +=
      "<p class=\"faint\">One parameter at a time along each curve, at " +
      std::to_string(client_counts(findings.lines).back()) +
      " clients; marks carry its value where there is room. Where other parameters have several "
      "values too, curves with their first values are drawn when all would be too many.</p>\n";
  for (const ParameterKind* kind : swept) add_sweep(content, findings, *kind);
  return content;
}

}  // namespace rink::loadgen
