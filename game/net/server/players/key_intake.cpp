// Takes keys and pushes from the wire; one over its player's limit is acknowledged like any other,
// so that the player does not wait for it.
#include "game/net/server/players/key_intake.h"

#include <algorithm>
#include <cassert>

#include "game/model/time_grid.h"
#include "game/replication/attributes.h"

namespace rink::game {
namespace {

/// How far ahead a player may stamp its keys [s], far more than jitter needs; a player that stamps
/// them later only delays itself.
constexpr double key_lead_max = 0.25;

}  // namespace

KeyIntake::KeyIntake(std::uint32_t player_count, double limit_per_s, double push_limit_per_s)
    : limit_per_s_(limit_per_s),
      push_limit_per_s_(push_limit_per_s),
      hands_(player_count, fresh_hand(0.0)),
      felt_(player_count) {}

KeyIntake::Hand KeyIntake::fresh_hand(double now_s) const {
  return {.allowance = {limit_per_s_, now_s}, .push_allowance = {push_limit_per_s_, now_s}};
}

void KeyIntake::enter(std::uint32_t player, double now_s) {
  assert(player < hands_.size());
  hands_[player] = fresh_hand(now_s);
  felt_[player] = 0;
}

void KeyIntake::leave(std::uint32_t player) {
  assert(player < hands_.size());
  std::erase_if(waiting_, [player](const Waiting& key) { return key.player == player; });
}

std::optional<InputEvent> KeyIntake::accept(std::uint32_t player, bool is_down, rti::Bytes message,
                                            const KeyArrival& arrival) {
  assert(player < hands_.size());
  ++counters_.received;
  KeyCharacter character;
  const std::optional<Key> key = decode(message, character)
                                     ? key_from_character(static_cast<char>(character.character))
                                     : std::nullopt;
  if (!key) {
    ++counters_.refused;
    return std::nullopt;
  }
  const std::optional<double> time = admit(player, Input::key, arrival);
  if (!time) return std::nullopt;
  hands_[player].held.set(*key, is_down);
  return InputEvent{.time = *time,
                    .player = player,
                    .kind = is_down ? InputKind::key_down : InputKind::key_up,
                    .key = *key};
}

std::optional<InputEvent> KeyIntake::accept_push(std::uint32_t player, rti::Bytes message,
                                                 const KeyArrival& arrival) {
  assert(player < hands_.size());
  PushSteps steps;
  if (!decode(message, steps)) {
    refuse_push();
    return std::nullopt;
  }
  ++counters_.received, ++counters_.pushes;
  // The end of a push is always felt: its player would not send it again.
  const bool is_end = push_of(steps) == Push() && hands_[player].push != Push();
  const std::optional<double> time = admit(player, is_end ? Input::push_end : Input::push, arrival);
  if (!time) return std::nullopt;
  hands_[player].push = push_of(steps);
  return InputEvent{
      .time = *time, .player = player, .kind = InputKind::push, .push = hands_[player].push};
}

/// When a sound key change or push takes effect; nothing if it is only acknowledged.
std::optional<double> KeyIntake::admit(std::uint32_t player, Input input,
                                       const KeyArrival& arrival) {
  Hand& hand = hands_[player];
  const double time = stamp(hand, arrival);
  waiting_.push_back({.time = time, .player = player});
  rti::TokenBucket& allowance = input == Input::key ? hand.allowance : hand.push_allowance;
  if (input != Input::push_end && !allowance.take(1.0, arrival.now_s)) {
    ++counters_.over_limit;
    counters_.player_over_limit = player;
    counters_.is_push_over_limit = input == Input::push;
    return std::nullopt;
  }
  if (!arrival.is_felt) return std::nullopt;
  waiting_.back().is_submitted = true;
  return time;
}

double KeyIntake::stamp(Hand& hand, const KeyArrival& arrival) {
  const double earliest = arrival.simulated_s;
  if (!arrival.wanted_s) return earliest;
  if (*arrival.wanted_s < earliest - 1e-4) ++counters_.late;
  const double wanted = std::min(*arrival.wanted_s, earliest + key_lead_max);
  return hand.last_key_s = next_on(key_grid, std::max({earliest, hand.last_key_s, wanted}));
}

std::vector<InputEvent> KeyIntake::release(std::uint32_t player, double simulated_s) {
  assert(player < hands_.size());
  Hand& hand = hands_[player];
  const double time = next_on(key_grid, std::max(simulated_s, hand.last_key_s));
  std::vector<InputEvent> events;
  for (const Key key : all_keys)
    if (hand.held.is_down(key))
      events.push_back({.time = time, .player = player, .kind = InputKind::key_up, .key = key});
  if (hand.push != Push{})
    events.push_back({.time = time, .player = player, .kind = InputKind::push});
  hand.held = {}, hand.push = {};
  return events;
}

void KeyIntake::feel_until(double until) {
  std::erase_if(waiting_, [&](const Waiting& key) {
    if (key.time > until) return false;
    ++felt_[key.player];
    ++counters_.applied;
    return true;
  });
}

/// Keys that were pressed by nobody who waits for them, as those of a player that has left, are
/// none of its.
void KeyIntake::feel_next(std::uint32_t player) {
  const auto key = std::ranges::find_if(waiting_, [player](const Waiting& each) {
    return each.player == player && each.is_submitted;
  });
  if (key == waiting_.end()) return;
  waiting_.erase(key);
  ++felt_[player];
  ++counters_.applied;
}

void KeyIntake::feel_unsubmitted() {
  std::vector<bool> is_blocked(waiting_.empty() ? 0 : felt_.size());
  std::vector<Waiting> kept;
  for (const Waiting& key : waiting_) {
    if (key.is_submitted) is_blocked[key.player] = true;
    if (is_blocked[key.player]) kept.push_back(key);
    else ++felt_[key.player], ++counters_.applied;
  }
  waiting_ = std::move(kept);
}

void KeyIntake::begin() {
  for (const Waiting& key : waiting_) ++felt_[key.player];
  waiting_.clear();
  for (Hand& hand : hands_) hand.held = {}, hand.push = {}, hand.last_key_s = 0.0;
  record_.clear();
}

}  // namespace rink::game
