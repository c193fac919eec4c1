// The law by which an entity moves until the next update, which the policy "on-event" and the
// dead-reckoning policies send instead of positions.
#pragma once

#include <bit>
#include <cstdint>

#include "game/physics/flight/motion.h"
#include "game/physics/world.h"

namespace rink::game {

/// A physics::Motion as receivers get it; its acceleration excludes friction, which follows from
/// the velocity. Its time is a multiple of `trajectory_time_step`, so it may start a little before
/// the event that it follows, or after.
struct Trajectory {
  static constexpr double of_its_kind =
      -1.0;           ///< a drag that the receiver knows: that of all pucks, or of all bats
  double time = 0.0;  ///< s
  physics::Vector2 position{0.0, 0.0}, velocity{0.0, 0.0}, acceleration{0.0, 0.0};
  physics::Vector2 drag{of_its_kind, of_its_kind};  ///< 1/s
  friend bool operator==(const Trajectory&, const Trajectory&) = default;
  bool is_resting() const { return velocity.isZero(0.0) && acceleration.isZero(0.0); }
};

/// The resistance of all entities of a kind.
struct Resistance {
  double drag = 0.0;      ///< linear [1/s]
  double friction = 0.0;  ///< Coulomb's, with the table [m/s^2]
};

/// The drag of pucks and of bats, as the field's object has it.
struct Drag {
  double pucks = 0.0, bats = 0.0;  ///< 1/s
  double puck_friction = 0.0;      ///< m/s^2
  static Drag of(const physics::WorldSpec& spec) {
    return {.pucks = spec.puck_drag, .bats = spec.bat_drag, .puck_friction = spec.puck_friction};
  }
  Resistance of(physics::BodyKind kind) const {
    return kind == physics::BodyKind::bat ? Resistance{bats, 0.0}
                                          : Resistance{pucks, puck_friction};
  }
};

template <class Stream>
bool exchange(Stream& stream, Drag& drag) {
  for (double* number : {&drag.pucks, &drag.bats, &drag.puck_friction})
    if (!stream.finite(*number) || *number < 0.0) return false;
  return true;
}

/// False for what no body can follow: a number that is not finite, or a drag below 0 that is not
/// `of_its_kind`.
template <class Stream>
bool exchange(Stream& stream, Trajectory& t) {
  if (!stream.finite(t.time)) return false;
  for (physics::Vector2* vector : {&t.position, &t.velocity, &t.acceleration, &t.drag})
    if (!stream.finite(vector->x()) || !stream.finite(vector->y())) return false;
  const auto is_drag = [](double drag) { return drag >= 0.0 || drag == Trajectory::of_its_kind; };
  return is_drag(t.drag.x()) && is_drag(t.drag.y());
}

/// The steps of rounding. All are powers of two, so that rounded values are exact in every
/// encoding.
inline constexpr double trajectory_time_step = 0x1p-10;      ///< s; rounds by at most 0.5 ms
inline constexpr double trajectory_position_step = 0x1p-11;  ///< m; rounds by at most 0.244 mm
inline constexpr double trajectory_velocity_step = 0x1p-11;  ///< m/s; rounds by at most 0.244 mm/s
/// No receiver's trajectory is further than this from the body at any tick [m]: one that rounding
/// leads away is sent again before.
inline constexpr double trajectory_error_max = 1e-3;
inline constexpr double event_age_max = 0.125;  ///< s; a little more than the longest tick
/// No trajectory is older than this [s], so that a receiver can resolve its abbreviated time
/// (docs/replication.md).
inline constexpr double trajectory_age_max = 12.0;

/// The double that is no finer than single precision nearest to `value`, of ordinary size. By its
/// bits, for GCC 12 (-O2, vectorised) leaves out the casts to float and back.
inline double single_precision(double value) {
  constexpr std::uint64_t finer = (1u << 29) - 1;
  return std::bit_cast<double>((std::bit_cast<std::uint64_t>(value) + (finer >> 1) + 1) & ~finer);
}
inline physics::Vector2 single_precision(const physics::Vector2& value) {
  return {single_precision(value.x()), single_precision(value.y())};
}

/// The trajectory of `body` at world.now(), rounded, from its last event on if that was less than
/// `event_age_max` ago, for there it leaves the one before. It rests if the body is out of play.
Trajectory trajectory_of(const physics::World& world, physics::BodyId body);

/// The rounded trajectory for a receiver that extrapolates a body at `position` [m] with `velocity`
/// [m/s] at `now` [s] with `own` resistance and no acceleration.
Trajectory extrapolation_of(const physics::Vector2& position, const physics::Vector2& velocity,
                            double now, const Resistance& own);

/// The law that a receiver follows by the `own` resistance of the entity's kind; it is not valid
/// before its time.
physics::Motion motion_of(const Trajectory& trajectory, const Resistance& own);

/// The last instant up to which `sent` is within `trajectory_error_max` of `body` without events,
/// and no older than `trajectory_age_max`; before world.now() if `sent` has the wrong law or is too
/// far off already.
double holds_until(const physics::World& world, physics::BodyId body, const Trajectory& sent);

/// The trajectory of a body that its receivers were sent last, as the sender keeps it.
struct SentTrajectory {
  Trajectory trajectory;
  double until_s = -1.0;  ///< up to there it holds, if nothing happens

  /// After an event: whether the next one is due at world.now(). An event that changes almost
  /// nothing, as those of bodies pressed to each other, makes none due; one that would be so within
  /// a tenth of a second is due now.
  bool must_be_renewed(const physics::World& world, physics::BodyId body) {
    constexpr double worthwhile_s = 0.1;
    until_s = holds_until(world, body, trajectory);
    return until_s < world.now() + worthwhile_s;
  }
  void renew(const physics::World& world, physics::BodyId body) {
    trajectory = trajectory_of(world, body);
    until_s = holds_until(world, body, trajectory);
  }
};

}  // namespace rink::game
