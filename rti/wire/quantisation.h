// The grid that a number of a stated range and error is rounded to before it travels.
#pragma once

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <optional>

namespace rink::rti {

/// Multiples of `step` from `first * step` on. The step is a power of two, so every value of the
/// grid is exact in a double: what was rounded once is not changed by being rounded again, zero
/// stays zero, and the error is at most half a step without a rounding of its own. Steps that
/// divide the range evenly would save at most a bit and have none of that.
struct Quantisation {
  static constexpr unsigned bits_max = 48;

  double step = 1.0;
  std::int64_t first = 0;
  std::uint64_t last = 0;  ///< the greatest count; counts start at 0
  unsigned bits = 0;       ///< that a count takes

  /// The coarsest grid that covers `low` to `high` and rounds by at most `error`. Nothing unless
  /// both are finite, low < high, error > 0, and `bits_max` suffice for the multiples themselves,
  /// which a double then holds exactly.
  static std::optional<Quantisation> of(double low, double high, double error) {
    if (!std::isfinite(low) || !std::isfinite(high) || !std::isfinite(error) || low >= high ||
        error <= 0.0)
      return std::nullopt;
    Quantisation grid;
    int exponent = 0;
    std::frexp(2.0 * error, &exponent);  // 2 error = f * 2^exponent, f in [1/2, 1)
    grid.step = std::ldexp(1.0, exponent - 1);
    constexpr double multiple_max = static_cast<double>(std::int64_t{1} << bits_max);
    const double first = std::floor(low / grid.step), last = std::ceil(high / grid.step);
    if (!(grid.step > 0.0) || !(first >= -multiple_max && last <= multiple_max))
      return std::nullopt;
    grid.first = static_cast<std::int64_t>(first);
    grid.last = static_cast<std::uint64_t>(static_cast<std::int64_t>(last) - grid.first);
    grid.bits = static_cast<unsigned>(std::bit_width(grid.last));
    if (grid.bits > bits_max) return std::nullopt;
    assert(grid.error() <= error);
    return grid;
  }

  double low() const { return static_cast<double>(first) * step; }
  double high() const {
    return static_cast<double>(first + static_cast<std::int64_t>(last)) * step;
  }
  /// The most that rounding changes a value within the range.
  double error() const { return 0.5 * step; }
  bool contains(double value) const { return value >= low() && value <= high(); }  // false for NaN
  /// The count of the nearest value; `value` must be within the range.
  std::uint64_t count(double value) const {
    assert(contains(value));
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::nearbyint(value / step)) -
                                      first);
  }
  /// The value of a count up to `last`.
  double value(std::uint64_t count) const {
    return static_cast<double>(first + static_cast<std::int64_t>(count)) * step;
  }
  friend bool operator==(const Quantisation&, const Quantisation&) = default;
};

}  // namespace rink::rti
