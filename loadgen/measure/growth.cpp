// Finds the runs between which one number alone differs, and fits a power law to each figure.
#include "loadgen/measure/growth.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <set>
#include <sstream>
#include <string_view>
#include <tuple>

#include "game/model/listed.h"
#include "loadgen/experiment/csv_number.h"
#include "loadgen/measure/formatted.h"

namespace rink::loadgen {
namespace {

constexpr std::size_t places_min = 3;

struct Quantity {
  const char* name;
  const char* title;  ///< in the terminal's table
  std::optional<double> (*of)(const RunRecord&);
};
constexpr const char *tick_p99 = "tick_us_p99",
                     *tick_p90 =
                         "tick_us_p90";  // after those that the terminal's table has room for
constexpr std::array quantities{
    Quantity{"physics_us_per_tick", "physics",
             [](const RunRecord& run) { return run.physics_us_per_tick; }},
    Quantity{"filter_us_per_tick", "filter",
             [](const RunRecord& run) { return run.filter_us_per_tick; }},
    Quantity{"send_us_per_tick", "send", [](const RunRecord& run) { return run.send_us_per_tick; }},
    Quantity{"total_us_per_tick", "tick",
             [](const RunRecord& run) { return run.total_us_per_tick(); }},
    Quantity{"down_bytes_per_client_per_s", "B/client",
             [](const RunRecord& run) { return run.down_bytes_per_client_per_s; }},
    Quantity{tick_p99, "p99", [](const RunRecord& run) { return run.tick_us.p99; }},
    Quantity{tick_p90, "p90", [](const RunRecord& run) { return run.tick_us.p90; }},
};

/// Equal but for seed and `factor`.
bool differ_in_factor_alone(const RunRecord& a, const RunRecord& b, const GrowthFactor& factor) {
  Cell other = b.cell;
  other.seed = a.cell.seed;
  other.*factor.number = a.cell.*factor.number;
  return other == a.cell && a.population == b.population && a.scene == b.scene;
}

std::string held_text(const RunRecord& run, const GrowthFactor& factor) {
  if (run.population == "per_client") return "density";
  std::string text;
  for (const GrowthFactor& other : growth_factors) {
    if (other.number == factor.number) continue;
    const std::uint32_t number = run.cell.*other.number;
    game::add_to_list(text,
                      (number == 0 ? "the scene's " : std::to_string(number) + " ") + other.name);
  }
  return text;
}

std::size_t places_of(const std::vector<const RunRecord*>& runs, const GrowthFactor& factor) {
  std::set<std::uint32_t> places;
  for (const RunRecord* run : runs) places.insert(run->cell.*factor.number);
  return places.size();
}

/// Nothing if some run lacks the quantity.
std::optional<std::vector<FitPoint>> points_of(const std::vector<const RunRecord*>& runs,
                                               const GrowthFactor& factor,
                                               const Quantity& quantity) {
  std::vector<FitPoint> points;
  for (const RunRecord* run : runs) {
    const auto value = quantity.of(*run);
    if (!value) return std::nullopt;
    points.push_back({static_cast<double>(run->cell.*factor.number), *value});
  }
  return points;
}

void add_growths(const std::vector<const RunRecord*>& runs, const GrowthFactor& factor,
                 std::vector<Growth>& growths) {
  assert(places_of(runs, factor) >= places_min);
  const RunRecord& first = *runs.front();
  for (const Quantity& quantity : quantities) {
    const auto points = points_of(runs, factor, quantity);
    const auto fit = points ? fit_power(*points) : std::nullopt;
    const auto line = points ? fit_line(*points) : std::nullopt;
    if (!fit || !line) continue;
    growths.push_back({first.cell.mode, first.cell.scheme, first.cell.policy, factor.name,
                       held_text(first, factor), quantity.name, *fit, *line,
                       line->log_residual < log_residual(*fit, *points),
                       std::ranges::max_element(*points, {}, &FitPoint::x)->x,
                       1e6 / first.cell.parameters.tick_rate_hz});
  }
}

std::string locals_text(const PowerFit& fit) {
  std::ostringstream text;
  text.precision(4);
  for (const PowerFit::Local& local : fit.locals)
    text << (text.tellp() > 0 ? "; " : "") << local.x_low << " to " << local.x_high << ": "
         << local.exponent;
  return text.str();
}

std::string exponent_text(const PowerFit& fit) {
  assert(fit.exponent_low.has_value() == fit.exponent_high.has_value());
  const double half = fit.exponent_high ? *fit.exponent_high - fit.exponent : 0.0;
  return formatted("%5.2f +-%-4.2f%c", fit.exponent, half, fit.is_rejected() ? '!' : ' ');
}

/// The quantities that the terminal's table has room for.
std::span<const Quantity> tabled() { return std::span(quantities).first(quantities.size() - 2); }

std::string row_title(const Growth& growth) {
  return formatted("%-8.8s %-8.8s %-14.14s", growth.factor.c_str(), growth.scheme.c_str(),
                   growth.policy.c_str());
}

bool is_same_row(const Growth& a, const Growth& b) {
  return std::tie(a.mode, a.scheme, a.policy, a.factor, a.held) ==
         std::tie(b.mode, b.scheme, b.policy, b.factor, b.held);
}

}  // namespace

std::vector<Growth> growths_of(std::span<const RunRecord> runs) {
  std::vector<Growth> growths;
  for (const GrowthFactor& factor : growth_factors) {
    std::vector<std::vector<const RunRecord*>> groups;
    for (const RunRecord& run : runs) {
      if (!run.valid || run.cell.*factor.number == 0) continue;
      const auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& g) {
        return differ_in_factor_alone(*g.front(), run, factor);
      });
      if (group == groups.end()) {
        groups.push_back({&run});
      } else {
        group->push_back(&run);
      }
    }
    for (const auto& group : groups)
      if (places_of(group, factor) >= places_min) add_growths(group, factor, growths);
  }
  return growths;
}

