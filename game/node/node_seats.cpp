// Carries wishes to the table at node 0, and its decisions to all.
#include "game/node/node_seats.h"

namespace rink::game {

bool NodeSeats::hear(peer::PeerNumber from, const SeatWish& wish) {
  const bool may_be =
      wish.player < table_.player_count() || (wish.player == no_player && !wish.is_leaving);
  if (own_ != 0 || from >= node_count_ || !may_be || heard_.size() >= wishes_max) return false;
  heard_.emplace_back(from, wish);
  return true;
}

std::vector<SeatDecision> NodeSeats::decide(std::uint64_t window, double now_s) {
  assert(own_ == 0);
  std::vector<SeatDecision> decisions;
  for (const auto& [from, wish] : std::exchange(heard_, {})) {
    std::optional<SeatDecision> decision = table_.decide(from, wish, now_s);
    if (!decision) continue;
    decision->window = window;
    decisions.push_back(*decision);
  }
  return decisions;
}

bool NodeSeats::hear(const SeatDecision& decision) {
  const bool is_bat = decision.player < table_.player_count() || decision.player == no_player;
  const std::uint64_t next = instant_of((window_ >> session_shift) + 1, 0);
  const bool is_soon = (decision.window > window_ && decision.window <= window_ + ahead_max) ||
                       (decision.window >= next && decision.window <= next + ahead_max);
  if (!is_bat || decision.node >= node_count_ || !is_soon ||
      (!decided_.empty() && decision.window < decided_.back().window))
    return false;
  decided_.push_back(decision);
  if (decision.node != own_) return true;
  const std::lock_guard lock(mutex_);
  answers_.push_back(
      {.token = decision.token,
       .player = decision.player == no_player ? std::nullopt : std::optional(decision.player)});
  return true;
}

std::vector<std::uint32_t> NodeSeats::own() const {
  std::vector<std::uint32_t> players;
  for (const auto& [player, node] : holders_)
    if (node == own_) players.push_back(player);
  return players;
}

std::vector<SeatDecision> NodeSeats::due(std::uint64_t window) {
  assert(window >= window_);
  window_ = window;
  std::vector<SeatDecision> due;
  for (; !decided_.empty() && decided_.front().window <= window; decided_.pop_front()) {
    due.push_back(decided_.front());
    if (due.back().player != no_player) holders_[due.back().player] = due.back().node;
  }
  return due;
}

}  // namespace rink::game
