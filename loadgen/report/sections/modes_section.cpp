// The load of nodes with and without a server, by purpose.
#include <algorithm>

#include "game/model/listed.h"
#include "loadgen/report/plots/chart_svg.h"
#include "loadgen/report/plots/lines.h"
#include "loadgen/report/plots/text.h"
#include "loadgen/report/sections/section_content.h"

namespace rink::loadgen {
namespace {

struct Subject {
  const char* name;
  std::size_t part;  ///< of a bar
  FigureOf of;
};

constexpr Subject subjects[] = {
    {"halo", 0, [](const RunRecord& run) { return run.traffic.halo; }},
    {"updates", 0, [](const RunRecord& run) { return run.traffic.updates; }},
    {"claims", 1, [](const RunRecord& run) { return run.traffic.claims; }},
    {"agreement", 1, [](const RunRecord& run) { return run.traffic.agreement; }},
    {"standby", 1, [](const RunRecord& run) { return run.traffic.standby; }},
    {"interest", 2, [](const RunRecord& run) { return run.traffic.interest; }},
    {"keys", 2, [](const RunRecord& run) { return run.traffic.keys; }},
};

struct Shown {
  const char *name, *title, *unit, *reading;
  FigureOf of;
};

constexpr Shown against_clients[] = {
    {"busiest-node-bytes", "The busiest node", "payload, bytes per second, both ways",
     "Payload of the server's link, or of the busiest peer's, without headers, of which many small "
     "messages have more: as the next plot shows.",
     [](const RunRecord& run) { return run.nodes.busiest_bytes_per_s; }},
    {"link-bytes", "The busiest link with headers", "bytes per second, both ways",
     "What one machine's link must carry, 66 bytes of headers for each segment and acknowledgement "
     "included: the server's, or the busiest peer's; over sockets, a peer's in the mean.",
     [](const RunRecord& run) {
       return run.nodes.busiest_link_bytes_per_s ? run.nodes.busiest_link_bytes_per_s
                                                 : run.wire_bytes_per_client_per_s;
     }},
    {"busiest-node-events", "Physics of the busiest node", "events per second",
     "What one machine must compute: the whole, or a part with the ghosts around it.",
     [](const RunRecord& run) { return run.nodes.busiest_events_per_s; }},
    {"busiest-node-cpu", "Processor time of the busiest node", "s",
     "From start to end, by the kernel.",
     [](const RunRecord& run) { return run.nodes.busiest_cpu_s; }},
    {"key-to-effect-median", "From key to effect, median", "ms",
     "From the instant a key was due to the first state of the own bat that has felt it.",
     [](const RunRecord& run) { return run.key_to_effect_ms.p50; }},
};

bool add_plot(SectionContent& content, const Findings& findings, const Shown& shown) {
  Chart plot{.title = shown.title, .x = {"clients", true}, .y = {shown.unit, true}};
  PlotTable table{shown.name,
                  std::string(shown.title) + ", " + shown.unit +
                      ": mean over replications and its 95 % interval",
                  cell_columns()};
  table.columns.insert(table.columns.end(), {shown.name, "low_95", "high_95"});
  add_lines(plot, table, findings.lines, [&](const CellGroup& group, auto& row) {
    const auto mean = group.mean(shown.of);
    append_interval(row, mean);
    return mean && mean->mean > 0.0
               ? std::optional(PlotPoint{static_cast<double>(group.cell.clients),
                                         mean->mean,
                                         mean->interval,
                                         {},
                                         short_number(mean->mean)})
               : std::nullopt;
  });
  if (!has_points(plot)) return false;
  plot.alternative = shown.reading;
  content.add(to_svg(plot), shown.reading, std::move(table));
  return true;
}

void add_bars(SectionContent& content, const Findings& findings) {
  PlotTable table{
      "traffic-by-subject",
      "Bytes for each client and second by what they are about: means over replications",
      cell_columns()};
  for (const Subject& subject : subjects)
    table.columns.push_back(std::string(subject.name) + "_bytes_per_client_per_s");
  for (const CellLine& line : findings.lines) {
    Chart plot{
        .title = line.name,
        .x = {"clients"},
        .y = {"bytes per second and client"},
        .alternative =
            "Bodies' states, what proves windows, and control, stacked, for each client count.",
        .width = 380.0,
        .frame_height = 190.0,
        .part_names = {"halo and updates", "claims, agreement and standby", "interest and keys"}};
    for (const CellGroup& group : line.groups) {
      Bar bar{std::to_string(group.cell.clients), {0.0, 0.0, 0.0}, ""};
      auto row = cell_values(line, group);
      for (const Subject& subject : subjects) {
        const auto mean = group.mean(subject.of);
        bar.parts[subject.part] += mean ? mean->mean : 0.0;
        row.push_back(mean ? exact_number(mean->mean) : "");
      }
      plot.bars.push_back(std::move(bar));
      table.rows.push_back(std::move(row));
    }
    if (!plot.bars.empty()) content.add_panel(table.name, to_svg(plot), "");
  }
  content.html += "</div>\n" + to_details(table);
  content.tables.push_back(std::move(table));
}

}  // namespace

SectionContent modes_content(const Findings& findings) {
  SectionContent content{
      "<p class=\"faint\">The same scenes and keys with a server, which simulates everything and "
      "sends each client what is relevant to it, and among peers, one for each player, which "
      "simulate a part of the field each, to the same state hash. A server's bytes are all its "
      "clients' together; "
      "among peers each carries its own.</p>\n<div class=\"plots\">\n"};
  std::string absences;
  for (const Shown& shown : against_clients)
    if (!add_plot(content, findings, shown)) game::add_to_list(absences, shown.title);
  content.html += "</div>\n";
  content.add_absences(absences);
  content.html +=
      "<p class=\"faint\">What the bytes are about; each panel has its own scale.</p>\n<div "
      "class=\"plots small\">\n";
  add_bars(content, findings);
  return content;
}

}  // namespace rink::loadgen
