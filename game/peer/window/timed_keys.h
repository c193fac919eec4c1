// Keys of a peer's bats, by the window in which they take effect.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "game/peer/messages.h"
#include "game/peer/window/roles.h"

namespace rink::peer {

class TimedKeys {
 public:
  /// For a window to come.
  void add(const Key& key) { later_.push_back(key); }
  void add(std::span<const Key> keys) { later_.insert(later_.end(), keys.begin(), keys.end()); }
  /// For this window, which is repeated with more ghosts.
  void repeat_with(std::span<const Key> keys);
  /// Begins the next window, which ends at `until` [s], when roles are decided: keys of
  /// absent bats are dropped, and later ones are kept for own bats alone.
  void begin_window(double until, const Roles& roles);
  /// Lets the window end at this time instead.
  void end_at(double until, const Roles& roles);
  /// Keys of live players that took effect on own bats in this window go to the log.
  void note_log(const Roles& roles);

  /// Of this window, in order.
  const std::vector<Key>& due() const { return due_; }
  /// Of own bats.
  const std::vector<Key>& later() const { return later_; }
  /// Of live players, on own bats, in the window that was final last; in order.
  const std::vector<Key>& log() const { return log_; }
  /// Asserts that the window's keys are in order.
  void check() const;

 private:
  std::vector<Key> later_, due_, log_;
};

}  // namespace rink::peer
