// The interface of players: objects that decide by their view of the game which keys to hold.
#pragma once

#include <cstdint>
#include <span>

#include "game/model/scene.h"

namespace rink::game {

/// The period of decisions [s]: about that of people, and long enough for a thousand players in one
/// process.
inline constexpr double decision_period = 0.05;

/// The phase of player `number` within each period [s]: spread by the golden ratio, so that any
/// number of players load a processor evenly, over 25 slots, so that a process that plays them all
/// wakes at most 500 times a second.
double decision_phase(std::uint32_t number);

/// Constants of a game that every player may know.
struct PlayerRules {
  physics::Field field;
  double puck_drag = 0.0, bat_drag = 0.0;  ///< 1/s
  double thrust = 10.0;                    ///< of the own bat [m/s^2]
  double puck_mass = 0.1, bat_mass = 1.0;  ///< kg
  double restitution = 0.9;                ///< of a puck on a bat
  double puck_friction = 0.0;              ///< with the table [m/s^2]
  double possession_s = 0.0;               ///< as MatchRules'
};

/// The rules of `scene` for the player of bat `number`, which must exist unless the scene has no
/// bats.
PlayerRules rules_of(const Scene& scene, std::uint32_t number);

/// The bat and team of a player.
struct PlayerSeat {
  std::uint32_t number = 0;
  Team team = Team::none;
  Vector2 half_extent{0.05, 0.05};  ///< of the bat [m]
};

/// The range of the centre of the bat in `seat` [m].
struct Reach {
  Vector2 low, high;
  Vector2 clamped(const Vector2& place) const { return place.cwiseMax(low).cwiseMin(high); }
  Vector2 size() const { return high - low; }
};
Reach reach_of(const PlayerRules& rules, const PlayerSeat& seat);

/// An entity as a player knows it, right or stale.
struct SeenEntity {
  std::uint32_t id = 0;  ///< stays the same for an entity from one decision to the next
  physics::BodyKind kind = physics::BodyKind::puck;
  Vector2 position{0.0, 0.0}, velocity{0.0, 0.0};  ///< m, m/s
  Vector2 half_extent{0.0, 0.0};                   ///< m; both the radius for discs
};

/// All that a player knows when it decides.
struct PlayerView {
  Vector2 position{0.0, 0.0}, velocity{0.0, 0.0};  ///< of the own bat [m, m/s]
  std::span<const SeenEntity> pucks;  ///< the nearest, as many as the player wants to see or fewer
};

/// Pure: it knows no clock and no network, and the same seat, seed and views give the same keys.
/// The same player plays on the true state when a log is recorded and on a client's replicas when
/// it plays live.
class Player {
 public:
  virtual ~Player() = default;
  /// The keys to hold from `instant` [s] on; called every `decision_period`, in order.
  virtual KeysHeld decide(const PlayerView& view, double instant) = 0;
  /// The number of nearest pucks that it looks at.
  virtual std::uint32_t pucks_wanted() const { return 0; }
};

}  // namespace rink::game
