// Bytes per client against clients, payload and on the wire.
#include <algorithm>

#include "loadgen/report/plots/chart_svg.h"
#include "loadgen/report/plots/lines.h"
#include "loadgen/report/plots/text.h"
#include "loadgen/report/sections/run_figures.h"
#include "loadgen/report/sections/section_content.h"

namespace rink::loadgen {
namespace {

/// Lines over numbers of clients, and their description.
struct Traffic {
  std::vector<RunRecord> runs{};  ///< of parts put together; else empty
  std::vector<CellLine> lines;
  std::string words{};
};

/// The lines that other sections draw or, if those have a single number of clients, the runs in
/// virtual time without delay for several numbers, from all parts.
Traffic traffic_of(const Findings& findings) {
  Traffic traffic{.lines = plotted_lines(findings)};
  if (client_counts(traffic.lines).size() > 1 || findings.experiment.parts.empty()) return traffic;
  for (const RunRecord& run : findings.runs) {
    const Experiment part = part_of(findings.experiment, run.cell.part);
    if (part.transport != TransportKind::virtual_time || part.is_of_curves || part.delay_ms != 0.0)
      continue;
    traffic.runs.push_back(run);
    traffic.runs.back().cell.part.clear();
  }
  std::vector<CellLine> lines = lines_of(traffic.runs);
  std::erase_if(lines, [](const CellLine& line) { return line.groups.size() < 2; });
  if (lines.empty()) return traffic;
  name_and_style(lines);
  traffic.lines = std::move(lines);
  traffic.words = " All in virtual time without delay.";
  return traffic;
}

/// A sentence about which schemes send most and least at the largest client count.
std::string extremes(const std::vector<CellLine>& lines, FigureOf figure) {
  const auto counts = client_counts(lines);
  if (counts.empty()) return "";
  std::vector<std::pair<double, std::string>> found;
  for (const CellLine& line : lines) {
    for (const CellGroup& group : line.groups) {
      const auto mean = group.cell.clients == counts.back() ? group.mean(figure) : std::nullopt;
      if (mean && mean->mean > 0.0) found.emplace_back(mean->mean, line.name);
    }
  }
  if (found.size() < 2) return "";
  const auto [least, most] = std::minmax_element(found.begin(), found.end());
  return " At " + std::to_string(counts.back()) + " clients: least " +
         short_bytes_per_s(least->first) + " (" + least->second + "), most " +
         short_bytes_per_s(most->first) + " (" + most->second + "), " +
         plain_number(most->first / least->first) + " times as much.";
}

struct TrafficPlot {
  FigureOf figure;
  std::string table_name, title;
  std::string reading;  ///< how to read it, in words
};

void add_plot(SectionContent& content, const Traffic& traffic, const TrafficPlot& of) {
  Chart plot{.title = of.title, .x = {"clients", true}, .y = {"bytes per second and client", true}};
  PlotTable table{
      of.table_name,
      of.title + ": bytes per second and client, mean over replications and its 95 % interval",
      cell_columns()};
  table.columns.insert(table.columns.end(), {"bytes_per_client_per_s", "low_95", "high_95"});
  add_lines(plot, table, traffic.lines, [&](const CellGroup& group, auto& row) {
    const auto mean = group.mean(of.figure);
    append_interval(row, mean);
    return mean ? std::optional(PlotPoint{static_cast<double>(group.cell.clients),
                                          mean->mean,
                                          mean->interval,
                                          {},
                                          short_bytes_per_s(mean->mean)})
                : std::nullopt;
  });
  if (!has_points(plot))
    return content.add_absence(of.title + ": no valid run has this figure, so there is no plot.");
  plot.alternative = of.reading + extremes(traffic.lines, of.figure) + traffic.words;
  content.add(to_svg(plot), plot.alternative, std::move(table));
}

}  // namespace

SectionContent traffic_content(const Findings& findings) {
  SectionContent content{"<div class=\"plots\">\n"};
  const Traffic traffic = traffic_of(findings);
  add_plot(
      content, traffic,
      {.figure = payload,
       .table_name = "payload-against-clients",
       .title = "Payload to each client",
       .reading =
           "Lower is better; a flat line means that a client's traffic does not depend on how many "
           "others there are. Bars: 95 % intervals of the mean."});
  add_plot(content, traffic,
           {.figure = on_the_wire,
            .table_name = "wire-against-clients",
            .title = "On the wire for each client",
            .reading = "Both directions with headers: what a client's link carries. Lines come "
                       "closer where headers outweigh payload."});
  content.html += "</div>\n";
  content.add(bytes_by_kind_content(findings));
  content.add(bytes_by_field_content(findings));
  return content;
}

}  // namespace rink::loadgen
