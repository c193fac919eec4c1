// Finds the runs between which one number alone differs, and fits a power law to each figure.
#include "loadgen/growth.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <set>
#include <sstream>
#include <string_view>
#include <tuple>

#include "loadgen/csv_number.h"

namespace rink::loadgen {
namespace {

constexpr std::size_t places_min = 3;

struct Quantity {
  const char* name;
  const char* title;  ///< in the terminal's table
  std::optional<double> (*of)(const RunRecord&);
};
constexpr std::array quantities{
    Quantity{"physics_us_per_tick", "physics", [](const RunRecord& run) { return run.physics_us_per_tick; }},
    Quantity{"filter_us_per_tick", "filter", [](const RunRecord& run) { return run.filter_us_per_tick; }},
    Quantity{"send_us_per_tick", "send", [](const RunRecord& run) { return run.send_us_per_tick; }},
    Quantity{"total_us_per_tick", "tick", [](const RunRecord& run) { return run.total_us_per_tick(); }},
    Quantity{"down_bytes_per_client_per_s", "B/client", [](const RunRecord& run) { return run.down_bytes_per_client_per_s; }},
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
    text += (text.empty() ? "" : ", ") + (number == 0 ? std::string("the scene's ") : std::to_string(number) + " ") + other.name;
  }
  return text;
}

std::size_t places_of(const std::vector<const RunRecord*>& runs, const GrowthFactor& factor) {
  std::set<std::uint32_t> places;
  for (const RunRecord* run : runs) places.insert(run->cell.*factor.number);
  return places.size();
}

/// Nothing if some run lacks the quantity.
std::optional<PowerFit> fit_of(const std::vector<const RunRecord*>& runs, const GrowthFactor& factor, const Quantity& quantity) {
  std::vector<FitPoint> points;
  for (const RunRecord* run : runs) {
    const auto value = quantity.of(*run);
    if (!value) return std::nullopt;
    points.push_back({static_cast<double>(run->cell.*factor.number), *value});
  }
  return fit_power(points);
}

void add_growths(const std::vector<const RunRecord*>& runs, const GrowthFactor& factor, std::vector<Growth>& growths) {
  const RunRecord& first = *runs.front();
  for (const Quantity& quantity : quantities) {
    if (const auto fit = fit_of(runs, factor, quantity)) {
      growths.push_back({first.cell.mode, first.cell.scheme, first.cell.policy, factor.name, held_text(first, factor), quantity.name, *fit});
    }
  }
}

std::string locals_text(const PowerFit& fit) {
  std::ostringstream text;
  text.precision(4);
  for (const PowerFit::Local& local : fit.locals) text << (text.tellp() > 0 ? "; " : "") << local.x_low << " to " << local.x_high << ": " << local.exponent;
  return text.str();
}

std::string exponent_text(const PowerFit& fit) {
  std::array<char, 48> text;
  const double half = fit.exponent_high ? *fit.exponent_high - fit.exponent : 0.0;
  std::snprintf(text.data(), text.size(), "%5.2f +-%-4.2f%c", fit.exponent, half, fit.is_rejected() ? '!' : ' ');
  return text.data();
}

std::string row_title(const Growth& growth) {
  std::array<char, 96> text;
  std::snprintf(text.data(), text.size(), "%-8.8s %-8.8s %-14.14s", growth.factor.c_str(), growth.scheme.c_str(), growth.policy.c_str());
  return text.data();
}

bool is_same_row(const Growth& a, const Growth& b) {
  return std::tie(a.mode, a.scheme, a.policy, a.factor, a.held) == std::tie(b.mode, b.scheme, b.policy, b.factor, b.held);
}

}  // namespace

std::vector<Growth> growths_of(std::span<const RunRecord> runs) {
  std::vector<Growth> growths;
  for (const GrowthFactor& factor : growth_factors) {
    std::vector<std::vector<const RunRecord*>> groups;
    for (const RunRecord& run : runs) {
      if (!run.valid || run.cell.*factor.number == 0) continue;
      const auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& g) { return differ_in_factor_alone(*g.front(), run, factor); });
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
  std::string csv = "factor,mode,scheme,policy,held,figure,exponent,exponent_low,exponent_high,at_one,r_squared,points,places,bend,misfit_p,is_power_law,local_exponents\n";
  for (const Growth& growth : growths) {
    const PowerFit& fit = growth.fit;
    csv += growth.factor + "," + growth.mode + "," + growth.scheme + "," + growth.policy + ",\"" + growth.held + "\"," + growth.figure + "," + six_digits(fit.exponent) + "," +
           six_digits(fit.exponent_low) + "," + six_digits(fit.exponent_high) + "," + six_digits(fit.factor) + "," + six_digits(fit.r_squared) + "," + std::to_string(fit.points) + "," +
           std::to_string(fit.places) + "," + six_digits(fit.bend) + "," + six_digits(fit.misfit_p) + "," + (fit.is_rejected() ? "no" : "yes") + "," + locals_text(fit) + "\n";
  }
  return csv;
}

std::string growth_table(std::span<const Growth> growths) {
  if (growths.empty()) return {};
  std::string text = "growth with one number while the others stay: y ~ x^b, b with 95 % interval\nover     scheme   policy        ";
  for (const Quantity& quantity : quantities) text += std::string(13 - std::string_view(quantity.title).size(), ' ') + quantity.title + " ";
  for (const Growth& row : growths) {
    if (&row != &*std::find_if(growths.begin(), growths.end(), [&row](const Growth& other) { return is_same_row(row, other); })) continue;
    text += "\n" + row_title(row);
    for (const Quantity& quantity : quantities) {
      const auto growth = std::find_if(growths.begin(), growths.end(), [&](const Growth& other) { return is_same_row(row, other) && other.figure == quantity.name; });
      text += " " + (growth == growths.end() ? std::string(11, ' ') + "- " : exponent_text(growth->fit));
    }
    if (row.mode != growths.front().mode) text += "  " + row.mode;
  }
  return text + "\n!: not a power law: the means bend by more than 10 % and more than the replications explain; local exponents are in growth.csv\n";
}

}  // namespace rink::loadgen
