// Carries wishes to the table at the referee, and its decisions to all.
#include "game/node/node_seats.h"

#include <algorithm>

namespace rink::game {
namespace {

bool gives(const SeatDecision& decision) {
  return decision.change == SeatChange::enter && decision.player != no_player;
}

std::vector<std::uint32_t> held_by(peer::PeerNumber node,
                                   const std::map<std::uint32_t, peer::PeerNumber>& holders) {
  std::vector<std::uint32_t> players;
  for (const auto& [player, holder] : holders)
    if (holder == node) players.push_back(player);
  return players;
}

}  // namespace

std::vector<SeatWish> NodeSeats::take_wishes() {
  std::vector<SeatWish> taken;
  {
    const std::lock_guard lock(mutex_);
    taken = std::exchange(wishes_, {});
  }
  open_.insert(open_.end(), taken.begin(), taken.end());
  return taken;
}

bool NodeSeats::hear(peer::PeerNumber from, const SeatWish& wish) {
  const bool may_be = wish.player < table_.player_count() ||
                      (wish.player == no_player && wish.change == SeatChange::enter);
  if (own_ != referee_ || from >= node_count_ || !may_be || heard_.size() >= wishes_max)
    return false;
  heard_.emplace_back(from, wish);
  return true;
}

std::vector<SeatDecision> NodeSeats::decide(std::uint64_t window, double now_s) {
  assert(own_ == referee_);
  std::vector<SeatDecision> decisions;
  std::stable_partition(heard_.begin(), heard_.end(),
                        [](const auto& each) { return each.second.change != SeatChange::enter; });
  for (const auto& [from, wish] : std::exchange(heard_, {})) {
    decisions.push_back(table_.decide(from, wish, now_s));
    decisions.back().window = window;
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
  if (may_go_back_) return true;
  if (own_ != referee_) table_.apply(decision, 0.0);  // matches lease no bats
  answer(decision), close(decision);
  return true;
}

/// The own wish that it answers is not repeated.
void NodeSeats::close(const SeatDecision& decision) {
  if (decision.node != own_) return;
  const auto answered =
      std::ranges::find_if(open_, [&](const SeatWish& wish) { return decision.answers(wish); });
  if (answered != open_.end()) open_.erase(answered);
}

void NodeSeats::answer(const SeatDecision& decision) {
  if (decision.node != own_ || decision.change != SeatChange::enter) return;
  const std::lock_guard lock(mutex_);
  answers_.push_back(
      {.token = decision.token,
       .player = decision.player == no_player ? std::nullopt : std::optional(decision.player)});
}

std::vector<std::uint32_t> NodeSeats::own() const { return held_by(own_, holders_); }

std::vector<std::uint32_t> NodeSeats::held_in_round(peer::PeerNumber node) const {
  return held_by(node, held_in_round_);
}

/// Nodes are at most a window apart: all have come to the one before.
std::vector<SeatDecision> NodeSeats::due(std::uint64_t window, double now_s) {
  assert(window >= window_);
  window_ = window;
  for (; !due_.empty() && due_.front().window < window; due_.pop_front())
    make_final(due_.front(), now_s);
  std::vector<SeatDecision> due;
  for (; !decided_.empty() && decided_.front().window <= window; decided_.pop_front()) {
    due.push_back(decided_.front());
    if (may_go_back_) due_.push_back(due.back());
    if (gives(due.back())) holders_[due.back().player] = due.back().node;
  }
  return due;
}

void NodeSeats::make_final(const SeatDecision& decision, double now_s) {
  final_.apply(decision, now_s);
  if (gives(decision)) final_holders_[decision.player] = decision.node;
  answer(decision), close(decision);
}

void NodeSeats::rewind(std::uint64_t window, double now_s) {
  assert(may_go_back_);
  window_ = window;
  const auto is_undone = [window](const SeatDecision& each) { return each.window > window; };
  decided_.insert(decided_.begin(), due_.begin(), due_.end());
  std::erase_if(decided_, is_undone);
  due_.clear();
  for (const SeatDecision& decision : std::exchange(decided_, {})) make_final(decision, now_s);
  holders_ = final_holders_;
  table_ = final_;
  heard_.clear();
  const std::lock_guard lock(mutex_);
  wishes_.insert(wishes_.begin(), open_.begin(), open_.end());
  open_.clear();
}

void NodeSeats::follow(peer::PeerNumber referee) {
  if (std::exchange(referee_, referee) == referee) return;
  const std::lock_guard lock(mutex_);
  wishes_.insert(wishes_.begin(), open_.begin(), open_.end());
  open_.clear();
}

std::vector<SeatTable::Seated> NodeSeats::lose(peer::PeerNumber node) {
  assert(!may_go_back_);
  std::erase_if(heard_, [node](const auto& wish) { return wish.first == node; });
  return table_.inherit(node, referee_);
}

std::vector<SeatTable::Seated> NodeSeats::lose(const std::vector<peer::PeerNumber>& lost,
                                               peer::PeerNumber referee) {
  referee_ = referee;
  std::vector<SeatTable::Seated> inherited;
  for (const peer::PeerNumber node : lost)
    for (const SeatTable::Seated& seated : final_.inherit(node, referee)) {
      inherited.push_back(seated);
      holders_[seated.player] = final_holders_[seated.player] = referee;
    }
  std::ranges::sort(inherited, {}, &SeatTable::Seated::player);
  table_ = final_;
  return inherited;
}

}  // namespace rink::game
