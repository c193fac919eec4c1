// Shows a game that peers share: the zones, the own halo, and bodies of others.
#pragma once

#include "game/view/match_source.h"
#include "game/view/render/overlay.h"

namespace rink::view {

/// Shows `sight.zones`; empty without it. The own bat is always marked in a crowd, all else only if
/// `is_shown`. Orange: ghosts; green: replicas beyond the halo.
Overlay zones_overlay(const MatchSight& sight, bool is_shown);

}  // namespace rink::view
