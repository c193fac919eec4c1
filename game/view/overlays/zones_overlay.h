// A game that peers share, made visible: whose zone is where, how far the own halo reaches, and
// which bodies are another's.
#pragma once

#include "game/view/match_source.h"
#include "game/view/render/overlay.h"

namespace rink::view {

/// Shows what `sight.zones` says; empty without it. The own bat is marked in any case if it is one
/// of a crowd, all else if `is_shown`. Orange: ghosts; green: what is beyond the halo, and told.
Overlay zones_overlay(const MatchSight& sight, bool is_shown);

}  // namespace rink::view
