// |v(t)| <= v exp(-g t) + a s(t), and its integral; friction is an acceleration backwards, until
// rest.
#include "loadgen/measure/truth/reach.h"

#include <cassert>
#include <cmath>

#include "game/physics/flight/motion.h"

namespace rink::loadgen {

Reach::Reach(double time_s, double drag, double friction)
    : time_s_(time_s), drag_(drag), friction_(friction) {
  assert(time_s > 0.0 && drag >= 0.0 && friction >= 0.0);
  const physics::WarpedTime warped = physics::warp(time_s, drag);
  s_ = warped.s, q_ = warped.q;
  assert(s_ > 0.0 && q_ > 0.0 && s_ <= time_s * (1.0 + 1e-12));
}

double Reach::of(double speed, double acceleration) const {
  assert((friction_ == 0.0 || acceleration == 0.0) && speed >= 0.0 && acceleration >= 0.0);
  if (friction_ == 0.0) return speed * s_ + acceleration * q_;
  const double rest_s =
      drag_ > 0.0 ? std::log1p(drag_ * speed / friction_) / drag_ : speed / friction_;
  if (rest_s >= time_s_) return speed * s_ - friction_ * q_;
  const physics::WarpedTime warped = physics::warp(rest_s, drag_);
  return speed * warped.s - friction_ * warped.q;
}

}  // namespace rink::loadgen
