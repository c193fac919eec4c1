// What a player is shown of a match that is played elsewhere: the own bat at once, by the same
// closed forms; all else on its path, as late as it must be.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "game/match/blend.h"
#include "game/model/scene.h"
#include "game/physics/world.h"

namespace rink::game {

/// A bat or a puck as the server told it.
struct ToldBody {
  Vector2 position{0.0, 0.0}, velocity{0.0, 0.0};  ///< m, m/s
  KeysHeld held;                                   ///< of bats
  bool is_in_play = true;                          ///< of pucks: not in a goal
  bool is_known = true;  ///< otherwise it is shown at `position` and stands in nobody's way: one of
                         ///< a crowd that is too far away to matter
};

/// All that was true at the simulated instant `time` [s]: of every bat and puck of the scene, in
/// their order there.
struct ToldRink {
  double time = 0.0;
  std::vector<ToldBody> bats, pucks;
  std::uint32_t own_felt = 0;  ///< how many of the own player's keys were felt until then
};

/// How far the pictures of one kind of body jumped, before the jump was blended away, whenever the
/// server told of it.
struct Corrections {
  static constexpr double visible = 2e-3;  ///< m: a pixel of a field 2.4 m long on 1,280 pixels
  std::uint64_t visible_count = 0;
  double greatest = 0.0, sum = 0.0, last_visible = 0.0;  ///< m; `sum` is of the visible ones
  void count(double jump);
};

struct ShownBody {
  Vector2 position{0.0, 0.0}, velocity{0.0, 0.0};  ///< m, m/s
  double time = 0.0;  ///< the simulated instant that is shown of it [s]
};

/// Pure: time, keys and what was told are handed in. Keeps a world of its own (physics::World), set
/// up anew from each thing told and played forward to the instant at which a key that is pressed
/// now will be felt.
class PredictedRink {
 public:
  /// m from the own bat: among more bats than two, pucks that are further away are shown in the
  /// others' time.
  static constexpr double crowd_reach = 0.6;

  /// `own_player` plays that bat of the scene; nobody for one who watches.
  PredictedRink(const Scene& scene, std::optional<std::uint32_t> own_player);

  /// The own player has pressed `count` keys before, in other matches, which are of no account
  /// here.
  void count_from(std::uint32_t count) { felt_ = std::max(felt_, count); }

  /// The own player's next key takes effect at `instant` [s], not before now() (asserted), nor
  /// before the last key.
  void press(Key key, bool is_down, double instant);

  /// Takes in what the server told. It is no news if something as new was told before; a match that
  /// begins anew needs a new PredictedRink.
  void hear(const ToldRink& told);

  /// Back to `now` [s] and what was told: the server says that time has stood still since then.
  /// What was pressed stays pressed.
  void rewind(double now);

  /// Shows the own bat at `now` [s], the other at `now - delay`, and pucks at an instant between,
  /// the nearer the later (docs/play.md). `now` never falls but by rewind().
  void advance(double now, double delay);

  const std::vector<ShownBody>& bats() const { return shown_bats_; }
  const std::vector<ShownBody>& pucks() const { return shown_pucks_; }
  double now() const { return now_; }
  double told_time() const { return told_.time; }  ///< of what was told last
  bool has_heard() const { return world_.has_value(); }
  const Corrections& own_corrections() const { return own_corrections_; }
  const Corrections& other_corrections() const { return other_corrections_; }
  const Corrections& puck_corrections() const { return puck_corrections_; }
  std::size_t keys_waiting() const {
    return keys_.size();
  }  ///< pressed, but not yet known to be felt

  /// Asserts that there is one of everything for each body, that keys and track are in order of
  /// time, and that what is shown of pucks is no later than now.
  void check() const;

 private:
  struct PressedKey {
    double instant;
    Key key;
    bool is_down;
  };
  /// Where everything is at one instant: bats, then pucks.
  struct Sample {
    double time;
    std::vector<Vector2> positions, velocities;
  };

  void set_up();
  void add_bat(std::uint32_t bat);
  void add_puck(std::size_t puck);
  Vector2 inside(const Vector2& position, const physics::BatSpec& bat) const;
  Vector2 inside(const Vector2& position, double radius) const;
  void apply_keys_until(double instant);
  void set_thrust(std::uint32_t bat);
  void play(double until);
  void sample(double time);
  void forget_before(double time);
  ShownBody at(std::size_t body, double time) const;
  void look(double now);
  double puck_lag(std::size_t puck, double lag, double dt) const;
  double portion_of_delay(const Vector2& puck) const;
  double portion_in_crowd(const Vector2& puck) const;
  bool is_known(std::size_t body) const {
    return (body < held_.size() ? told_.bats[body] : told_.pucks[body - held_.size()]).is_known;
  }
  std::size_t body_count() const { return scene_.bodies.bats.size() + scene_.bodies.pucks.size(); }
  double time_of(std::size_t body) const;
  ShownBody shown(std::size_t body) const;
  Corrections& corrections_of(std::size_t body);

  Scene scene_;
  std::optional<std::uint32_t> own_;
  std::optional<physics::World> world_;
  ToldRink told_;  ///< what the world was set up from; it counts its time from there
  std::vector<std::optional<physics::BodyId>>
      ids_;                      ///< bats, then pucks; nothing for a puck that was out of play
  std::vector<KeysHeld> held_;   ///< by bat
  std::deque<PressedKey> keys_;  ///< from the first that is not known to be felt
  std::uint32_t felt_ = 0;       ///< those before
  std::size_t applied_ = 0;      ///< of keys_, in the world
  std::deque<Sample> track_;
  std::vector<Vector2> left_at_;  ///< where it was told to be while out of play, or not known
  std::vector<double> lags_;      ///< by puck [s]
  std::vector<Blend> blends_;
  std::vector<ShownBody> shown_bats_, shown_pucks_;
  double now_ = 0.0, delay_ = 0.0;
  bool has_looked_ = false;
  Corrections own_corrections_, other_corrections_, puck_corrections_;
};

}  // namespace rink::game
