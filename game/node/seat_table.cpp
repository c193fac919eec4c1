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

SeatDecision SeatTable::decide(peer::PeerNumber node, const SeatWish& wish, double now_s) {
  SeatDecision decision{
      .change = wish.change, .node = node, .player = no_player, .token = wish.token};
  if (wish.change == SeatChange::enter) decision.player = choice(node, wish, now_s);
  else if (wish.player < seats_.size() && seats_[wish.player].is_taken &&
           seats_[wish.player].node == node)
    decision.player = wish.player;
  apply(decision, now_s);
  return decision;
}

void SeatTable::apply(const SeatDecision& decision, double now_s) {
  if (decision.player >= seats_.size()) return;
  Seat& seat = seats_[decision.player];
  const bool is_left = decision.change == SeatChange::leave;
  seat = {.node = decision.node, .is_taken = !is_left, .token = decision.token};
  if (is_left) seat.leased_until = decision.token == SharedPlay::nobody ? now_s : now_s + lease_s_;
}

std::vector<SeatTable::Seated> SeatTable::inherit(peer::PeerNumber from, peer::PeerNumber to) {
  std::vector<Seated> inherited;
  for (std::uint32_t player = 0; player < seats_.size(); ++player) {
    Seat& seat = seats_[player];
    if (!seat.is_taken || seat.node != from) continue;
    seat.node = to;
    inherited.push_back({player, seat.token});
  }
  return inherited;
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
