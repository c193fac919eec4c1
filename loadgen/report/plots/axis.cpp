// Ticks at 1, 2 and 5, and ranges with a little air.
#include "loadgen/report/plots/axis.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "loadgen/report/plots/text.h"

namespace rink::loadgen {
namespace {

constexpr double rounding = 1e-9;  // of a tick that lies on the axis' end

std::vector<double> linear_places(const Axis& axis, double spacing) {
  const double span = axis.high - axis.low;
  const double rough = span * spacing / std::max(std::abs(axis.to - axis.from), 1.0);
  const double decade = std::pow(10.0, std::floor(std::log10(rough)));
  const double digit = rough / decade;
  const double step = decade * (digit > 5.0 ? 10.0 : digit > 2.0 ? 5.0 : digit > 1.0 ? 2.0 : 1.0);
  std::vector<double> places;
  const auto last = static_cast<long long>(std::floor(axis.high / step + rounding));
  for (auto i = static_cast<long long>(std::ceil(axis.low / step - rounding)); i <= last; ++i)
    places.push_back(static_cast<double>(i) * step);
  return places;
}

/// Three, or more where neighbours are closer than a thousandth of themselves.
int digits_that_tell_apart(const std::vector<double>& places) {
  if (places.size() < 2) return 3;
  const double largest = std::max(std::abs(places.front()), std::abs(places.back()));
  return std::max(
      3,
      static_cast<int>(std::floor(std::log10(largest / (places[1] - places[0])) + rounding)) + 1);
}

Ticks logarithmic_ticks(const Axis& axis, double spacing) {
  const int first = static_cast<int>(std::floor(std::log10(axis.low))),
            last = static_cast<int>(std::ceil(std::log10(axis.high)));
  const double decade_length = std::abs(axis.to - axis.from) / std::log10(axis.high / axis.low);
  const bool has_digits = decade_length * std::log10(2.0) >= spacing;
  const int stride = std::max(1, static_cast<int>(std::ceil(spacing / decade_length)));
  Ticks ticks;
  for (int decade = first; decade <= last; ++decade) {
    for (int digit = 1; digit <= 9; ++digit) {
      const double value = digit * std::pow(10.0, decade);
      if (value < axis.low * (1.0 - rounding) || value > axis.high * (1.0 + rounding)) continue;
      const bool is_major =
          digit == 1 ? decade % stride == 0 : has_digits && (digit == 2 || digit == 5);
      if (is_major) ticks.major.emplace_back(value, short_number(value));
      else ticks.minor.push_back(value);
    }
  }
  return ticks;
}

}  // namespace

double Axis::at(double value) const {
  const double share =
      is_logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
  return from + share * (to - from);
}

double Axis::clamped_at(double value) const {
  if (value <= low) return from;
  return at(std::min(value, high));
}

Ticks ticks_of(const Axis& axis, double spacing) {
  assert(axis.high > axis.low && spacing > 0.0);
  if (axis.is_logarithmic) return logarithmic_ticks(axis, spacing);
  Ticks ticks;
  const std::vector<double> places = linear_places(axis, spacing);
  const int digits = digits_that_tell_apart(places);
  for (const double place : places) ticks.major.emplace_back(place, short_number(place, digits));
  return ticks;
}

Axis axis_around(double low, double high, bool is_logarithmic, double least_ratio) {
  if (!is_logarithmic) {
    const double bottom = std::min(low, 0.0);
    return {bottom, high > bottom ? high + 0.06 * (high - bottom) : bottom + 1.0, 0.0, 1.0, false};
  }
  if (!(low > 0.0) || !(high >= low)) return {1.0, 10.0, 0.0, 1.0, true};
  const double widening = std::max(1.0, std::sqrt(least_ratio * low / high));
  return {low / (1.15 * widening), high * 1.15 * widening, 0.0, 1.0, true};
}

}  // namespace rink::loadgen
