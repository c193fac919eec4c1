// Seats players, stamps their keys with the simulated instant of their arrival, and steps the game.
#include "game/net/server/server.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "game/control/game_state.h"
#include "game/model/state_hash.h"
#include "game/net/interest_codec.h"
#include "game/replication/names.h"
#include "rti/time/federate_clock.h"

namespace rink::game {
namespace {

/// Shows all windows that are final and end by `until` [s].
void follow(SharedPlay& shared, double until, Game& game, KeyIntake& keys, Publisher& publisher) {
  while (const std::optional<ShownWindow> window = shared.show_next(until, game)) {
    for (const EntityId entity : window->left) publisher.hide(entity);
    for (const EntityId entity : window->told) publisher.show(entity);
    for (const InputEvent& key : window->keys) {
      keys.feel_next(key.player);
      keys.record(key);
    }
  }
  keys.feel_unsubmitted();
}

/// By which the server of a shared game knows a player that comes back, perhaps at another server.
std::uint64_t token_of(std::string_view name) {
  StateHash hash;
  for (const char letter : name) hash.add(std::uint64_t{static_cast<unsigned char>(letter)});
  return hash.value();
}

struct Answered {
  rti::FederateHandle federate;
  std::optional<std::uint32_t> player;
};

/// The next player who has asked for a bat and is still here. The bat of one who has gone is given
/// back.
std::optional<Answered> next_answered(SharedPlay& shared, Seats& seats) {
  while (const std::optional<SharedPlay::SeatAnswer> answer = shared.next_seat()) {
    const std::optional<rti::FederateHandle> federate = seats.take_waiting(answer->token);
    if (federate && answer->player) seats.open(*answer->player);
    if (federate) return Answered{*federate, answer->player};
    if (answer->player) shared.leave_seat(*answer->player, answer->token);
  }
  return std::nullopt;
}

/// A host of matches that stood still goes on, while one of several nodes was lost by the others.
rti::Timeouts timeouts_of(const ServerSettings& settings) {
  constexpr double ever = 1e9;
  return settings.hosting && settings.shared == nullptr ? rti::Timeouts{.lost_after_s = ever}
                                                        : rti::Timeouts{};
}

}  // namespace

Server::Server(const rti::Fom& fom, const Scene& scene, const ServerSettings& settings,
               std::function<double()> now)
    : model_(fom),
      now_([this, clock = std::move(now)] {
        const double now_s = clock();
        if (hosted_) hosted_->pass(now_s);
        return now_s;
      }),
      game_(settings.state.empty() ? Game(scene)
                                   : game_in_state(settings.state, scene, "ServerSettings")),
      is_replay_(settings.replay.has_value()),
      shared_(settings.shared),
      policy_(make_update_policy(settings.policy, {.threshold = settings.threshold})),
      sweep_(settings.sweep_ticks, settings.tick_s),
      ambassador_(fom, *this, timeouts_of(settings)),
      seats_(game_.player_count()),
      keys_(game_.player_count(), settings.key_limit_per_s, settings.push_limit_per_s),
      turns_({.tick_s = settings.tick_s,
              .is_synchronous = settings.is_synchronous,
              .is_time_managed = settings.is_time_managed}),
      budget_({.events_per_s = settings.events_per_s,
               .tick_s = settings.tick_s,
               .has_whole_ticks = settings.is_time_managed}),
      always_relevant_(settings.always_relevant.value_or(relevant_kinds_of(scene))) {
  assert(!settings.hosting || (!is_replay_ && !settings.is_time_managed && settings.state.empty()));
  assert(!shared_ || (!is_replay_ && settings.state.empty() && !settings.is_synchronous &&
                      !settings.is_time_managed));
  if (shared_) seats_.keep_to(shared_->first_player(), shared_->player_count());
  if (settings.hosting) hosted_.emplace(*settings.hosting, scene);
  if (hosted_ && shared_) hosted_->follow(shared_->match()->state());
  assert(policy_ && "the command line is checked against update_policy_names()");
  if (is_replay_)
    for (const InputEvent& event : *settings.replay)
      if (settings.state.empty() || event.time > game_.now()) submit(event);
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
  if (hosted_) {
    board_.emplace(ambassador_, model_, hosted_->scene_text(), turns_.tick_s());
    ambassador_.subscribe_interaction_class(model_.push);
    board_->show(hosted_->state(), {});
  }
  if (!turns_.is_time_managed()) return;
  ambassador_.enable_asynchronous_delivery();  // keys in real time, and players that join or leave,
                                               // do not wait for a tick
  ambassador_.enable_time_regulation(turns_.lookahead());
  ambassador_.enable_time_constrained();
}

void Server::join_refused(rti::Refusal, std::string_view why) { error_ = why; }
void Server::connection_lost(std::string_view why) { error_ = why; }

/// The members are those with a seat and the server: watchers and latecomers keep no other waiting.
void Server::call_to_start() {
  std::vector<rti::FederateHandle> members{ambassador_.federate()};
  seats_.for_each(
      [&](rti::FederateHandle federate, const Seats::Seat&) { members.push_back(federate); });
  turns_.call();
  ambassador_.register_synchronization_point(start_barrier, {}, members);
}

/// A player has left that the server had not discovered yet.
void Server::synchronization_point_registration_failed(std::string_view,
                                                       rti::SynchronizationFailure failure) {
  if (failure == rti::SynchronizationFailure::member_not_joined) call_to_start();
}

void Server::announce_synchronization_point(std::string_view label, rti::Bytes) {
  ambassador_.synchronization_point_achieved(label);
}

void Server::federation_synchronized(std::string_view label, std::span<const rti::FederateHandle>) {
  if (label != start_barrier) return;
  turns_.start();
  ask_for_turns();
}

void Server::federate_joined(rti::FederateHandle federate, std::string_view name,
                             std::string_view type) {
  if (type != player_federate_type) return;
  const std::optional<std::uint32_t> player = seats_.free(name);
  const bool is_at_once = !shared_ || (player && !shared_->has_begun());
  if (shared_ && is_at_once) shared_->keep_seat(*player, token_of(name));
  if (is_at_once) return seat_player(federate, player);
  seats_.await(federate, token_of(name));
  shared_->ask_seat({.token = token_of(name), .player = seats_.named(name)});
}

/// Without a bat it is refused.
void Server::seat_player(rti::FederateHandle federate, std::optional<std::uint32_t> player) {
  if (!player) return offer_seat(federate, SeatOffer{});
  const double now = now_();
  if (hosted_) hosted_->enter(*player, now);
  else if (!is_replay_ && (!game_.bat(*player) || seats_.is_leaving(*player)))
    submit({.time = simulated_at_clock(now), .player = *player, .kind = InputKind::enter});
  seats_.enter(federate, *player);
  keys_.enter(*player, now);
}

/// In a hosted match, or a shared game, a bat stays when its player leaves, without pressed keys.
void Server::federate_resigned(rti::FederateHandle federate, std::string_view name,
                               std::string_view, rti::ResignReason reason) {
  if (reason != rti::ResignReason::resigned) ++counters_.federates_lost;
  seats_.forget_waiting(federate);
  const Seats::Seat* const seat = seats_.find(federate);
  if (seat == nullptr) return;
  const std::uint32_t player = seat->player;
  const double now = now_(), simulated = simulated_at_clock(now);
  keys_.leave(player);
  if (hosted_ || shared_) {
    if (!hosted_ || hosted_->are_keys_felt())
      for (const InputEvent& event : keys_.release(player, simulated)) submit(event);
    if (hosted_) hosted_->leave(player, now);
  } else if (!is_replay_) {
    submit({.time = simulated, .player = player, .kind = InputKind::leave});
  }
  seats_.leave(federate, !hosted_ && !is_replay_ && !shared_);
  if (shared_ && shared_->has_begun()) shared_->leave_seat(player, token_of(name));
}

void Server::receive_interaction(rti::InteractionClassHandle interaction, rti::Bytes parameters,
                                 rti::FederateHandle sender, const rti::Stamp& stamp) {
  if (board_ && interaction == model_.ping) {
    // Nodes feel a key within two windows at the earliest: so far ahead are their players' clocks.
    const double lead_s = shared_ ? 2.0 * turns_.tick_s() : 0.0;
    return board_->answer(sender, stamp.tag, now_() + lead_s);
  }
  const Seats::Seat* const seat = seats_.find(sender);
  if (interaction == model_.inspect) {
    Inspection wanted;
    if (!hosted_ && seat == nullptr && decode(parameters, wanted))
      inspections_.ask(sender, rti::ObjectHandle{wanted.object});
  } else if (seat == nullptr) {
    return;
  } else if (interaction == model_.update) {
    seats_.end_turn(sender);
  } else if (interaction == model_.rematch) {
    if (hosted_ && shared_) shared_->match()->ask_rematch(seat->player);
    else if (hosted_) hosted_->ask_rematch(seat->player, now_());
  } else if (interaction == model_.pause) {
    PauseWish wish;
    if (!hosted_ || !decode(parameters, wish)) return;
    if (shared_) shared_->match()->pause(wish.is_wanted != 0);
    else hosted_->pause(wish.is_wanted != 0, now_());
  } else {
    receive_input(seat->player, interaction, parameters, stamp.time);
  }
}

/// A key change, or a push; servers that share a game tell each other keys alone.
void Server::receive_input(std::uint32_t player, rti::InteractionClassHandle interaction,
                           rti::Bytes parameters, double wanted_s) {
  const double now = now_();
  const KeyArrival arrival{.now_s = now,
                           .simulated_s = simulated_at_clock(now),
                           .wanted_s = hosted_ ? std::optional(wanted_s) : std::nullopt,
                           .is_felt = !is_replay_ && (!hosted_ || hosted_->are_keys_felt())};
  if (interaction == model_.push && (!hosted_ || shared_)) return keys_.refuse_push();
  const std::optional<InputEvent> event =
      interaction == model_.push
          ? keys_.accept_push(player, parameters, arrival)
          : keys_.accept(player, interaction == model_.key_down, parameters, arrival);
  if (event) submit(*event);
}

double Server::simulate(double until) {
  until = std::max(game_.now(), game_.network_grid().instants().snapped(until));
  const bool has_arrived = shared_ != nullptr || budget_.advance(game_, until);
  turns_.stepped(has_arrived);
  // Alone: keys of the very instant in which it was cut short are not felt yet.
  if (shared_) {
    follow(*shared_, until, game_, keys_, *publisher_);
    while (const std::optional<Answered> next = next_answered(*shared_, seats_))
      seat_player(next->federate, next->player);
  } else {
    keys_.feel_until(has_arrived ? until : std::nextafter(game_.now(), -1.0));
  }
  seats_.begin_turns();
  if (hosted_) hosted_->judge(game_);
  return game_.now();
}

bool Server::publish(const rti::Stamp& stamp) {
  if (turns_.is_within_tick()) return false;
  publisher_->publish(game_, keys_.felt(), stamp);
  if (hosted_) board_->show(hosted_->state(), stamp);
  if (turns_.take_step()) send_pace({}, stamp.time);
  ask_for_turns();
  seats_.offer([this](rti::FederateHandle federate, std::uint32_t player) {
    return offer_seat(federate, player);
  });
  return true;
}

/// A player is sent its seat once the bat is in play; one that comes back to a running game may
/// have to wait for a free place. In a shared game the bat may never have moved, so that nothing of
/// it shows a latecomer that the game runs.
bool Server::offer_seat(rti::FederateHandle federate, std::uint32_t player) {
  const std::optional<EntityId> bat = game_.bat(player);
  if (!bat) return false;
  if (turns_.concerns_players() || (shared_ && shared_->has_begun()))
    send_pace(federate, game_.now());
  offer_seat(federate, {.bat = player, .position = rounded(game_.position(*bat))});
  return true;
}

void Server::offer_seat(rti::FederateHandle federate, const SeatOffer& offer) {
  std::vector<std::byte> bytes;
  ambassador_.send_directed_interaction(model_.seat, federate, encode(bytes, offer),
                                        {.time = game_.now(), .tag = 0});
}

rti::ObjectHandle Server::bat_of(rti::FederateHandle federate) const {
  const Seats::Seat* const seat = seats_.find(federate);
  if (seat == nullptr) return {};
  const std::optional<EntityId> bat = game_.bat(seat->player);
  return bat ? publisher_->object(*bat) : rti::ObjectHandle{};
}

void Server::send_interest(rti::FederateHandle federate, InterestSeen seen) {
  std::vector<std::byte> bytes;
  rti::Writer writer(bytes);
  exchange(writer, seen);
  ambassador_.send_directed_interaction(model_.interest, federate, bytes,
                                        {.time = game_.now(), .tag = 0});
  ++counters_.inspections_answered;
}

}  // namespace rink::game
