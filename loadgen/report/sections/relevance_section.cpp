// Precision against recall, of the filter's decisions and of what clients held.
#include <algorithm>
#include <set>

#include "loadgen/report/plots/chart_svg.h"
#include "loadgen/report/plots/lines.h"
#include "loadgen/report/plots/text.h"
#include "loadgen/report/sections/run_figures.h"
#include "loadgen/report/sections/section_content.h"

namespace rink::loadgen {
namespace {

/// Where the harmonic mean of precision p and recall r is `score`, p = score r / (2 r - score),
/// from a recall and a precision of so much on.
ReferenceCurve equal_score(double score, double recall_least, double precision_least) {
  const double first = std::max(recall_least, score / (2.0 - score));
  const double last = 2.0 * precision_least > score
                          ? std::min(1.0, score * precision_least / (2.0 * precision_least - score))
                          : 1.0;
  ReferenceCurve curve{"F1 " + short_number(score), {}};
  for (int i = 0; i <= 100 && first < last; ++i) {
    const double recall = first + (last - first) * i / 100.0;
    curve.points.emplace_back(recall, score * recall / (2.0 * recall - score));
  }
  return curve;
}

struct RelevancePlot {
  FigureOf precision, recall;
  std::string table_name, title;
};

void add_plot(SectionContent& content, const Findings& findings, const RelevancePlot& of) {
  Chart plot{.title = of.title, .x = {"recall"}, .y = {"precision"}};
  PlotTable table{of.table_name, of.title + ": means over replications with their 95 % intervals",
                  cell_columns()};
  table.columns.insert(table.columns.end(), {"recall", "recall_low_95", "recall_high_95",
                                             "precision", "precision_low_95", "precision_high_95"});
  double low_recall = 1.0, low_precision = 1.0;
  const auto point_of = [&](const CellGroup& group,
                            std::vector<std::string>& row) -> std::optional<PlotPoint> {
    const auto p = group.mean(of.precision), r = group.mean(of.recall);
    if (!p || !r) return std::nullopt;
    low_recall = std::min({low_recall, r->mean, r->interval ? r->interval->first : 1.0}),
    low_precision = std::min({low_precision, p->mean, p->interval ? p->interval->first : 1.0});
    append_interval(row, r);
    append_interval(row, p);
    return PlotPoint{
        r->mean, p->mean, p->interval, r->interval,
        "recall " + plain_number(r->mean, 4) + ", precision " + plain_number(p->mean, 4)};
  };
  add_lines(plot, table, largest_crowds(plotted_lines(findings)), point_of);
  if (!has_points(plot))
    return content.add_absence(of.title +
                               ": no run was held against truth in this, so there is no plot.");
  plot.x.range = zoomed(low_recall, 1.0), plot.y.range = zoomed(low_precision, 1.0);
  for (const double score : {0.2, 0.4, 0.6, 0.8, 0.9, 0.95, 0.98})
    plot.references.push_back(equal_score(score, plot.x.range->first, plot.y.range->first));
  plot.alternative =
      "The upper right corner is perfect: nothing relevant is missing, nothing irrelevant is sent. "
      "Faint curves join points of equal F1, the harmonic mean of both. The axes show where the "
      "data are: recall from " +
      plain_number(plot.x.range->first, 4) + ", precision from " +
      plain_number(plot.y.range->first, 4) + " on." + largest_crowd_words(findings);
  content.add(to_svg(plot), plot.alternative, std::move(table));
}

constexpr FigureOf delivered_precision{
    [](const RunRecord& run) { return run.truth.delivered_precision; }, Scale::fraction};

struct Quality {
  const char* name;
  FigureOf of;
  double scale;
  int digits = 3;
};

constexpr Quality qualities[] = {
    {"filter recall", filter_recall, 1.0, 5},
    {"filter precision", filter_precision, 1.0},
    {"delivered recall", delivered_recall, 1.0, 5},
    {"delivered precision", delivered_precision, 1.0},
    {"missed interactions",
     [](const RunRecord& run) {
       return run.truth.missed_interactions
                  ? std::optional(static_cast<double>(*run.truth.missed_interactions))
                  : std::nullopt;
     },
     1.0},
    {"late entry p99 ms", [](const RunRecord& run) { return run.truth.late_entry_ms.p99; }, 1.0},
    {"changes of scope per client and s",
     [](const RunRecord& run) { return run.truth.churn_per_client_per_s; }, 1.0},
    {"flapping %",
     {[](const RunRecord& run) { return run.truth.flapping_fraction; }, Scale::fraction},
     100.0},
    {"wasted bytes %",
     {[](const RunRecord& run) { return run.truth.wasted_bytes_fraction; }, Scale::fraction},
     100.0},
    {"control bytes %",
     {[](const RunRecord& run) { return run.truth.control_bytes_fraction; }, Scale::fraction},
     100.0},
    {"fairness (Jain)",
     {[](const RunRecord& run) { return run.truth.fairness_jain; }, Scale::fraction},
     1.0},
};

/// One row per cell, with the columns that any cell has.
void add_quality_table(SectionContent& content, const Findings& findings) {
  PlotTable table{"quality", "Quality of each cell by truth: means over replications",
                  cell_columns()};
  for (const Quality& quality : qualities) table.columns.emplace_back(quality.name);
  std::string body;
  for (const CellLine& line : findings.lines) {
    for (const CellGroup& group : line.groups) {
      auto row = cell_values(line, group);
      std::string cells;
      bool has_any = false;
      for (const Quality& quality : qualities) {
        const auto mean = group.mean(quality.of);
        has_any = has_any || mean.has_value();
        row.push_back(mean ? exact_number(mean->mean * quality.scale) : "");
        cells += mean_cell(group, quality.of, quality.scale, quality.digits);
      }
      if (!has_any) continue;
      table.rows.push_back(std::move(row));
      body += "<tr><td class=\"text\">" + escaped(line.name) + "</td><td>" +
              std::to_string(group.cell.clients) + "</td>" + cells + "</tr>\n";
    }
  }
  if (table.is_empty()) return;
  content.html +=
      "<div class=\"scroll\"><table class=\"wide\"><thead><tr><th "
      "class=\"text\">filter</th><th>clients</th>";
  for (const Quality& quality : qualities)
    content.html += std::string("<th>") + quality.name + "</th>";
  content.html += "</tr></thead><tbody>\n" + body +
                  "</tbody></table></div>\n<p class=\"data\">Data: plots/quality.csv</p>\n";
  content.tables.push_back(std::move(table));
}

}  // namespace

SectionContent relevance_content(const Findings& findings) {
  SectionContent content;
  if (findings.relevance.empty()) {
    content.add_absence("No run was held against truth, so precision and recall are unknown.");
    return content;
  }
  content.html += "<p class=\"faint\">Relevant to a player: " + escaped(findings.relevance) +
                  ". Truth is the run's scene and key log simulated again; neither the filter nor "
                  "a client grades itself.</p>\n<div class=\"plots\">\n";
  add_plot(content, findings,
           {.precision = filter_precision,
            .recall = filter_recall,
            .table_name = "precision-recall-filter",
            .title = "The filter's decisions"});
  add_plot(content, findings,
           {.precision = delivered_precision,
            .recall = delivered_recall,
            .table_name = "precision-recall-delivered",
            .title = "What clients held"});
  add_bytes_against_relevance(content, findings);
  add_recall_against_delay(content, findings);
  content.html += "</div>\n";
  add_quality_table(content, findings);
  return content;
}

}  // namespace rink::loadgen
