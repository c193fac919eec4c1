// How far a body can get within a time: the bound behind relevance by contact (docs/metrics.md,
// "Truth").
#pragma once

namespace rink::loadgen {

/// Of bodies of one kind, within one time, by their own law dv/dt = a - g v; what others do to them
/// is left aside.
class Reach {
 public:
  /// `time_s` above 0; `drag` [1/s] and Coulomb `friction` [m/s^2] at least 0 (all asserted).
  Reach(double time_s, double drag, double friction);

  /// The farthest [m] from `speed` [m/s], with at most `thrust` [m/s^2] along whatever direction.
  /// One under friction has no thrust (asserted).
  double of(double speed, double thrust = 0.0) const;

 private:
  double time_s_, drag_, friction_;
  double s_, q_;  ///< see physics::WarpedTime
};

}  // namespace rink::loadgen
