// Seats players, stamps their keys with the simulated instant of their arrival, and steps the game.
#include "game/net/server/server.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "game/model/time_grid.h"
#include "game/replication/names.h"

namespace rink::game {
namespace {

/// How far ahead a player may stamp its keys [s]: what it needs against jitter is far less, and who
/// stamps them later only hurts itself.
constexpr double key_lead_max = 0.25;

}  // namespace

Server::Server(const rti::Fom& fom, const Scene& scene, const ServerSettings& settings,
               std::function<double()> now)
    : model_(fom),
      now_(std::move(now)),
      game_(settings.begun ? settings.begun->copy() : Game(scene)),
      is_replay_(settings.replay.has_value()),
      policy_(make_update_policy(settings.policy, {.threshold = settings.threshold})),
      sweep_(settings.sweep_ticks, settings.tick_s),
      ambassador_(fom, *this),
      always_relevant_(settings.always_relevant.value_or(relevant_kinds_of(scene))),
      key_limit_per_s_(settings.key_limit_per_s),
      is_synchronous_(settings.is_synchronous),
      is_time_managed_(settings.is_time_managed),
      tick_s_(settings.tick_s) {
  assert(!settings.hosting ||
         (!is_replay_ && !match_objection(scene) && !is_time_managed_ && !settings.begun));
  if (settings.hosting) {
    hosting_ = settings.hosting;
    scene_ = scene;
    flow_.emplace(hosting_->times);
  }
  assert(policy_ && "the command line is checked against update_policy_names()");
  is_taken_.resize(game_.player_count());
  is_leaving_.resize(game_.player_count());
  felt_.resize(game_.player_count());
  if (is_replay_)
    for (const InputEvent& event : *settings.replay)
      if (!settings.begun || event.time > game_.now()) submit(event);
  ambassador_.join(settings.federation, "server", "server");
}

void Server::joined(rti::FederateHandle) {
  ambassador_.watch_federates();
  ambassador_.publish_interaction_class(model_.seat);
  ambassador_.publish_interaction_class(model_.interest);
  ambassador_.publish_interaction_class(model_.pace);
  for (const rti::InteractionClassHandle interaction :
       {model_.key_down, model_.key_up, model_.update, model_.inspect})
    ambassador_.subscribe_interaction_class(interaction);
  publisher_ = std::make_unique<Publisher>(model_, ambassador_, *policy_, game_, sweep_);
  if (hands_in_flights_) publisher_->hand_in_flights();
  if (flow_) announce_match();
  if (is_time_managed_) keep_time();
}

void Server::join_refused(rti::Refusal, std::string_view why) { trouble_ = why; }
void Server::connection_lost(std::string_view why) { trouble_ = why; }

/// Those with a seat and the server: who only watches, or comes later, keeps nobody waiting.
void Server::call_to_start() {
  std::vector<rti::FederateHandle> members{ambassador_.federate()};
  for (std::uint32_t federate = 0; federate < seats_.size(); ++federate)
    if (seats_[federate]) members.push_back({federate});
  is_called_ = true;
  ambassador_.register_synchronization_point(start_barrier, {}, members);
}

/// A player has left of whom the server had not heard yet.
void Server::synchronization_point_registration_failed(std::string_view,
                                                       rti::SynchronizationFailure failure) {
  if (failure == rti::SynchronizationFailure::member_not_joined) call_to_start();
}

void Server::announce_synchronization_point(std::string_view label, rti::Bytes) {
  ambassador_.synchronization_point_achieved(label);
}

void Server::federation_synchronized(std::string_view label, std::span<const rti::FederateHandle>) {
  if (label != start_barrier) return;
  is_started_ = true;
  ask_for_turns();
}

void Server::federate_joined(rti::FederateHandle federate, std::string_view name,
                             std::string_view type) {
  if (type != player_federate_type) return;
  const std::optional<std::uint32_t> player = free_seat(name);
  if (!player) return offer_seat(federate, {});
  if (seats_.size() <= federate.value) seats_.resize(federate.value + 1);
  seats_[federate.value] =
      Seat{.player = *player, .held = {}, .allowance = {key_limit_per_s_, now_()}};
  if (flow_) flow_->enter(*player, now_());
  else if (!is_replay_ && (!game_.bat(*player) || is_leaving_[*player]))
    submit({.time = simulated_now(), .player = *player, .kind = InputKind::enter});
  is_leaving_[*player] = false;
  is_taken_[*player] = true;
  felt_[*player] = 0;
  ++player_count_;
}

void Server::federate_resigned(rti::FederateHandle federate, std::string_view, std::string_view,
                               rti::ResignReason reason) {
  if (reason != rti::ResignReason::resigned) ++counters_.federates_lost;
  Seat* seat = seat_of(federate);
  if (seat == nullptr) return;
  const std::uint32_t player = seat->player;
  std::erase_if(pending_, [player](const Pending& pending) { return pending.player == player; });
  if (flow_) release_keys(*seat), flow_->leave(player, now_());
  else if (!is_replay_)
    submit({.time = simulated_now(), .player = player, .kind = InputKind::leave}),
        is_leaving_[player] = true;
  if (seat->is_turn_done) --turns_done_;
  --player_count_;
  is_taken_[player] = false;
  seats_[federate.value].reset();
}

/// The bat that bears the federate's name ("bat-17"), or else the first free one.
std::optional<std::uint32_t> Server::free_seat(std::string_view federate_name) const {
  for (std::uint32_t player = 0; player < is_taken_.size(); ++player)
    if (!is_taken_[player] && federate_name == bat_name(player)) return player;
  const auto free = std::find(is_taken_.begin(), is_taken_.end(), false);
  if (free == is_taken_.end()) return std::nullopt;
  return static_cast<std::uint32_t>(free - is_taken_.begin());
}

void Server::offer_seat(rti::FederateHandle federate, const SeatOffer& offer) {
  std::vector<std::byte> bytes;
  ambassador_.send_directed_interaction(model_.seat, federate, encode(bytes, offer),
                                        {.time = game_.now(), .tag = 0});
}

void Server::receive_interaction(rti::InteractionClassHandle interaction, rti::Bytes parameters,
                                 rti::FederateHandle sender, const rti::Stamp& stamp) {
  if (flow_ && interaction == model_.ping) return answer(sender, stamp.tag);
  if (interaction == model_.inspect) return note_inspection(sender, parameters);
  Seat* seat = seat_of(sender);
  if (seat == nullptr) return;
  if (interaction == model_.update) {
    turns_done_ += seat->is_turn_done ? 0u : 1u;
    seat->is_turn_done = true;
  } else if (interaction == model_.pause || interaction == model_.rematch) {
    receive_wish(*seat, interaction, parameters);
  } else {
    receive_key(*seat, parameters, interaction == model_.key_down, stamp.time);
  }
}

void Server::receive_key(Seat& seat, rti::Bytes parameters, bool is_down, double wanted_s) {
  ++counters_.keys_received;
  KeyCharacter character;
  const std::optional<Key> key = decode(parameters, character)
                                     ? key_from_character(static_cast<char>(character.character))
                                     : std::nullopt;
  if (!key) {
    ++counters_.keys_refused;
    return;
  }
  const double now = now_();
  double time = simulated_at_clock(now);
  if (flow_ && wanted_s < time - 1e-4) ++counters_.keys_late;
  if (flow_)
    time = seat.last_key_s = next_on(
        key_grid, std::max({time, seat.last_key_s, std::min(wanted_s, time + key_lead_max)}));
  pending_.push_back({.time = time, .player = seat.player});
  if (!seat.allowance.take(1.0, now)) {
    ++counters_.keys_over_limit;
    counters_.player_over_limit = seat.player;
    return;
  }
  if (!are_keys_felt()) return;
  submit({.time = time,
          .player = seat.player,
          .kind = is_down ? InputKind::key_down : InputKind::key_up,
          .key = *key});
  seat.held.set(*key, is_down);
}

void Server::submit(const InputEvent& event) { record_.push_back(game_.submit(event)); }

void Server::simulate(double until) {
  game_.advance(until);
  has_stepped_ = true;
  std::erase_if(pending_, [&](const Pending& pending) {
    if (pending.time > until) return false;
    ++felt_[pending.player];
    ++counters_.keys_applied;
    return true;
  });
  for (std::optional<Seat>& seat : seats_)
    if (seat) seat->is_turn_done = false;
  turns_done_ = 0;
  if (!flow_ || !flow_->runs() || !game_.is_over()) return;
  const MatchState& match = flow_->state();
  flow_->win(game_.score().left > game_.score().right ? Team::left : Team::right,
             match.clock_real_s + game_.now() - match.clock_simulated_s);
}

void Server::publish(const rti::Stamp& stamp) {
  seated_.clear();
  publisher_->publish(game_, felt_, stamp);
  if (flow_) publish_match(stamp);
  if (std::exchange(has_stepped_, false) && is_synchronous_ && !is_time_managed_)
    tell_pace({}, stamp.time);
  ask_for_turns();
  offer_seats();
}

/// A player is told of its seat once the bat is there; one that comes back to a running game may
/// have to wait for a free place.
void Server::offer_seats() {
  for (std::uint32_t federate = 0; federate < seats_.size(); ++federate) {
    std::optional<Seat>& seat = seats_[federate];
    if (!seat || seat->is_offered) continue;
    const std::optional<EntityId> bat = game_.bat(seat->player);
    if (!bat) continue;
    if (is_synchronous_ || is_time_managed_) tell_pace(rti::FederateHandle{federate}, game_.now());
    offer_seat(rti::FederateHandle{federate},
               {.bat = seat->player, .position = rounded(game_.position(*bat))});
    seat->is_offered = true;
    seated_.push_back({rti::FederateHandle{federate}, seat->player});
  }
}

std::optional<rti::FederateHandle> Server::federate_of(std::uint32_t player) const {
  for (std::uint32_t federate = 0; federate < seats_.size(); ++federate)
    if (seats_[federate] && seats_[federate]->player == player)
      return rti::FederateHandle{federate};
  return std::nullopt;
}

Server::Seat* Server::seat_of(rti::FederateHandle federate) {
  return federate.value < seats_.size() && seats_[federate.value] ? &*seats_[federate.value]
                                                                  : nullptr;
}

}  // namespace rink::game
