// The matches that the window of rink play shows.
#pragma once

#include <memory>

#include "game/apps/play_flags.h"
#include "game/match/match_source.h"

namespace rink::view {

/// Begins the match of the menu or the command line. Throws std::exception that says why it cannot
/// be played.
std::unique_ptr<game::MatchSource> make_match(const MatchWish& wish, const PlayOptions& options);

}  // namespace rink::view
