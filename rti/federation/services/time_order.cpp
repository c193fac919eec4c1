// Messages in time-stamp order on their way: whom they go to, when they are told, and what they
// leave behind.
#include <bit>

#include "rti/federation/services/time_service.h"
#include "rti/fom/coded_values.h"
#include "rti/wire/update_block.h"

namespace rink::rti {

namespace {

/// Memory of messages that is used again: bytes of a body, and places once all are free. A flood's
/// goes with it.
constexpr std::size_t body_kept_max = 512, places_kept_max = 4096;

template <class Message>
void write_into(std::vector<std::byte>& bytes, Message message) {
  write(bytes, message);
}

}  // namespace

void TimeService::settle() {
  if (!management_) return;
  for (const std::uint32_t index : arrived_) distribute(index);
  arrived_.clear();
  management_->settle(*this);
  for (const std::uint32_t slot : asking_)
    basis_.federates[slot].outbox.after_updates(
        TimeBoundsMessage{management_->galt(slot), management_->lits(slot)});
  asking_.clear();
}

void TimeService::find_receivers(Message& message) {
  const auto add = [&](std::uint32_t slot, AttributeSet told) {
    if (basis_.federates[slot].handle != message.sender)
      message.receivers.push_back({basis_.federates[slot].handle, told});
  };
  if (message.kind == MessageKind::interaction) {
    // The sender may be gone: its handle then names nobody's slot, and the check in `add` is all
    // there is.
    const std::uint32_t sender = basis_.federates.joined(message.sender).value_or(no_federate);
    for (const std::uint32_t slot : uses_.interactions.receivers(message.class_number, sender))
      if (!message.only || basis_.federates[slot].handle == message.only) add(slot, {});
    return;
  }
  const ObjectSlot object = basis_.objects.find({message.object});
  if (object == no_object) return;
  for (std::uint32_t slot = 0; slot < basis_.federates.size(); ++slot) {
    if (!basis_.federates[slot].is_joined) continue;
    const FederateInterest& interest = uses_.distribution.of(slot);
    const AttributeSet told =
        interest.told(object, basis_.objects[object].object_class) & message.attributes;
    const bool is_concerned =
        message.kind == MessageKind::updates
            ? !told.is_empty()
            : interest.known.contains(object) || interest.in_scope.contains(object);
    if (is_concerned) add(slot, told);
  }
  if (message.kind == MessageKind::delete_object)
    uses_.distribution.object_deleted(object);  // nobody else shall discover it any more
}

/// To the queues of those who are constrained, to the others at once.
void TimeService::distribute(std::uint32_t index) {
  Message& message = messages_[index];
  message.is_distributed = true;
  if (!message.is_retracted) find_receivers(message);
  for (std::uint32_t place = 0; place < message.receivers.size(); ++place) {
    Message::Receiver& receiver = message.receivers[place];
    const std::uint32_t slot = basis_.federates.slot_of(receiver.federate);
    receiver.is_waiting = management_->is_constrained(slot);
    if (!receiver.is_waiting) {
      receiver.has_it = tell(slot, message, receiver.told, false);
      continue;
    }
    ++message.waiting;
    management_->enqueue(slot,
                         {message.stamp.time, message.sender.value, message.number, index, place});
  }
  if (message.waiting == 0 && !message.is_retracted) complete(message);
  finish(index);
}

/// The message in the form in which it travels, in `content_`.
void TimeService::write_content(const Message& message, AttributeSet told) {
  content_.clear();
  if (message.kind == MessageKind::interaction) {
    write_into(content_,
               InteractionMessage{message.class_number, message.sender.value, {}, message.body});
    return;
  }
  if (message.kind == MessageKind::delete_object) {
    write_into(content_, RemoveObjectMessage{message.object});
    return;
  }
  write_into(content_, UpdatesMessage{message.class_number, told.bits});
  write_handle(content_, 0, message.object);
  const ObjectClass& object_class = basis_.fom.at(ObjectClassHandle{message.class_number});
  for (std::uint32_t bits = told.bits; bits != 0; bits &= bits - 1) {
    const AttributeHandle attribute{static_cast<std::uint32_t>(std::countr_zero(bits))};
    const Bytes value = told == message.attributes ? Bytes(message.body)
                                                   : coded_value(object_class, message.attributes,
                                                                 attribute, message.body);
    content_.insert(content_.end(), value.begin(), value.end());
    if (told == message.attributes) break;  // the whole at once
  }
  content_.push_back(std::byte{0});
}

/// False if there is nothing to tell, since the object is gone meanwhile.
bool TimeService::tell(std::uint32_t slot, const Message& message, AttributeSet told,
                       bool is_in_order) {
  if (message.kind != MessageKind::interaction) {
    const ObjectSlot object = basis_.objects.find({message.object});
    if (object == no_object) return false;
    FederateInterest& interest = uses_.distribution.of(slot);
    const bool is_known = interest.known.contains(object);
    const bool is_in_scope = interest.in_scope.contains(object);
    if (!is_known && !is_in_scope) return false;
    if (message.kind == MessageKind::delete_object) {
      interest.unannounced.erase(object);  // for who was not told of it, it was never there
      if (!is_known) return false;
      interest.known.erase(object);
    } else if (is_in_scope && (!is_known || interest.unannounced.contains(object) ||
                               interest.fresh.contains(object))) {
      uses_.announcements.press(slot, object);
    }
  }
  write_content(message, told);
  basis_.federates[slot].outbox.after_updates(
      TimedDeliveryMessage{message.sender.value, static_cast<std::uint8_t>(is_in_order),
                           message.number, message.stamp, content_});
  ++basis_.counters.timed_sent;
  FederateCounts& counts = basis_.federates[slot].counts;
  if (message.kind == MessageKind::updates) ++counts.reflections_received;
  if (message.kind == MessageKind::interaction) ++counts.interactions_received;
  return true;
}

void TimeService::deliver(std::uint32_t federate, const TimedEntry& entry) {
  Message& message = messages_[entry.message];
  Message::Receiver& receiver = message.receivers[entry.place];
  receiver.is_waiting = false;
  receiver.has_it = tell(federate, message, receiver.told, management_->is_constrained(federate));
  if (--message.waiting == 0) complete(message);
  finish(entry.message);
}

void TimeService::discard(std::uint32_t, const TimedEntry& entry) {
  Message& message = messages_[entry.message];
  message.receivers[entry.place].is_waiting = false;
  if (--message.waiting == 0) complete(message);
  finish(entry.message);
}

/// Nobody waits for it any more: what it says is now the state that newcomers are told. (Earlier,
/// they would be told what is to come.)
void TimeService::complete(const Message& message) {
  const ObjectSlot slot =
      message.kind == MessageKind::interaction ? no_object : basis_.objects.find({message.object});
  if (slot == no_object) return;
  if (message.kind == MessageKind::delete_object) {
    told_until_.erase(message.object);
    return uses_.objects.remove(slot);
  }
  if (!is_news(message)) return;
  basis_.objects.store(slot, message.attributes, message.body);
  const Object& object = basis_.objects[slot];
  if (object.owner == no_federate) return;
  uses_.newest.say_if_newer(object.owner, message.stamp);
}

/// False for an update that is completed after a later one of its object, which had fewer to wait
/// for.
bool TimeService::is_news(const Message& message) {
  if (told_until_.size() > 64 + 2 * basis_.objects.size())
    std::erase_if(told_until_, [this](const auto& each) {
      return basis_.objects.find({each.first}) == no_object;
    });
  double& until = told_until_.try_emplace(message.object, message.stamp.time).first->second;
  if (message.stamp.time < until) return false;
  until = message.stamp.time;
  return true;
}

/// Frees the message's place once nobody can ask for it.
void TimeService::finish(std::uint32_t index) {
  const Message& message = messages_[index];
  if (message.is_distributed && !message.is_retractable && message.waiting == 0) release(index);
}

void TimeService::release(std::uint32_t index) {
  Message& message = messages_[index];
  std::vector<std::byte> body = std::move(message.body);
  std::vector<Message::Receiver> receivers = std::move(message.receivers);
  bytes_ -= body.size();
  body.clear();
  if (body.capacity() > body_kept_max) body = {};
  receivers.clear();
  message = {};
  message.body = std::move(body);
  message.receivers = std::move(receivers);
  free_.push_back(index);
  if (free_.size() < messages_.size() || free_.size() <= places_kept_max) return;
  messages_ = {};
  free_ = {};
}

void TimeService::regulation_enabled(std::uint32_t federate, double time, double earliest) {
  basis_.federates[federate].outbox.after_updates(TimeRegulationEnabledMessage{time, earliest});
}
void TimeService::constrained_enabled(std::uint32_t federate, double time) {
  basis_.federates[federate].outbox.after_updates(TimeConstrainedEnabledMessage{time});
}
void TimeService::grant(std::uint32_t federate, double time) {
  basis_.federates[federate].outbox.after_updates(TimeAdvanceGrantMessage{time});
  federates_[federate].is_advancing = false;
  ++basis_.counters.time_advance_grants;
}

}  // namespace rink::rti
