// The prediction of a match that is played elsewhere: the own bat at once, by the engine's closed
// forms; all else on its path, with the necessary delay.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "game/match/hand_spring.h"
#include "game/match/jump_blends.h"
#include "game/match/pending_keys.h"
#include "game/match/predicted_world.h"

namespace rink::game {

/// Pure: time, keys and updates are arguments. Keeps a world of its own, rebuilt from each update
/// and played forward to the instant at which a key that is pressed now takes effect.
class PredictedRink {
 public:
  /// m from the own bat: among more bats than two, pucks that are further away are shown in the
  /// others' time.
  static constexpr double crowd_reach = 0.6;

  /// `own_player` plays that bat of the scene; none for a watcher.
  PredictedRink(const Scene& scene, std::optional<std::uint32_t> own_player);

  /// The own player has pressed `count` keys before, in other matches, which do not count here.
  void count_from(std::uint32_t count) { keys_.count_from(count); }

  /// The own player's next key takes effect at `instant` [s], not before now() (asserted), nor
  /// before the last key.
  void press(Key key, bool is_down, double instant);
  /// As press: the own player's next push.
  void push(const Push& push, double instant);

  /// Applies an update of the server unless one as new was received before; a new match needs a new
  /// PredictedRink.
  void receive(const ReceivedRink& received);

  /// `instant` [s], but not before now(), nor more than `longest_s` beyond the newest update.
  double within_reach(double instant, double longest_s) const {
    return std::clamp(instant, now_, std::max(now_, received_time() + longest_s));
  }

  /// Returns to `now` [s] and the newest update, since the server's time has stood still since
  /// then. Held keys stay held.
  void rewind(double now);

  /// Shows the own bat at `now` [s], the other at `now - delay`, and pucks at an instant between,
  /// the nearer the later (docs/play.md). `now` never falls but by rewind().
  void advance(double now, double delay);

  const std::vector<ShownBody>& bats() const { return shown_bats_; }
  const std::vector<ShownBody>& pucks() const { return shown_pucks_; }
  double now() const { return now_; }
  double received_time() const { return world_.received().time; }  ///< of the newest update
  bool has_received() const { return world_.is_set_up(); }
  const Corrections& own_corrections() const { return blends_.of_own_bat(); }
  const Corrections& other_corrections() const { return blends_.of_other_bats(); }
  const Corrections& puck_corrections() const { return blends_.of_pucks(); }
  /// The own bat as it is shown, for the spring that pulls it; it must have been received
  /// (asserted).
  PulledBat own_bat() const;
  std::size_t keys_waiting() const {
    return keys_.count();
  }  ///< pressed, but not yet known to be felt

  /// Asserts that all lists have an entry for each body, that keys and track are in order of time,
  /// and that pucks are shown at no later instant than now.
  void check() const;

 private:
  void begin();
  void push_own_bat();
  void apply_keys_until(double instant);
  void play(double until);
  std::vector<std::optional<Vector2>> seen() const;
  double puck_lag(std::size_t puck, double lag, double dt) const;
  double portion_of_delay(const Vector2& puck) const;
  double portion_in_crowd(const Vector2& puck) const;
  double time_of(std::size_t body) const;
  ShownBody shown(std::size_t body) const;

  std::optional<std::uint32_t> own_;
  PredictedWorld world_;
  PendingKeys keys_;
  RinkTrack track_;
  std::vector<double> lags_;  ///< by puck [s]
  JumpBlends blends_;
  std::vector<ShownBody> shown_bats_, shown_pucks_;
  double now_ = 0.0, delay_ = 0.0;
  bool has_looked_ = false;
};

}  // namespace rink::game
