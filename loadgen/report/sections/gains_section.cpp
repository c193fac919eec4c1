// Bytes against error, and the table of gains: filter alone, policy alone, together, always beside
// the error.
#include <algorithm>

#include "loadgen/report/plots/chart_svg.h"
#include "loadgen/report/plots/lines.h"
#include "loadgen/report/plots/text.h"
#include "loadgen/report/sections/gains.h"
#include "loadgen/report/sections/run_figures.h"
#include "loadgen/report/sections/section_content.h"

namespace rink::loadgen {
namespace {

constexpr FigureOf matched_rms = [](const RunRecord& run) {
  return run.truth.position_error_mm.rms;
};

void add_scatter(SectionContent& content, const Findings& findings) {
  Chart plot{.title = "Payload against displayed error",
             .x = {"displayed error, RMS [mm]", true},
             .y = {"bytes per second and client", true}};
  PlotTable table{"bytes-against-error",
                  "Payload to each client beside the error of displayed positions: means over "
                  "replications with their 95 % intervals",
                  cell_columns()};
  table.columns.insert(table.columns.end(),
                       {"displayed_error_mm_rms", "error_low_95", "error_high_95",
                        "bytes_per_client_per_s", "bytes_low_95", "bytes_high_95"});
  const auto point_of = [](const CellGroup& group,
                           std::vector<std::string>& row) -> std::optional<PlotPoint> {
    const auto bytes = group.mean(payload), error = group.mean(displayed_rms);
    if (!bytes || !error) return std::nullopt;
    append_interval(row, error);
    append_interval(row, bytes);
    return PlotPoint{error->mean, bytes->mean, bytes->interval, error->interval,
                     plain_number(error->mean) + " mm, " + short_bytes_per_s(bytes->mean)};
  };
  add_lines(plot, table, largest_crowds(plotted_lines(findings)), point_of);
  if (!has_points(plot))
    return content.add_absence(
        "No run has a displayed error, so bytes cannot be drawn against it.");
  plot.alternative =
      "Lower left is better: fewer bytes and smaller error. Entities that a client never "
      "discovered have no error here: read recall beside it." +
      largest_crowd_words(findings);
  content.add(to_svg(plot), plot.alternative, std::move(table));
}

const char* words(Gain::Kind kind) {
  switch (kind) {
    case Gain::Kind::baseline:
      return "baseline";
    case Gain::Kind::filter_alone:
      return "filter alone";
    case Gain::Kind::policy_alone:
      return "policy alone";
    case Gain::Kind::together:
      return "together";
    case Gain::Kind::parameters:
      break;
  }
  return "other parameters";
}

std::string ratio_text(const Gain& gain) {
  if (gain.kind == Gain::Kind::baseline) return "1";
  if (!gain.bytes) return "\xE2\x80\x93";
  if (!gain.bytes->interval)
    return plain_number(gain.bytes->value) + " (one replication: cannot be told from chance)";
  std::string text = plain_number(gain.bytes->value) + " (" +
                     plain_number(gain.bytes->interval->low) + " to " +
                     plain_number(gain.bytes->interval->high) + ")";
  return gain.bytes->difference() == Difference::insignificant
             ? text + ", " + words_for(Difference::insignificant)
             : text;
}

std::string html_row(const Gain& gain, bool is_first) {
  return std::string("<tr") + (is_first ? " class=\"first\"" : "") + "><td>" +
         std::to_string(gain.group->cell.clients) + "</td><td class=\"text\">" +
         escaped(gain.line->name) + "</td><td class=\"text\">" + words(gain.kind) + "</td>" +
         mean_cell(*gain.group, payload, 1e-3) + "<td>" + ratio_text(gain) + "</td>" +
         mean_cell(*gain.group, displayed_rms) + mean_cell(*gain.group, displayed_p99) +
         mean_cell(*gain.group, matched_rms) + mean_cell(*gain.group, delivered_recall) + "</tr>\n";
}

std::vector<std::string> csv_row(const Gain& gain) {
  auto row = cell_values(*gain.line, *gain.group);
  row.emplace_back(words(gain.kind));
  row.push_back(gain.bytes ? exact_number(gain.bytes->value) : "");
  row.push_back(gain.bytes && gain.bytes->interval ? exact_number(gain.bytes->interval->low) : "");
  row.push_back(gain.bytes && gain.bytes->interval ? exact_number(gain.bytes->interval->high) : "");
  for (const FigureOf figure :
       {payload, displayed_rms, displayed_p99, matched_rms, delivered_recall}) {
    const auto mean = gain.group->mean(figure);
    row.push_back(mean ? exact_number(mean->mean) : "");
  }
  return row;
}

void add_gains(SectionContent& content, const Findings& findings) {
  const std::vector<Gain> gains = gains_of(findings);
  const bool has_other = std::any_of(gains.begin(), gains.end(), [](const Gain& gain) {
    return gain.kind != Gain::Kind::baseline;
  });
  const std::string baseline = findings.experiment.baseline().words();
  if (!has_other)
    return content.add_absence("There is no valid run of the baseline (" + baseline +
                               ") beside another, so gains are unknown.");
  PlotTable table{"gains",
                  "Payload bytes of the baseline, " + baseline +
                      ", divided by those of each cell, paired by seed, beside its errors",
                  cell_columns()};
  table.columns.insert(table.columns.end(),
                       {"gain_of", "times_fewer_bytes", "low_95", "high_95",
                        "bytes_per_client_per_s", "displayed_error_mm_rms",
                        "displayed_error_mm_p99", "position_error_mm_rms", "delivered_recall"});
  content.html +=
      "<h3>Reduction factors (gains)</h3>\n<p class=\"faint\">How many times fewer payload bytes "
      "than the baseline, " +
      escaped(baseline) +
      ": geometric mean over seeds, each against the baseline's run of the same game, with its 95 "
      "% interval. Where the filter's and the policy's gains "
      "multiply to the gain together, the two do not get in each other's way.</p>\n<div "
      "class=\"scroll\"><table>\n<thead><tr><th>clients</th><th class=\"text\">filter</th>"
      "<th class=\"text\">gain of</th><th>payload<br/>kB/s/client</th><th>reduction factor: "
      "times<br/>fewer bytes (95 % interval)</th><th>dead-reckoning error<br/>now (displayed), RMS "
      "mm</th><th>p99 mm</th>"
      "<th>at the time stamp<br/>(matched), RMS "
      "mm</th><th>delivered<br/>recall</th></tr></thead>\n<tbody>\n";
  for (std::size_t i = 0; i < gains.size(); ++i) {
    content.html += html_row(
        gains[i], i > 0 && gains[i].group->cell.clients != gains[i - 1].group->cell.clients);
    table.rows.push_back(csv_row(gains[i]));
  }
  content.html += "</tbody></table></div>\n<p class=\"data\">Data: plots/gains.csv</p>\n";
  content.tables.push_back(std::move(table));
}

}  // namespace

SectionContent gains_content(const Findings& findings) {
  SectionContent content{"<div class=\"plots\">\n"};
  add_scatter(content, findings);
  add_error_distribution(content, findings);
  content.html += "</div>\n";
  add_gains(content, findings);
  return content;
}

}  // namespace rink::loadgen
