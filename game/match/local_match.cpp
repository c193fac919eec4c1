// Real time goes through the rules around the match; keys take effect at the frame in which they were pressed, a bot's at its own instants.
#include "game/match/local_match.h"

#include <algorithm>
#include <cassert>

#include "game/control/replay.h"

namespace rink::game {

LocalMatch::LocalMatch(const Scene& scene, const LocalMatchSettings& settings)
    : scene_(scene), settings_(settings), flow_(settings.times), game_(scene), sight_(sight_of(scene)) {
  assert(!match_objection(scene));
}

void LocalMatch::press(std::uint32_t hand, Key key, bool is_down) {
  assert(hand < hand_count());
  pressed_.push_back({hand, key, is_down});
}

void LocalMatch::pause(bool is_wanted) { flow_.pause(is_wanted, now_s_); }

void LocalMatch::rematch() {
  for (const std::uint32_t player : {0u, 1u}) flow_.ask_rematch(player, now_s_);
}

void LocalMatch::advance(double now_s) {
  now_s_ = now_s;
  if (!has_begun_)
    for (const std::uint32_t player : {0u, 1u}) flow_.enter(player, now_s);
  has_begun_ = true;
  flow_.advance(now_s);
  if (flow_.state().number != number_) begin();
  const double until = std::max(game_.now(), simulated_at(flow_.state(), now_s));
  if (flow_.state().phase != MatchPhase::over)
    for (const PressedKey& key : pressed_) press_at(until, key);
  pressed_.clear();
  play(until);
  if (flow_.runs() && game_.is_over()) flow_.win(game_.score().left > game_.score().right ? Team::left : Team::right, now_s);
  if (flow_.state().phase == MatchPhase::over) finish();
  show(now_s);
}

void LocalMatch::begin() {
  finish();
  number_ = flow_.state().number;
  is_finished_ = false;
  game_ = Game(scene_);
  decisions_ = 0;
  bot_holds_ = {};
  if (settings_.opponent.empty()) return;
  const Bat& bat = scene_.bodies.bats[1];
  bot_ = make_player(settings_.opponent, rules_of(scene_, 1), {.number = 1, .team = bat.team, .half_extent = bat.body.half_extent}, settings_.seed + number_);
}

void LocalMatch::finish() {
  if (!is_finished_ && game_.now() > 0.0) finished_.push_back(log_of(game_, scene_, settings_.scene_text, std::exchange(events_, {})));
  is_finished_ = true;
  events_.clear();
}

void LocalMatch::press_at(double instant, const PressedKey& key) {
  events_.push_back({instant, key.player, key.is_down ? InputKind::key_down : InputKind::key_up, key.key});
  game_.submit(events_.back());
}

void LocalMatch::play(double until) {
  for (; bot_ && static_cast<double>(decisions_) * decision_period < until; ++decisions_) {
    const double instant = static_cast<double>(decisions_) * decision_period;
    game_.advance(std::max(instant, game_.now()));
    if (flow_.runs() && !game_.is_over()) decide(game_.now());
  }
  game_.advance(until);
}

void LocalMatch::decide(double instant) {
  std::vector<SeenEntity> pucks;
  for (const Entity& entity : game_.entities())
    if (entity.kind == physics::BodyKind::puck && game_.simulator().is_in_play(entity.id))
      pucks.push_back({entity.id.index, entity.kind, game_.position(entity.id), game_.velocity(entity.id), entity.half_extent});
  const EntityId bat = *game_.bat(1);
  const KeysHeld wanted = bot_->decide({.position = game_.position(bat), .velocity = game_.velocity(bat), .pucks = pucks}, instant);
  for (const Key key : all_keys)
    if (wanted.is_down(key) != bot_holds_.is_down(key)) press_at(instant, {1, key, wanted.is_down(key)});
  bot_holds_ = wanted;
}

void LocalMatch::show(double now_s) {
  show_game(game_, sight_);
  const MatchState& state = flow_.state();
  sight_.phase = state.phase;
  sight_.winner = state.winner;
  sight_.remaining_s = state.phase == MatchPhase::countdown ? std::max(0.0, state.until_s - now_s) : 0.0;
  if (!settings_.opponent.empty()) sight_.own_team = Team::left;
  goals_.look(sight_, now_s, scene_.rules.face_off_delay);
  noises_.listen(sight_);
}

}  // namespace rink::game
