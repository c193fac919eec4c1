// When it is a client's turn, and which tick it asks the RTI for: the client's side of TickGrid.
#pragma once

#include <cstdint>
#include <optional>

#include "game/net/tick_grid.h"
#include "game/replication/attributes.h"

namespace rink::game {

/// A turn taker sends nothing itself. Until it has a pace, the server ticks by its own timer, and
/// nobody waits for anybody.
class TurnTaker {
 public:
  bool is_synchronous() const { return pace_ && pace_->is_synchronous != 0; }
  bool is_time_managed() const { return pace_ && pace_->is_time_managed != 0; }
  /// True while the server waits for this player's turn, as far as it has told; false of one that
  /// ticks by its own timer.
  bool has_turn() const { return has_turn_; }
  /// It came after the call to the start, so that it is in nobody's way before it has sat down.
  bool is_late() const { return pace_ && pace_->is_late != 0; }
  /// Synchronous mode: the simulated instant [s] of the newest tick that was heard of.
  double turn_s() const { return turn_s_; }
  double lookahead() const { return grid().lookahead(); }
  /// True unless it should keep logical time and can't yet.
  bool is_time_kept(bool is_constrained, bool is_regulating) const;

  /// The server told its pace at `simulated_s` [s]; true the first time, which is what counts.
  bool receive(const Pace& pace, double simulated_s);
  /// Logical time is kept from now on. True if the next tick is to be asked for; else it is this
  /// player's turn first.
  bool begin();
  void end_turn() { has_turn_ = false; }

  struct Request {
    double time = 0.0;         ///< the logical time to advance to
    bool asks_bounds = false;  ///< how far the server is is to be asked before
  };
  /// The next tick for who was granted `granted`. One who waits for turns is never ahead by more
  /// than a tick; one who does not may be ahead by any number, which then come together.
  Request next(double granted);
  /// The RTI has advanced it. True if the next tick is to be asked for at once.
  bool grant(double granted);
  /// The answer to `asks_bounds`, which comes after the grant if that could be given at once: when
  /// there may be more to ask for. False if nothing was asked.
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
