// Shows bodies while wrong predictions of them are corrected.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <optional>
#include <vector>

#include "game/match/blend.h"

namespace rink::game {

/// m: a puck that is further off was moved by the rules, into a goal or onto a spot.
inline constexpr double blended_furthest = 0.3;

/// The jumps of one kind of body on updates of the server, before they are blended away.
struct Corrections {
  static constexpr double visible = 2e-3;  ///< m: a pixel of a field 2.4 m long on 1,280 pixels
  std::uint64_t visible_count = 0;
  double greatest = 0.0, sum = 0.0, last_visible = 0.0;  ///< m; `sum` is of the visible ones
  void count(double jump) {
    assert(jump >= 0.0);
    greatest = std::max(greatest, jump);
    if (jump <= visible) return;
    ++visible_count;
    sum += jump;
    last_visible = jump;
  }
};

/// Blends away jumps of bats, then pucks, and measures them.
class JumpBlends {
 public:
  JumpBlends(std::size_t bats, std::size_t pucks, std::optional<std::uint32_t> own_bat)
      : bat_count_(bats), own_bat_(own_bat), blends_(bats + pucks) {
    assert(!own_bat || *own_bat < bats);
  }

  /// `body` was shown `jump` [m] away from its place at the instant `now` [s] by the latest update.
  void jump(std::size_t body, const physics::Vector2& jump, double now) {
    assert(body < blends_.size());
    const double length = jump.norm();
    if (length > blended_furthest && body >= bat_count_) return forget(body);
    if (length == 0.0) return;
    corrections_of(body).count(length);
    blends_[body].begin(jump + blends_[body].at(now), now);
  }
  /// Shows the body at its place from now on.
  void forget(std::size_t body) {
    assert(body < blends_.size());
    blends_[body] = {};
  }
  void forget_all() { blends_.assign(blends_.size(), {}); }
  /// The offset of the shown place of `body` [m].
  physics::Vector2 at(std::size_t body, double now) const {
    assert(body < blends_.size());
    return blends_[body].at(now);
  }

  const Corrections& of_own_bat() const { return own_; }
  const Corrections& of_other_bats() const { return others_; }
  const Corrections& of_pucks() const { return pucks_; }

 private:
  Corrections& corrections_of(std::size_t body) {
    if (body >= bat_count_) return pucks_;
    return own_bat_ == body ? own_ : others_;
  }

  std::size_t bat_count_;
  std::optional<std::uint32_t> own_bat_;
  std::vector<Blend> blends_;
  Corrections own_, others_, pucks_;
};

}  // namespace rink::game
