// The view's names of the types that it shows.
#pragma once

#include "game/match/match_source.h"

namespace rink::view {

using game::LinkFigures;
using game::MatchSight;
using game::MatchSource;
using game::Noise;
using game::Thing;
using physics::Vector2;
using Phase = game::MatchPhase;

}  // namespace rink::view
