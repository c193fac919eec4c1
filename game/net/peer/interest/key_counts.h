// Counts the keys of the players in a shared game on their way.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <optional>
#include <vector>

namespace rink::game {

/// Counts each player's keys as one peer knows them: those that came here; and, for the bats that
/// it owns, those in effect in the present window, in final windows, and those acknowledged to
/// their player.
class KeyCounts {
 public:
  /// Adds players; their number never falls.
  void set_player_count(std::size_t count) {
    assert(count >= received_.size());
    for (std::vector<std::uint32_t>* const counts : {&received_, &playing_, &felt_, &told_})
      counts->resize(count, 0);
  }
  std::size_t player_count() const { return received_.size(); }

  void begin_window() { playing_ = received_; }
  void finish_window() { felt_ = playing_; }

  /// Counts the own player's next key and returns the new number.
  std::uint32_t press(std::uint32_t own) {
    assert(own < received_.size());
    return received_[own] = ++pressed_;
  }
  /// `player` has pressed so many keys. False if that was known.
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
  /// The number of keys in effect if it is greater than the acknowledged one; returned once.
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
