// Decides when it is a client's turn, and which tick it asks the RTI for: the client's side of
// TickGrid.
#pragma once

#include <cstdint>
#include <optional>

#include "game/net/tick_grid.h"
#include "game/replication/attributes.h"
#include "rti/time/federate_clock.h"

namespace rink::game {

/// A turn taker sends nothing itself. Without a pace, the server ticks by its own timer, and none
/// waits for another.
class TurnTaker {
 public:
  bool is_synchronous() const { return pace_ && pace_->is_synchronous != 0; }
  bool is_time_managed() const { return pace_ && pace_->is_time_managed != 0; }
  /// True while the server waits for this player's turn, by its last message; false if it ticks by
  /// its own timer.
  bool has_turn() const { return has_turn_; }
  /// True if it came after the call to the start, so that others do not wait for it before it is
  /// seated.
  bool is_late() const { return pace_ && pace_->is_late != 0; }
  /// True if it came late, and the server waits for nobody's turns.
  bool is_late_by_timer() const { return is_late() && !is_synchronous() && !is_time_managed(); }
  /// Synchronous mode: the simulated instant [s] of the newest received tick.
  double turn_s() const { return turn_s_; }
  double lookahead() const { return grid().lookahead(); }
  /// True unless it should keep logical time and cannot yet.
  bool is_time_kept(bool is_constrained, bool is_regulating) const;
  bool is_time_kept(const rti::FederateClock& clock) const {
    return is_time_kept(clock.is_constrained(), clock.is_regulating());
  }

  /// The server sent its pace at `simulated_s` [s]; true for the first one, the others are ignored.
  bool receive(const Pace& pace, double simulated_s);
  /// Logical time is kept from now on. True if the next tick must be requested; else it is this
  /// player's turn first.
  bool begin();
  void end_turn() { has_turn_ = false; }

  struct Request {
    double time = 0.0;         ///< the logical time to advance to
    bool asks_bounds = false;  ///< the server's progress must be queried before
  };
  /// The request for the next tick after the grant of `granted`. A server that waits for turns is
  /// never ahead by more than a tick; another may be ahead by any number, which then come together.
  Request next(double granted);
  /// The RTI has granted an advance. True if the next tick must be requested at once.
  bool grant(double granted);
  /// The answer to `asks_bounds`, which comes after an immediate grant, when there may be more to
  /// request. False if nothing was asked.
  bool receive_bounds(double galt);

 private:
  TickGrid grid() const { return {pace_->ticks_per_second}; }

  std::optional<Pace> pace_;
  bool has_turn_ = false;
  bool awaits_bounds_ = false;
  std::uint64_t grants_ = 0;
  double galt_ = 0.0, turn_s_ = 0.0;
};

}  // namespace rink::game
