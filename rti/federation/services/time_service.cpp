// Requests and messages of federates, and how many of them are kept.
#include "rti/federation/services/time_service.h"

#include <algorithm>
#include <cassert>

#include "rti/time/conservative_time.h"
#include "rti/wire/update_block.h"

namespace rink::rti {

/// Of a federate whose messages wait for its time, which no datagram could keep up with.
TimeManagement& TimeService::begin(std::uint32_t slot) {
  basis_.federates[slot].has_stream_only = true;
  if (!management_) management_ = make_ ? make_() : std::make_unique<ConservativeTime>();
  return *management_;
}

void TimeService::joined(std::uint32_t slot) {
  if (slot >= federates_.size()) federates_.resize(slot + 1);
  assert(federates_[slot].sent.empty());
}

void TimeService::left(std::uint32_t slot) {
  if (management_) {
    management_->remove(slot, *this);
    std::erase(asking_, slot);
    for (const Sent& each : federates_[slot].sent) {
      messages_[each.message].is_retractable = false;
      finish(each.message);
    }
  }
  federates_[slot] = {};
}

Outcome TimeService::handle_regulation(std::uint32_t slot, Reader& reader) {
  TimeManagement& management = begin(slot);
  EnableTimeRegulationMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  if (!management.enable_regulation(slot, message.seconds)) return Violation::untimely;
  federates_[slot].lookahead = message.seconds;
  return std::nullopt;
}

Outcome TimeService::handle_lookahead(std::uint32_t slot, Reader& reader) {
  TimeManagement& management = begin(slot);
  ModifyLookaheadMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  if (!management.modify_lookahead(slot, message.seconds)) return Violation::untimely;
  federates_[slot].lookahead = message.seconds;
  return std::nullopt;
}

Outcome TimeService::handle_advance(std::uint32_t slot, Reader& reader) {
  TimeManagement& management = begin(slot);
  AdvanceRequestMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  if (!management.request(slot, static_cast<AdvanceKind>(message.advance), message.time))
    return Violation::untimely;
  federates_[slot].is_advancing = true;
  return std::nullopt;
}

/// Asked twice in a row, answered once: the answer is longer than the question.
Outcome TimeService::handle_query(std::uint32_t slot) {
  begin(slot);
  if (asking_.empty() || asking_.back() != slot) asking_.push_back(slot);
  return std::nullopt;
}

Outcome TimeService::handle_switch(std::uint32_t slot, Reader& reader) {
  TimeManagement& management = begin(slot);
  TimeSwitchMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  bool is_allowed = false;
  switch (static_cast<TimeSwitch>(message.which)) {
    case TimeSwitch::enable_constrained:
      is_allowed = management.enable_constrained(slot);
      break;
    case TimeSwitch::disable_constrained:
      is_allowed = management.disable_constrained(slot);
      break;
    case TimeSwitch::disable_regulation:
      is_allowed = management.disable_regulation(slot);
      forget_final(slot);
      break;
  }
  return is_allowed ? Outcome() : Violation::untimely;
}

std::uint32_t TimeService::take_place() {
  if (free_.empty()) {
    messages_.emplace_back();
    return static_cast<std::uint32_t>(messages_.size() - 1);
  }
  const std::uint32_t index = free_.back();
  free_.pop_back();
  return index;
}

Outcome TimeService::handle_send(std::uint32_t slot, Reader& reader) {
  TimeManagement& management = begin(slot);
  TimedSendMessage wire;
  if (!exchange(reader, wire)) return Violation::malformed;
  if (!management.may_send(slot, wire.stamp.time)) return Violation::untimely;
  if (wire.number < federates_[slot].next_number) return Violation::malformed;
  if (is_full()) make_room(slot);
  if (is_full()) return Violation::over_limit;
  const std::uint32_t index = take_place();
  Message& message = messages_[index];
  message.sender = basis_.federates[slot].handle;
  message.number = wire.number;
  message.stamp = wire.stamp;
  if (const Outcome outcome = read_content(slot, wire.content, message)) {
    message.body.clear();
    release(index);
    return outcome;
  }
  return keep(slot, index);
}

Outcome TimeService::keep(std::uint32_t slot, std::uint32_t index) {
  Sender& from = federates_[slot];
  Message& message = messages_[index];
  from.next_number = message.number + 1;
  from.sent.push_back({message.number, index});
  from.bytes += message.body.size();
  bytes_ += message.body.size();
  message.is_retractable = true;
  arrived_.push_back(index);
  ++basis_.counters.timed_received;
  FederateCounts& counts = basis_.federates[slot].counts;
  if (message.kind == MessageKind::updates) ++counts.updates_sent;
  if (message.kind == MessageKind::interaction) ++counts.interactions_sent;
  if (from.sent.size() < from.compact_at && from.bytes < from.compact_bytes_at) return std::nullopt;
  forget_final(slot);
  return is_greedy(from) ? Violation::over_limit : Outcome();
}

bool TimeService::is_full() const {
  return messages_.size() - free_.size() >= basis_.settings.timed_max ||
         bytes_ >= basis_.settings.timed_bytes_max;
}

/// What a federate can still take back is there by its own doing: it says more than it lets time
/// pass.
bool TimeService::is_greedy(const Sender& sender) const {
  return sender.sent.size() > basis_.settings.timed_per_federate_max ||
         sender.bytes > basis_.settings.timed_bytes_per_federate_max;
}

/// Forgets what nobody can ask for any more. If that is not enough, whoever holds most of it up
/// must go: it must not cost the others the federate that they all listen to, nor those who wait
/// their place.
void TimeService::make_room(std::uint32_t speaker) {
  for (std::uint32_t slot = 0; slot < federates_.size(); ++slot) forget_final(slot);
  while (is_full()) {
    const std::uint32_t culprit = find_culprit();
    if (culprit == speaker || culprit == no_federate) return;
    expel_(culprit, Violation::over_limit, ResignReason::lost,
           "more waits for its time than the federation keeps");
    if (is_full()) settle();  // what it held up
  }
}

/// The regulating federate that is furthest behind.
std::uint32_t TimeService::find_last_regulating() const {
  std::uint32_t last = no_federate;
  for (std::uint32_t slot = 0; slot < basis_.federates.size(); ++slot)
    if (basis_.federates[slot].is_joined && management_->is_regulating(slot) &&
        (last == no_federate || management_->earliest(slot) < management_->earliest(last)))
      last = slot;
  return last;
}

/// A message that can still be taken back is there for its sender's sake. One that waits in time
/// for its receiver's next request is there for the receiver's; one that could not be delivered if
/// it asked is there for the sake of the regulating federate that is furthest behind.
std::uint32_t TimeService::find_culprit() const {
  const std::uint32_t count = basis_.federates.size(), last = find_last_regulating();
  std::vector<std::size_t> blamed(count);
  std::vector<double> galt(count);
  for (std::uint32_t slot = 0; slot < count; ++slot)
    if (basis_.federates[slot].is_joined) galt[slot] = management_->galt(slot);
  for (const Message& message : messages_) {
    const std::size_t weight = sizeof message + message.body.size();
    if (message.is_retractable) {
      blamed[basis_.federates.slot_of(message.sender)] += weight;
      continue;
    }
    for (const Message::Receiver& each : message.receivers) {
      const std::uint32_t receiver =
          each.is_waiting ? basis_.federates.slot_of(each.federate) : no_federate;
      const std::uint32_t culprit =
          receiver == no_federate || message.stamp.time < galt[receiver] ? receiver : last;
      if (culprit != no_federate) blamed[culprit] += weight;
    }
  }
  const auto worst = std::ranges::max_element(blamed);
  return worst == blamed.end() || *worst == 0 ? no_federate
                                              : static_cast<std::uint32_t>(worst - blamed.begin());
}

Outcome TimeService::read_content(std::uint32_t slot, Bytes bytes, Message& message) {
  Reader content(bytes);
  std::uint8_t kind = 0;
  content.number(kind);
  message.kind = static_cast<MessageKind>(kind);
  Outcome outcome = Violation::malformed;
  if (message.kind == MessageKind::updates) outcome = read_update(slot, content, message);
  if (message.kind == MessageKind::interaction) outcome = read_interaction(slot, content, message);
  if (message.kind == MessageKind::delete_object) outcome = read_deletion(slot, content, message);
  if (!outcome && !content.is_at_end()) outcome = Violation::malformed;
  return outcome;
}

Outcome TimeService::read_update(std::uint32_t slot, Reader& content, Message& message) {
  UpdatesMessage header;
  if (!exchange(content, header)) return Violation::malformed;
  if (header.object_class >= basis_.fom.object_classes().size()) return Violation::unknown_name;
  const ObjectClassHandle object_class{header.object_class};
  const AttributeSet attributes{header.attributes};
  if (!basis_.fom.attributes(object_class).includes(attributes) || attributes.is_empty())
    return Violation::unknown_name;
  if (!uses_.publications.of_class(slot, header.object_class).includes(attributes))
    return Violation::undeclared;
  std::size_t records = 0;
  const bool is_read = read_records(content, basis_.fom.at(object_class), attributes,
                                    [&](std::uint32_t handle, Bytes values) {
                                      message.object = handle;
                                      message.body.assign(values.begin(), values.end());
                                      return ++records == 1;
                                    });
  if (!is_read || records != 1) return Violation::malformed;
  const ObjectSlot object = basis_.objects.find({message.object});
  const bool is_late =
      object == no_object && uses_.known.is_late({message.object});  // then nobody will be told
  if (!is_late &&
      (object == no_object || basis_.objects[object].object_class != header.object_class))
    return Violation::unknown_name;
  if (!is_late && !uses_.ownership.owned_by(slot, object).includes(attributes))
    return Violation::not_owned;
  message.class_number = header.object_class;
  message.attributes = attributes;
  return std::nullopt;
}

Outcome TimeService::read_interaction(std::uint32_t slot, Reader& content, Message& message) {
  InteractionMessage wire;
  if (!exchange(content, wire)) return Violation::malformed;
  if (wire.interaction_class >= basis_.fom.interaction_classes().size())
    return Violation::unknown_name;
  if (!uses_.publications.has_interaction(slot, wire.interaction_class))
    return Violation::undeclared;
  message.class_number = wire.interaction_class;
  message.only = {wire.federate};
  message.body.assign(wire.parameters.begin(), wire.parameters.end());
  return std::nullopt;
}

Outcome TimeService::read_deletion(std::uint32_t slot, Reader& content, Message& message) {
  DeleteObjectMessage wire;
  if (!exchange(content, wire)) return Violation::malformed;
  const ObjectSlot object = basis_.objects.find({wire.object});
  const bool is_late =
      object == no_object ? uses_.known.is_late({wire.object})
                          : basis_.objects[object].is_leaving && uses_.known.is_late({wire.object});
  if (is_late) {  // what the first deletion does, and its retraction undoes, the second has no part
                  // in
    message.object = ObjectHandle::none;
    return std::nullopt;
  }
  if (object == no_object) return Violation::unknown_name;
  if (!uses_.ownership.owned_by(slot, object).contains(privilege_to_delete_object))
    return Violation::not_owned;
  basis_.objects[object].is_leaving = true;
  message.object = wire.object;
  return std::nullopt;
}

/// Drops what `slot` can't take back any more: its time stamp lies before the least that it could
/// still use.
void TimeService::forget_final(std::uint32_t slot) {
  Sender& from = federates_[slot];
  const double earliest = management_->earliest(slot);
  std::erase_if(from.sent, [&](const Sent& each) {
    if (messages_[each.message].stamp.time >= earliest) return false;
    from.bytes -= messages_[each.message].body.size();
    messages_[each.message].is_retractable = false;
    finish(each.message);
    return true;
  });
  // Seldom, and in any case where the sender's limit is passed.
  from.compact_at = std::min(std::max<std::size_t>(64, 2 * from.sent.size()),
                             basis_.settings.timed_per_federate_max + std::size_t{1});
  from.compact_bytes_at = std::min(std::max<std::size_t>(1u << 20, 2 * from.bytes),
                                   basis_.settings.timed_bytes_per_federate_max + 1);
}

Outcome TimeService::handle_retract(std::uint32_t slot, Reader& reader) {
  TimeManagement& management = begin(slot);
  RetractMessage wire;
  if (!exchange(reader, wire)) return Violation::malformed;
  Sender& from = federates_[slot];
  const auto found = std::ranges::lower_bound(from.sent, wire.number, {}, &Sent::number);
  if (found == from.sent.end() || found->number != wire.number)
    return std::nullopt;  // retracted before, or too late
  const std::uint32_t index = found->message;
  const Message& message = messages_[index];
  if (message.stamp.time < management.earliest(slot)) return std::nullopt;
  from.sent.erase(found);
  from.bytes -= message.body.size();
  ++basis_.counters.retractions;
  withdraw(index);
  if (message.kind == MessageKind::delete_object) {
    const ObjectSlot object = basis_.objects.find({message.object});
    if (object != no_object)
      basis_.objects[object].is_leaving = false, uses_.distribution.object_registered(object);
  }
  finish(index);
  return std::nullopt;
}

/// From all queues; those who have it are asked to take it back.
void TimeService::withdraw(std::uint32_t index) {
  Message& message = messages_[index];
  message.is_retracted = true;
  message.is_retractable = false;
  for (std::uint32_t place = 0; place < message.receivers.size(); ++place) {
    Message::Receiver& receiver = message.receivers[place];
    const std::optional<std::uint32_t> at = basis_.federates.joined(receiver.federate);
    if (!at) continue;
    if (receiver.is_waiting)
      management_->withdraw(
          *at, {message.stamp.time, message.sender.value, message.number, index, place});
    if (receiver.has_it)
      basis_.federates[*at].outbox.after_updates(
          RequestRetractionMessage{message.sender.value, message.number, message.stamp.time});
    receiver.is_waiting = false;
  }
  message.waiting = 0;
}

}  // namespace rink::rti
