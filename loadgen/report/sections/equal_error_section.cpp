// Rivals at equal displayed error and recall: how much more each sends, and the curves behind it.
#include <algorithm>
#include <map>
#include <set>

#include "loadgen/experiment/parameter.h"
#include "loadgen/measure/equal_error.h"
#include "loadgen/report/plots/chart_svg.h"
#include "loadgen/report/plots/lines.h"
#include "loadgen/report/plots/text.h"
#include "loadgen/report/sections/run_figures.h"
#include "loadgen/report/sections/section_content.h"

namespace rink::loadgen {
namespace {

std::string ratio_text(const std::optional<Ratio>& ratio, AtEqualError::End end) {
  if (!ratio) return "\xE2\x80\x93";
  std::string text = plain_number(ratio->value);
  if (ratio->interval)
    text += " (" + plain_number(ratio->interval->low) + " to " +
            plain_number(ratio->interval->high) + ")";
  if (ratio->difference() == Difference::insignificant)
    text += std::string(", ") + words_for(Difference::insignificant);
  return text + (end == AtEqualError::End::not_left ? ", at most" : "");
}

std::string points_text(const RivalRatio& rival) {
  const std::string text =
      std::to_string(rival.points_below) + ", " + std::to_string(rival.points_above);
  return rival.has_few_points() ? text + " (few)" : text;
}

std::string conditions_text(const EqualError& each) {
  return each.scheme + ", " + std::to_string(each.clients) + " clients, " +
         shortest(each.delay_ms) + " ms of delay";
}

void add_table(SectionContent& content, const std::vector<EqualError>& comparisons) {
  content.html +=
      "<div class=\"scroll\"><table>\n<thead><tr><th class=\"text\">filter, crowd, delay</th><th "
      "class=\"text\">at recall</th><th class=\"text\">policy</th>"
      "<th>payload<br/>kB/s/client</th><th>on the wire<br/>kB/s/client</th><th>displayed "
      "error<br/>RMS mm</th><th>times the payload<br/>(95 % interval)</th>"
      "<th>times on the wire<br/>(95 % interval)</th>"
      "<th>points with at most<br/>and with more error</th></tr></thead>\n<tbody>\n";
  for (const EqualError& each : comparisons) {
    content.html += "<tr class=\"first\"><td class=\"text\">" + escaped(conditions_text(each)) +
                    "</td><td class=\"text\">" + plain_number(each.recall, 4) +
                    (each.is_own_recall ? ", without a margin" : ", by its margin") +
                    "</td><td class=\"text\">" + escaped(each.subject) + " at " +
                    shortest(each.rate_hz) + " Hz</td><td>" + plain_number(1e-3 * each.payload) +
                    "</td><td>" + plain_number(1e-3 * each.wire) + "</td><td>" +
                    plain_number(each.error_mm) + "</td><td>1</td><td>1</td><td></td></tr>\n";
    for (const RivalRatio& rival : each.rivals)
      content.html += "<tr><td></td><td></td><td class=\"text\">" + escaped(rival.policy) +
                      "</td><td></td><td></td><td></td><td>" +
                      (rival.payload_end == AtEqualError::End::not_reached
                           ? "never so small an error with this recall"
                           : ratio_text(rival.payload, rival.payload_end)) +
                      "</td><td>" + ratio_text(rival.wire, rival.wire_end) + "</td><td>" +
                      points_text(rival) + "</td></tr>\n";
  }
  content.html +=
      "</tbody></table></div>\n"
      "<p class=\"faint\">Points: settings that have the recall, with at most and with "
      "more than the error compared, the fewest of all seeds; few: fewer than " +
      std::to_string(points_wanted) +
      " on a side.</p>\n<p class=\"data\">Data: equal_error.csv</p>\n";
}

/// A policy's settings at the smallest margin that was run: mean error and bytes, the ones that no
/// other beats in both.
std::vector<PlotPoint> frontier_of(const std::vector<const RunRecord*>& runs,
                                   const std::string& policy, FigureOf bytes) {
  std::map<std::pair<double, double>, std::vector<const RunRecord*>> settings;
  for (const RunRecord* run : runs)
    settings[{run->cell.parameters.tick_rate_hz, run->cell.parameters.threshold}].push_back(run);
  std::vector<PlotPoint> points;
  for (const auto& [setting, group] : settings) {
    std::vector<double> errors, sent;
    for (const RunRecord* run : group)
      if (const auto error = displayed_rms(*run), own = bytes(*run); error && own)
        errors.push_back(*error), sent.push_back(*own);
    if (errors.empty()) continue;
    const MeanInterval x = mean_interval(errors), y = mean_interval(sent);
    std::string label = shortest(setting.first) + " Hz";
    if (policy.starts_with("dead-reckoning"))
      label += ", " + shortest(1e3 * setting.second) + " mm";
    points.push_back(
        {x.mean,
         y.mean,
         y.interval,
         x.interval,
         policy + ", " + label + ": " + plain_number(x.mean) + " mm, " + short_bytes_per_s(y.mean),
         {}});
  }
  std::ranges::sort(points, {}, &PlotPoint::x);
  std::vector<PlotPoint> best;
  for (const PlotPoint& point : points)
    if (best.empty() || point.y < best.back().y) best.push_back(point);
  return best;
}

struct Curves {
  double delay_ms = 0.0;
  std::string scheme;
  bool operator<(const Curves& other) const {
    return std::tie(delay_ms, scheme) < std::tie(other.delay_ms, other.scheme);
  }
};

struct Bytes {
  const char *title, *table_name;
  FigureOf of;
};

void add_plot(SectionContent& content, const Curves& of, const std::vector<const RunRecord*>& runs,
              const Bytes& bytes) {
  Chart plot{.title = std::string(bytes.title) + " against displayed error, " +
                      shortest(of.delay_ms) + " ms of delay",
             .x = {"displayed error, RMS [mm]", true},
             .y = {"bytes per second and client", true}};
  PlotTable table{std::string(bytes.table_name) + "-delay" + shortest(of.delay_ms),
                  "Settings of each policy, at the smallest margin, that no other of its settings "
                  "beats in both error and bytes",
                  {"policy", "setting", "displayed_error_mm_rms", "bytes_per_client_per_s"}};
  double least_margin = 1e9;
  std::vector<std::string> policies;
  for (const RunRecord* run : runs) {
    least_margin = std::min(least_margin, run->cell.parameters.view_margin);
    if (std::ranges::find(policies, run->cell.policy) == policies.end())
      policies.push_back(run->cell.policy);
  }
  for (std::size_t i = 0; i < policies.size(); ++i) {
    std::vector<const RunRecord*> own;
    for (const RunRecord* run : runs)
      if (run->cell.policy == policies[i] && run->cell.parameters.view_margin == least_margin)
        own.push_back(run);
    plot.lines.push_back({policies[i], {i, i, i}, frontier_of(own, policies[i], bytes.of)});
    for (const PlotPoint& point : plot.lines.back().points)
      table.rows.push_back(
          {policies[i], point.title, exact_number(point.x), exact_number(point.y)});
  }
  if (!has_points(plot))
    return content.add_absence("No run has a displayed error, so no curve can be drawn.");
  plot.alternative =
      "Lower left is better. Each curve is one policy under " + of.scheme +
      ", along its ticks per second or its thresholds; the table gives the distance of "
      "two curves above an error.";
  content.add(to_svg(plot), plot.alternative, std::move(table));
}

}  // namespace

SectionContent equal_error_content(const Experiment& experiment, std::span<const RunRecord> runs,
                                   const std::vector<EqualError>& comparisons) {
  SectionContent content{
      "<p class=\"faint\">How many times the bytes of " + escaped(comparisons.front().subject) +
      " its rivals send when they show entities with the same displayed error and the same recall: "
      "each at the setting of its "
      "own ticks per second, threshold and margin that sends the least, interpolated between those "
      "that were run; geometric mean over seeds with its 95 % interval. In virtual time.</p>\n"};
  add_table(content, comparisons);
  std::map<Curves, std::vector<const RunRecord*>> curves;
  for (const RunRecord& run : runs)
    if (run.valid && part_of(experiment, run.cell.part).is_of_curves)
      curves[{run.delay_ms, run.cell.scheme}].push_back(&run);
  content.html += "<div class=\"plots\">\n";
  for (const auto& [of, own] : curves) {
    add_plot(content, of, own, {"Payload", "curves-payload", payload});
    add_plot(content, of, own, {"On the wire", "curves-wire", on_the_wire});
  }
  content.html += "</div>\n";
  return content;
}

std::string equal_error_headline(const std::vector<EqualError>& comparisons) {
  if (comparisons.empty()) return "";
  const EqualError& first = comparisons.front();
  const auto best = std::ranges::find_if(
      first.rivals, [](const RivalRatio& rival) { return rival.payload && rival.wire; });
  if (best == first.rivals.end()) return "";
  return "At equal displayed error (" + plain_number(first.error_mm) +
         " mm RMS) and equal recall (" + plain_number(first.recall) + ") the best rival of " +
         first.subject + ", " + best->policy + ", sends " +
         ratio_text(best->payload, best->payload_end) + " times its payload and " +
         ratio_text(best->wire, best->wire_end) + " times its bytes on the wire, under " +
         conditions_text(first) + ".";
}

}  // namespace rink::loadgen
