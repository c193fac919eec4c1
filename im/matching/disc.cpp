// Decides in doubles where they cannot err, in numbers of 64 bits elsewhere.
#include "im/matching/disc.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "im/matching/region_history.h"

namespace rink::im {
namespace {

/// Of the disc around the region's middle whose radius is half its shorter side, and of the point
/// of the entity that is nearest to the middle; all doubled, so that nothing needs halving.
template <class Real>
struct Distance {
  Real middle_x, middle_y, x, y, diameter;

  Distance(const Region& disc, const Region& box)
      : middle_x(Real(disc.low_x) + disc.high_x),
        middle_y(Real(disc.low_y) + disc.high_y),
        x(offset(middle_x, box.low_x, box.high_x)),
        y(offset(middle_y, box.low_y, box.high_y)),
        diameter(std::min(Real(disc.high_x) - disc.low_x, Real(disc.high_y) - disc.low_y)) {}
  static Real offset(Real middle, Real low, Real high) {
    return std::max(std::max(2 * low - middle, middle - 2 * high), Real(0));
  }
  /// Above 0 outside.
  Real excess() const { return x * x + y * y - diameter * diameter; }
};

}  // namespace

/// Doubles decide if they are farther from a tie than they can err: each length by 2^-51 of itself
/// and of the middle, and a square that is too small by less than 1e-290. Else, and if they
/// overflow, the wider numbers do; always asking those takes twice as long. The rectangle holds the
/// disc, so it must overlap too.
bool touches_disc(const Region& subscription, const Region& box) {
  if (!overlap(subscription, box)) return false;
  const Distance<double> near(subscription, box);
  assert(near.diameter >= 0.0);
  const double lengths = near.x + near.y + near.diameter,
               error = 0x1p-48 * lengths *
                           (lengths + std::abs(near.middle_x) + std::abs(near.middle_y)) +
                       1e-290;
  const double excess = near.excess();
  if (std::abs(excess) > error) return excess < 0.0;
  return Distance<long double>(subscription, box).excess() <= 0.0L;
}

}  // namespace rink::im
