// A player's own bat comes first, then the one that it likes best, then any. Its token is made of
// its name, which a player of another node may bear too: so the bat that was left at the same node
// comes before one that was left elsewhere.
#include "game/node/seat_table.h"

#include <algorithm>
#include <cassert>

namespace rink::game {

SeatTable::SeatTable(std::uint32_t player_count, double lease_s)
    : seats_(player_count), lease_s_(lease_s) {
  assert(lease_s >= 0.0);
}

void SeatTable::assign(peer::PeerNumber node, std::uint32_t first, std::uint32_t count) {
  assert(first <= seats_.size() && count <= seats_.size() - first);
  for (std::uint32_t player = first; player < first + count; ++player) {
    assert(!seats_[player].is_taken);
    seats_[player] = {.node = node, .is_taken = true};
  }
}

std::optional<SeatDecision> SeatTable::decide(peer::PeerNumber node, const SeatWish& wish,
                                              double now_s) {
  if (wish.is_leaving) {
    if (wish.player >= seats_.size()) return std::nullopt;
    Seat& seat = seats_[wish.player];
    if (seat.is_taken && seat.node == node)
      seat = {.node = node,
              .token = wish.token,
              .leased_until = wish.token == SharedPlay::nobody ? now_s : now_s + lease_s_};
    return std::nullopt;
  }
  SeatDecision decision{.node = node, .player = choice(node, wish, now_s), .token = wish.token};
  if (decision.player != no_player)
    seats_[decision.player] = {.node = node, .is_taken = true, .token = wish.token};
  return decision;
}

std::uint32_t SeatTable::choice(peer::PeerNumber node, const SeatWish& wish, double now_s) const {
  const auto is_own = [&](const Seat& seat) {
    return !seat.is_taken && now_s < seat.leased_until && seat.token == wish.token;
  };
  const auto is_any = [&](const Seat& seat) { return is_free(seat, wish.token, now_s); };
  auto seat = std::ranges::find_if(
      seats_, [&](const Seat& each) { return is_own(each) && each.node == node; });
  if (seat == seats_.end()) seat = std::ranges::find_if(seats_, is_own);
  if (seat == seats_.end() && wish.player < seats_.size() && is_any(seats_[wish.player]))
    return wish.player;
  if (seat == seats_.end()) seat = std::ranges::find_if(seats_, is_any);
  return seat == seats_.end() ? no_player : static_cast<std::uint32_t>(seat - seats_.begin());
}

}  // namespace rink::game
