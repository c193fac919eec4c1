// How a tick's cost grows with clients, pucks and bats, and where the server saturates.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "loadgen/measure/growth.h"
#include "loadgen/measure/server_cores.h"
#include "loadgen/report/plots/chart_svg.h"
#include "loadgen/report/plots/text.h"
#include "loadgen/report/sections/section_content.h"

namespace rink::loadgen {
namespace {

constexpr std::size_t values_least = 3;

/// Cells that differ in `factor` and seed alone, sorted by it.
struct Sweep {
  Cell cell;
  std::map<std::uint32_t, std::vector<double>> costs;
};

std::vector<Sweep> sweeps_over(const GrowthFactor& factor, std::span<const RunRecord> runs) {
  std::vector<Sweep> sweeps;
  for (const RunRecord& run : runs) {
    const auto cost = run.total_us_per_tick();
    const std::uint32_t value = run.cell.*factor.number;
    if (!run.valid || !cost || value == 0) continue;
    Cell key = run.cell;
    key.seed = 0;
    key.*factor.number = 0;
    auto sweep = std::find_if(sweeps.begin(), sweeps.end(),
                              [&key](const Sweep& other) { return other.cell == key; });
    if (sweep == sweeps.end()) sweep = sweeps.insert(sweep, Sweep{key, {}});
    sweep->costs[value].push_back(*cost);
  }
  std::erase_if(sweeps, [](const Sweep& sweep) { return sweep.costs.size() < values_least; });
  return sweeps;
}

std::string sweep_name(const GrowthFactor& factor, const Sweep& sweep, bool names_rest) {
  std::string name = sweep.cell.scheme + ", " + sweep.cell.policy;
  if (!names_rest) return name;
  for (const GrowthFactor& other : growth_factors) {
    if (other.number != factor.number && sweep.cell.*other.number > 0)
      name += ", " + std::to_string(sweep.cell.*other.number) + " " + other.name;
  }
  return name + (sweep.cell.server_cores > 1 ? ", 2 cores" : "");
}

/// The law that fits better, from the first value to the last.
ReferenceCurve fit_of(const Sweep& sweep) {
  std::vector<FitPoint> points;
  for (const auto& [value, costs] : sweep.costs)
    for (const double cost : costs) points.push_back({static_cast<double>(value), cost});
  const auto line = fit_line(points);
  const auto power = fit_power(points);
  if (!line || !power) return {};
  const bool is_line = line->log_residual < log_residual(*power, points);
  ReferenceCurve curve{is_line
                           ? plain_number(line->constant) + " + " + plain_number(line->slope) + " n"
                           : plain_number(power->factor) + " n^" + plain_number(power->exponent),
                       {}};
  constexpr int steps = 40;
  const double first = sweep.costs.begin()->first, last = sweep.costs.rbegin()->first;
  for (int i = 0; i <= steps; ++i) {
    const double x = first * std::pow(last / first, static_cast<double>(i) / steps);
    curve.points.emplace_back(x,
                              is_line ? line->at(x) : power->factor * std::pow(x, power->exponent));
  }
  return curve;
}

void add_plot(SectionContent& content, const Findings& findings, const GrowthFactor& factor) {
  const auto sweeps = sweeps_over(factor, findings.runs);
  if (sweeps.empty()) return;
  std::set<std::string> short_names;
  for (const Sweep& sweep : sweeps) short_names.insert(sweep_name(factor, sweep, false));
  Chart plot{.title = std::string("Cost of a tick against ") + factor.name,
             .x = {factor.name, true},
             .y = {"us per tick, all parts", true}};
  PlotTable table{
      std::string("growth-over-") + factor.name,
      "Physics, filter and send together per tick: mean over replications and its 95 % interval",
      {"line", factor.name, "total_us_per_tick", "low_95", "high_95"}};
  std::vector<ReferenceCurve> fits;
  std::vector<std::string> schemes, policies;
  const auto place = [](std::vector<std::string>& seen, const std::string& text) {
    const auto found = std::find(seen.begin(), seen.end(), text);
    if (found == seen.end()) seen.push_back(text);
    return static_cast<std::size_t>(std::find(seen.begin(), seen.end(), text) - seen.begin());
  };
  for (const Sweep& sweep : sweeps) {
    PlotLine line{
        sweep_name(factor, sweep, short_names.size() < sweeps.size()),
        {place(schemes, sweep.cell.scheme), place(policies, sweep.cell.policy), plot.lines.size()},
        {}};
    for (const auto& [value, costs] : sweep.costs) {
      const MeanInterval mean = mean_interval(costs);
      line.points.push_back({static_cast<double>(value), mean.mean, mean.interval, {}, ""});
      table.rows.push_back({line.name, std::to_string(value)});
      append_interval(table.rows.back(), mean);
    }
    plot.lines.push_back(std::move(line));
    fits.push_back(fit_of(sweep));
  }
  for (const ReferenceCurve& fit : fits)
    if (!fit.points.empty()) plot.references.push_back(fit);
  plot.alternative =
      std::string(
          "On these axes a power law is a straight line and its slope the exponent: twice the ") +
      factor.name +
      " cost 2 to the exponent times as much. Bars: 95 % intervals; faint: the better of a "
      "constant with a proportional part and a power law, through all replications.";
  content.add(to_svg(plot), plot.alternative, std::move(table));
}

std::string bounds(const std::optional<double>& low, const std::optional<double>& high) {
  return low && high ? " (" + plain_number(low) + " to " + plain_number(high) + ")" : "";
}

void add_exponents(SectionContent& content, std::span<const Growth> growths) {
  content.html +=
      "<h3>Exponents</h3>\n<p class=\"faint\">y grows as x to the exponent, by least squares on "
      "logarithms with its 95 % interval. Where the points contradict a power law, the slopes "
      "between "
      "neighbouring values are given instead.</p>\n<div class=\"scroll\"><table><thead><tr><th "
      "class=\"text\">filter</th><th class=\"text\">over</th><th class=\"text\">at</th>"
      "<th class=\"text\">figure</th><th>exponent (95 %)</th><th>R\xC2\xB2</th><th "
      "class=\"text\">power law?</th></tr></thead><tbody>\n";
  for (const Growth& growth : growths) {
    std::string verdict = "not contradicted";
    if (growth.fit.is_rejected()) {
      verdict = "no; slopes";
      for (const auto& local : growth.fit.locals) verdict += " " + plain_number(local.exponent, 2);
    }
    content.html += "<tr><td class=\"text\">" + escaped(growth.scheme + ", " + growth.policy) +
                    "</td><td class=\"text\">" + escaped(growth.factor) +
                    "</td><td class=\"text\">" + escaped(growth.held) + "</td><td class=\"text\">" +
                    escaped(growth.figure) + "</td><td>" + plain_number(growth.fit.exponent) +
                    bounds(growth.fit.exponent_low, growth.fit.exponent_high) + "</td><td>" +
                    plain_number(growth.fit.r_squared, 4) + "</td><td class=\"text\">" + verdict +
                    "</td></tr>\n";
  }
  content.html += "</tbody></table></div>\n";
  if (const std::string capacity = capacity_text(growths); !capacity.empty())
    content.html +=
        "<h3>How many clients the server holds</h3>\n<pre>" + escaped(capacity) + "</pre>\n";
  content.html += "<p class=\"data\">Data: growth.csv</p>\n";
}

void add_cores(SectionContent& content, std::span<const CoresRatio> ratios) {
  content.html +=
      "<h3>One core against two</h3>\n<p class=\"faint\">Both programs wherever the kernel puts "
      "them, as a multiple of the server on a processor of its own; the server has one thread. "
      "Geometric "
      "mean over seeds, paired, with its 95 % interval.</p>\n<div "
      "class=\"scroll\"><table><thead><tr><th>clients</th><th class=\"text\">filter</th><th "
      "class=\"text\">figure</th>"
      "<th>ratio (95 %)</th><th class=\"text\">difference</th></tr></thead><tbody>\n";
  for (const CoresRatio& ratio : ratios) {
    const auto& interval = ratio.ratio.interval;
    content.html +=
        "<tr><td>" + std::to_string(ratio.cell.clients) + "</td><td class=\"text\">" +
        escaped(ratio.cell.scheme + ", " + ratio.cell.policy) + "</td><td class=\"text\">" +
        escaped(ratio.figure) + "</td><td>" + plain_number(ratio.ratio.value) +
        (interval ? bounds(interval->low, interval->high) : "") + "</td><td class=\"text\">" +
        words_for(ratio.ratio.difference()) + "</td></tr>\n";
  }
  content.html += "</tbody></table></div>\n<p class=\"data\">Data: server_cores.csv</p>\n";
}

}  // namespace

SectionContent growth_content(const Findings& findings) {
  SectionContent content{"<div class=\"plots\">\n"};
  for (const GrowthFactor& factor : growth_factors) add_plot(content, findings, factor);
  content.html += "</div>\n";
  const auto growths = growths_of(findings.runs);
  const auto ratios = cores_ratios_of(findings.runs);
  if (!growths.empty()) add_exponents(content, growths);
  if (!ratios.empty()) add_cores(content, ratios);
  if (content.tables.empty() && growths.empty() && ratios.empty()) {
    content.html.clear();
    content.add_absence(
        "Neither clients, pucks nor bats take three values while all else stays, so nothing can be "
        "said about growth.");
  }
  return content;
}

}  // namespace rink::loadgen
