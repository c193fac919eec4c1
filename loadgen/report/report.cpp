// Puts the sections on one page.
#include "loadgen/report/report.h"

#include <algorithm>
#include <set>

#include "game/model/listed.h"
#include "loadgen/measure/summary.h"
#include "loadgen/measure/tables/modes_table.h"
#include "loadgen/report/page.h"
#include "loadgen/report/plots/text.h"
#include "loadgen/report/sections/gains.h"

namespace rink::loadgen {
namespace {

std::string relevance_of(std::span<const RunRecord> runs) {
  std::set<std::string> texts;
  for (const RunRecord& run : runs) {
    if (!run.truth.relevance.empty()) texts.insert(run.truth.relevance);
  }
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "" : "; ") + text;
  return all;
}

std::string agreement_paragraph(std::span<const RunRecord> runs) {
  const Agreement agreement = agreement_of(runs);
  if (agreement.games == 0)
    return "<p class=\"faint\">No two runs were given the same keys, so no state hashes can be "
           "compared.</p>\n";
  if (agreement.differing.empty())
    return "<p>All cells of one seed ended in the same state hash: <b>yes</b>. The filters changed "
           "the traffic, not the game.</p>\n";
  std::string html =
      "<p class=\"warn\">All cells of one seed ended in the same state hash: NO.</p>\n<ul>\n";
  for (const std::string& difference : agreement.differing)
    html += "<li>" + escaped(difference) + "</li>\n";
  return html + "</ul>\n";
}

std::string view_text(const Experiment& experiment) {
  if (experiment.view_area > 0.0)
    return "each client sees " + short_number(experiment.view_area) + " m\xC2\xB2";
  const auto percentage = [](double fraction) { return short_number(100.0 * fraction) + " %"; };
  return "each client sees " + game::listed(experiment.view_fractions, percentage) +
         " of the field";
}

std::string rates_text(const Experiment& experiment) {
  return game::listed(experiment.tick_rates_hz, [](double rate) { return short_number(rate); });
}

std::string transport_text(const Experiment& experiment) {
  if (experiment.transport != TransportKind::virtual_time)
    return std::string("processes over ") + to_string(experiment.transport);
  return "virtual time with " + short_number(experiment.delay_ms) + " ms from one end to the other";
}

std::string span_text(const Experiment& experiment) {
  const std::string from = experiment.start_s > 0.0
                               ? " from the game at " + short_number(experiment.start_s) + " s"
                               : "";
  return short_number(experiment.duration_s) + " s measured after " +
         short_number(experiment.warm_up_s) + " s of warm-up" + from + ", ";
}

/// Describes the differences between the parts that have rows.
std::string parts_text(const Experiment& experiment, std::span<const RunRecord> runs) {
  std::string text = "Scene " + experiment.scene + ". ";
  for (const Experiment& part : experiment.parts) {
    std::size_t count = 0, valid = 0;
    for (const RunRecord& run : runs)
      if (run.cell.part == part.part) ++count, valid += run.valid;
    if (count == 0) continue;
    text += "Part " + part.part + ": " + transport_text(part) + ", " + rates_text(part) + " Hz, " +
            span_text(part) + view_text(part) + "; " + std::to_string(count) + " of " +
            std::to_string(cells_of(part).size()) + " cells run, " + std::to_string(valid) +
            " valid. ";
  }
  return text + "Plots over clients are of the first part that has valid runs.";
}

std::string setting_text(const Experiment& experiment, std::span<const RunRecord> runs) {
  if (!experiment.parts.empty()) return parts_text(experiment, runs);
  const auto valid =
      std::count_if(runs.begin(), runs.end(), [](const RunRecord& run) { return run.valid; });
  std::string text = "Scene " + experiment.scene + ", " +
                     (experiment.population == Population::fixed ? "fixed" : "per-client") +
                     " population, players " + experiment.players + ", " + rates_text(experiment) +
                     " Hz, " + span_text(experiment) + view_text(experiment) + "; ";
  text += transport_text(experiment) + "; ";
  // A search runs further cells beside those of the experiment.
  const std::vector<Cell> cells = cells_of(experiment);
  const bool is_plan = std::all_of(runs.begin(), runs.end(), [&cells](const RunRecord& run) {
    return std::find(cells.begin(), cells.end(), run.cell) != cells.end();
  });
  const std::string count = std::to_string(runs.size());
  return text +
         (is_plan ? count + " of " + std::to_string(cells.size()) + " cells run, "
                  : count + " runs, ") +
         std::to_string(valid) + " valid.";
}

const std::string* fact(const Provenance& provenance, const std::string& name) {
  for (const auto& [key, text] : provenance.facts) {
    if (key == name) return &text;
  }
  return nullptr;
}

SectionContent reproduction(const Experiment& experiment, const Provenance& provenance) {
  SectionContent content{
      "<p>Save the experiment below as EXPERIMENT.toml and run it; seeds fix the scene and every "
      "key, so that games, bytes and errors repeat, while times depend on the machine:</p>\n"
      "<pre>./rink compare EXPERIMENT.toml</pre>\n"};
  if (const std::string* command = fact(provenance, "command"))
    content.html +=
        "<p class=\"faint\">This report was made by</p>\n<pre>" + escaped(*command) + "</pre>\n";
  content.html +=
      "<p class=\"faint\">The experiment:</p>\n<pre>" + escaped(experiment.text) + "</pre>\n";
  return content;
}

constexpr const char* definitions =
    "<p class=\"faint\">Payload is what the server passes to its transport; wire bytes are payload "
    "of both directions plus 66 bytes per segment (Ethernet 14, IPv4 20, TCP with timestamps 32; "
    "a segment carries up to 1,448 bytes; those without payload, acknowledgements, are counted "
    "too). Displayed error: distance between where a client shows an entity at an instant and "
    "where it truly is then; at matched time: the same at the instant that the client's newest "
    "state describes. Latencies count from the instant an action was due. A percentile is shown "
    "only if ten or more samples lie beyond it, and averaged only if every valid replication has "
    "it. Intervals are Student's t over replications (seeds) at 95 %; ratios are paired by "
    "seed.</p>\n"
    "<p class=\"faint\">In the literature's terms: update age is update latency, key to effect "
    "input latency, late entry discovery latency. Displayed error is dead-reckoning error now, "
    "the error at matched time is that at the time stamp. A replica is a client's copy of an "
    "entity; the area fraction is the area of a client's view divided by the field's. How "
    "many times more another filter or policy sends is the reduction factor. Costs of a tick are "
    "wall time; CPU time is that of whole processes.</p>\n";

std::string introduction_of(const Findings& findings, const std::vector<EqualError>& comparisons) {
  const std::string headline =
      comparisons.empty() ? headline_of(findings) : equal_error_headline(comparisons);
  std::string html =
      headline.empty() ? "" : "<p class=\"headline\">" + escaped(headline) + "</p>\n";
  html +=
      "<p class=\"faint\">" + escaped(setting_text(findings.experiment, findings.runs)) + "</p>\n";
  if (!findings.relevance.empty())
    html += "<p class=\"faint\">Relevant to a player: " + escaped(findings.relevance) + ".</p>\n";
  return html + agreement_paragraph(findings.runs);
}

}  // namespace