std::string to_csv(std::span<const Growth> growths) {
  std::string csv =
      "factor,mode,scheme,policy,held,figure,exponent,exponent_low,exponent_high,at_one,r_squared,"
      "points,places,bend,misfit_p,is_power_law,local_exponents,constant,per_one,better\n";
  for (const Growth& growth : growths) {
    const PowerFit& fit = growth.fit;
    csv += growth.factor + "," + growth.mode + "," + growth.scheme + "," + growth.policy + ",\"" +
           growth.held + "\"," + growth.figure + "," + six_digits(fit.exponent) + "," +
           six_digits(fit.exponent_low) + "," + six_digits(fit.exponent_high) + "," +
           six_digits(fit.factor) + "," + six_digits(fit.r_squared) + "," +
           std::to_string(fit.points) + "," + std::to_string(fit.places) + "," +
           six_digits(fit.bend) + "," + six_digits(fit.misfit_p) + "," +
           (fit.is_rejected() ? "no" : "yes") + "," + locals_text(fit) + "," +
           six_digits(growth.line.constant) + "," + six_digits(growth.line.slope) + "," +
           (growth.is_line_better ? "constant_and_proportional" : "power_law") + "\n";
  }
  return csv;
}

std::vector<Capacity> capacities_of(std::span<const Growth> growths) {
  std::vector<Capacity> capacities;
  for (const Growth& growth : growths) {
    const bool is_p99 = growth.figure == tick_p99;
    if (growth.factor != std::string_view("clients") || (!is_p99 && growth.figure != tick_p90))
      continue;
    const auto is_better_known = [&growth](const Growth& other) {
      return is_same_row(growth, other) && other.figure == tick_p99;
    };
    if (!is_p99 && std::ranges::any_of(growths, is_better_known)) continue;
    std::optional<double> clients = growth.line.reaches(growth.period_us);
    if (!growth.is_line_better)
      clients = growth.fit.exponent > 0.0
                    ? std::optional(
                          std::pow(growth.period_us / growth.fit.factor, 1.0 / growth.fit.exponent))
                    : std::nullopt;
    capacities.push_back({growth, is_p99 ? 0.99 : 0.9,
                          clients ? std::optional(std::floor(*clients)) : std::nullopt});
  }
  return capacities;
}

std::string capacity_text(std::span<const Growth> growths) {
  std::string text;
  for (const auto& [growth, fraction, clients] : capacities_of(growths)) {
    const std::string law =
        growth.is_line_better
            ? formatted("%.4g + %.4g n us", growth.line.constant, growth.line.slope)
            : formatted("%.4g n^%.3g us", growth.fit.factor, growth.fit.exponent);
    const std::string holds = clients ? formatted("this server holds %.0f clients", *clients)
                                      : "no number of clients fills a tick";
    text +=
        "  " + growth.scheme + ", " + growth.policy + ": " + (fraction == 0.99 ? "99" : "90") +
        " % of the ticks end within " + law + " of n clients: " + holds +
        (clients && *clients > growth.most ? ", by extrapolation from " + six_digits(growth.most)
                                           : "") +
        "\n";
  }
  return text.empty() ? text : "clients by the better of a + b n and a n^b:\n" + text;
}

std::string growth_table(std::span<const Growth> growths) {
  if (growths.empty()) return {};
  std::string text =
      "growth with one number while the others stay: y ~ x^b, b with 95 % interval\nover     "
      "scheme   policy        ";
  for (const Quantity& quantity : tabled())
    text += std::string(13 - std::string_view(quantity.title).size(), ' ') + quantity.title + " ";
  for (const Growth& row : growths) {
    if (&row != &*std::find_if(growths.begin(), growths.end(),
                               [&row](const Growth& other) { return is_same_row(row, other); }))
      continue;
    text += "\n" + row_title(row);
    for (const Quantity& quantity : tabled()) {
      const auto growth = std::find_if(growths.begin(), growths.end(), [&](const Growth& other) {
        return is_same_row(row, other) && other.figure == quantity.name;
      });
      text += " " +
              (growth == growths.end() ? std::string(11, ' ') + "- " : exponent_text(growth->fit));
    }
    if (row.mode != growths.front().mode) text += "  " + row.mode;
  }
  return text +
         "\n!: not a power law: the means bend by more than 10 % and more than the replications "
         "explain; local exponents are in growth.csv\n" +
         capacity_text(growths);
}

}  // namespace rink::loadgen
