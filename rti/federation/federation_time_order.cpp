// Messages in time-stamp order on their way: whom they go to, when they are told, and what they
// leave behind.
#include <algorithm>

#include "rti/federation/federation_time.h"
#include "rti/fom/coded_values.h"
#include "rti/wire/update_block.h"

namespace rink::rti {

namespace {

/// Memory of messages that is used again: bytes of a body, and places once all are free. A flood's
/// goes with it.
constexpr std::size_t body_kept_max = 512, places_kept_max = 4096;

}  // namespace

void FederationParts::Time::settle() {
  for (const std::uint32_t index : arrived_) distribute(index);
  arrived_.clear();
  management_->settle(*this);
  for (const std::uint32_t slot : asking_)
    parts_.federates_[slot].outbox.after_updates(
        TimeBoundsMessage{management_->galt(slot), management_->lits(slot)});
  asking_.clear();
}

bool FederationParts::Time::is_here(FederateHandle federate) const {
  return parts_.federates_.joined(federate).has_value();
}

void FederationParts::Time::find_receivers(Message& message) {
  const auto add = [&](std::uint32_t slot, AttributeSet told) {
    if (parts_.federates_[slot].handle != message.sender)
      message.receivers.push_back({parts_.federates_[slot].handle, told});
  };
  if (message.kind == MessageKind::interaction) {
    // The sender may be gone: its handle then names nobody's slot, and the check in `add` is all
    // there is.
    for (const std::uint32_t slot : parts_.interactions_.receivers(
             message.class_number,
             is_here(message.sender) ? parts_.federates_.slot_of(message.sender) : no_federate))
      if (!message.only || parts_.federates_[slot].handle == message.only) add(slot, {});
    return;
  }
  const ObjectSlot object = parts_.objects_.find({message.object});
  if (object == no_object) return;
  for (std::uint32_t slot = 0; slot < parts_.federates_.size(); ++slot) {
    if (!parts_.federates_[slot].is_joined) continue;
    const FederateInterest& interest = parts_.interest_.of(slot);
    const AttributeSet told =
        interest.told(object, parts_.objects_[object].object_class) & message.attributes;
    const bool is_concerned =
        message.kind == MessageKind::updates
            ? !told.is_empty()
            : interest.known.contains(object) || interest.in_scope.contains(object);
    if (is_concerned) add(slot, told);
  }
  if (message.kind == MessageKind::delete_object)
    parts_.interest_.object_deleted(object);  // nobody else shall discover it any more
}

/// To the queues of those who are constrained, to the others at once.
void FederationParts::Time::distribute(std::uint32_t index) {
  Message& message = messages_[index];
  message.is_distributed = true;
  if (!message.is_retracted) find_receivers(message);
  for (std::uint32_t place = 0; place < message.receivers.size(); ++place) {
    Message::Receiver& receiver = message.receivers[place];
    const std::uint32_t slot = parts_.federates_.slot_of(receiver.federate);
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
void FederationParts::Time::write_content(const Message& message, AttributeSet told) {
  content_.clear();
  if (message.kind == MessageKind::interaction) {
    say(content_, InteractionMessage{message.class_number, message.sender.value, {}, message.body});
    return;
  }
  if (message.kind == MessageKind::delete_object) {
    say(content_, RemoveObjectMessage{message.object});
    return;
  }
  say(content_, UpdatesMessage{message.class_number, told.bits});
  write_handle(content_, 0, message.object);
  const ObjectClass& object_class = parts_.fom_.at(ObjectClassHandle{message.class_number});
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
bool FederationParts::Time::tell(std::uint32_t slot, const Message& message, AttributeSet told,
                                 bool is_in_order) {
  if (message.kind != MessageKind::interaction) {
    const ObjectSlot object = parts_.objects_.find({message.object});
    if (object == no_object) return false;
    FederateInterest& interest = parts_.interest_.of(slot);
    const bool is_known = interest.known.contains(object);
    const bool is_in_scope = interest.in_scope.contains(object);
    if (!is_known && !is_in_scope) return false;
    if (message.kind == MessageKind::delete_object) {
      interest.unannounced.erase(object);  // for who was not told of it, it was never there
      if (!is_known) return false;
      interest.known.erase(object);
    } else if (is_in_scope && (!is_known || interest.unannounced.contains(object) ||
                               interest.fresh.contains(object))) {
      parts_.announcements_.press(slot, object);
    }
  }
  write_content(message, told);
  parts_.federates_[slot].outbox.after_updates(
      TimedDeliveryMessage{message.sender.value, static_cast<std::uint8_t>(is_in_order),
                           message.number, message.stamp, content_});
  ++parts_.counters_.timed_sent;
  FederateCounts& counts = parts_.federates_[slot].counts;
  if (message.kind == MessageKind::updates) ++counts.reflections_received;
  if (message.kind == MessageKind::interaction) ++counts.interactions_received;
  return true;
}

void FederationParts::Time::deliver(std::uint32_t federate, const TimedEntry& entry) {
  Message& message = messages_[entry.message];
  Message::Receiver& receiver = message.receivers[entry.place];
  receiver.is_waiting = false;
  receiver.has_it = tell(federate, message, receiver.told, management_->is_constrained(federate));
  if (--message.waiting == 0) complete(message);
  finish(entry.message);
}

void FederationParts::Time::discard(std::uint32_t, const TimedEntry& entry) {
  Message& message = messages_[entry.message];
  message.receivers[entry.place].is_waiting = false;
  if (--message.waiting == 0) complete(message);
  finish(entry.message);
}

/// Nobody waits for it any more: what it says is now the state that newcomers are told. (Earlier,
/// they would be told what is to come.)
void FederationParts::Time::complete(const Message& message) {
  const ObjectSlot slot =
      message.kind == MessageKind::interaction ? no_object : parts_.objects_.find({message.object});
  if (slot == no_object) return;
  if (message.kind == MessageKind::delete_object) {
    told_until_.erase(message.object);
    return parts_.object_service_.remove(slot);
  }
  if (!is_news(message)) return;
  parts_.objects_.store(slot, message.attributes, message.body);
  const Object& object = parts_.objects_[slot];
  if (object.owner == no_federate) return;
  parts_.newest_.say_if_newer(object.owner, message.stamp);
}

/// False for an update that is completed after a later one of its object, which had fewer to wait
/// for.
bool FederationParts::Time::is_news(const Message& message) {
  if (told_until_.size() > 64 + 2 * parts_.objects_.size())
    std::erase_if(told_until_, [this](const auto& each) {
      return parts_.objects_.find({each.first}) == no_object;
    });
  double& until = told_until_.try_emplace(message.object, message.stamp.time).first->second;
  if (message.stamp.time < until) return false;
  until = message.stamp.time;
  return true;
}

/// Frees the message's place once nobody can ask for it.
void FederationParts::Time::finish(std::uint32_t index) {
  const Message& message = messages_[index];
  if (message.is_distributed && !message.is_retractable && message.waiting == 0) release(index);
}

void FederationParts::Time::release(std::uint32_t index) {
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

void FederationParts::Time::regulation_enabled(std::uint32_t federate, double time,
                                               double earliest) {
  parts_.federates_[federate].outbox.after_updates(TimeRegulationEnabledMessage{time, earliest});
}
void FederationParts::Time::constrained_enabled(std::uint32_t federate, double time) {
  parts_.federates_[federate].outbox.after_updates(TimeConstrainedEnabledMessage{time});
}
void FederationParts::Time::grant(std::uint32_t federate, double time) {
  parts_.federates_[federate].outbox.after_updates(TimeAdvanceGrantMessage{time});
  parts_.federates_[federate].is_advancing = false;
  ++parts_.counters_.time_advance_grants;
}

}  // namespace rink::rti
