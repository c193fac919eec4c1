// A row per search: the clients that held and that failed, why, and the cost at the edge.
#include "loadgen/report/sections/saturation_section.h"

#include "loadgen/report/plots/text.h"

namespace rink::loadgen {

ReportSection saturation_section(std::span<const Saturation> found, const ServiceLevel& level) {
  ReportSection section{"saturation", "Saturation", {}};
  std::string& html = section.content.html;
  html += "<p>The largest number of clients at which at least " +
          plain_number(100.0 * level.on_time_fraction_min, 4) +
          " % of the ticks are on time and the 99th percentile of the update age stays below " +
          plain_number(level.age_p99_ms_max) +
          " ms.</p>\n<div class=\"scroll\"><table class=\"wide\"><thead><tr><th "
          "class=\"text\">filter</th><th>clients held</th><th>failed</th><th>predicted "
          "(from)</th><th class=\"text\">why</th>"
          "<th>physics us/tick</th><th>filter us/tick</th><th>send us/tick</th><th>payload "
          "kB/s/client</th></tr></thead><tbody>\n";
  for (const Saturation& saturation : found) {
    html +=
        "<tr><td class=\"text\">" +
        escaped(saturation.cell.scheme + ", " + saturation.cell.policy) + "</td><td>" +
        escaped(held_text(saturation.search)) + "</td><td>" +
        (saturation.search.failed ? std::to_string(*saturation.search.failed) : "\xE2\x80\x93") +
        "</td><td>" + escaped(predicted_text(saturation)) + "</td><td class=\"wrap\">" +
        escaped(saturation.why) + "</td>";
    const RunRecord edge = saturation.edge.value_or(RunRecord{});
    for (const auto& cost :
         {edge.physics_us_per_tick, edge.filter_us_per_tick, edge.send_us_per_tick})
      html += "<td>" + plain_number(cost) + "</td>";
    const auto bytes = edge.down_bytes_per_client_per_s;
    html +=
        "<td>" + plain_number(bytes ? std::optional(*bytes * 1e-3) : std::nullopt) + "</td></tr>\n";
  }
  html +=
      "</tbody></table></div>\n<p class=\"faint\">Costs and bytes are those of the last run that "
      "held. Predicted is the crowd by the cost of the probes of fewer clients (up to the number "
      "in "
      "brackets), by the better of a + b n and a n^b. Data: saturation.csv; every probe is in "
      "runs.jsonl.</p>\n";
  return section;
}

}  // namespace rink::loadgen
