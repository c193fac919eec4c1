// A sum of very many numbers that loses no more than one addition does.
#pragma once

#include <cmath>

#include "game/physics/real.h"
#include "game/physics/snapshot_stream.h"

namespace rink::physics::inline RINK_PRECISION {

/// Neumaier's compensated summation (Z. Angew. Math. Mech. 54, 1974): what each addition rounds
/// away is kept beside the sum.
class Sum {
 public:
  void add(Real number) {
    const Real sum = sum_ + number;
    lost_ += std::abs(sum_) >= std::abs(number) ? (sum_ - sum) + number : (number - sum) + sum_;
    sum_ = sum;
  }
  Real value() const { return sum_ + lost_; }
  /// Saves or restores it (exchange_all of snapshot_stream.h).
  template <class Stream>
  bool exchange(Stream& stream) {
    return exchange_all(stream, sum_, lost_);
  }

 private:
  Real sum_ = 0.0, lost_ = 0.0;
};

}  // namespace rink::physics::inline RINK_PRECISION
