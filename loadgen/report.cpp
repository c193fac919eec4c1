// Puts plots, tables and provenance on one page.
#include "loadgen/report.h"

#include <algorithm>
#include <cstdio>
#include <set>

#include "loadgen/report_style.h"
#include "loadgen/summary.h"
#include "loadgen/svg_plot.h"

namespace rink::loadgen {
namespace {

/// What one line of a plot stands for; what is empty is not named.
std::string series_name(const std::string& scheme, const std::string& policy, const std::string& mode) {
  return scheme + (policy.empty() ? "" : ", " + policy) + (mode.empty() ? "" : ", " + mode);
}

/// The rows together with how their lines are called and drawn.
class Chart {
 public:
  explicit Chart(std::span<const RunRecord> runs) : rows_(summarise(runs)) {
    std::set<std::string> modes, policies;
    for (const SummaryRow& row : rows_) {
      modes.insert(row.mode);
      policies.insert(row.policy);
      clients_.insert(row.clients);
    }
    names_mode_ = modes.size() > 1;
    names_policy_ = policies.size() > 1;
    for (const SummaryRow& row : rows_) {
      const std::string name = series_name(row.scheme, names_policy_ ? row.policy : "", names_mode_ ? row.mode : "");
      if (std::find(names_.begin(), names_.end(), name) == names_.end()) names_.push_back(name);
      row_names_.push_back(name);
    }
  }

  const std::vector<SummaryRow>& rows() const { return rows_; }
  const std::set<std::uint32_t>& clients() const { return clients_; }
  const std::vector<std::string>& names() const { return names_; }

  /// The name of the line that `run` belongs to: mode and policy only where there are several.
  std::string name_of_run(const RunRecord& run) const {
    return series_name(run.cell.scheme, names_policy_ ? run.cell.policy : "", names_mode_ ? run.cell.mode : "");
  }

  /// The row of line `series` at `clients`, or null.
  const SummaryRow* row(std::size_t series, std::uint32_t clients) const {
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (row_names_[i] == names_[series] && rows_[i].clients == clients) return &rows_[i];
    }
    return nullptr;
  }

 private:
  std::vector<SummaryRow> rows_;
  std::set<std::uint32_t> clients_;
  std::vector<std::string> names_, row_names_;
  bool names_mode_ = false, names_policy_ = false;
};

std::string figure_of(const std::string& svg, const std::string& caption = "") {
  return "<figure>\n" + svg + (caption.empty() ? "" : "<figcaption>" + escaped(caption) + "</figcaption>\n") + "</figure>\n";
}

/// `is_total` multiplies by the clients.
std::string bytes_plot(const Chart& chart, const char* figure, bool is_total, const std::string& title, const std::string& caption) {
  LinePlot plot{title, "clients", is_total ? "bytes per second" : "bytes per client per second", {}, {}, true, true, true, 640.0, 400.0, {}, {}};
  for (const std::uint32_t clients : chart.clients()) plot.x_ticks.push_back({clients, std::to_string(clients)});
  for (std::size_t series = 0; series < chart.names().size(); ++series) {
    Series line{chart.names()[series], series, {}};
    for (const std::uint32_t clients : chart.clients()) {
      const SummaryRow* row = chart.row(series, clients);
      if (!row || !row->of(figure).mean) continue;
      const Statistic& bytes = row->of(figure);
      const double scale = is_total ? clients : 1.0;
      line.points.push_back({static_cast<double>(clients), scale * *bytes.mean, scale * *bytes.min, scale * *bytes.max});
    }
    plot.series.push_back(line);
  }
  return figure_of(to_svg(plot), caption);
}

std::string cost_plot(const Chart& chart, double tick_rate_hz) {
  StackedBars plot{"Server time per tick, by part", "clients", "us per tick", {"physics", "filter", "send"}, {}, 640.0, 400.0};
  for (const std::uint32_t clients : chart.clients()) {
    StackedBars::Group group{std::to_string(clients), {}};
    for (std::size_t series = 0; series < chart.names().size(); ++series) {
      const SummaryRow* row = chart.row(series, clients);
      if (!row) continue;
      StackedBars::Bar bar{chart.names()[series], {}};
      for (const char* part : {"physics_us_per_tick", "filter_us_per_tick", "send_us_per_tick"}) bar.parts.push_back(row->of(part).mean.value_or(0.0));
      group.bars.push_back(bar);
    }
    plot.groups.push_back(group);
  }
  return figure_of(to_svg(plot), "Lower is better; a tick has " + short_number(1e3 / tick_rate_hz) + " ms.");
}

/// The five percentiles of one latency for each client count, all on one scale.
std::string percentile_plots(const Chart& chart, const std::string& latency) {
  static constexpr const char* parts[] = {"_p50", "_p90", "_p99", "_p999", "_max"};
  std::vector<LinePlot> plots;
  double low = 1e300, high = 0.0;
  for (const std::uint32_t clients : chart.clients()) {
    LinePlot plot{std::to_string(clients) + (clients == 1 ? " client" : " clients"), "percentile", "ms", {}, {}, false, true, false, 320.0, 270.0, {}, {}};
    for (int part = 0; part < 5; ++part) plot.x_ticks.push_back({part, std::string(part == 3 ? "p99.9" : parts[part] + 1)});
    for (std::size_t series = 0; series < chart.names().size(); ++series) {
      const SummaryRow* row = chart.row(series, clients);
      Series line{chart.names()[series], series, {}};
      for (int part = 0; row && part < 5; ++part) {
        const Statistic& value = row->of((latency + parts[part]).c_str());
        if (!value.mean || *value.mean <= 0.0) continue;
        line.points.push_back({static_cast<double>(part), *value.mean, 0.0, 0.0});
        low = std::min(low, *value.mean);
        high = std::max(high, *value.mean);
      }
      plot.series.push_back(line);
    }
    plots.push_back(plot);
  }
  std::string html = "<div class=\"plots small\">\n";
  for (LinePlot& plot : plots) {
    if (high > 0.0) plot.y_low = low, plot.y_high = high;
    html += figure_of(to_svg(plot));
  }
  return html + "</div>\n";
}

std::string colour_key(const Chart& chart) {
  static constexpr const char* shapes[] = {"<circle cx=\"6\" cy=\"6\" r=\"5\"", "<rect x=\"1.5\" y=\"1.5\" width=\"9\" height=\"9\"", "<path d=\"M6 1l5 9.5h-10z\""};
  std::string html = "<p>";
  for (std::size_t series = 0; series < chart.names().size(); ++series) {
    html += std::string("<span class=\"key\"><svg viewBox=\"0 0 12 12\">") + shapes[series % 3] + " class=\"mark s" + std::to_string(series % 6) + "\"/></svg>" +
            escaped(chart.names()[series]) + "</span>\n";
  }
  return html + "</p>\n";
}

std::string cell(const std::optional<double>& value, int decimals, double scale = 1.0, const char* classes = "") {
  if (!value) return "<td>\xE2\x80\x93</td>";
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, *value * scale);
  return std::string("<td class=\"") + classes + "\">" + text + "</td>";
}

