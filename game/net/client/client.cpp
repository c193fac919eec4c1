// Takes a seat, subscribes around it, reaches the start barrier, then plays.
#include "game/net/client/client.h"

#include <cassert>

#include "game/net/view.h"
#include "game/replication/names.h"
#include "rti/time/federate_clock.h"

namespace rink::game {
namespace {

physics::Vector2 vector_of(const Position& position) {
  return {static_cast<double>(position.x), static_cast<double>(position.y)};
}

bool is_state_on_entry(const ReplicaSet& replicas, rti::ObjectHandle object) {
  const EntityReplica* const entity = replicas.find(object);
  return entity != nullptr && !entity->is_placed;
}

/// Who computes subscribes to the rest as well, for servers of other policies.
rti::AttributeSet wanted(const ObjectModel& model, bool computes) {
  rti::AttributeSet wanted{model.shape, model.input, model.position, model.trajectory,
                           model.snapshot};
  if (computes) wanted.insert(model.exact);
  return wanted;
}

}  // namespace

Client::Client(const rti::Fom& fom, const ObjectModel& model, const ClientSettings& settings)
    : model_(model),
      settings_(settings),
      replicas_(model),
      ambassador_(fom, *this, settings.timeouts),
      view_(settings.view_margin) {
  if (settings.extrapolates) replicas_.extrapolate();
  ambassador_.join(settings.federation, settings.name,
                   settings.only_watches ? watcher_federate_type : player_federate_type);
  // These are in one frame with the join, so that the server cannot offer a seat before this client
  // subscribes.
  for (const rti::InteractionClassHandle interaction :
       {model_.key_down, model_.key_up, model_.update})
    ambassador_.publish_interaction_class(interaction);
  for (const rti::InteractionClassHandle interaction : {model_.seat, model_.pace})
    ambassador_.subscribe_interaction_class(interaction);
  ambassador_.subscribe_object_class_attributes(model_.field, {model_.extent, model_.drag});
  ambassador_.subscribe_object_class_attributes(model_.score, {model_.goals});
  if (settings.only_watches) questions_.emplace(ambassador_, model_);
  if (settings.plays_match) remote_.emplace(ambassador_, model_);
}

void Client::join_refused(rti::Refusal refusal, std::string_view why) {
  joining_.refuse(refusal, why);
}

void Client::connection_lost(std::string_view why) { joining_.lose(why); }

void Client::receive_interaction(rti::InteractionClassHandle interaction, rti::Bytes parameters,
                                 rti::FederateHandle, const rti::Stamp& stamp) {
  if (remote_ && interaction == model_.pong) return remote_->receive({stamp.tag, stamp.time});
  if (questions_ && interaction == model_.interest) return questions_->receive(parameters);
  if (interaction == model_.pace) return receive_pace(parameters, stamp);
  SeatOffer offer;
  if (interaction != model_.seat || !decode(parameters, offer)) return;
  if (joining_.offer(offer)) subscribe_once_seated();
  else ambassador_.resign();
}

/// Seat and field come by separate messages, in either order; a watcher waits for the field alone.
void Client::subscribe_once_seated() {
  if (state() != State::joining || !replicas_.field()) return;
  if (settings_.only_watches) joining_.watch();
  else if (joining_.seat()) joining_.sit_down();
  else return;
  if (settings_.declares_regions) {
    region_ = ambassador_.create_region();
    look_around(joining_.seat()->position);
  }
  ambassador_.subscribe_object_class_attributes(model_.entity, wanted(model_, settings_.computes),
                                                region_);
}

/// A message has all news of a tick; who is seated late sees its bat in one.
void Client::receive_host_message(rti::Bytes content) {
  if (!settings_.computes) return;
  if (!computed_) computed_.emplace(model_, replicas_, received_);
  const std::optional<SeatOffer>& seat = joining_.seat();
  const auto before = [this](const rti::Stamp& stamp) {
    if (before_next_stamp && stamp != replicas_.newest()) before_next_stamp();
  };
  const ExactReplicas::Result result =
      computed_->receive(content, seat ? seat->bat : SeatOffer::no_bat, before);
  if (result == ExactReplicas::Result::resend) {
    ambassador_.notify_host();  // who sends all again
  } else if (result == ExactReplicas::Result::hopeless) {
    settings_.computes = false;
    computed_->withdraw();
    ambassador_.subscribe_object_class_attributes(model_.entity, wanted(model_, false), region_);
  }
  if (result != ExactReplicas::Result::exact) return;
  bat_ = computed_->bat();
  if (on_news && replicas_.newest() != news_) on_news(news_ = replicas_.newest());
  if (state() == State::seated || state() == State::ready) reach_barrier_once_ready();
}

void Client::look_around(const Position& centre) {
  const Extent& field = *replicas_.field();
  const double half_side =
      view_half_side(settings_.view_area, settings_.view_fraction, field.length, field.width);
  ambassador_.set_region(region_, view_.look_around(vector_of(centre), half_side));
  ambassador_.commit_region_modifications(region_);
}

void Client::follow_bat(double instant) {
  const EntityReplica* own = bat();
  if (!settings_.declares_regions || own == nullptr || !own->is_placed) return;
  if (state() >= State::refused || !ambassador_.is_joined()) return;
  const Position there = rounded(own->position_at(instant));
  if (view_.is_left_by(vector_of(there))) look_around(there);
}

void Client::press(Key key, double instant) { send_key(model_.key_down, key, instant); }
void Client::release(Key key, double instant) { send_key(model_.key_up, key, instant); }

void Client::send_key(rti::InteractionClassHandle interaction, Key key, double instant) {
  assert(state() == State::playing && !settings_.only_watches);
  const KeyCharacter character{static_cast<std::uint8_t>(key_character(key))};
  encode(encoded_, character);
  if (turns_.is_time_managed() && turns_.is_synchronous())
    ambassador_.send_interaction(interaction, encoded_,
                                 rti::LogicalTime(ambassador_.clock().earliest()));
  else ambassador_.send_interaction(interaction, encoded_, {.time = instant, .tag = 0});
  ++keys_sent_;
}

void Client::announce_synchronization_point(std::string_view label, rti::Bytes) {
  if (label != start_barrier) return;
  joining_.call();
  reach_barrier_once_ready();
}

/// The barrier is reached with the own bat in sight, so that the start-up is not measured. A client
/// that joined late, when ticks are due already or the server says so, plays at once, and so does
/// one in a match, which itself waits for its players.
void Client::reach_barrier_once_ready() {
  const EntityReplica* own = bat();
  if (own != nullptr && own->in_scope && own->is_placed) joining_.see_bat();
  if (state() != State::ready || !turns_.is_time_kept(ambassador_.clock())) return;
  if (joining_.take_call()) ambassador_.synchronization_point_achieved(start_barrier);
  else if (replicas_.has_match() || turns_.is_late_by_timer() ||
           (own != nullptr && own->stamp.tag != 0))
    joining_.play();
}

void Client::federation_synchronized(std::string_view label, std::span<const rti::FederateHandle>) {
  if (label == start_barrier) joining_.play();
}

void Client::discover_object_instance(rti::ObjectHandle object, rti::ObjectClassHandle object_class,
                                      std::string_view name) {
  replicas_.discover(object, object_class);
  const std::optional<SeatOffer>& seat = joining_.seat();
  if (seat && name == bat_name(seat->bat)) bat_ = object;
}

void Client::reflect_attribute_values(rti::ObjectHandle object, rti::AttributeSet attributes,
                                      rti::Bytes values, const rti::Stamp& stamp) {
  if (before_next_stamp && stamp != replicas_.newest()) before_next_stamp();
  const bool is_news = on_news && stamp != news_ && !is_state_on_entry(replicas_, object);
  replicas_.reflect(object, attributes, values, stamp);
  if (is_news) on_news(news_ = stamp);
  received_.note_update(object, values.size());
  if (state() == State::joining) subscribe_once_seated();
  if ((state() == State::seated || state() == State::ready) && object == bat_)
    reach_barrier_once_ready();
}

void Client::attributes_in_scope(rti::ObjectHandle object) {
  received_.note_scope(object, true);
  replicas_.set_scope(object, true);
}

void Client::attributes_out_of_scope(rti::ObjectHandle object) {
  received_.note_scope(object, false);
  replicas_.set_scope(object, false);
}

void Client::remove_object_instance(rti::ObjectHandle object) {
  received_.note_scope(object, false);
  replicas_.remove(object);
}

}  // namespace rink::game
