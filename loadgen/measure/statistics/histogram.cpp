// Log-linear buckets: where a duration falls, what a bucket stands for, and how counts travel as
// JSON.
#include "loadgen/measure/statistics/histogram.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "im/basics/checked.h"

namespace rink::loadgen {
namespace {

constexpr std::uint64_t shortest_ns = 1u << 10;
constexpr std::uint64_t longest_ns = (std::uint64_t{1} << 37) - 1;
constexpr std::uint64_t parts_per_octave = 512;  // an octave: a power of two

std::uint64_t clamped_ns(double duration_s) {
  if (!(duration_s * 1e9 < static_cast<double>(longest_ns))) return longest_ns;
  if (duration_s * 1e9 < static_cast<double>(shortest_ns)) return shortest_ns;
  return static_cast<std::uint64_t>(duration_s * 1e9);
}

std::size_t bucket_of(std::uint64_t duration_ns) {
  assert(duration_ns >= shortest_ns && duration_ns <= longest_ns);
  const int shift = static_cast<int>(std::bit_width(duration_ns)) - 10;
  return (static_cast<std::size_t>(shift) - 1) * parts_per_octave +
         static_cast<std::size_t>((duration_ns >> shift) - parts_per_octave);
}

double middle_s(std::size_t bucket) {
  assert(bucket < Histogram::bucket_count);
  const std::size_t shift = bucket / parts_per_octave + 1;
  const double low_ns =
      static_cast<double>((bucket % parts_per_octave + parts_per_octave) << shift);
  return (low_ns + 0.5 * static_cast<double>(std::uint64_t{1} << shift)) * 1e-9;
}

bool is_non_negative_number(const nlohmann::json& value) {
  return value.is_number() && value.get<double>() >= 0.0;
}

}  // namespace

Histogram::Histogram() : buckets_(bucket_count, 0) {}

void Histogram::record(double duration_s, std::uint64_t times) {
  if (times == 0) return;
  buckets_[bucket_of(clamped_ns(duration_s))] += times;
  const double finite_s = std::isfinite(duration_s) ? std::max(duration_s, 0.0)
                                                    : static_cast<double>(longest_ns) * 1e-9;
  min_s_ = count_ == 0 ? finite_s : std::min(min_s_, finite_s);
  max_s_ = std::max(max_s_, finite_s);
  sum_s_ += finite_s * static_cast<double>(times);
  count_ += times;
}

void Histogram::merge(const Histogram& other) {
  if (other.count_ == 0) return;
  for (std::size_t bucket = 0; bucket < bucket_count; ++bucket)
    buckets_[bucket] += other.buckets_[bucket];
  min_s_ = count_ == 0 ? other.min_s_ : std::min(min_s_, other.min_s_);
  max_s_ = std::max(max_s_, other.max_s_);
  sum_s_ += other.sum_s_;
  count_ += other.count_;
  if constexpr (checks_whole_structures) check();
}

void Histogram::check() const {
  assert(buckets_.size() == bucket_count);
  assert(std::accumulate(buckets_.begin(), buckets_.end(), std::uint64_t{0}) == count_);
  assert(count_ == 0 || min_s_ <= max_s_);
  assert(count_ > 0 || (sum_s_ == 0.0 && max_s_ == 0.0));
}

std::optional<double> Histogram::mean_s() const {
  if (count_ == 0) return std::nullopt;
  return sum_s_ / static_cast<double>(count_);
}

bool Histogram::supports(std::uint64_t count, double fraction) {
  assert(fraction >= 0.0 && fraction <= 1.0);
  return static_cast<double>(count) * (1.0 - fraction) >=
         10.0 - 1e-6;  // 1 - 0.999 is not quite 0.001
}

std::optional<double> Histogram::percentile_s(double fraction) const {
  if (!supports(count_, fraction)) return std::nullopt;
  const double exact_rank = std::ceil(fraction * static_cast<double>(count_) - 1e-6);
  const std::uint64_t rank = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(exact_rank));
  assert(rank <= count_);
  std::uint64_t seen = 0;
  for (std::size_t bucket = 0; bucket < bucket_count; ++bucket) {
    seen += buckets_[bucket];
    if (seen >= rank) return std::clamp(middle_s(bucket), min_s_, max_s_);
  }
  return max_s_;
}

Percentiles Histogram::percentiles_ms() const {
  const auto in_ms = [this](double fraction) {
    std::optional<double> value = percentile_s(fraction);
    if (value) *value *= 1e3;
    return value;
  };
  Percentiles result{.p50 = in_ms(0.5),
                     .p90 = in_ms(0.9),
                     .p95 = in_ms(0.95),
                     .p99 = in_ms(0.99),
                     .p999 = in_ms(0.999),
                     .max = std::nullopt};
  if (count_ > 0) result.max = max_s_ * 1e3;
  return result;
}

nlohmann::json Histogram::to_json() const {
  nlohmann::json filled = nlohmann::json::array();
  for (std::size_t bucket = 0; bucket < bucket_count; ++bucket) {
    if (buckets_[bucket] > 0) filled.push_back({bucket, buckets_[bucket]});
  }
  return {{"count", count_},
          {"sum_s", sum_s_},
          {"min_s", min_s()},
          {"max_s", max_s_},
          {"buckets", std::move(filled)}};
}

std::optional<Histogram> Histogram::from_json(const nlohmann::json& written) {
  if (!written.is_object()) return std::nullopt;
  for (const char* key : {"count", "sum_s", "min_s", "max_s"}) {
    if (!written.contains(key) || !is_non_negative_number(written[key])) return std::nullopt;
  }
  if (!written["count"].is_number_unsigned() || !written.contains("buckets") ||
      !written["buckets"].is_array())
    return std::nullopt;
  Histogram result;
  std::size_t next = 0;
  for (const nlohmann::json& entry : written["buckets"]) {
    if (!entry.is_array() || entry.size() != 2 || !entry[0].is_number_unsigned() ||
        !entry[1].is_number_unsigned())
      return std::nullopt;
    const auto bucket = entry[0].get<std::uint64_t>();
    const auto times = entry[1].get<std::uint64_t>();
    if (bucket < next || bucket >= bucket_count || times == 0 || times > UINT64_MAX - result.count_)
      return std::nullopt;
    result.buckets_[bucket] = times;
    result.count_ += times;
    next = bucket + 1;
  }
  if (result.count_ != written["count"].get<std::uint64_t>()) return std::nullopt;
  result.sum_s_ = written["sum_s"].get<double>();
  result.min_s_ = written["min_s"].get<double>();
  result.max_s_ = written["max_s"].get<double>();
  if (result.min_s_ > result.max_s_) return std::nullopt;
  return result;
}

}  // namespace rink::loadgen
