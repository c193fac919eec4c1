// The pace of a server, and when it may tick: by its own timer, by turns, or in logical time.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "game/net/tick_grid.h"
#include "game/replication/attributes.h"

namespace rink::game {

struct TurnSettings {
  double tick_s = 1.0 / 30.0;  ///< between two ticks
  bool is_synchronous = false, is_time_managed = false;
};

/// Decides only, and leaves sending to the server. Times are simulated [s]; `granted` is the
/// logical time that the RTI has granted to the server.
class ServerTurns {
 public:
  explicit ServerTurns(const TurnSettings& settings) : settings_(settings) {}

  bool is_time_managed() const { return settings_.is_time_managed; }
  double tick_s() const { return settings_.tick_s; }
  double lookahead() const { return grid().lookahead(); }
  /// True if players must know the pace.
  bool concerns_players() const { return settings_.is_synchronous || settings_.is_time_managed; }
  Pace pace() const;

  /// The players have been called to the start, and they have all come.
  void call() { is_called_ = true; }
  void start() { is_started_ = true; }
  bool is_started() const { return is_started_; }

  /// `has_arrived`: as far as it was to go, and not cut short (tick_budget.h).
  void stepped(bool has_arrived) {
    has_stepped_ = true;
    is_within_tick_ = settings_.is_time_managed && !has_arrived;
  }
  /// True if nothing may be said before the rest of the tick is played: under time management
  /// states exist at ticks alone, for the server's lookahead keeps it from a time stamp before the
  /// next.
  bool is_within_tick() const { return is_within_tick_; }
  /// True once after a step that only a message of the server shows to players.
  bool take_step() {
    return std::exchange(has_stepped_, false) && settings_.is_synchronous &&
           !settings_.is_time_managed;
  }
  /// The logical time to request, if any, now that all up to `played` was published.
  std::optional<double> wanted(double played, double granted) const;
  /// True if the tick after `played`, or the rest of one, may come: no earlier message can arrive
  /// any more.
  bool may_step(bool are_all_turns_done, double played, double granted) const;

 private:
  TickGrid grid() const { return {1.0 / settings_.tick_s}; }

  TurnSettings settings_;
  bool is_called_ = false, is_started_ = false;
  bool has_stepped_ = false;  ///< since players were last notified
  bool is_within_tick_ = false;
};

}  // namespace rink::game
