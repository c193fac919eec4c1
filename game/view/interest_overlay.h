// Interest management made visible: the grid's cells, every bat's view, and in colour what the chosen bat's view takes in.
#pragma once

#include <cstdint>

#include "game/view/match_source.h"
#include "game/view/render/overlay.h"

namespace rink::view {

/// What to show, in the server's and clients' own terms.
struct InterestChoice {
  double cell_size = 0.0;      ///< of the grid scheme [m]; 0: none
  double view_fraction = 0.0;  ///< of the field's area that a client sees around its bat (as rink bots --view); 0: none
  std::uint32_t chosen = 0;    ///< the bat whose interest is coloured, counted modulo the bats that are there
};

/// Views follow the same rule as clients declare them by (game/net/view.h), and an entity is in a view when its box touches it: what ought to be heard, not a record of what was.
/// The bat whose interest is coloured; null if there is none.
const Thing* chosen_bat(const MatchSight& sight, const InterestChoice& choice);

Overlay interest_overlay(const MatchSight& sight, const InterestChoice& choice);

}  // namespace rink::view
