// Every run with its figures, invalid ones with their reasons, and the state of the load generator.
#include <algorithm>
#include <cmath>

#include "loadgen/report/plots/text.h"
#include "loadgen/report/sections/section_content.h"

namespace rink::loadgen {
namespace {

struct Column {
  const char* title;
  FigureOf of;
  double scale;
};

std::optional<double> as_number(const std::optional<std::uint64_t>& count) {
  if (!count) return std::nullopt;
  return static_cast<double>(*count);
}

constexpr Column run_columns[] = {
    {"down<br/>kB/s/client", [](const RunRecord& run) { return run.down_bytes_per_client_per_s; },
     1e-3},
    {"up<br/>kB/s/client", [](const RunRecord& run) { return run.up_bytes_per_client_per_s; },
     1e-3},
    {"wire<br/>kB/s/client", [](const RunRecord& run) { return run.wire_bytes_per_client_per_s; },
     1e-3},
    {"delivered<br/>recall",
     {[](const RunRecord& run) { return run.truth.delivered_recall; }, Scale::fraction},
     1.0},
    {"delivered<br/>precision",
     {[](const RunRecord& run) { return run.truth.delivered_precision; }, Scale::fraction},
     1.0},
    {"displayed<br/>RMS mm", [](const RunRecord& run) { return run.truth.displayed_error_mm.rms; },
     1.0},
    {"matched<br/>RMS mm", [](const RunRecord& run) { return run.truth.position_error_mm.rms; },
     1.0},
    {"update age<br/>p50 ms", [](const RunRecord& run) { return run.update_age_ms.p50; }, 1.0},
    {"p99 ms", [](const RunRecord& run) { return run.update_age_ms.p99; }, 1.0},
    {"key to effect<br/>p50 ms", [](const RunRecord& run) { return run.key_to_effect_ms.p50; },
     1.0},
    {"p99 ms", [](const RunRecord& run) { return run.key_to_effect_ms.p99; }, 1.0},
    {"on time<br/>%",
     {[](const RunRecord& run) { return run.ticks_on_time_fraction; }, Scale::fraction},
     100.0},
    {"physics<br/>us/tick", [](const RunRecord& run) { return run.physics_us_per_tick; }, 1.0},
    {"filter<br/>us/tick", [](const RunRecord& run) { return run.filter_us_per_tick; }, 1.0},
    {"send<br/>us/tick", [](const RunRecord& run) { return run.send_us_per_tick; }, 1.0},
};

constexpr Column generator_columns[] = {
    {"keys due", [](const RunRecord& run) { return as_number(run.keys_due); }, 1.0},
    {"keys sent", [](const RunRecord& run) { return as_number(run.keys_sent); }, 1.0},
    {"sent late<br/>%",
     {[](const RunRecord& run) { return run.late_sends_fraction; }, Scale::fraction},
     100.0},
    {"share of its<br/>processors %",
     {[](const RunRecord& run) { return run.health.bots_cpu_share; }, Scale::fraction},
     100.0},
    {"bots<br/>CPU s", [](const RunRecord& run) { return run.bots_cpu_s; }, 1.0},
    {"server<br/>CPU s", [](const RunRecord& run) { return run.server_cpu_s; }, 1.0},
    {"recording one<br/>latency ns",
     [](const RunRecord& run) { return run.health.histogram_ns_per_record; }, 1.0},
};

/// The columns that any run has a figure for.
std::vector<Column> present(std::span<const Column> columns, std::span<const RunRecord> runs) {
  std::vector<Column> result;
  for (const Column& column : columns) {
    if (std::any_of(runs.begin(), runs.end(),
                    [&column](const RunRecord& run) { return column.of(run).has_value(); }))
      result.push_back(column);
  }
  return result;
}

std::string scaled_cell(std::optional<double> value, double scale) {
  if (value) *value *= scale;
  return "<td>" + plain_number(value) + "</td>";
}

void add_runs(SectionContent& content, const Findings& findings) {
  const auto columns = present(run_columns, findings.runs);
  content.html +=
      "<div class=\"scroll\"><table class=\"wide\">\n<thead><tr><th>clients</th><th "
      "class=\"text\">filter</th><th>seed</th>";
  for (const Column& column : columns) content.html += std::string("<th>") + column.title + "</th>";
  content.html +=
      "<th class=\"text\">state hash</th><th class=\"text\">valid</th></tr></thead>\n<tbody>\n";
  for (std::size_t i = 0; i < findings.runs.size(); ++i) {
    const RunRecord& run = findings.runs[i];
    const bool is_first = i > 0 && run.cell.clients != findings.runs[i - 1].cell.clients;
    content.html += std::string("<tr") + (is_first ? " class=\"first\"" : "") + "><td>" +
                    std::to_string(run.cell.clients) + "</td><td class=\"text\">" +
                    escaped(line_name(findings.lines, run.cell)) + "</td><td>" +
                    std::to_string(run.cell.seed) + "</td>";
    for (const Column& column : columns) content.html += scaled_cell(column.of(run), column.scale);
    content.html += "<td class=\"text\">" + escaped(run.state_hash) + "</td><td class=\"text\">" +
                    (run.valid ? "yes" : "<span class=\"warn\">no</span>") + "</td></tr>\n";
  }
  content.html +=
      "</tbody></table></div>\n<p class=\"data\">Data: runs.jsonl, and by cell summary.csv</p>\n";
}

void add_invalid_runs(SectionContent& content, const Findings& findings) {
  std::string rows;
  for (const RunRecord& run : findings.runs) {
    if (!run.valid)
      rows += "<tr><td class=\"wrap\">" + escaped(name_of(run.cell)) + "</td><td class=\"wrap\">" +
              escaped(run.why_invalid) + "</td></tr>\n";
  }
  if (rows.empty()) return;
  content.html +=
      "<h2 class=\"warn\" id=\"invalid\">Runs that do not count</h2>\n<p>They are in the table "
      "above but in no mean and no plot.</p>\n<table><tbody>\n" +
      rows + "</tbody></table>\n";
}

}  // namespace

SectionContent generator_content(const Findings& findings) {
  SectionContent content;
  const auto columns = present(generator_columns, findings.runs);
  if (columns.empty()) {
    content.add_absence("No run reports the state of its load generator.");
    return content;
  }
  content.html +=
      "<p class=\"faint\">A generator that cannot keep its schedule measures itself. Means over "
      "the valid runs of a cell; late is a key sent more than 10 ms after it was due. Where "
      "too many were for 1 % and chance, latencies of keys are not given, and with live keys or "
      "peers the run does not count.</p>\n<div "
      "class=\"scroll\"><table>\n<thead><tr><th>clients</th><th class=\"text\">filter</th>";
  for (const Column& column : columns) content.html += std::string("<th>") + column.title + "</th>";
  content.html += "</tr></thead>\n<tbody>\n";
  for (const CellLine& line : findings.lines) {
    for (const CellGroup& group : line.groups) {
      content.html += "<tr><td>" + std::to_string(group.cell.clients) + "</td><td class=\"text\">" +
                      escaped(line.name) + "</td>";
      for (const Column& column : columns) {
        const auto mean = group.mean(column.of);
        content.html += scaled_cell(mean ? std::optional(mean->mean) : std::nullopt, column.scale);
      }
      content.html += "</tr>\n";
    }
  }
  content.html += "</tbody></table></div>\n";
  return content;
}

SectionContent runs_content(const Findings& findings) {
  SectionContent content;
  add_runs(content, findings);
  add_invalid_runs(content, findings);
  return content;
}

}  // namespace rink::loadgen
