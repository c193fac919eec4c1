// A count for each value that occurred.
#include "loadgen/measure/statistics/sample_distribution.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <nlohmann/json.hpp>

#include "im/basics/checked.h"

namespace rink::loadgen {

void SampleDistribution::add(double value) {
  assert(value >= 0.0);
  ++counts_[static_cast<std::uint64_t>(std::llround(1e6 * value))];
  ++ended_;
}

void SampleDistribution::merge(const SampleDistribution& other) {
  for (const auto& [value, count] : other.counts_) counts_[value] += count;
  ended_ += other.ended_;
  never_ += other.never_;
  if constexpr (checks_whole_structures) check();
}

void SampleDistribution::check() const {
  [[maybe_unused]] std::uint64_t sum = 0;
  for (const auto& [value, count] : counts_) {
    assert(count > 0);
    sum += count;
  }
  assert(sum == ended_);
}

std::vector<SampleDistribution::Point> SampleDistribution::distribution(
    std::size_t points_max) const {
  assert(points_max >= 3);
  std::vector<Point> points;
  if (samples() == 0) return points;
  const double all = static_cast<double>(samples());
  const double step = static_cast<double>(ended_) / static_cast<double>(points_max - 2);
  std::uint64_t below = 0;
  if (counts_.empty() || counts_.begin()->first > 0) points.push_back({0.0, 0.0});
  double next = 0.0;
  for (const auto& [value, count] : counts_) {
    below += count;
    if (value > 0 && below < ended_ && static_cast<double>(below) < next) continue;
    points.push_back({static_cast<double>(value) / 1e3, static_cast<double>(below) / all});
    next = static_cast<double>(below) + step;
  }
  assert(below == ended_ && points.size() <= points_max && points.front().thousandths == 0.0);
  return points;
}

nlohmann::ordered_json SampleDistribution::to_json() const {
  nlohmann::ordered_json distribution = nlohmann::ordered_json::array();
  for (const auto& [value, count] : counts_) distribution.push_back({value, count});
  return {{"never", never_}, {"millionths", distribution}};
}

std::optional<SampleDistribution> SampleDistribution::from_json(const nlohmann::json& written) {
  if (!written.is_object() || !written.contains("never") ||
      !written["never"].is_number_unsigned() || !written.contains("millionths") ||
      !written["millionths"].is_array())
    return std::nullopt;
  SampleDistribution distribution;
  distribution.never_ = written["never"].get<std::uint64_t>();
  for (const nlohmann::json& entry : written["millionths"]) {
    if (!entry.is_array() || entry.size() != 2 || !entry[0].is_number_unsigned() ||
        !entry[1].is_number_unsigned())
      return std::nullopt;
    const std::uint64_t value = entry[0].get<std::uint64_t>(),
                        count = entry[1].get<std::uint64_t>();
    if (count == 0 || count > UINT64_MAX - distribution.ended_ - distribution.never_ ||
        (!distribution.counts_.empty() && distribution.counts_.rbegin()->first >= value))
      return std::nullopt;
    distribution.counts_[value] = count;
    distribution.ended_ += count;
  }
  return distribution;
}

}  // namespace rink::loadgen
