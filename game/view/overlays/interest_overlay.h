// Shows interest management: cells, every federate's subscription region, and in colour which
// player receives what.
#pragma once

#include <cstdint>
#include <optional>

#include "game/view/match_source.h"
#include "game/view/render/overlay.h"

namespace rink::view {

/// The choice of what to show.
struct InterestChoice {
  bool is_shown = true;
  std::uint32_t chosen = 0;  ///< the inspected bat, counted modulo the number of bats
  std::optional<std::uint32_t>
      picked{};  ///< the inspected thing instead, by its id, while it exists
};

/// The thing whose interest is coloured; null if there is none.
const Thing* asked_thing(const MatchSight& sight, const InterestChoice& choice);

/// The nearest thing within `reach` [m] of `place`; nothing if there is none.
std::optional<std::uint32_t> thing_at(const MatchSight& sight, const Vector2& place, double reach);

/// Shows the decisions in `sight.interest` without deciding again; empty without it. Green: things
/// that the inspected bat's player receives. Orange: players that receive the inspected thing.
Overlay interest_overlay(const MatchSight& sight, const InterestChoice& choice);

}  // namespace rink::view
