// The bats of all nodes' players while they play: one node decides, and all take over what it
// decides after the same window.
#pragma once

#include <cassert>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "game/net/server/shared_play.h"
#include "game/node/seat_table.h"

namespace rink::game {

/// The server's thread wishes and takes answers; all else is the session's thread's. A window is
/// counted in its session (instant_of), of which nodes that host matches play one after the other.
///
/// Where a loss may undo windows, a player is answered once its decision cannot be undone, which is
/// one window later; decisions that are undone are made anew.
class NodeSeats {
 public:
  /// What is decided between sessions holds from the start of the next, after its window 0.
  static constexpr std::uint64_t instant_of(std::uint64_t session, std::uint64_t window) {
    return session << session_shift | window;
  }

  NodeSeats(SeatTable table, peer::PeerNumber own, peer::PeerNumber node_count,
            bool may_go_back = false)
      : table_(table),
        final_(std::move(table)),
        own_(own),
        node_count_(node_count),
        may_go_back_(may_go_back) {
    assert(own < node_count);
  }

  peer::PeerNumber number() const { return own_; }
  peer::PeerNumber node_count() const { return node_count_; }

  void wish(const SeatWish& wish) {
    const std::lock_guard lock(mutex_);
    wishes_.push_back(wish);
  }
  std::optional<SharedPlay::SeatAnswer> next_answer() {
    const std::lock_guard lock(mutex_);
    if (answers_.empty()) return std::nullopt;
    const SharedPlay::SeatAnswer first = answers_.front();
    answers_.pop_front();
    return first;
  }

  /// Who decides: the first node that is not lost.
  peer::PeerNumber referee() const { return referee_; }
  /// The own players' wishes, which are to go to that one.
  std::vector<SeatWish> take_wishes();
  /// At the referee: a node's wish. False for one that no node has.
  bool hear(peer::PeerNumber from, const SeatWish& wish);
  /// At the referee, at `now_s` [s]: what all are to be told, to hold after `window`. Who
  /// leaves makes room first.
  std::vector<SeatDecision> decide(std::uint64_t window, double now_s);
  /// The referee has decided something that will hold. False for what it never says.
  bool hear(const SeatDecision& decision);
  /// The decisions that hold from now on, after `window`, which ends at `now_s` [s], in order. Each
  /// is returned once.
  std::vector<SeatDecision> due(std::uint64_t window, double now_s = 0.0);
  /// At the referee: whether the bat has a player.
  bool is_taken(std::uint32_t player) const { return table_.is_taken(player); }
  /// Which nodes' players have been given bats by decisions that hold, by bat.
  const std::map<std::uint32_t, peer::PeerNumber>& holders() const { return holders_; }
  /// The bats that were given to players of this node.
  std::vector<std::uint32_t> own() const;
  /// In matches: the words of a round have had their effect; and the bats that were given to
  /// players of `node` before it.
  void finish_round() { held_in_round_ = holders_; }
  std::vector<std::uint32_t> held_in_round(peer::PeerNumber node) const;

  /// All go back to the end of `window`, of which all have the decisions: later ones are undone.
  void rewind(std::uint64_t window, double now_s);
  /// In matches, equal at all: this node decides. Own wishes that nobody has answered go to it.
  void follow(peer::PeerNumber referee);
  /// In matches, then: `node` is lost. Its players are the referee's, which is to let them leave;
  /// returns them, by bat.
  std::vector<SeatTable::Seated> lose(peer::PeerNumber node);
  /// Then, equal at all: these nodes are lost. Their players are the new referee's, which is to
  /// release their keys before they leave; returns them, by bat.
  std::vector<SeatTable::Seated> lose(const std::vector<peer::PeerNumber>& lost,
                                      peer::PeerNumber referee);

 private:
  /// Nodes are no further apart than a window, and a decision holds after the next one.
  static constexpr std::uint64_t ahead_max = 2;
  static constexpr int session_shift = 40;
  static constexpr std::size_t wishes_max = 1u << 16;  ///< that wait

  void make_final(const SeatDecision& decision, double now_s);
  void answer(const SeatDecision& decision);
  void close(const SeatDecision& decision);

  SeatTable table_;  ///< with all decisions, at the referee
  SeatTable final_;  ///< with those that cannot be undone
  peer::PeerNumber own_, node_count_, referee_ = 0;
  bool may_go_back_;
  std::vector<std::pair<peer::PeerNumber, SeatWish>> heard_;
  std::deque<SeatDecision> due_, decided_;  ///< that hold, but may be undone; and that will hold
  std::uint64_t window_ = 0;                ///< of the last due()
  std::map<std::uint32_t, peer::PeerNumber> holders_, final_holders_, held_in_round_;
  std::deque<SeatWish> open_;  ///< own ones on which nothing final was decided
  std::mutex mutex_;
  std::vector<SeatWish> wishes_;  ///< guarded by `mutex_`, as are these:
  std::deque<SharedPlay::SeatAnswer> answers_;
};

}  // namespace rink::game
