// Who plays which bat: seats by federate and by player, and whose turn is done.
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
    bool is_offered = false;  ///< the player has been told
    bool is_turn_done = false;
  };
  struct Seated {
    rti::FederateHandle federate;
    std::uint32_t player = 0;
  };

  explicit Seats(std::uint32_t seat_count) : is_taken_(seat_count), is_leaving_(seat_count) {}

  /// The bat that bears the federate's name ("bat-17"), or else the first free one.
  std::optional<std::uint32_t> free(std::string_view federate_name) const;
  /// The seat must be free (asserted).
  void enter(rti::FederateHandle federate, std::uint32_t player);
  /// Who sits there leaves. `takes_bat`: the bat is to go at an instant that need not have been
  /// played yet.
  void leave(rti::FederateHandle federate, bool takes_bat);
  /// Whether the bat went, or is to go, with who played it last.
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

  /// Calls `offer(federate, player)` for each who has not been told of its seat; true if it now
  /// has.
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
  /// Those notified by the last `offer`.
  std::span<const Seated> offered() const { return offered_; }

  /// Who sits there has taken its turn.
  void end_turn(rti::FederateHandle federate);
  /// True if every player has taken its turn, and there is one.
  bool are_all_turns_done() const { return player_count_ > 0 && turns_done_ == player_count_; }
  /// All are to take their turns again.
  void begin_turns();

 private:
  std::vector<std::optional<Seat>> seats_;   ///< by federate
  std::vector<bool> is_taken_, is_leaving_;  ///< by player
  std::vector<Seated> offered_;
  std::uint32_t player_count_ = 0, turns_done_ = 0;
};

}  // namespace rink::game
