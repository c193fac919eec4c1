// The distribution function of a sample of which some have no value, in a bounded number of exact
// points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

namespace rink::loadgen {

/// Values of a sample to a millionth of their unit, and how many of the sample have none: censored,
/// such as delays that never ended, they count without a value.
class SampleDistribution {
 public:
  void add(double value);  ///< at least 0 (asserted)
  void add_never() { ++never_; }
  void merge(const SampleDistribution& other);

  std::uint64_t samples() const { return ended_ + never_; }
  std::uint64_t never() const { return never_; }

  /// A point of the distribution function: the part of the sample that has at most this value, in
  /// thousandths of its unit.
  struct Point {
    double thousandths = 0.0, fraction = 0.0;
    friend bool operator==(const Point&, const Point&) = default;
  };
  /// Exact at each of at most `points_max` values (at least 3, asserted): at 0, at the largest, and
  /// in between at those that occurred, as far apart as equal steps of the fraction allow. Its last
  /// fraction is 1 - never/samples. None of an empty sample.
  std::vector<Point> distribution(std::size_t points_max) const;

  friend bool operator==(const SampleDistribution&, const SampleDistribution&) = default;

  /// `{"never": count, "millionths": [[value, count], ...]}`, values ascending.
  nlohmann::ordered_json to_json() const;
  /// Reads what `to_json` wrote; nothing if it is malformed.
  static std::optional<SampleDistribution> from_json(const nlohmann::json& written);

  /// Asserts that the counts of all values add up to the number that ended.
  void check() const;

 private:
  std::map<std::uint64_t, std::uint64_t> counts_;  ///< by value in millionths
  std::uint64_t ended_ = 0, never_ = 0;
};

}  // namespace rink::loadgen
