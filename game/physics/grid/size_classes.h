// How many bodies there are of each size, and which of them a grid should list in one cell each.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace rink::physics {

/// Sizes are told apart by factors of two.
class SizeClasses {
 public:
  /// A body that reaches so far from its centre along some axis [m].
  void add(double reach) {
    assert(reach >= 0.0);
    constexpr int exponent_min = 1023 - 40;  // as it stands in a double: of 1e-12 m
    const int exponent = static_cast<int>(std::bit_cast<std::uint64_t>(reach) >> 52);
    Class& its = classes_[static_cast<std::size_t>(
        std::clamp(exponent - exponent_min, 0, static_cast<int>(class_count) - 1))];
    its.reach = std::max(its.reach, reach);
    ++its.count;
  }

  struct Choice {
    double reach = 0.0;            ///< how far those reach that stand in one cell, at most [m]
    std::uint32_t wide_count = 0;  ///< bodies that reach further
  };
  /// What lets a body look at the fewest others, by a rough estimate, on a field of so many square
  /// metres. `side_of(reach)` is the side of a grid's cells [m]. At most a fifth are wide.
  Choice choose(double area, const std::function<double(double)>& side_of) const;

 private:
  static constexpr std::size_t class_count = 64;
  struct Class {
    double reach = 0.0;  // the longest
    std::uint32_t count = 0;
  };

  double looked_at(std::size_t smalls_end, double area, double side) const;
  std::uint32_t count_from(std::size_t first) const;

  std::array<Class, class_count> classes_{};
};

}  // namespace rink::physics