std::string table_row(const RunRecord& run, const std::string& name, bool is_first_of_group) {
  std::string html = std::string("<tr") + (is_first_of_group ? " class=\"first\"" : "") + "><td>" + std::to_string(run.cell.clients) + "</td><td class=\"text\">" +
                     escaped(name) + "</td><td>" + std::to_string(run.cell.seed) + "</td>";
  html += cell(run.down_bytes_per_client_per_s, 2, 1e-3) + cell(run.up_bytes_per_client_per_s, 2, 1e-3) + cell(run.wire_bytes_per_client_per_s, 2, 1e-3);
  html += cell(run.update_age_ms.p50, 2) + cell(run.update_age_ms.p99, 2) + cell(run.key_to_effect_ms.p50, 2) + cell(run.key_to_effect_ms.p99, 2);
  html += cell(run.ticks_on_time_fraction, 2, 100.0) + cell(run.physics_us_per_tick, 1) + cell(run.filter_us_per_tick, 1) + cell(run.send_us_per_tick, 1);
  html += "<td class=\"text\">" + escaped(run.state_hash) + "</td><td class=\"text\">" + (run.valid ? "yes" : "<span class=\"warn\">no</span>") + "</td></tr>\n";
  return html;
}

std::string all_cells(std::span<const RunRecord> runs, const Chart& chart) {
  std::string html =
      "<h2>All runs</h2>\n<div class=\"scroll\"><table>\n<thead><tr><th>clients</th><th class=\"text\">filter</th><th>seed</th>"
      "<th>down<br/>kB/s/client</th><th>up<br/>kB/s/client</th><th>wire<br/>kB/s/client</th><th>update age<br/>p50 "
      "ms</th><th>p99 ms</th><th>key to effect<br/>p50 ms</th><th>p99 ms</th><th>on time<br/>%</th><th>physics<br/>us/tick</th><th>filter<br/>us/tick</th>"
      "<th>send<br/>us/tick</th><th class=\"text\">state hash</th><th class=\"text\">valid</th></tr></thead>\n<tbody>\n";
  for (std::size_t i = 0; i < runs.size(); ++i) html += table_row(runs[i], chart.name_of_run(runs[i]), i > 0 && runs[i].cell.clients != runs[i - 1].cell.clients);
  return html + "</tbody></table></div>\n";
}

