// The player of each peer.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "game/control/game.h"
#include "game/net/peer/interest/shared_interest.h"
#include "game/net/peer/network/greetings.h"
#include "game/peer/cuts.h"

namespace rink::game {

/// A division with one of the bats in each zone, and by peer the body of its bat.
struct SeatedDivision {
  peer::Cuts cuts;
  peer::Division division;
  std::vector<std::uint32_t> bats;
};
/// The division for the first `peer_count` players (at most as many as there are: asserted).
SeatedDivision seated_division(const Game& start, peer::PeerNumber peer_count);

/// By peer, the body that its player moves, or no_bat: the one in its zone if the terms seat them,
/// else the first of the bats that it plays. Throws peer::ProtocolError if there is no such bat.
std::vector<std::uint32_t> bats_of_peers(const Game& start, const Terms& terms,
                                         std::span<const PeerInfo> peer_infos);

/// The settings for a view of `half_side` and `margin` [m].
InterestSettings interest_settings(const Game& start, const Terms& terms,
                                   std::span<const PeerInfo> peer_infos, double half_side,
                                   double margin);

}  // namespace rink::game
