// How far a body can get within a time: the bound behind relevance by contact (docs/metrics.md,
// "Truth").
#pragma once

namespace rink::loadgen {

/// The reach of bodies of one kind within one time by their own law dv/dt = a - g v, without
/// effects of other bodies.
class Reach {
 public:
  /// `time_s` above 0; `drag` [1/s] and Coulomb `friction` [m/s^2] at least 0 (all asserted).
  Reach(double time_s, double drag, double friction);

  /// The farthest distance [m] from `speed` [m/s], with at most `acceleration` [m/s^2] in any
  /// direction. A body under friction has no acceleration (asserted).
  double of(double speed, double acceleration = 0.0) const;

 private:
  double time_s_, drag_, friction_;
  double s_, q_;  ///< see physics::WarpedTime
};

}  // namespace rink::loadgen
