// Takes a seat, subscribes around it, reaches the start barrier, then plays.
#include "game/net/client/client.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "game/net/interest_codec.h"
#include "game/net/view.h"
#include "game/replication/names.h"
#include "rti/time/federate_clock.h"

namespace rink::game {

Client::Client(const rti::Fom& fom, const ObjectModel& model, const ClientSettings& settings)
    : model_(model), settings_(settings), mirror_(model), ambassador_(fom, *this) {
  if (settings.extrapolates) mirror_.extrapolate();
  ambassador_.join(settings.federation, settings.name,
                   settings.only_watches ? watcher_federate_type : player_federate_type);
  // In one frame with the join, so that the server cannot offer a seat before we listen.
  for (const rti::InteractionClassHandle interaction :
       {model_.key_down, model_.key_up, model_.update})
    ambassador_.publish_interaction_class(interaction);
  for (const rti::InteractionClassHandle interaction : {model_.seat, model_.pace})
    ambassador_.subscribe_interaction_class(interaction);
  ambassador_.subscribe_object_class_attributes(model_.field, {model_.extent, model_.drag});
  ambassador_.subscribe_object_class_attributes(model_.score, {model_.goals});
  if (settings.only_watches) {
    ambassador_.publish_interaction_class(model_.inspect);
    ambassador_.subscribe_interaction_class(model_.interest);
  }
  if (!settings.plays_match) return;
  for (const rti::InteractionClassHandle interaction : {model_.pause, model_.rematch, model_.ping})
    ambassador_.publish_interaction_class(interaction);
  ambassador_.subscribe_interaction_class(model_.pong);
  ambassador_.subscribe_object_class_attributes(
      model_.match, {model_.match_state, model_.match_scene, model_.match_tick});
}

void Client::join_refused(rti::Refusal refusal, std::string_view why) {
  state_ = State::refused;
  refusal_ = refusal;
  trouble_ = why;
}

void Client::connection_lost(std::string_view why) {
  state_ = State::lost;
  trouble_ = why;
}

void Client::receive_interaction(rti::InteractionClassHandle interaction, rti::Bytes parameters,
                                 rti::FederateHandle, const rti::Stamp& stamp) {
  if (interaction == model_.pong) {
    pong_ = Pong{stamp.tag, stamp.time};
    return;
  }
  if (interaction == model_.interest) return receive_interest(parameters);
  if (interaction == model_.pace) return receive_pace(parameters, stamp);
  SeatOffer offer;
  if (interaction != model_.seat || state_ != State::joining || !decode(parameters, offer)) return;
  if (offer.bat == SeatOffer::no_bat) {
    state_ = State::refused;
    trouble_ = "no bat is free";
    ambassador_.resign();
    return;
  }
  seat_ = offer;
  subscribe_once_seated();
}

/// Seat and field come by separate messages, in either order.
void Client::subscribe_once_seated() {
  if (settings_.only_watches && mirror_.field()) seat_ = SeatOffer{};
  if (state_ != State::joining || !seat_ || !mirror_.field()) return;
  state_ = State::seated;
  if (settings_.declares_regions) {
    view_ = ambassador_.create_region();
    look_around(seat_->position);
  }
  ambassador_.subscribe_object_class_attributes(
      model_.entity,
      {model_.shape, model_.input, model_.position, model_.trajectory, model_.snapshot}, view_);
  if (settings_.only_watches) state_ = State::playing;
}

void Client::look_around(const Position& centre) {
  centre_ = centre;
  const Extent& field = *mirror_.field();
  const double half_side =
      view_half_side(settings_.view_area, settings_.view_fraction, field.length, field.width) +
      settings_.view_margin;
  view_bounds_ = {centre.x - half_side, centre.y - half_side, centre.x + half_side,
                  centre.y + half_side};
  ambassador_.set_region(view_, view_bounds_);
  ambassador_.commit_region_modifications(view_);
}

void Client::follow_bat(double instant) {
  if (!settings_.declares_regions) return;
  const MirroredEntity* own = bat();
  if (state_ >= State::refused || !ambassador_.is_joined() || own == nullptr || !own->is_placed)
    return;
  const Position there = rounded(own->position_at(instant));
  if (there == centre_) return;
  const double moved = std::max(std::abs(double(there.x) - double(centre_.x)),
                                std::abs(double(there.y) - double(centre_.y)));
  if (moved < 0.5 * settings_.view_margin) return;
  look_around(there);
}

void Client::press(Key key, double instant) { send_key(model_.key_down, key, instant); }
void Client::release(Key key, double instant) { send_key(model_.key_up, key, instant); }

void Client::send_key(rti::InteractionClassHandle interaction, Key key, double instant) {
  assert(state_ == State::playing && !settings_.only_watches);
  const KeyCharacter character{static_cast<std::uint8_t>(key_character(key))};
  encode(encoded_, character);
  if (is_time_managed() && is_synchronous())
    ambassador_.send_interaction(interaction, encoded_,
                                 rti::LogicalTime(ambassador_.clock().earliest()));
  else ambassador_.send_interaction(interaction, encoded_, {.time = instant, .tag = 0});
  ++keys_sent_;
}

void Client::pause(bool is_wanted) {
  const PauseWish wish{static_cast<std::uint8_t>(is_wanted)};
  ambassador_.send_interaction(model_.pause, encode(encoded_, wish), {});
}

void Client::ask_rematch() { ambassador_.send_interaction(model_.rematch, {}, {}); }

void Client::ping(std::uint64_t number) {
  ambassador_.send_interaction(model_.ping, {}, {.time = 0.0, .tag = number});
}

void Client::inspect(rti::ObjectHandle object) {
  assert(settings_.only_watches);
  const Inspection inspection{object.value};
  ambassador_.send_interaction(model_.inspect, encode(encoded_, inspection), {});
}

void Client::receive_interest(rti::Bytes parameters) {
  InterestSeen seen;
  if (decode(parameters, seen)) interest_ = std::move(seen);
}

void Client::announce_synchronization_point(std::string_view label, rti::Bytes) {
  if (label != start_barrier) return;
  is_called_ = true;
  reach_barrier_once_ready();
}

/// The barrier is reached with the own bat in sight, so that nothing of the start-up falls into the
/// measured time.
void Client::reach_barrier_once_ready() {
  const MirroredEntity* own = bat();
  if (state_ == State::seated && own != nullptr && own->in_scope && own->is_placed)
    state_ = State::ready;
  if (state_ != State::ready || !is_time_kept()) return;
  if (is_called_) {
    ambassador_.synchronization_point_achieved(start_barrier);
    is_called_ = false;
  } else if (own->stamp.tag != 0 || mirror_.has_match()) {
    state_ =
        State::playing;  // joined late, and ticks are due already; or a match waits for its players
  }
}

void Client::federation_synchronized(std::string_view label, std::span<const rti::FederateHandle>) {
  if (label == start_barrier && state_ == State::ready) state_ = State::playing;
}

void Client::discover_object_instance(rti::ObjectHandle object, rti::ObjectClassHandle object_class,
                                      std::string_view name) {
  mirror_.discover(object, object_class);
  if (seat_ && name == bat_name(seat_->bat)) bat_ = object;
}

bool Client::is_state_on_entry(rti::ObjectHandle object) const {
  const MirroredEntity* const entity = mirror_.find(object);
  return entity != nullptr && !entity->is_placed;
}

void Client::reflect_attribute_values(rti::ObjectHandle object, rti::AttributeSet attributes,
                                      rti::Bytes values, const rti::Stamp& stamp) {
  if (before_next_stamp && stamp != mirror_.newest()) before_next_stamp();
  const bool is_news = on_news && stamp != news_ && !is_state_on_entry(object);
  mirror_.reflect(object, attributes, values, stamp);
  if (is_news) on_news(news_ = stamp);
  if (is_watched_) heard_.updates.push_back({object, static_cast<std::uint32_t>(values.size())});
  if (state_ == State::joining) subscribe_once_seated();
  if ((state_ == State::seated || state_ == State::ready) && object == bat_)
    reach_barrier_once_ready();
}

void Client::attributes_in_scope(rti::ObjectHandle object) { set_scope(object, true); }
void Client::attributes_out_of_scope(rti::ObjectHandle object) { set_scope(object, false); }

void Client::remove_object_instance(rti::ObjectHandle object) {
  if (is_watched_) heard_.scopes.push_back({object, false});
  mirror_.remove(object);
}

void Client::set_scope(rti::ObjectHandle object, bool is_in) {
  if (is_watched_) heard_.scopes.push_back({object, is_in});
  mirror_.set_scope(object, is_in);
}

void Client::forget_heard() {
  heard_.scopes.clear();
  heard_.updates.clear();
}

}  // namespace rink::game