std::string invalid_runs(std::span<const RunRecord> runs) {
  std::string rows;
  for (const RunRecord& run : runs) {
    if (!run.valid) rows += "<tr><td class=\"text\">" + escaped(name_of(run.cell)) + "</td><td class=\"wrap\">" + escaped(run.why_invalid) + "</td></tr>\n";
  }
  if (rows.empty()) return "";
  return "<h2 class=\"warn\">Runs that do not count</h2>\n<p>They are in the table above but in no mean and no plot.</p>\n<table><tbody>\n" + rows +
         "</tbody></table>\n";
}

std::string agreement_text(std::span<const RunRecord> runs) {
  const Agreement agreement = agreement_of(runs);
  if (agreement.games == 0) return "<p class=\"faint\">No two runs were given the same keys, so no state hashes can be compared.</p>\n";
  if (agreement.differing.empty()) return "<p>All cells of one seed ended in the same state hash: <b>yes</b>. The filters changed the traffic, not the game.</p>\n";
  std::string html = "<p class=\"warn\">All cells of one seed ended in the same state hash: NO.</p>\n<ul>\n";
  for (const std::string& difference : agreement.differing) html += "<li>" + escaped(difference) + "</li>\n";
  return html + "</ul>\n";
}

std::string setting_text(const Experiment& experiment, std::span<const RunRecord> runs) {
  const auto valid = std::count_if(runs.begin(), runs.end(), [](const RunRecord& run) { return run.valid; });
  char text[512];
  std::snprintf(text, sizeof text,
                "Scene %s, %s population, %g Hz, %g s measured after %g s of warm-up, each client sees %g %% of the field; %zu of %zu cells run, %zu valid.",
                experiment.scene.c_str(), experiment.population == Population::fixed ? "fixed" : "per-client", experiment.tick_rate_hz, experiment.duration_s,
                experiment.warm_up_s, experiment.view_fraction * 100.0, runs.size(), cells_of(experiment).size(), static_cast<std::size_t>(valid));
  return text;
}

std::string provenance_text(const Experiment& experiment, const Provenance& provenance) {
  std::string html = "<h2>Provenance</h2>\n<dl>\n";
  for (const auto& [name, text] : provenance.facts) html += "<dt>" + escaped(name) + "</dt><dd>" + escaped(text) + "</dd>\n";
  return html + "</dl>\n<p class=\"faint\">The experiment:</p>\n<pre>" + escaped(experiment.text) + "</pre>\n";
}

constexpr const char* definitions =
    "<h2>Definitions</h2>\n<p class=\"faint\">Payload is what the processes hand to TCP; wire bytes are payload of both directions plus 66 bytes per segment (Ethernet 14, "
    "IPv4 20, TCP with timestamps 32; a segment carries up to 1,448 bytes; acknowledgements are not counted). Latencies count from the instant an action was "
    "due. A percentile is shown only if ten or more samples lie beyond it, and averaged only if every valid replication has it.</p>\n";

}  // namespace

std::string report_of(const Experiment& experiment, std::span<const RunRecord> runs, const Provenance& provenance) {
  const Chart chart(runs);
  std::string html = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n<meta name=\"viewport\" content=\"width=device-width\"/>\n<title>" +
                     escaped(experiment.name) + ": interest management compared</title>\n<style>" + report_style + "</style>\n</head>\n<body>\n";
  html += "<h1>" + escaped(experiment.name) + ": interest management compared</h1>\n<p class=\"faint\">" + escaped(setting_text(experiment, runs)) + "</p>\n";
  html += agreement_text(runs);
  html += "<h2>Traffic and server time</h2>\n<div class=\"plots\">\n";
  html += bytes_plot(chart, "down_bytes_per_client_per_s", false, "Payload to each client",
                     "Lower is better. Mean over replications; whiskers span the lowest and highest.");
  html += bytes_plot(chart, "wire_bytes_per_client_per_s", false, "On the wire for each client, both directions, with headers",
                     "What a client's link carries.");
  html += bytes_plot(chart, "wire_bytes_per_client_per_s", true, "On the wire for all clients together", "What the server's link carries.");
  html += cost_plot(chart, experiment.tick_rate_hz) + "</div>\n";
  html += "<h2>Update age</h2>\n<p class=\"faint\">From the simulated instant that a position shows to the client's receipt of it.</p>\n";
  html += colour_key(chart) + percentile_plots(chart, "update_age_ms");
  html += "<h2>Key to effect</h2>\n<p class=\"faint\">From the instant a key was due to the client's own bat answering in its mirror.</p>\n";
  html += colour_key(chart) + percentile_plots(chart, "key_to_effect_ms");
  html += all_cells(runs, chart) + invalid_runs(runs) + definitions + provenance_text(experiment, provenance);
  return html + "</body>\n</html>\n";
}

}  // namespace rink::loadgen