Report report_of(const Experiment& experiment, std::span<const RunRecord> runs,
                 const Provenance& provenance, const MoreFindings& more) {
  const std::vector<RunRecord> rows = without_curves(experiment, runs);
  const std::vector<EqualError> comparisons = equal_errors_of(experiment, runs);
  const Findings findings{.experiment = experiment,
                          .runs = rows,
                          .latencies = more.latencies,
                          .lines = lines_of(rows),
                          .relevance = relevance_of(rows),
                          .discoveries = more.discoveries};
  Page page;
  if (!comparisons.empty())
    page.add("equal-error", "Reduction factor: rivals at equal error",
             equal_error_content(experiment, runs, comparisons));
  page.add("traffic", "Traffic", traffic_content(findings));
  if (has_several_modes(runs))
    page.add("modes", "With and without a server", modes_content(findings));
  page.add("gains", "Bytes against dead-reckoning error", gains_content(findings));
  page.add("relevance", "Precision and recall", relevance_content(findings));
  if (!more.discoveries.empty())
    page.add("discovery", "Discovery latency and missed contacts", discovery_content(findings));
  page.add("sweeps", "Parameters", sweep_content(findings));
  if (has_expressions_of_one_form(findings)) page.add("stages", "Stages", stages_content(findings));
  page.add("latency", "Latency", latency_content(findings));
  page.add("cost", "Cost of a tick (wall time)", cost_content(findings));
  page.add("replications", "Replications", replication_content(findings));
  page.add("growth", "Growth", growth_content(findings));
  for (const ReportSection& section : more.sections)
    page.add(section.id, section.title, section.content);
  page.add("generator", "The load generator", generator_content(findings));
  page.add("runs", "All runs", runs_content(findings));
  page.add("definitions", "Definitions", {definitions});
  page.add("reproduce", "How to reproduce", reproduction(experiment, provenance));
  page.add("provenance", "Provenance", provenance_list(provenance));
  return std::move(page).finished(experiment.name + ": interest management compared",
                                  introduction_of(findings, comparisons));
}

}  // namespace rink::loadgen
