// The own player's keys and pushes between being made here and taking effect at the server.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>

#include "game/model/key.h"

namespace rink::game {

/// Keeps each key and each push, which counts as a key, until an update includes its effect, in
/// order of time, so that reconciliation can apply them again.
class PendingKeys {
 public:
  struct PressedKey {
    double instant;  ///< at which it takes effect [s]
    Key key;
    bool is_down;
    std::optional<Push> push{};  ///< instead of the key
  };

  /// `count` keys took effect before all that are pressed here.
  void count_from(std::uint32_t count) { felt_ = std::max(felt_, count); }
  /// Adds a key that takes effect at `instant` [s], but not before the last one.
  void press(Key key, bool is_down, double instant) { add({instant, key, is_down}); }
  void push(const Push& push, double instant) { add({instant, Key::left, false, push}); }
  /// Drops the first `count` of all keys ever pressed, whose effect is known, and marks the others
  /// to be applied again.
  void felt(std::uint32_t count) {
    for (; felt_ < count && !keys_.empty(); ++felt_) {
      if (keys_.front().push) felt_push_ = *keys_.front().push;
      keys_.pop_front();
    }
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
  /// The last push that is known to be felt.
  const Push& felt_push() const { return felt_push_; }
  void check() const {
    assert(applied_ <= keys_.size());
    assert(std::ranges::is_sorted(keys_, {}, &PressedKey::instant));
  }

 private:
  void add(PressedKey pressed) {
    assert(std::isfinite(pressed.instant));
    if (!keys_.empty()) pressed.instant = std::max(pressed.instant, keys_.back().instant);
    keys_.push_back(pressed);
  }

  std::deque<PressedKey> keys_;  ///< from the first that is not known to be felt
  std::uint32_t felt_ = 0;       ///< those before
  Push felt_push_;
  std::size_t applied_ = 0;  ///< of keys_
};

}  // namespace rink::game
