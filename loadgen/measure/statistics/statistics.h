// Statistics of replications: a mean or a ratio, its 95 % confidence interval, and whether a
// difference is significant.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace rink::loadgen {

/// All intervals here are of this confidence; replications are taken as independent and roughly
/// normal (ratios: their logarithms).
inline constexpr double interval_confidence = 0.95;

struct Interval {
  double low = 0.0, high = 0.0;
  bool contains(double value) const { return low <= value && value <= high; }
  friend bool operator==(const Interval&, const Interval&) = default;
};

/// The range of a figure's values, which limits the interval of its mean.
enum class Scale : std::uint8_t {
  unbounded,  ///< any number
  positive,   ///< 0 or more: bytes, times, errors, counts
  fraction    ///< 0 to 1
};

/// The interval of the mean of `values` by Student's t with n - 1 degrees of freedom (Jain, The Art
/// of Computer Systems Performance Analysis, 1991, 13.2; Le Boudec, Performance Evaluation of
/// Computer and Communication Systems, 2010, theorem 2.2.2); nothing for fewer than two values.
/// With m the mean, h half the width: m -+ h if unbounded; m exp(-+ h / m) if positive; logit m -+
/// h / (m (1 - m)), turned back, of a fraction. The standard error is carried to the scale by its
/// slope at m (the delta method: Meeker and Escobar, Statistical Methods for Reliability Data,
/// 1998, chapter 8), so single values of 0 or 1, which have no logarithm or logit, need no
/// shifting, and the interval is about the arithmetic mean; averaged logarithms would give that of
/// the geometric one. If all values are 0, or all 1, the interval is that point. Values beyond what
/// `scale` says widen it: a fraction with one above 1 is taken as positive, one below 0 as
/// unbounded.
std::optional<Interval> interval_of_mean(std::span<const double> values, Scale scale);

/// Whether replications show a significant difference.
enum class Difference : std::uint8_t {
  lower,          ///< the interval of the ratio lies below 1
  higher,         ///< ... above 1
  insignificant,  ///< ... contains 1
  unknown         ///< there is no interval: one replication cannot tell
};

/// The ratio of a figure to its baseline's.
struct Ratio {
  double value = 1.0;                ///< geometric mean of own / baseline
  std::optional<Interval> interval;  ///< absent for a single pair
  std::size_t pairs = 0;

  Difference difference() const;
  /// The inverse ratio, baseline / own.
  Ratio inverse() const;
};

/// The ratio over `pairs` of (own, baseline), one pair per seed: both played the same game, and the
/// effects of that game cancel, so the pairs' log ratios are averaged and not the parts (Jain 1991,
/// 13.4.1, paired observations; 12.7 for why ratios are averaged geometrically). Nothing if there
/// is no pair, or if one is not above 0 on both sides.
std::optional<Ratio> ratio_of(std::span<const std::pair<double, double>> pairs);

/// In words: "lower", "higher", "no significant difference", "cannot be told from one replication".
const char* words_for(Difference difference);

}  // namespace rink::loadgen
