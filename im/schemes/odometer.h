// How far regions have moved in all: an upper bound by which a pair needs no test until both could
// have moved far enough.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

#include "im/matching/region_history.h"

namespace rink::im {

/// The sum of all steps of each id, a step being the greatest change of any of its four coordinates
/// [m]. Never less than that: rounding is added.
class Odometer {
 public:
  /// Adds the steps of all regions that moved.
  void follow(const RegionHistory& regions) {
    while (way_.size() < regions.size()) way_.push_back(0.0);
    for (const std::uint32_t id : regions.moved())
      if (const Motion& motion = regions[id]; !is_nowhere(motion.before)) add(id, step(motion));
  }
  void add(std::uint32_t id, double length) {
    assert(length >= 0.0);  // a bound on ways never shrinks
    way_[id] += length * (1.0 + 0x1p-40) + way_[id] * 0x1p-52;
  }
  double operator[](std::uint32_t id) const { return way_[id]; }
  std::size_t bytes() const { return sizeof(double) * way_.capacity(); }

 private:
  static double step(const Motion& motion) {
    return std::max(std::max(std::abs(motion.now.low_x - motion.before.low_x),
                             std::abs(motion.now.low_y - motion.before.low_y)),
                    std::max(std::abs(motion.now.high_x - motion.before.high_x),
                             std::abs(motion.now.high_y - motion.before.high_y)));
  }
  Buffer<double> way_;
};

}  // namespace rink::im
