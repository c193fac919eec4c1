// The own player's keys between being pressed here and taking effect at the server.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <deque>
#include <limits>

#include "game/model/key.h"

namespace rink::game {

/// Keeps each key until an update includes its effect, in order of time, so that reconciliation can
/// apply them again.
class PendingKeys {
 public:
  struct PressedKey {
    double instant;  ///< at which it takes effect [s]
    Key key;
    bool is_down;
  };

  /// `count` keys took effect before all that are pressed here.
  void count_from(std::uint32_t count) { felt_ = std::max(felt_, count); }
  /// Adds a key that takes effect at `instant` [s], but not before the last one.
  void press(Key key, bool is_down, double instant) {
    assert(std::isfinite(instant));
    keys_.push_back(
        {keys_.empty() ? instant : std::max(instant, keys_.back().instant), key, is_down});
  }
  /// Drops the first `count` of all keys ever pressed, whose effect is known, and marks the others
  /// to be applied again.
  void felt(std::uint32_t count) {
    for (; felt_ < count && !keys_.empty(); ++felt_) keys_.pop_front();
    felt_ = std::max(felt_, count);
    applied_ = 0;
  }
  void apply_again() { applied_ = 0; }
  /// The next key to apply up to `instant`, which then counts as applied; null if there is none.
  /// Valid until the next key is pressed.
  const PressedKey* take_until(double instant) {
    return next_instant() <= instant ? &keys_[applied_++] : nullptr;
  }
  /// Infinite if all are applied.
  double next_instant() const {
    return applied_ < keys_.size() ? keys_[applied_].instant
                                   : std::numeric_limits<double>::infinity();
  }
  std::size_t count() const { return keys_.size(); }
  void check() const {
    assert(applied_ <= keys_.size());
    assert(std::ranges::is_sorted(keys_, {}, &PressedKey::instant));
  }

 private:
  std::deque<PressedKey> keys_;  ///< from the first that is not known to be felt
  std::uint32_t felt_ = 0;       ///< those before
  std::size_t applied_ = 0;      ///< of keys_
};

}  // namespace rink::game
