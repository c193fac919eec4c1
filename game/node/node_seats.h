// The bats of all nodes' players while they play: node 0 decides, and all take over what it decides
// after the same window.
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
class NodeSeats {
 public:
  /// What is decided between sessions holds from the start of the next, after its window 0.
  static constexpr std::uint64_t instant_of(std::uint64_t session, std::uint64_t window) {
    return session << session_shift | window;
  }

  NodeSeats(SeatTable table, peer::PeerNumber own, peer::PeerNumber node_count)
      : table_(std::move(table)), own_(own), node_count_(node_count) {
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

  /// The own players' wishes, which are to go to node 0.
  std::vector<SeatWish> take_wishes() {
    const std::lock_guard lock(mutex_);
    return std::exchange(wishes_, {});
  }
  /// At node 0: a node's wish. False for one that no node has.
  bool hear(peer::PeerNumber from, const SeatWish& wish);
  /// At node 0, at `now_s` [s]: what all are to be told, to hold after `window`.
  std::vector<SeatDecision> decide(std::uint64_t window, double now_s);
  /// Node 0 has decided something that will hold. False for what it never says.
  bool hear(const SeatDecision& decision);
  /// The decisions that hold from now on, after `window`, in order. Each is returned once.
  std::vector<SeatDecision> due(std::uint64_t window);
  /// At node 0: whether the bat has a player.
  bool is_taken(std::uint32_t player) const { return table_.is_taken(player); }
  /// Which nodes' players have been given bats by decisions that hold, by bat.
  const std::map<std::uint32_t, peer::PeerNumber>& holders() const { return holders_; }
  /// The bats that were given to players of this node.
  std::vector<std::uint32_t> own() const;

 private:
  /// Nodes are no further apart than a window, and a decision holds after the next one.
  static constexpr std::uint64_t ahead_max = 2;
  static constexpr int session_shift = 40;
  static constexpr std::size_t wishes_max = 1u << 16;  ///< that wait

  SeatTable table_;
  peer::PeerNumber own_, node_count_;
  std::vector<std::pair<peer::PeerNumber, SeatWish>> heard_;
  std::deque<SeatDecision> decided_;
  std::uint64_t window_ = 0;  ///< of the last due()
  std::map<std::uint32_t, peer::PeerNumber> holders_;
  std::mutex mutex_;
  std::vector<SeatWish> wishes_;  ///< guarded by `mutex_`, as are these:
  std::deque<SharedPlay::SeatAnswer> answers_;
};

}  // namespace rink::game
