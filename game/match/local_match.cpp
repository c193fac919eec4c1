// Runs the game while the flow of the match allows, and shows it as it is.
#include "game/match/local_match.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "game/control/replay.h"
#include "game/model/time_grid.h"

namespace rink::game {

LocalMatch::LocalMatch(const Scene& scene, const LocalMatchSettings& settings)
    : scene_(scene), settings_(settings), flow_(settings.times), sight_(sight_of(scene)) {
  assert(!match_objection(scene) && settings.players.size() == 2);
  for (std::uint32_t player = 0; player < 2; ++player)
    if (settings_.players[player] == Playing::hand) hands_.push_back(player);
  if (hands_.size() == 1) sight_.own_team = scene.bodies.bats[hands_.front()].team;
  sight_.left_name = settings.left_name;
  sight_.right_name = settings.right_name;
}

void LocalMatch::begin(double now_s) {
  if (match_number_ == 0) {
    flow_.enter(0, now_s);
    flow_.enter(1, now_s);
  }
  finish();
  is_finished_ = false;
  match_number_ = flow_.state().number;
  assert(match_number_ > 0 && flow_.is_here(0) && flow_.is_here(1));
  played_s_ = 0.0;
  for (HandSpring& spring : springs_) spring.forget();
  constexpr double forever = 0.0;  // no bot here has its keys drawn beforehand
  playing_ = std::make_unique<Playing>(scene_, settings_.players,
                                       settings_.seed + match_number_ - 1, forever);
}

void LocalMatch::advance(double now_s) {
  assert(std::isfinite(now_s) && now_s >= now_s_ && "real time never falls");
  const double elapsed = now_s_ < 0.0 ? 0.0 : std::min(now_s - now_s_, frame_max_s);
  now_s_ = now_s;
  const bool was_running = flow_.runs();
  flow_.advance(now_s);
  if (flow_.state().number != match_number_ || match_number_ == 0) begin(now_s);
  if (was_running && flow_.runs()) play(elapsed);
  if (flow_.state().phase == MatchPhase::over) finish(), pressed_.clear();
  assert(playing_ != nullptr && playing_->game().player_count() == 2);
  for (const PressedKey& pressed : std::exchange(pressed_, {}))
    playing_->press(hands_[pressed.hand], pressed.key, pressed.is_down);
  if (flow_.runs()) push_bats();
  show();
}

std::optional<KeyLog> LocalMatch::record_so_far() const {
  if (is_finished_ || playing_->game().now() == 0.0) return std::nullopt;
  return log_of(playing_->game(), scene_, settings_.scene_text, playing_->keys());
}

void LocalMatch::finish() {
  if (std::optional<KeyLog> log = record_so_far()) finished_.push_back(*std::move(log));
  is_finished_ = true;
}

void LocalMatch::play(double duration_s) {
  assert(duration_s >= 0.0 && duration_s <= frame_max_s);
  played_s_ += duration_s;
  playing_->advance(std::max(playing_->game().now(), last_on(key_grid, played_s_)));
  if (!playing_->game().is_over()) return;
  const Score& score = playing_->game().score();
  assert(score.left != score.right && "a match that is won has a winner");
  flow_.win(score.left > score.right ? Team::left : Team::right, now_s_);
}

void LocalMatch::press(std::uint32_t hand, Key key, bool is_down) {
  assert(hand < hands_.size());
  pressed_.push_back({hand, key, is_down});
}

void LocalMatch::reach(std::uint32_t hand, const std::optional<Vector2>& place) {
  assert(hand < hands_.size());
  springs_[hand].reach(place);
}

void LocalMatch::push_bats() {
  const Game& game = playing_->game();
  for (std::size_t hand = 0; hand < hands_.size(); ++hand) {
    const std::uint32_t player = hands_[hand];
    const EntityId bat = *game.bat(player);
    const std::optional<Push> push = springs_[hand].next(
        {game.position(bat), game.velocity(bat), key_thrust(game, player), scene_.world.bat_drag},
        now_s_);
    if (push) playing_->push(player, *push);
  }
}

void LocalMatch::pause(bool is_wanted) { flow_.pause(is_wanted, now_s_); }

/// Bots are always ready.
void LocalMatch::rematch() {
  flow_.ask_rematch(0, now_s_);
  flow_.ask_rematch(1, now_s_);
}

void LocalMatch::show() {
  const Game& game = playing_->game();
  game_sight_.show(game, sight_);
  sight_.phase = flow_.state().phase;
  sight_.remaining_s = std::max(0.0, flow_.state().until_s - now_s_);
  sight_.winner = flow_.state().winner;
  noises_.listen(sight_);
  goals_.look(sight_, now_s_, scene_.rules.face_off_delay);
}

}  // namespace rink::game
