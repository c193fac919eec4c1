// Time management in the federation execution: requests in, messages in time-stamp order and grants
// out.
#include "rti/federation/federation_time.h"

#include <algorithm>

#include "rti/time/conservative_time.h"
#include "rti/wire/update_block.h"

namespace rink::rti {

Outcome FederationParts::take_time(std::uint32_t slot, MessageKind kind, Reader& reader) {
  federates_[slot].has_stream_only =
      true;  // whose messages wait for its time, which no datagram could keep up with
  if (!time_) {
    auto management =
        make_time_management_ ? make_time_management_() : std::make_unique<ConservativeTime>();
    time_ = std::make_unique<Time>(*this, std::move(management));
  }
  return time_->take(slot, kind, reader);
}

void FederationParts::settle_time() {
  if (time_) time_->settle();
}

void FederationParts::leave_time(std::uint32_t slot) {
  if (time_) time_->leave(slot);
}

Outcome FederationParts::Time::take(std::uint32_t slot, MessageKind kind, Reader& reader) {
  switch (kind) {
    case MessageKind::timed_send:
      return take_message(slot, reader);
    case MessageKind::retract:
      return retract(slot, reader);
    case MessageKind::time_switch:
      return take_switch(slot, reader);
    case MessageKind::query_time_bounds:
      if (asking_.empty() || asking_.back() != slot)
        asking_.push_back(
            slot);  // asked twice in a row, answered once: the answer is longer than the question
      return std::nullopt;
    case MessageKind::advance_request: {
      AdvanceRequestMessage message;
      if (!exchange(reader, message)) return Violation::malformed;
      if (!management_->request(slot, static_cast<AdvanceKind>(message.advance), message.time))
        return Violation::untimely;
      parts_.federates_[slot].is_advancing = true;
      return std::nullopt;
    }
    default:
      break;
  }
  EnableTimeRegulationMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  const bool is_allowed = kind == MessageKind::modify_lookahead
                              ? management_->modify_lookahead(slot, message.seconds)
                              : management_->enable_regulation(slot, message.seconds);
  if (is_allowed) parts_.federates_[slot].lookahead = message.seconds;
  return is_allowed ? Outcome() : Violation::untimely;
}

Outcome FederationParts::Time::take_switch(std::uint32_t slot, Reader& reader) {
  TimeSwitchMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  bool is_allowed = false;
  switch (static_cast<TimeSwitch>(message.which)) {
    case TimeSwitch::enable_constrained:
      is_allowed = management_->enable_constrained(slot);
      break;
    case TimeSwitch::disable_constrained:
      is_allowed = management_->disable_constrained(slot);
      break;
    case TimeSwitch::disable_regulation:
      is_allowed = management_->disable_regulation(slot);
      forget_final(slot);
      break;
  }
  return is_allowed ? Outcome() : Violation::untimely;
}

std::uint32_t FederationParts::Time::take_place() {
  if (free_.empty()) {
    messages_.emplace_back();
    return static_cast<std::uint32_t>(messages_.size() - 1);
  }
  const std::uint32_t index = free_.back();
  free_.pop_back();
  return index;
}

FederationParts::Time::Sender& FederationParts::Time::sender(std::uint32_t slot) {
  if (slot >= senders_.size()) senders_.resize(slot + 1);
  return senders_[slot];
}

Outcome FederationParts::Time::take_message(std::uint32_t slot, Reader& reader) {
  TimedSendMessage wire;
  if (!exchange(reader, wire)) return Violation::malformed;
  if (!management_->may_send(slot, wire.stamp.time)) return Violation::untimely;
  Sender& from = sender(slot);
  if (wire.number < from.next_number) return Violation::malformed;
  if (is_full()) make_room(slot);
  if (is_full()) return Violation::over_limit;
  const std::uint32_t index = take_place();
  Message& message = messages_[index];
  message.sender = parts_.federates_[slot].handle;
  message.number = wire.number;
  message.stamp = wire.stamp;
  if (const Outcome outcome = read_content(slot, wire.content, message)) {
    message.body.clear();
    release(index);
    return outcome;
  }
  from.next_number = wire.number + 1;
  from.sent.push_back({wire.number, index});
  from.bytes += message.body.size();
  bytes_ += message.body.size();
  message.is_retractable = true;
  arrived_.push_back(index);
  ++parts_.counters_.timed_received;
  FederateCounts& counts = parts_.federates_[slot].counts;
  if (message.kind == MessageKind::updates) ++counts.updates_sent;
  if (message.kind == MessageKind::interaction) ++counts.interactions_sent;
  if (from.sent.size() < from.compact_at && from.bytes < from.compact_bytes_at) return std::nullopt;
  forget_final(slot);
  return is_greedy(from) ? Violation::over_limit : Outcome();
}

bool FederationParts::Time::is_full() const {
  return messages_.size() - free_.size() >= parts_.settings_.timed_max ||
         bytes_ >= parts_.settings_.timed_bytes_max;
}

/// What a federate can still take back is there by its own doing: it says more than it lets time
/// pass.
bool FederationParts::Time::is_greedy(const Sender& sender) const {
  return sender.sent.size() > parts_.settings_.timed_per_federate_max ||
         sender.bytes > parts_.settings_.timed_bytes_per_federate_max;
}

/// Forgets what nobody can ask for any more. If that is not enough, whoever holds most of it up
/// must go: it must not cost the others the federate that they all listen to, nor those who wait
/// their place.
void FederationParts::Time::make_room(std::uint32_t speaker) {
  for (std::uint32_t slot = 0; slot < senders_.size(); ++slot) forget_final(slot);
  while (is_full()) {
    const std::uint32_t culprit = find_culprit();
    if (culprit == speaker || culprit == no_federate) return;
    parts_.expel(parts_.federates_[culprit].connection, Violation::over_limit, ResignReason::lost,
                 "more waits for its time than the federation keeps");
    if (is_full()) settle();  // what it held up
  }
}

/// A message that can still be taken back is there for its sender's sake. One that waits in time
/// for its receiver's next request is there for the receiver's; one that could not be delivered if
/// it asked is there for the sake of the regulating federate that is furthest behind.
std::uint32_t FederationParts::Time::find_culprit() const {
  const auto count = static_cast<std::uint32_t>(parts_.federates_.size());
  std::vector<std::size_t> blamed(count);
  std::vector<double> galt(count);
  std::uint32_t last = no_federate;
  for (std::uint32_t slot = 0; slot < count; ++slot) {
    if (!parts_.federates_[slot].is_joined) continue;
    galt[slot] = management_->galt(slot);
    if (management_->is_regulating(slot) &&
        (last == no_federate || management_->earliest(slot) < management_->earliest(last)))
      last = slot;
  }
  for (const Message& message : messages_) {
    const std::size_t weight = sizeof message + message.body.size();
    if (message.is_retractable) {
      blamed[parts_.federates_.slot_of(message.sender)] += weight;
      continue;
    }
    for (const Message::Receiver& each : message.receivers) {
      const std::uint32_t receiver =
          each.is_waiting ? parts_.federates_.slot_of(each.federate) : no_federate;
      const std::uint32_t culprit =
          receiver == no_federate || message.stamp.time < galt[receiver] ? receiver : last;
      if (culprit != no_federate) blamed[culprit] += weight;
    }
  }
  const auto worst = std::ranges::max_element(blamed);
  return worst == blamed.end() || *worst == 0 ? no_federate
                                              : static_cast<std::uint32_t>(worst - blamed.begin());
}

Outcome FederationParts::Time::read_content(std::uint32_t slot, Bytes bytes, Message& message) {
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

Outcome FederationParts::Time::read_update(std::uint32_t slot, Reader& content, Message& message) {
  UpdatesMessage header;
  if (!exchange(content, header)) return Violation::malformed;
  if (header.object_class >= parts_.fom_.object_classes().size()) return Violation::unknown_name;
  const ObjectClassHandle object_class{header.object_class};
  const AttributeSet attributes{header.attributes};
  if (!parts_.fom_.attributes(object_class).includes(attributes) || attributes.is_empty())
    return Violation::unknown_name;
  if (!parts_.publications_.of_class(slot, header.object_class).includes(attributes))
    return Violation::undeclared;
  std::size_t records = 0;
  const bool is_read = read_records(content, parts_.fom_.at(object_class), attributes,
                                    [&](std::uint32_t handle, Bytes values) {
                                      message.object = handle;
                                      message.body.assign(values.begin(), values.end());
                                      return ++records == 1;
                                    });
  if (!is_read || records != 1) return Violation::malformed;
  const ObjectSlot object = parts_.objects_.find({message.object});
  const bool is_late =
      object == no_object && parts_.known_.is_late({message.object});  // then nobody will be told
  if (!is_late &&
      (object == no_object || parts_.objects_[object].object_class != header.object_class))
    return Violation::unknown_name;
  if (!is_late && !parts_.ownership_.owned_by(slot, object).includes(attributes))
    return Violation::not_owned;
  message.class_number = header.object_class;
  message.attributes = attributes;
  return std::nullopt;
}

Outcome FederationParts::Time::read_interaction(std::uint32_t slot, Reader& content,
                                                Message& message) {
  InteractionMessage wire;
  if (!exchange(content, wire)) return Violation::malformed;
  if (wire.interaction_class >= parts_.fom_.interaction_classes().size())
    return Violation::unknown_name;
  if (!parts_.publications_.has_interaction(slot, wire.interaction_class))
    return Violation::undeclared;
  message.class_number = wire.interaction_class;
  message.only = {wire.federate};
  message.body.assign(wire.parameters.begin(), wire.parameters.end());
  return std::nullopt;
}

Outcome FederationParts::Time::read_deletion(std::uint32_t slot, Reader& content,
                                             Message& message) {
  DeleteObjectMessage wire;
  if (!exchange(content, wire)) return Violation::malformed;
  const ObjectSlot object = parts_.objects_.find({wire.object});
  const bool is_late = object == no_object ? parts_.known_.is_late({wire.object})
                                           : parts_.objects_[object].is_leaving &&
                                                 parts_.known_.is_late({wire.object});
  if (is_late) {  // what the first deletion does, and its retraction undoes, the second has no part
                  // in
    message.object = ObjectHandle::none;
    return std::nullopt;
  }
  if (object == no_object) return Violation::unknown_name;
  if (!parts_.ownership_.owned_by(slot, object).contains(privilege_to_delete_object))
    return Violation::not_owned;
  parts_.objects_[object].is_leaving = true;
  message.object = wire.object;
  return std::nullopt;
}

/// Drops what `slot` can't take back any more: its time stamp lies before the least that it could
/// still use.
void FederationParts::Time::forget_final(std::uint32_t slot) {
  Sender& from = sender(slot);
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
                             parts_.settings_.timed_per_federate_max + std::size_t{1});
  from.compact_bytes_at = std::min(std::max<std::size_t>(1u << 20, 2 * from.bytes),
                                   parts_.settings_.timed_bytes_per_federate_max + 1);
}

Outcome FederationParts::Time::retract(std::uint32_t slot, Reader& reader) {
  RetractMessage wire;
  if (!exchange(reader, wire)) return Violation::malformed;
  std::vector<Sent>& sent = sender(slot).sent;
  const auto found = std::ranges::lower_bound(sent, wire.number, {}, &Sent::number);
  if (found == sent.end() || found->number != wire.number)
    return std::nullopt;  // retracted before, or too late
  const std::uint32_t index = found->message;
  Message& message = messages_[index];
  if (message.stamp.time < management_->earliest(slot)) return std::nullopt;
  sent.erase(found);
  sender(slot).bytes -= message.body.size();
  ++parts_.counters_.retractions;
  message.is_retracted = true;
  message.is_retractable = false;
  for (std::uint32_t place = 0; place < message.receivers.size(); ++place) {
    Message::Receiver& receiver = message.receivers[place];
    if (!is_here(receiver.federate)) continue;
    const std::uint32_t at = parts_.federates_.slot_of(receiver.federate);
    if (receiver.is_waiting)
      management_->withdraw(
          at, {message.stamp.time, message.sender.value, message.number, index, place});
    if (receiver.has_it)
      parts_.federates_[at].outbox.after_updates(
          RequestRetractionMessage{message.sender.value, message.number, message.stamp.time});
    receiver.is_waiting = false;
  }
  message.waiting = 0;
  if (message.kind == MessageKind::delete_object) {
    const ObjectSlot object = parts_.objects_.find({message.object});
    if (object != no_object)
      parts_.objects_[object].is_leaving = false, parts_.interest_.object_registered(object);
  }
  finish(index);
  return std::nullopt;
}

void FederationParts::Time::leave(std::uint32_t slot) {
  management_->remove(slot, *this);
  std::erase(asking_, slot);
  if (slot >= senders_.size()) return;
  for (const Sent& each : senders_[slot].sent) {
    messages_[each.message].is_retractable = false;
    finish(each.message);
  }
  senders_[slot] = {};
}

}  // namespace rink::rti
