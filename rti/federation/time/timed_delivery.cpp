// Finds receivers of messages in time-stamp order, sends the messages, and stores the state that
// they leave.
#include "rti/federation/time/timed_delivery.h"

#include <cassert>

#include "rti/fom/coded_values.h"
#include "rti/wire/time_messages.h"
#include "rti/wire/update_block.h"

namespace rink::rti {

namespace {

template <class Message>
void write_into(std::vector<std::byte>& bytes, Message message) {
  write(bytes, message);
}

/// One receiver's share of a message, as the time management orders it.
TimedEntry entry_of(const StampedMessage& message, std::uint32_t index, std::uint32_t place) {
  return {message.stamp.time, message.sender.value, message.number, index, place};
}

}  // namespace

void TimedDelivery::accept(std::uint32_t index) {
  arrived_.push_back(index);
  if (messages_[index].kind != MessageKind::updates) return;
  const ObjectSlot object = basis_.objects.find({messages_[index].object});
  if (object != no_object) uses_.residuals.bar(basis_.objects[object], object);
}

void TimedDelivery::distribute(TimeManagement& management) {
  for (const std::uint32_t index : arrived_) distribute(index, management);
  arrived_.clear();
}

void TimedDelivery::distribute(std::uint32_t index, TimeManagement& management) {
  const StampedMessage& message = messages_[index];
  if (!message.is_retracted) find_receivers(index);
  messages_.distributed(index);
  for (std::uint32_t place = 0; place < message.receivers.size(); ++place) {
    const StampedMessage::Receiver& receiver = message.receivers[place];
    const std::uint32_t slot = basis_.federates.slot_of(receiver.federate);
    if (management.is_constrained(slot)) {
      messages_.enqueued(index, place);
      management.enqueue(slot, entry_of(message, index, place));
    } else if (send(slot, message, receiver.attributes, false)) {
      messages_.sent(index, place);
    }
  }
  if (message.waiting == 0 && !message.is_retracted) complete(message);
  messages_.finish(index);
}

void TimedDelivery::add_receiver(std::uint32_t index, std::uint32_t slot, AttributeSet attributes) {
  const FederateHandle federate = basis_.federates[slot].handle;
  if (federate != messages_[index].sender) messages_.add_receiver(index, federate, attributes);
}

void TimedDelivery::find_receivers(std::uint32_t index) {
  const StampedMessage& message = messages_[index];
  if (message.kind == MessageKind::interaction) return find_listeners(index);
  const ObjectSlot object = basis_.objects.find({message.object});
  if (object == no_object) return;
  find_reflectors(index, object);
  if (message.kind == MessageKind::delete_object)
    uses_.distribution.object_deleted(object);  // no other federate may discover it any more
}

void TimedDelivery::find_listeners(std::uint32_t index) {
  const StampedMessage& message = messages_[index];
  // The sender may have left: its handle then has no slot, and only the check in add_receiver()
  // remains.
  const std::uint32_t sender = basis_.federates.joined(message.sender).value_or(no_federate);
  for (const std::uint32_t slot : uses_.interactions.receivers(message.class_number, sender))
    if (!message.only || basis_.federates[slot].handle == message.only)
      add_receiver(index, slot, {});
}

void TimedDelivery::find_reflectors(std::uint32_t index, ObjectSlot object) {
  const StampedMessage& message = messages_[index];
  for (std::uint32_t slot = 0; slot < basis_.federates.size(); ++slot) {
    if (!basis_.federates[slot].is_joined) continue;
    const FederateInterest& interest = uses_.distribution.of(slot);
    const AttributeSet attributes =
        interest.attributes_in_scope(object, basis_.objects[object].object_class) &
        message.attributes;
    const bool is_concerned =
        message.kind == MessageKind::updates
            ? !attributes.is_empty()
            : interest.known.contains(object) || interest.in_scope.contains(object);
    if (is_concerned) add_receiver(index, slot, attributes);
  }
}

/// Writes the message into `content_` as it is sent.
void TimedDelivery::write_content(const StampedMessage& message, AttributeSet attributes) {
  content_.clear();
  if (message.kind == MessageKind::interaction)
    return write_into(
        content_, InteractionMessage{message.class_number, message.sender.value, {}, message.body});
  if (message.kind == MessageKind::delete_object)
    return write_into(content_, RemoveObjectMessage{message.object});
  write_update(message, attributes);
}

void TimedDelivery::write_update(const StampedMessage& message, AttributeSet attributes) {
  write_into(content_, UpdatesMessage{message.class_number, attributes.bits});
  write_handle(content_, 0, message.object);
  const ObjectClass& object_class = basis_.fom.at(ObjectClassHandle{message.class_number});
  for (const AttributeHandle attribute : attributes) {
    const Bytes value =
        attributes == message.attributes
            ? Bytes(message.body)
            : coded_value(object_class, message.attributes, attribute, message.body);
    content_.insert(content_.end(), value.begin(), value.end());
    if (attributes == message.attributes) break;  // the whole at once
  }
  content_.push_back(std::byte{0});
}

/// The receiver of an update or a deletion must know the object: false if it does not, or the
/// object is gone meanwhile.
bool TimedDelivery::prepare(std::uint32_t slot, const StampedMessage& message) {
  const ObjectSlot object = basis_.objects.find({message.object});
  if (object == no_object) return false;
  FederateInterest& interest = uses_.distribution.of(slot);
  const bool is_known = interest.known.contains(object);
  const bool is_in_scope = interest.in_scope.contains(object);
  if (!is_known && !is_in_scope) return false;
  if (message.kind == MessageKind::delete_object) {
    interest.unannounced.erase(object);  // the federate was never sent the object
    if (!is_known) return false;
    interest.known.erase(object);
  } else if (is_in_scope && (!is_known || interest.unannounced.contains(object) ||
                             interest.needs_full_state.contains(object))) {
    uses_.announcements.send_state_now(slot, object);
  }
  return true;
}

/// False if there is nothing to send.
bool TimedDelivery::send(std::uint32_t slot, const StampedMessage& message, AttributeSet attributes,
                         bool is_in_order) {
  if (message.kind != MessageKind::interaction && !prepare(slot, message)) return false;
  write_content(message, attributes);
  basis_.federates[slot].outbox.after_updates(
      TimedDeliveryMessage{message.sender.value, static_cast<std::uint8_t>(is_in_order),
                           message.number, message.stamp, content_});
  ++basis_.counters.timed_sent;
  FederateCounts& counts = basis_.federates[slot].counts;
  if (message.kind == MessageKind::updates) ++counts.reflections_received;
  if (message.kind == MessageKind::interaction) ++counts.interactions_received;
  return true;
}

void TimedDelivery::deliver(std::uint32_t slot, const TimedEntry& entry, bool is_in_order) {
  const StampedMessage& message = messages_[entry.message];
  assert(entry.place < message.receivers.size());
  if (send(slot, message, message.receivers[entry.place].attributes, is_in_order))
    messages_.sent(entry.message, entry.place);
  discard(entry);
}

void TimedDelivery::discard(const TimedEntry& entry) {
  if (messages_.dequeued(entry.message, entry.place)) complete(messages_[entry.message]);
  messages_.finish(entry.message);
}

void TimedDelivery::withdraw(std::uint32_t index, TimeManagement& management) {
  const StampedMessage& message = messages_[index];
  for (std::uint32_t place = 0; place < message.receivers.size(); ++place) {
    const StampedMessage::Receiver& receiver = message.receivers[place];
    const std::optional<std::uint32_t> at = basis_.federates.joined(receiver.federate);
    if (!at) continue;
    if (receiver.is_waiting) management.withdraw(*at, entry_of(message, index, place));
    if (receiver.has_it)
      basis_.federates[*at].outbox.after_updates(
          RequestRetractionMessage{message.sender.value, message.number, message.stamp.time});
  }
  messages_.withdrawn(index);
  const ObjectSlot object = message.kind == MessageKind::delete_object
                                ? basis_.objects.find({message.object})
                                : no_object;
  if (object == no_object) return;
  basis_.objects[object].is_leaving = false;
  uses_.distribution.object_registered(object);
}

/// No receiver waits for the message any more: its values become the state that new subscribers
/// receive. (Earlier, they would receive a state of the future.)
void TimedDelivery::complete(const StampedMessage& message) {
  const ObjectSlot slot =
      message.kind == MessageKind::interaction ? no_object : basis_.objects.find({message.object});
  if (slot == no_object) return;
  if (message.kind == MessageKind::delete_object) {
    stored_until_.erase(message.object);
    return uses_.objects.remove(slot);
  }
  if (!is_news(message)) return;
  basis_.objects.store(slot, message.attributes, message.body);
  const Object& object = basis_.objects[slot];
  if (object.owner == no_federate) return;
  uses_.newest.note_if_newer(object.owner, message.stamp);
}

/// False for an update that is completed after a later one of its object, which had fewer to wait
/// for.
bool TimedDelivery::is_news(const StampedMessage& message) {
  if (stored_until_.size() > 64 + 2 * basis_.objects.size())
    std::erase_if(stored_until_, [this](const auto& each) {
      return basis_.objects.find({each.first}) == no_object;
    });
  double& until = stored_until_.try_emplace(message.object, message.stamp.time).first->second;
  if (message.stamp.time < until) return false;
  until = message.stamp.time;
  return true;
}

}  // namespace rink::rti
