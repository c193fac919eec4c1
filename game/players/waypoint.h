// The random-waypoint model (Johnson and Maltz 1996): go straight to a random place, pause, choose
// the next.
#pragma once

#include "game/players/steering.h"

namespace rink::game {

/// Goes from place to place and rests at each; kinds of players choose the places. Speeds are
/// uniform between a quarter of and the whole top speed: without a lower bound slow trips take ever
/// more of the time and the mean speed decays for as long as a run lasts (Yoon, Liu and Noble
/// 2003).
class Traveller {
 public:
  Traveller(const PlayerRules& rules, const PlayerSeat& seat)
      : rules_(rules), reach_(reach_of(rules, seat)), tolerance_(seat.half_extent.maxCoeff()) {}

  static constexpr double slowest = 0.25;     ///< of the top speed
  static constexpr double pause_max_s = 1.0;  ///< pauses are uniform from 0

  /// True when a new target is due.
  bool needs_target(const PlayerView& view, double instant, RandomStream& random);
  void go_to(const Vector2& target, const PlayerView& view, double instant, RandomStream& random);
  /// The present keys: none while it rests.
  KeysHeld travel(const PlayerView& view, KeysHeld held) const;

  const Vector2& target() const { return target_; }
  double speed() const { return speed_; }  ///< of the present trip [m/s]
  bool is_resting() const { return state_ == State::resting; }
  const Reach& reach() const { return reach_; }

 private:
  enum class State : std::uint8_t { idle, travelling, resting };
  PlayerRules rules_;
  Reach reach_;
  double tolerance_, speed_ = 0.0;
  Vector2 target_{0.0, 0.0};
  double until_s_ = 0.0;  ///< the end of the rest, or of a trip that others block
  State state_ = State::idle;
};

/// A place within `reach`, all equally likely.
Vector2 anywhere(const Reach& reach, RandomStream& random);

class Waypoint : public Player {
 public:
  Waypoint(const PlayerRules& rules, const PlayerSeat& seat, std::uint64_t seed);
  KeysHeld decide(const PlayerView& view, double instant) override;
  const Traveller& traveller() const { return traveller_; }

 private:
  RandomStream random_;
  Traveller traveller_;
  Hands hands_;
};

}  // namespace rink::game
