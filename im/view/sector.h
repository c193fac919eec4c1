// A closed sector of a disc, as a field of view is one, and whether a rectangle touches it.
#pragma once

#include "im/basics/exact.h"
#include "im/filter.h"

namespace rink::im {

/// The region in plain numbers, as views use it.
inline Region plain(const Region& region) {
  return {plain(region.low_x), plain(region.low_y), plain(region.high_x), plain(region.high_y)};
}

/// A subscriber's eye: the middle of its region, rounded to doubles.
struct Eye {
  double x = 0.0, y = 0.0;
  explicit Eye(const Region& region)
      : x(plain(0.5 * region.low_x + 0.5 * region.high_x)),
        y(plain(0.5 * region.low_y + 0.5 * region.high_y)) {}
};

/// The same direction at a length near 1; a component that is 2^-100 of the other is none.
Heading scaled(Heading heading);

/// All directions that differ from one by at most a half angle. Its two edges are what rotation
/// gives in doubles; they belong to it, and from there on everything is exact.
class Wedge {
 public:
  /// All directions.
  Wedge() = default;
  /// `half_angle_deg` is 0 to 180. Around a direction of no length there are all directions.
  Wedge(const Heading& ahead, double half_angle_deg);

  /// True if the sector of this wedge touches `box`: it has its point at the middle of
  /// `subscription`, and is of the closed disc with half its shorter side as radius. Both are
  /// plain.
  bool touches(const Region& subscription, const Region& box) const;
  /// How far the sector and the box may come towards or from each other before that can change [m],
  /// by doubles: above 0 if they touch, below if not, 0 if that is in doubt.
  double clearance(const Region& subscription, const Region& box) const;

 private:
  enum class Width { all, at_most_half, more_than_half };
  Width width_ = Width::all;
  Heading ahead_, left_, right_;
};

}  // namespace rink::im
