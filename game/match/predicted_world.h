// A world that continues from a server's update.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "game/match/rink_track.h"
#include "game/model/scene.h"
#include "game/physics/world.h"

namespace rink::game {

/// A bat or a puck in a server's update.
struct ReceivedBody {
  Vector2 position{0.0, 0.0}, velocity{0.0, 0.0};  ///< m, m/s
  KeysHeld held;                                   ///< of bats
  Push push{};  ///< of bats, as far as the motion shows it: 0 along an axis where none acts or
                ///< something holds the bat
  bool is_in_play = true;  ///< of pucks: not in a goal
  bool is_known = true;    ///< otherwise it is shown at `position` and does not collide: one of a
                           ///< crowd that is too far away to matter
};

/// The state at the simulated instant `time` [s] of every bat and puck of the scene, in their order
/// there.
struct ReceivedRink {
  double time = 0.0;
  std::vector<ReceivedBody> bats, pucks;
  std::uint32_t own_felt = 0;  ///< how many of the own player's keys were felt until then
};

/// Rebuilt from each update, and played forward from there. Bodies are numbered bats first, then
/// pucks.
class PredictedWorld {
 public:
  explicit PredictedWorld(const Scene& scene);

  void set_up(const ReceivedRink& received);
  /// Returns to the instant of the newest update. It must be set up.
  void rewind();
  /// The bat's player presses or releases a key. It must be set up.
  void press(std::uint32_t bat, Key key, bool is_down);
  void push(std::uint32_t bat, const Push& push);
  /// Plays to the instant `until` [s], not before the last.
  void advance(double until);

  bool is_set_up() const { return world_.has_value(); }
  /// The update that it was set up from; its time is 0 before.
  const ReceivedRink& received() const { return received_; }
  bool is_known(std::size_t body) const;
  /// The present places of all bodies, at the instant `time`.
  RinkSample sample(double time) const;
  std::size_t bat_count() const { return held_.size(); }
  std::size_t puck_count() const { return ids_.size() - held_.size(); }
  std::size_t body_count() const { return ids_.size(); }
  const Vector2& half_extent(std::uint32_t bat) const;
  double thrust(std::uint32_t bat) const;                ///< of a held key [m/s^2]
  double drag() const { return scene_.world.bat_drag; }  ///< of bats [1/s]

 private:
  void add_bat(std::uint32_t bat);
  void add_puck(std::size_t puck);
  Vector2 inside(const Vector2& position, const physics::BatSpec& bat) const;
  Vector2 inside(const Vector2& position, double radius) const;
  void set_thrust(std::uint32_t bat);

  Scene scene_;
  std::optional<physics::World> world_;
  ReceivedRink received_;  ///< the update that the world was set up from, and its time origin
  std::vector<std::optional<physics::BodyId>> ids_;  ///< nothing for a puck that was out of play
  std::vector<KeysHeld> held_;                       ///< by bat
  std::vector<Push> pushes_;                         ///< by bat
  std::vector<Vector2> left_at_;  ///< its received place while it is out of play or not known
};

}  // namespace rink::game
