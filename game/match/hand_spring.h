// The force with which a hand at a place pulls its bat there: a damped spring within the thrust.
#pragma once

#include <optional>

#include "game/model/push.h"
#include "game/physics/body.h"

namespace rink::game {

/// A bat as its player sees it.
struct PulledBat {
  physics::Vector2 position{0.0, 0.0}, velocity{0.0, 0.0};  ///< m, m/s
  double thrust = 0.0;                                      ///< of a held key [m/s^2]
  double drag = 0.0;                                        ///< 1/s
};

/// The push towards a hand at `place` [m] (docs/play.md, "Pointer and stick"). Along each axis:
/// near the hand a critically damped spring; further off no faster than the bat can brake, so that
/// it does not shoot past; nothing within `spring_dead_zone` once it is slow.
Push spring_push(const PulledBat& bat, const physics::Vector2& place);

inline constexpr double spring_rate = 25.0;       ///< of the spring [1/s]
inline constexpr double spring_braking = 0.7;     ///< of the thrust that braking may take
inline constexpr double spring_dead_zone = 1e-3;  ///< m
inline constexpr double spring_slow = 3e-3;       ///< m/s: what drag ends within the dead zone

/// What a hand pushes at each frame, and when that has to be told.
class HandSpring {
 public:
  /// Pushes are told no faster: 1/200 s, so that no screen goes beyond a host's limit.
  static constexpr double shortest_s = 1.0 / 200.0;
  /// A change by so few steps along both axes is not told, but for the end of a push: 2 % of the
  /// thrust, which the next frames make up for.
  static constexpr int untold_steps = 3;

  void reach(const std::optional<physics::Vector2>& place) { place_ = place; }
  /// The push of the frame at `now_s` [s, real time], if it differs from the one told before.
  std::optional<Push> next(const PulledBat& bat, double now_s);
  /// Nothing that was told holds any more.
  void forget() { told_ = {}; }
  /// It was told last.
  const Push& told() const { return told_; }

 private:
  std::optional<physics::Vector2> place_;
  Push told_;
  double told_s_ = -1.0;
};

}  // namespace rink::game
