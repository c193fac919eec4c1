// Players that move in groups: reference-point group mobility (Hong, Gerla, Pei and Chiang 1999).
#pragma once

#include "game/players/steering.h"

namespace rink::game {

/// The path of a group's centre: a random waypoint walk at a constant speed, a function of seed,
/// group and time alone, so that the members agree on it without messages.
class GroupRoute {
 public:
  /// A route at `speed` [m/s] within `reach`; at speed 0 the centre stays.
  GroupRoute(const Reach& reach, double speed, std::uint64_t seed, std::uint32_t group);
  /// The place of the centre at `instant` [s]; instants must not fall.
  Vector2 at(double instant);

 private:
  void start_leg();
  Reach reach_;
  double speed_;
  RandomStream random_;
  Vector2 from_, to_;
  double begin_s_ = 0.0, end_s_ = 0.0;  ///< infinite if it is never reached
};

/// A member of a group of up to eight with consecutive numbers: it stays near its own reference
/// point about the group's centre, drawn uniformly in a disc.
class Gathering : public Player {
 public:
  static constexpr std::uint32_t group_size = 8;

  Gathering(const PlayerRules& rules, const PlayerSeat& seat, std::uint64_t seed);
  KeysHeld decide(const PlayerView& view, double instant) override;
  /// The radius of the disc in which the members' reference points lie [m].
  double spread() const { return spread_; }

 private:
  PlayerRules rules_;
  Reach reach_;
  RandomStream random_;
  GroupRoute route_;
  double spread_;
  Vector2 place_,
      stray_{0.0, 0.0};  ///< of the reference point about the centre, and of the member about that
  double stray_until_s_ = 0.0;
  Hands hands_;
};

}  // namespace rink::game
