// A count for each delay that occurred.
#include "loadgen/truth/discovery.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <nlohmann/json.hpp>

namespace rink::loadgen {

void DiscoveryDelays::add(double delay_s) {
  assert(delay_s >= 0.0);
  ++counts_[static_cast<std::uint64_t>(std::llround(1e6 * delay_s))];
  ++ended_;
}

void DiscoveryDelays::merge(const DiscoveryDelays& other) {
  for (const auto& [delay_us, count] : other.counts_) counts_[delay_us] += count;
  ended_ += other.ended_;
  never_ += other.never_;
}

std::vector<DiscoveryDelays::Point> DiscoveryDelays::distribution(std::size_t points_max) const {
  assert(points_max >= 3);
  std::vector<Point> points;
  if (samples() == 0) return points;
  const double all = static_cast<double>(samples());
  const double step = static_cast<double>(ended_) / static_cast<double>(points_max - 2);
  std::uint64_t below = 0;
  if (counts_.empty() || counts_.begin()->first > 0) points.push_back({0.0, 0.0});
  double next = 0.0;
  for (const auto& [delay_us, count] : counts_) {
    below += count;
    if (delay_us > 0 && below < ended_ && static_cast<double>(below) < next) continue;
    points.push_back({static_cast<double>(delay_us) / 1e3, static_cast<double>(below) / all});
    next = static_cast<double>(below) + step;
  }
  return points;
}

nlohmann::ordered_json DiscoveryDelays::to_json() const {
  nlohmann::ordered_json delays = nlohmann::ordered_json::array();
  for (const auto& [delay_us, count] : counts_) delays.push_back({delay_us, count});
  return {{"never", never_}, {"delays_us", delays}};
}

std::optional<DiscoveryDelays> DiscoveryDelays::from_json(const nlohmann::json& written) {
  if (!written.is_object() || !written.contains("never") || !written["never"].is_number_unsigned() || !written.contains("delays_us") || !written["delays_us"].is_array()) return std::nullopt;
  DiscoveryDelays delays;
  delays.never_ = written["never"].get<std::uint64_t>();
  for (const nlohmann::json& entry : written["delays_us"]) {
    if (!entry.is_array() || entry.size() != 2 || !entry[0].is_number_unsigned() || !entry[1].is_number_unsigned()) return std::nullopt;
    const std::uint64_t delay_us = entry[0].get<std::uint64_t>(), count = entry[1].get<std::uint64_t>();
    if (count == 0 || (!delays.counts_.empty() && delays.counts_.rbegin()->first >= delay_us)) return std::nullopt;
    delays.counts_[delay_us] = count;
    delays.ended_ += count;
  }
  return delays;
}

}  // namespace rink::loadgen
