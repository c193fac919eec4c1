// The turns in which objects in scope are updated where not all are updated at once.
#pragma once

#include <array>
#include <cassert>
#include <cstdint>

#include "rti/distribution/late_states.h"
#include "rti/objects/bitmap.h"

namespace rink::rti {

/// One federate's turns, under a filter that decides tiers, holds updates back or has a budget.
/// Sets of objects by slot.
struct Turns {
  /// An object in tier k is updated every 2^k-th match, at most this k: objects take turns by their
  /// slots, and the turns of 64 of them fit a word.
  static constexpr std::uint32_t tier_max = 6;

  std::array<Bitmap, tier_max> tiers;  ///< in scope and in tier 1, 2 ...; the others are in tier 0
  Bitmap held;                         ///< updated when they are due alone
  Bitmap prompt;  ///< changed their tiers or became due since the last flush: what is late of them
                  ///< waits no longer
  std::uint64_t number =
      0;  ///< of the federate's turn, if it is not updated at every match; else 0
  std::uint64_t shared_out = 0;  ///< the match whose budget is spent
  LateStates late;

  // The three sets of one flush.
  Bitmap waiting;    ///< in scope, and not updated
  Bitmap caught_up;  ///< sent their late attributes from the newest state, which this flush's
                     ///< updates lack
  Bitmap reflected;  ///< updated by this flush's updates
};

/// The slots whose turn it is at `match` in tier `tier`, as a word that is the same for every 64
/// slots.
constexpr std::uint64_t turn_of(std::uint64_t match, std::uint32_t tier) {
  assert(tier <= Turns::tier_max);
  const std::uint32_t period = 1u << tier;
  std::uint64_t slots = 0;
  for (std::uint32_t slot = static_cast<std::uint32_t>((period - match % period) % period);
       slot < 64; slot += period)
    slots |= std::uint64_t{1} << slot;
  return slots;
}

}  // namespace rink::rti
