// Rectangles: where entities are, and what subscribers want to see.
#pragma once

namespace rink::im {

/// A closed axis-aligned rectangle, in metres (touching is overlap). `low` never exceeds `high`;
/// both are finite.
struct Region {
  double low_x = 0.0, low_y = 0.0, high_x = 0.0, high_y = 0.0;
  friend bool operator==(const Region&, const Region&) = default;
};

/// The smallest rectangle that holds both.
constexpr Region hull_of(const Region& a, const Region& b) {
  return {a.low_x < b.low_x ? a.low_x : b.low_x, a.low_y < b.low_y ? a.low_y : b.low_y,
          a.high_x > b.high_x ? a.high_x : b.high_x, a.high_y > b.high_y ? a.high_y : b.high_y};
}

/// True if `region` is finite and not inverted, which every filter asserts. For checks of regions
/// from untrusted sources.
bool is_valid(const Region& region);

}  // namespace rink::im
