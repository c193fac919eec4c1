// How far the keys of the players in a shared game have come.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <optional>
#include <vector>

namespace rink::game {

/// Counts each player's keys from where they are pressed to where they are felt, as one peer knows
/// it: those that came here; and, for the bats that it owns, those that are felt in the window that
/// is played, in final windows, and those of which their player was told.
class KeyCounts {
 public:
  /// Players are never fewer than before; of new ones nothing has come.
  void set_player_count(std::size_t count) {
    assert(count >= received_.size());
    for (std::vector<std::uint32_t>* const counts : {&received_, &playing_, &felt_, &told_})
      counts->resize(count, 0);
  }
  std::size_t player_count() const { return received_.size(); }

  void begin_window() { playing_ = received_; }
  void finish_window() { felt_ = playing_; }

  /// The own player's next key: how many it has pressed with it.
  std::uint32_t press(std::uint32_t own) {
    assert(own < received_.size());
    return received_[own] = ++pressed_;
  }
  /// `player` has pressed so many keys. False if that is no news.
  bool receive(std::uint32_t player, std::uint32_t count) {
    assert(player < received_.size());
    if (count <= received_[player]) return false;
    received_[player] = count;
    return true;
  }
  std::uint32_t received(std::uint32_t player) const {
    assert(player < received_.size());
    return received_[player];
  }
  std::uint32_t felt(std::uint32_t player) const {
    assert(player < felt_.size());
    return felt_[player];
  }
  /// How many were felt, if that are more than `player` was told; given once.
  std::optional<std::uint32_t> take_newly_felt(std::uint32_t player) {
    assert(player < felt_.size());
    if (felt_[player] <= told_[player]) return std::nullopt;
    return told_[player] = felt_[player];
  }

 private:
  std::vector<std::uint32_t> received_, playing_, felt_, told_;  ///< by player
  std::uint32_t pressed_ = 0;
};

}  // namespace rink::game
