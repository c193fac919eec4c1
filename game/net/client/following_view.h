// The square around a bat that a client declares as its interest, and when it must be declared
// anew.
#pragma once

#include <algorithm>
#include <cmath>

#include "game/net/view.h"
#include "game/replication/attributes.h"
#include "rti/types.h"

namespace rink::game {

/// See ClientSettings.
struct ViewSettings {
  double fraction = 0.05, area = 0.0, margin = 0.0;
};

class FollowingView {
 public:
  explicit FollowingView(const ViewSettings& settings) : settings_(settings) {}

  /// Lays the square around `centre`, on a field of the given extent.
  const im::Region& look_around(const Position& centre, const Extent& field) {
    centre_ = centre;
    const double half_side = settings_.margin + view_half_side(settings_.area, settings_.fraction,
                                                               field.length, field.width);
    bounds_ = {centre.x - half_side, centre.y - half_side, centre.x + half_side,
               centre.y + half_side};
    return bounds_;
  }
  /// True if a bat at `there` is too far from the middle: by half the margin.
  bool is_left_by(const Position& there) const {
    if (there == centre_) return false;
    const double moved = std::max(std::abs(double(there.x) - double(centre_.x)),
                                  std::abs(double(there.y) - double(centre_.y)));
    return moved >= 0.5 * settings_.margin;
  }
  const im::Region& bounds() const { return bounds_; }

 private:
  ViewSettings settings_;
  Position centre_;
  im::Region bounds_;
};

}  // namespace rink::game
