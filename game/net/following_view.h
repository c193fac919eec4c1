// The square around a bat that a player declares as its interest, to a server or to peers, and when
// it must be declared anew.
#pragma once

#include "game/physics/body.h"
#include "rti/types.h"

namespace rink::game {

class FollowingView {
 public:
  /// By `margin` [m] the square exceeds the player's view, so that it need not follow each step.
  explicit FollowingView(double margin) : margin_(margin) {}

  /// Lays the square around a view of `half_side` [m] at `centre`.
  const im::Region& look_around(const physics::Vector2& centre, double half_side) {
    centre_ = centre;
    const double reach = margin_ + half_side;
    bounds_ = {centre.x() - reach, centre.y() - reach, centre.x() + reach, centre.y() + reach};
    return bounds_;
  }
  /// True if a bat at `there` is too far from the middle: by half the margin.
  bool is_left_by(const physics::Vector2& there) const {
    return there != centre_ && (there - centre_).cwiseAbs().maxCoeff() >= 0.5 * margin_;
  }
  const im::Region& bounds() const { return bounds_; }

 private:
  double margin_;
  physics::Vector2 centre_{0.0, 0.0};
  im::Region bounds_;
};

}  // namespace rink::game
