// The part of the server that hosts matches: begins them, follows their rules, answers who asks for
// the time, and keeps their records.
#include <algorithm>
#include <cassert>

#include "game/control/replay.h"
#include "game/model/time_grid.h"
#include "game/net/server/server.h"
#include "game/replication/attributes.h"

namespace rink::game {

void Server::announce_match() {
  for (const rti::InteractionClassHandle interaction : {model_.pause, model_.rematch, model_.ping})
    ambassador_.subscribe_interaction_class(interaction);
  ambassador_.publish_interaction_class(model_.pong);
  ambassador_.publish_object_class_attributes(
      model_.match, {model_.match_state, model_.match_scene, model_.match_tick});
  match_ = ambassador_.register_object_instance(model_.match, "match");
  std::vector<std::byte> bytes;
  const SceneText scene{std::as_bytes(std::span(hosting_->scene_text))};
  ambassador_.update_attribute_values(match_, {model_.match_scene, model_.match_tick},
                                      encode(bytes, scene, TickPeriod{tick_s_}), {});
  publish_match({});
}

void Server::publish_match(const rti::Stamp& stamp) {
  MatchState state = flow_->state();
  state.is_unrecorded = is_unrecorded_;
  if (published_match_ == state) return;
  published_match_ = state;
  std::vector<std::byte> bytes;
  ambassador_.update_attribute_values(match_, {model_.match_state},
                                      encode(bytes, *published_match_), stamp);
}

/// Simulated time as players count on it; a countdown's end is foreseen, so that keys that are
/// stamped for the first instants of play are not late.
double Server::simulated_at_clock(double now) const {
  return std::max(flow_ ? simulated_at(flow_->state(), now) : now, game_.now());
}

double Server::follow_match(double real_s) {
  assert(flow_);
  flow_->advance(real_s);
  if (flow_->state().number != match_number_) begin_match();
  if (flow_->state().phase == MatchPhase::over) finish_record();
  if (flow_->state().phase == MatchPhase::countdown) return game_.now();
  const double simulated = simulated_at(flow_->state(), real_s);
  return std::max(game_.now(), flow_->runs() ? last_on(tick_grid, simulated) : simulated);
}

void Server::begin_match() {
  finish_record();  // of one that was given up
  is_recorded_ = false;
  match_number_ = flow_->state().number;
  for (const Pending& pending : pending_) ++felt_[pending.player];
  pending_.clear();
  for (std::optional<Seat>& seat : seats_)
    if (seat) seat->held = {}, seat->last_key_s = 0.0;
  publisher_->retire_all();
  record_.clear();
  earlier_s_ += game_.now();
  game_ = Game(*scene_);
}

void Server::finish_record() {
  if (is_recorded_ || game_.now() == 0.0) return;
  is_recorded_ = true;
  finished_.push_back(log_of(game_, *scene_, hosting_->scene_text, std::exchange(record_, {})));
}

void Server::answer(rti::FederateHandle sender, std::uint64_t number) {
  ambassador_.send_directed_interaction(model_.pong, sender, {}, {.time = now_(), .tag = number});
  is_urgent_ = true;
}

void Server::receive_wish(Seat& seat, rti::InteractionClassHandle interaction,
                          rti::Bytes parameters) {
  if (!flow_) return;
  PauseWish wish;
  if (interaction == model_.rematch) flow_->ask_rematch(seat.player, now_());
  else if (decode(parameters, wish)) flow_->pause(wish.is_wanted != 0, now_());
}

/// A bat whose player has left stays, but nobody pushes it.
void Server::release_keys(Seat& seat) {
  if (!are_keys_felt()) return;
  for (const Key key : all_keys)
    if (seat.held.is_down(key))
      submit({.time = next_on(key_grid, std::max(simulated_now(), seat.last_key_s)),
              .player = seat.player,
              .kind = InputKind::key_up,
              .key = key});
  seat.held = {};
}

bool Server::are_keys_felt() const {
  if (is_replay_) return false;
  return !flow_ ||
         (flow_->state().phase != MatchPhase::waiting && flow_->state().phase != MatchPhase::over);
}

}  // namespace rink::game
