// Time management at the federate's side: requests, messages in time-stamp order, and what waits
// while a federate may not be disturbed.
#include <algorithm>
#include <string>

#include "rti/federate/ambassador_services.h"
#include "rti/fom/coded_values.h"
#include "rti/hla_error.h"
#include "rti/wire/time_messages.h"
#include "rti/wire/update_block.h"

namespace rink::rti {

namespace {

/// What a constrained federate that never advances may be owed [bytes].
constexpr std::size_t postponed_max = 64u << 20;

}  // namespace

void AmbassadorServices::enable_time_regulation(double lookahead) {
  clock_.ask_regulation(lookahead);
  release_best_effort();
  is_timed_ = true;
  frames_.enqueue(EnableTimeRegulationMessage{lookahead});
}

void AmbassadorServices::disable_time_regulation() {
  clock_.ask_no_regulation();
  deletions_.clear();
  frames_.enqueue(TimeSwitchMessage{static_cast<std::uint8_t>(TimeSwitch::disable_regulation)});
}

void AmbassadorServices::enable_time_constrained() {
  clock_.ask_constrained();
  release_best_effort();
  is_timed_ = true;
  frames_.enqueue(TimeSwitchMessage{static_cast<std::uint8_t>(TimeSwitch::enable_constrained)});
}

void AmbassadorServices::disable_time_constrained() {
  clock_.ask_no_constrained();
  frames_.enqueue(TimeSwitchMessage{static_cast<std::uint8_t>(TimeSwitch::disable_constrained)});
}

void AmbassadorParts::request_advance(AdvanceKind kind, LogicalTime time) {
  clock_.ask_advance(kind, time.value);
  frames_.enqueue(AdvanceRequestMessage{static_cast<std::uint8_t>(kind), time.value});
}

void AmbassadorServices::modify_lookahead(double lookahead) {
  clock_.ask_lookahead(lookahead);
  frames_.enqueue(ModifyLookaheadMessage{lookahead});
}

void AmbassadorServices::query_time_bounds() { frames_.enqueue(QueryTimeBoundsMessage{}); }

AttributeSet AmbassadorParts::timestamped(ObjectHandle object,
                                          ObjectClassHandle object_class) const {
  const auto changed = order_changes_.find(object.value);
  if (changed != order_changes_.end()) return changed->second;
  AttributeSet set;
  const std::vector<Attribute>& attributes = fom_.at(object_class).attributes;
  for (std::uint32_t i = 0; i < attributes.size(); ++i)
    if (attributes[i].order == Order::timestamp) set.insert({i});
  return set;
}

RetractionHandle AmbassadorParts::say_timed(LogicalTime time, std::uint64_t tag, Bytes content) {
  TimedSendMessage message;
  message.number = clock_.ask_send(time.value);
  message.stamp = {time.value, tag};
  message.content = content;
  frames_.enqueue(message);
  ++counters_.timed_sent;
  return {phase_.federate(), message.number, time.value};
}

RetractionHandle AmbassadorServices::update_attribute_values(ObjectHandle object,
                                                             AttributeSet attributes, Bytes values,
                                                             LogicalTime time, std::uint64_t tag) {
  const KnownObject* known = objects_.find(object);
  if (known == nullptr)
    throw RtiException(HlaError::object_instance_not_known,
                       "object " + std::to_string(object.value));
  const ObjectClassHandle object_class{known->object_class};
  const AttributeSet in_order =
      clock_.is_regulating() ? attributes & timestamped(object, object_class) : AttributeSet();
  if (in_order.is_empty()) {
    update_attribute_values(object, attributes, values, Stamp{time.value, tag});
    return {};
  }
  clock_.check_send(time.value);
  if (!known->is_own && !owned_of(object, *known).includes(attributes))
    throw RtiException(HlaError::attribute_not_owned,
                       "object " + std::to_string(object.value) + " is somebody else's");
  require_values(object_class, attributes, values);
  std::vector<std::byte> ordered, others;  // each attribute's value goes with those of its order
  for (std::uint32_t i = 0; i < attribute_max; ++i) {
    if (!attributes.contains({i})) continue;
    const Bytes value = fom_.value(object_class, attributes, {i}, values);
    std::vector<std::byte>& part = in_order.contains({i}) ? ordered : others;
    part.insert(part.end(), value.begin(), value.end());
  }
  const AttributeSet at_once(attributes.bits & ~in_order.bits);
  if (!at_once.is_empty()) update_attribute_values(object, at_once, others, Stamp{time.value, tag});
  release_spared(object);  // of receive order, and older
  declared_.note_sent(object_class, in_order, declared_.newest);
  content_.clear();
  UpdatesMessage header{static_cast<std::uint16_t>(object_class.value), in_order.bits};
  write(content_, header);
  write_handle(content_, 0, object.value);
  if (is_coded(fom_.at(object_class), in_order))
    encode(fom_.at(object_class), in_order, ordered, time.value, content_);
  else content_.insert(content_.end(), ordered.begin(), ordered.end());
  content_.push_back(std::byte{0});
  return say_timed(time, tag, content_);
}

RetractionHandle AmbassadorServices::send_interaction(InteractionClassHandle interaction_class,
                                                      Bytes parameters, LogicalTime time,
                                                      std::uint64_t tag) {
  return send_directed_interaction(interaction_class, {}, parameters, time, tag);
}

RetractionHandle AmbassadorServices::send_directed_interaction(
    InteractionClassHandle interaction_class, FederateHandle receiver, Bytes parameters,
    LogicalTime time, std::uint64_t tag) {
  if (interaction_class.value >= fom_.interaction_classes().size())
    throw RtiException(HlaError::interaction_class_not_defined,
                       std::to_string(interaction_class.value));
  const Order order = interaction_orders_.empty() ? fom_.at(interaction_class).order
                                                  : interaction_orders_[interaction_class.value];
  if (!clock_.is_regulating() || order == Order::receive || fom_.is_for_rti(interaction_class)) {
    send_directed_interaction(interaction_class, receiver, parameters, Stamp{time.value, tag});
    return {};
  }
  require_parameters(parameters);
  content_.clear();
  InteractionMessage message{
      static_cast<std::uint16_t>(interaction_class.value), receiver.value, {}, parameters};
  write(content_, message);
  const RetractionHandle handle = say_timed(time, tag, content_);
  ++counters_.interactions_sent;
  return handle;
}

RetractionHandle AmbassadorServices::delete_object_instance(ObjectHandle object, LogicalTime time,
                                                            std::uint64_t tag) {
  if (!clock_.is_regulating()) {
    delete_object_instance(object);
    return {};
  }
  const KnownObject* known = objects_.find(object);
  if (known == nullptr)
    throw RtiException(HlaError::object_instance_not_known,
                       "object " + std::to_string(object.value));
  if (!owned_of(object, *known).contains(privilege_to_delete_object))
    throw RtiException(HlaError::delete_privilege_not_held,
                       "object " + std::to_string(object.value) + " is somebody else's");
  content_.clear();
  DeleteObjectMessage message{object.value};
  write(content_, message);
  const RetractionHandle handle = say_timed(time, tag, content_);
  std::erase_if(deletions_,
                [this](const TimedDeletion& each) { return each.time < clock_.earliest_ever(); });
  deletions_.push_back({handle.number, object.value, objects_.hide(object), time.value});
  return handle;
}

void AmbassadorServices::retract(const RetractionHandle& handle) {
  clock_.ask_retraction(handle, phase_.federate());
  frames_.enqueue(RetractMessage{handle.number});
  const auto deletion = std::ranges::find(deletions_, handle.number, &TimedDeletion::number);
  if (deletion == deletions_.end()) return;
  objects_.restore({deletion->object}, deletion->known);
  deletions_.erase(deletion);
}

void AmbassadorServices::change_attribute_order_type(ObjectHandle object, AttributeSet attributes,
                                                     Order order) {
  const KnownObject* known = objects_.find(object);
  if (known == nullptr)
    throw RtiException(HlaError::object_instance_not_known,
                       "object " + std::to_string(object.value));
  const ObjectClassHandle object_class{known->object_class};
  if (!fom_.attributes(object_class).includes(attributes))
    throw RtiException(HlaError::attribute_not_defined, "in class " + fom_.at(object_class).name);
  if (!owned_of(object, *known).includes(attributes))
    throw RtiException(HlaError::attribute_not_owned,
                       "object " + std::to_string(object.value) + " is somebody else's");
  const AttributeSet before = timestamped(object, object_class);
  order_changes_[object.value] = order == Order::timestamp
                                     ? before | attributes
                                     : AttributeSet(before.bits & ~attributes.bits);
}

void AmbassadorServices::change_interaction_order_type(InteractionClassHandle interaction_class,
                                                       Order order) {
  if (interaction_class.value >= fom_.interaction_classes().size())
    throw RtiException(HlaError::interaction_class_not_defined,
                       std::to_string(interaction_class.value));
  if (interaction_orders_.empty())
    for (const InteractionClass& each : fom_.interaction_classes())
      interaction_orders_.push_back(each.order);
  interaction_orders_[interaction_class.value] = order;
}

bool AmbassadorParts::take_time(Reader& reader, std::uint8_t number, const ReadContext& context) {
  const auto kind = static_cast<MessageKind>(number);
  if (kind == MessageKind::timed_delivery) return take_timed(reader, context);
  if (kind == MessageKind::time_advance_grant) {
    TimeAdvanceGrantMessage message;
    if (!exchange(reader, message) || !clock_.granted(message.seconds)) return false;
    ++counters_.time_advance_grants;
    callbacks_.time_advance_grant(LogicalTime(message.seconds));
  } else if (kind == MessageKind::time_regulation_enabled) {
    TimeRegulationEnabledMessage message;
    if (!exchange(reader, message) || !clock_.regulation_enabled(message.time, message.earliest))
      return false;
    callbacks_.time_regulation_enabled(LogicalTime(message.time));
  } else if (kind == MessageKind::time_constrained_enabled) {
    TimeConstrainedEnabledMessage message;
    if (!exchange(reader, message) || !clock_.constrained_enabled(message.seconds)) return false;
    callbacks_.time_constrained_enabled(LogicalTime(message.seconds));
  } else if (kind == MessageKind::request_retraction) {
    RequestRetractionMessage message;
    if (!exchange(reader, message)) return false;
    callbacks_.request_retraction({{message.sender}, message.number, message.time});
  } else {
    TimeBoundsMessage message;
    if (!exchange(reader, message)) return false;
    callbacks_.time_bounds(message.galt, message.lits);
  }
  return true;
}

bool AmbassadorParts::take_timed(Reader& reader, const ReadContext& context) {
  TimedDeliveryMessage message;
  if (!exchange(reader, message) || context.timed != nullptr) return false;
  ++counters_.timed_received;
  const TimedStamp timed{message.stamp,
                         message.is_in_order != 0,
                         {{message.sender}, message.number, message.stamp.time}};
  ReadContext inner{message.stamp, &timed};
  Reader content(message.content);
  const bool is_content =
      !message.content.empty() && is_receive_ordered(static_cast<MessageKind>(message.content[0]));
  const bool is_read =
      is_content && take_message(content, inner) && (content.is_at_end() || !phase_.is_joined());
  return is_read;
}

/// Keeps one message, with its stamp if it needs one, for `release_postponed`.
bool AmbassadorParts::postpone(Reader& reader, MessageKind kind, const ReadContext& context) {
  const Bytes body = reader.rest();
  bool is_read = false;
  if (kind == MessageKind::updates) {
    UpdatesMessage message;
    if (!context.stamp || !exchange(reader, message) ||
        message.object_class >= fom_.object_classes().size())
      return false;
    StampMessage stamp{*context.stamp};
    write(postponed_, stamp);
    is_read =
        read_records(reader, fom_.object_classes()[message.object_class],
                     AttributeSet(message.attributes), [](std::uint32_t, Bytes) { return true; });
  } else if (kind == MessageKind::interaction) {
    InteractionMessage message;
    is_read = exchange(reader, message);
  } else {
    RemoveObjectMessage message;
    is_read = exchange(reader, message);
  }
  postponed_.push_back(static_cast<std::byte>(kind));
  postponed_.insert(postponed_.end(), body.begin(),
                    body.end() - static_cast<std::ptrdiff_t>(reader.left()));
  if (postponed_.size() > postponed_max)
    lose("more to tell than a federate that never advances is kept");
  return is_read;
}

bool AmbassadorParts::release_postponed() {
  if (clock_.holds_receive_order()) return true;
  const std::vector<std::byte> messages = std::exchange(postponed_, {});
  Reader reader(messages);
  ReadContext context;
  while (!reader.is_at_end() && phase_.is_joined())
    if (!take_message(reader, context)) return false;
  return true;
}

}  // namespace rink::rti
