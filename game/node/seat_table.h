// Decides which bat a player gets at which node, and keeps the bat of one that has left for a
// while.
#pragma once

#include <cassert>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "game/net/server/shared_play.h"
#include "game/peer/division.h"

namespace rink::game {

/// Stands for no bat, or any.
inline constexpr std::uint32_t no_player = std::numeric_limits<std::uint32_t>::max();

enum class SeatChange : std::uint8_t {
  enter,  ///< a player gets a bat
  stay,   ///< it has had one since the start, and says its token
  leave
};

/// What a node's player wants.
struct SeatWish {
  SeatChange change = SeatChange::enter;
  std::uint32_t player = no_player;          ///< the bat that it has, or would like best
  std::uint64_t token = SharedPlay::nobody;  ///< the player's own, by which it gets its bat back
};

/// The answer: the player of `token` at `node` gets the bat `player`, or leaves it; or nothing is
/// changed, which is said too.
struct SeatDecision {
  SeatChange change = SeatChange::enter;
  std::uint64_t window = 0;  ///< after which it holds
  std::uint32_t node = 0, player = no_player;
  std::uint64_t token = 0;
  bool answers(const SeatWish& wish) const { return change == wish.change && token == wish.token; }
};

template <class Stream>
bool exchange(Stream& stream, SeatWish& wish) {
  return stream.choice(wish.change, SeatChange::leave) && stream.numbers(wish.player, wish.token);
}

template <class Stream>
bool exchange(Stream& stream, SeatDecision& decision) {
  return stream.choice(decision.change, SeatChange::leave) &&
         stream.numbers(decision.window, decision.node, decision.player, decision.token);
}

/// All bats of the scene. A value of pure rules: the same wishes at the same times have the same
/// answers.
class SeatTable {
 public:
  /// The bat of a player that has left is kept for it for `lease_s` [s].
  SeatTable(std::uint32_t player_count, double lease_s);

  std::uint32_t player_count() const { return static_cast<std::uint32_t>(seats_.size()); }
  bool is_taken(std::uint32_t player) const {
    assert(player < seats_.size());
    return seats_[player].is_taken;
  }
  /// From the start the bats from `first` on have players at `node`; they must be free (asserted).
  void assign(peer::PeerNumber node, std::uint32_t first, std::uint32_t count);
  /// Answers a wish of `node` at `now_s` [s], and applies the answer, whose window is still to be
  /// set. Who does not have the bat changes nothing.
  SeatDecision decide(peer::PeerNumber node, const SeatWish& wish, double now_s);
  /// What another table of the same bats has decided.
  void apply(const SeatDecision& decision, double now_s);
  /// A player that has a bat.
  struct Seated {
    std::uint32_t player = 0;
    std::uint64_t token = SharedPlay::nobody;
  };
  /// `to` has all players of the node `from`, until it says that they have left. Returns these.
  std::vector<Seated> inherit(peer::PeerNumber from, peer::PeerNumber to);

 private:
  struct Seat {
    peer::PeerNumber node = 0;
    bool is_taken = false;
    std::uint64_t token = SharedPlay::nobody;  ///< of its player, also once that has left
    double leased_until =
        std::numeric_limits<double>::lowest();  ///< to that player alone [s]; the clock of matches
                                                ///< is below 0 before the start
  };
  std::uint32_t choice(peer::PeerNumber node, const SeatWish& wish, double now_s) const;
  static bool is_free(const Seat& seat, std::uint64_t token, double now_s) {
    return !seat.is_taken && (now_s >= seat.leased_until || seat.token == token);
  }

  std::vector<Seat> seats_;  ///< by player
  double lease_s_;
};

}  // namespace rink::game
