// Interest management made visible: cells, every federate's subscription region, and in colour who
// hears of what.
#pragma once

#include <cstdint>
#include <optional>

#include "game/view/match_source.h"
#include "game/view/render/overlay.h"

namespace rink::view {

/// What of it is to be seen.
struct InterestChoice {
  bool is_shown = true;
  std::uint32_t chosen = 0;  ///< the bat that is asked of, counted modulo the bats that are there
  std::optional<std::uint32_t>
      picked{};  ///< the thing that is asked of instead, by its id, as long as it is there
};

/// The thing whose interest is coloured; null if there is none.
const Thing* asked_thing(const MatchSight& sight, const InterestChoice& choice);

/// The nearest thing within `reach` [m] of `place`; nothing if there is none.
std::optional<std::uint32_t> thing_at(const MatchSight& sight, const Vector2& place, double reach);

/// Shows what `sight.interest` says was decided, and works nothing out again; empty without it.
/// Green: what the federate that plays the asked bat hears of. Orange: who hears of what is asked
/// of.
Overlay interest_overlay(const MatchSight& sight, const InterestChoice& choice);

}  // namespace rink::view
