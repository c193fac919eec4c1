// Student intervals of means and of log ratios, within a figure's possible range.
#include "loadgen/measure/statistics/statistics.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "loadgen/measure/statistics/distributions.h"

namespace rink::loadgen {
namespace {

double mean_of(std::span<const double> values) {
  assert(!values.empty());
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

}  // namespace

std::optional<Interval> interval_of_mean(std::span<const double> values, Scale scale) {
  if (values.size() < 2) return std::nullopt;
  const auto count = static_cast<double>(values.size());
  const auto [least, most] = std::ranges::minmax(values);
  const double mean =
      std::clamp(mean_of(values), least, most);  // of equal values the sum may round
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  const double half = student_t_quantile(0.5 + 0.5 * interval_confidence, count - 1.0) *
                      std::sqrt(squares / (count - 1.0) / count);
  assert(!(half < 0.0));
  if (half == 0.0) return Interval{mean, mean};
  if (scale == Scale::unbounded || least < 0.0) return Interval{mean - half, mean + half};
  if (scale == Scale::positive || most > 1.0)
    return Interval{mean * std::exp(-half / mean), mean * std::exp(half / mean)};
  const double odds = std::exp(half / (mean * (1.0 - mean)));  // may be infinite: from 0 to 1, then
  return Interval{mean / (mean + (1.0 - mean) * odds), mean / (mean + (1.0 - mean) / odds)};
}

Difference Ratio::difference() const {
  if (!interval) return Difference::unknown;
  assert(!(interval->low > interval->high));
  if (interval->contains(1.0)) return Difference::insignificant;
  return interval->high < 1.0 ? Difference::lower : Difference::higher;
}

Ratio Ratio::inverse() const {
  Ratio result{1.0 / value, std::nullopt, pairs};
  if (interval) result.interval = Interval{1.0 / interval->high, 1.0 / interval->low};
  return result;
}

std::optional<Ratio> ratio_of(std::span<const std::pair<double, double>> pairs) {
  std::vector<double> logs;
  for (const auto& [own, baseline] : pairs) {
    if (!(own > 0.0) || !(baseline > 0.0) || !std::isfinite(own) || !std::isfinite(baseline))
      return std::nullopt;
    logs.push_back(own == baseline ? 0.0 : std::log(own / baseline));
  }
  if (logs.empty()) return std::nullopt;
  Ratio ratio{std::exp(mean_of(logs)), std::nullopt, logs.size()};
  if (const auto interval = interval_of_mean(logs, Scale::unbounded))
    ratio.interval = Interval{std::exp(interval->low), std::exp(interval->high)};
  return ratio;
}

const char* words_for(Difference difference) {
  switch (difference) {
    case Difference::lower:
      return "lower";
    case Difference::higher:
      return "higher";
    case Difference::insignificant:
      return "no significant difference";
    case Difference::unknown:
      return "cannot be told from one replication";
  }
  return "";
}

}  // namespace rink::loadgen
