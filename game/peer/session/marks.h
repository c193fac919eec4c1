// What a peer has agreed on with all others, in a form that shows who was told something else.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "game/peer/session/loss.h"
#include "game/peer/session/session_state.h"

namespace rink::peer {

/// Whoever says one thing to all and plays another finds faults in the others, where they find none
/// in each other. A round needs words of all, so peers are at most one round apart: of the last two
/// marks, all have one in common.
class Marks {
 public:
  /// The words of all members, the same at all, of the next round after `step`.
  void note_round(std::uint64_t step, std::span<const std::vector<std::uint8_t>> words);
  /// With the states at the last two steps.
  std::vector<Mark> told(const State& now, const State& before) const;
  /// Whether `others` has another digest of what is here, too.
  static bool differ(std::span<const Mark> own, std::span<const Mark> others);

 private:
  std::vector<Mark> rounds_;  ///< the last two
};

}  // namespace rink::peer
