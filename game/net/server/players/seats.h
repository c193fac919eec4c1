// The seats of players: by federate and by player, and the turns that are done.
#pragma once

#include <cassert>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "rti/types.h"

namespace rink::game {

/// One seat for each bat of the scene. A federate is found by its handle's number, which is dense.
class Seats {
 public:
  struct Seat {
    std::uint32_t player = 0;
    bool is_offered = false;  ///< the player was notified
    bool is_turn_done = false;
  };
  struct Seated {
    rti::FederateHandle federate;
    std::uint32_t player = 0;
  };

  explicit Seats(std::uint32_t seat_count) : is_taken_(seat_count), is_leaving_(seat_count) {}

  /// This server's players take only `count` seats from `first` on. None of them is there yet.
  void keep_to(std::uint32_t first, std::uint32_t count);
  /// Of a shared game: this server was given the seat of `player`, which is free here.
  void open(std::uint32_t player);
  /// Of a shared game: the federate waits for an answer to its question, whose token that is.
  void await(rti::FederateHandle federate, std::uint64_t token) {
    waiting_.push_back({federate, token});
  }
  /// The one who waits for that answer, who waits no longer; nothing if it has gone.
  std::optional<rti::FederateHandle> take_waiting(std::uint64_t token);
  /// The federate waits no longer, if it did.
  void forget_waiting(rti::FederateHandle federate) {
    std::erase_if(waiting_, [federate](const Waiting& one) { return one.federate == federate; });
  }
  /// The bat whose name the federate bears, taken or not.
  std::optional<std::uint32_t> named(std::string_view federate_name) const;
  /// The bat that bears the federate's name ("bat-17"), or else the first free one.
  std::optional<std::uint32_t> free(std::string_view federate_name) const;
  /// The seat must be free (asserted).
  void enter(rti::FederateHandle federate, std::uint32_t player);
  /// The federate leaves its seat. `takes_bat`: the bat leaves too, at an instant that may be in
  /// the future.
  void leave(rti::FederateHandle federate, bool takes_bat);
  /// True if the bat has left, or will leave, with its last player.
  bool is_leaving(std::uint32_t player) const {
    assert(player < is_leaving_.size());
    return is_leaving_[player];
  }

  /// Null if it has no seat.
  const Seat* find(rti::FederateHandle federate) const;
  /// The federate that plays `player`, if any does.
  std::optional<rti::FederateHandle> federate_of(std::uint32_t player) const;
  std::uint32_t player_count() const { return player_count_; }
  /// Calls `visit(federate, seat)` in order of federates.
  template <class Visit>
  void for_each(Visit visit) const {
    for (std::uint32_t federate = 0; federate < seats_.size(); ++federate)
      if (seats_[federate]) visit(rti::FederateHandle{federate}, *seats_[federate]);
  }

  /// Calls `offer(federate, player)`, which returns success, for each player that was not notified
  /// of its seat.
  template <class Offer>
  void offer(Offer offer) {
    offered_.clear();
    for (std::uint32_t federate = 0; federate < seats_.size(); ++federate) {
      std::optional<Seat>& seat = seats_[federate];
      if (!seat || seat->is_offered || !offer(rti::FederateHandle{federate}, seat->player))
        continue;
      seat->is_offered = true;
      offered_.push_back({rti::FederateHandle{federate}, seat->player});
    }
  }
  /// The players notified by the last `offer`.
  std::span<const Seated> offered() const { return offered_; }

  /// The federate has taken its turn.
  void end_turn(rti::FederateHandle federate);
  /// True if every player has taken its turn, and there is one.
  bool are_all_turns_done() const { return player_count_ > 0 && turns_done_ == player_count_; }
  /// Begins new turns for all.
  void begin_turns();

 private:
  struct Waiting {
    rti::FederateHandle federate;
    std::uint64_t token;
  };
  std::vector<std::optional<Seat>> seats_;   ///< by federate
  std::vector<bool> is_taken_, is_leaving_;  ///< by player
  std::vector<Seated> offered_;
  std::vector<Waiting> waiting_;
  std::uint32_t player_count_ = 0, turns_done_ = 0;
};

}  // namespace rink::game
