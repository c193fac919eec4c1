// Assigns players to peers, by zones or by order of joining.
#include "game/net/peer/network/seating.h"

#include <algorithm>
#include <cassert>

#include "game/peer/protocol.h"

namespace rink::game {

SeatedDivision seated_division(const Game& start, peer::PeerNumber peer_count) {
  assert(peer_count <= start.player_count());
  std::vector<Vector2> places;
  for (peer::PeerNumber player = 0; player < peer_count; ++player)
    places.push_back(start.position(*start.bat(player)));
  peer::Cuts cuts = peer::Cuts::by_count(start.world().spec().field, places, peer_count);
  SeatedDivision seated{cuts, cuts.division(peer_count), std::vector<std::uint32_t>(peer_count)};
  std::vector<bool> is_taken(peer_count, false);
  std::vector<std::uint32_t> others;
  for (peer::PeerNumber player = 0; player < peer_count; ++player) {
    const peer::PeerNumber owner = seated.division.owner_of(places[player]);
    const std::uint32_t bat = start.bat(player)->index;
    if (is_taken[owner]) others.push_back(bat);
    else is_taken[owner] = true, seated.bats[owner] = bat;
  }
  // Bats in one line cannot always be separated by cuts.
  for (peer::PeerNumber peer = 0; peer < peer_count; ++peer)
    if (!is_taken[peer]) seated.bats[peer] = others.back(), others.pop_back();
  return seated;
}

std::vector<std::uint32_t> bats_of_peers(const Game& start, const Terms& terms,
                                         std::span<const PeerInfo> peer_infos) {
  const std::string there = "the scene has " + std::to_string(start.player_count()) + " bats";
  if (terms.is_seated && terms.peer_count > start.player_count())
    throw peer::ProtocolError("each of " + std::to_string(terms.peer_count) +
                              " peers is to have a player, but " + there);
  if (terms.is_seated) return seated_division(start, terms.peer_count).bats;
  std::vector<std::uint32_t> bats(terms.peer_count, no_bat);
  for (peer::PeerNumber peer = 0; peer < std::min<std::size_t>(peer_infos.size(), terms.peer_count);
       ++peer) {
    if (peer_infos[peer].bat_count == 0) continue;
    if (peer_infos[peer].first_bat >= start.player_count())
      throw peer::ProtocolError("peer " + std::to_string(peer) + " plays bat " +
                                std::to_string(peer_infos[peer].first_bat) + ", but " + there);
    bats[peer] = start.bat(peer_infos[peer].first_bat)->index;
  }
  return bats;
}

InterestSettings interest_settings(const Game& start, const Terms& terms,
                                   std::span<const PeerInfo> peer_infos, double half_side,
                                   double margin) {
  InterestSettings settings;
  settings.scheme = terms.interest.scheme, settings.policy = terms.interest.policy,
  settings.cell_size = terms.interest.cell_size;
  settings.half_side = half_side, settings.margin = margin;
  settings.always_relevant = RelevantKinds::of_bits(terms.interest.always);
  settings.rate_hz = 1.0 / terms.window;
  settings.bats = bats_of_peers(start, terms, peer_infos);
  return settings;
}

}  // namespace rink::game
