// A set of dimensions of one federation object model.
#pragma once

#include <bit>
#include <cassert>
#include <cstdint>
#include <initializer_list>

#include "rti/handles.h"

namespace rink::rti {

/// Most dimensions that a model may have: a set is one word.
inline constexpr std::uint32_t dimension_max = 64;

/// Bit k stands for the dimension whose handle is k.
struct DimensionSet {
  std::uint64_t bits = 0;

  constexpr DimensionSet() = default;
  explicit constexpr DimensionSet(std::uint64_t bits) : bits(bits) {}
  DimensionSet(std::initializer_list<DimensionHandle> dimensions) {
    for (const DimensionHandle dimension : dimensions) insert(dimension);
  }
  void insert(DimensionHandle dimension) {
    assert(dimension.value < dimension_max);
    bits |= std::uint64_t{1} << dimension.value;
  }
  bool contains(DimensionHandle dimension) const { return dimension.value < dimension_max && (bits >> dimension.value & 1u) != 0; }
  bool includes(DimensionSet other) const { return (other.bits & ~bits) == 0; }
  bool is_empty() const { return bits == 0; }
  std::size_t count() const { return static_cast<std::size_t>(std::popcount(bits)); }
  /// Where the range of `dimension` stands among those of all members in ascending order.
  std::size_t rank(DimensionHandle dimension) const {
    assert(contains(dimension));
    return static_cast<std::size_t>(std::popcount(bits & ((std::uint64_t{1} << dimension.value) - 1)));
  }
  /// Calls `visit(DimensionHandle)` for each member in ascending order.
  template <class Visit>
  void for_each(Visit visit) const {
    for (std::uint64_t left = bits; left != 0; left &= left - 1) visit(DimensionHandle{static_cast<std::uint32_t>(std::countr_zero(left))});
  }
  friend DimensionSet operator&(DimensionSet a, DimensionSet b) { return DimensionSet(a.bits & b.bits); }
  friend DimensionSet operator|(DimensionSet a, DimensionSet b) { return DimensionSet(a.bits | b.bits); }
  friend bool operator==(DimensionSet, DimensionSet) = default;
};

}  // namespace rink::rti
