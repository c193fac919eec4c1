// Handles requests about time, and expels federates when messages fill the room for them.
#include "rti/federation/time/time_service.h"

#include <algorithm>
#include <cassert>

#include "rti/time/conservative_time.h"
#include "rti/wire/time_messages.h"

namespace rink::rti {

/// A federate that uses time management is sent no datagrams, since messages wait for its time.
TimeManagement& TimeService::begin(std::uint32_t slot) {
  basis_.federates[slot].has_stream_only = true;
  if (!management_) management_ = make_ ? make_() : std::make_unique<ConservativeTime>();
  return *management_;
}

void TimeService::joined(std::uint32_t slot) {
  if (slot >= federates_.size()) federates_.resize(slot + 1);
  messages_.joined(slot);
}

void TimeService::left(std::uint32_t slot) {
  if (management_) {
    management_->remove(slot, *this);
    std::erase(asking_, slot);
  }
  messages_.left(slot);
  federates_[slot] = {};
}

template <class Message>
Status TimeService::set_lookahead(std::uint32_t slot, Reader& reader,
                                  bool (TimeManagement::*set)(std::uint32_t, double)) {
  TimeManagement& management = begin(slot);
  Message message;
  if (!exchange(reader, message)) return Violation::malformed;
  if (!(management.*set)(slot, message.seconds)) return Violation::untimely;
  federates_[slot].lookahead = message.seconds;
  return std::nullopt;
}

Status TimeService::handle_regulation(std::uint32_t slot, Reader& reader) {
  return set_lookahead<EnableTimeRegulationMessage>(slot, reader,
                                                    &TimeManagement::enable_regulation);
}

Status TimeService::handle_lookahead(std::uint32_t slot, Reader& reader) {
  return set_lookahead<ModifyLookaheadMessage>(slot, reader, &TimeManagement::modify_lookahead);
}

Status TimeService::handle_advance(std::uint32_t slot, Reader& reader) {
  TimeManagement& management = begin(slot);
  AdvanceRequestMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  if (!management.request(slot, static_cast<AdvanceKind>(message.advance), message.time))
    return Violation::untimely;
  federates_[slot].is_advancing = true;
  return std::nullopt;
}

/// Repeated queries get one answer, since the answer is longer than the query.
Status TimeService::handle_query(std::uint32_t slot) {
  begin(slot);
  if (asking_.empty() || asking_.back() != slot) asking_.push_back(slot);
  return std::nullopt;
}

Status TimeService::handle_switch(std::uint32_t slot, Reader& reader) {
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
      messages_.forget_final(slot, management.earliest(slot));
      break;
  }
  return is_allowed ? Status() : Violation::untimely;
}

Status TimeService::handle_send(std::uint32_t slot, Reader& reader) {
  TimeManagement& management = begin(slot);
  TimedSendMessage wire;
  if (!exchange(reader, wire)) return Violation::malformed;
  if (!management.may_send(slot, wire.stamp.time)) return Violation::untimely;
  if (!messages_.may_be_next(slot, wire.number)) return Violation::malformed;
  if (messages_.is_full()) make_room(slot);
  if (messages_.is_full()) return Violation::over_limit;
  clear(incoming_);
  incoming_.sender = basis_.federates[slot].handle;
  incoming_.number = wire.number;
  incoming_.stamp = wire.stamp;
  if (const Status status = contents_.read(slot, wire.content, incoming_)) return status;
  return keep(slot);
}

/// Keeps the message that was read and checked.
Status TimeService::keep(std::uint32_t slot) {
  FederateCounts& counts = basis_.federates[slot].counts;
  if (incoming_.kind == MessageKind::updates) ++counts.updates_sent;
  if (incoming_.kind == MessageKind::interaction) ++counts.interactions_sent;
  ++basis_.counters.timed_received;
  delivery_.accept(messages_.add(slot, incoming_));
  if (!messages_.is_forgetting_due(slot)) return std::nullopt;
  messages_.forget_final(slot, management_->earliest(slot));
  return messages_.is_greedy(slot) ? Violation::over_limit : Status();
}

Status TimeService::handle_retract(std::uint32_t slot, Reader& reader) {
  TimeManagement& management = begin(slot);
  RetractMessage wire;
  if (!exchange(reader, wire)) return Violation::malformed;
  const std::optional<std::uint32_t> index =
      messages_.retract(slot, wire.number, management.earliest(slot));
  if (!index) return std::nullopt;  // retracted before, or too late
  ++basis_.counters.retractions;
  delivery_.withdraw(*index, management);
  messages_.finish(*index);
  return std::nullopt;
}

/// Forgets messages that nothing needs any more. If that is not enough, the federate that holds up
/// most of them is expelled (find_culprit).
void TimeService::make_room(std::uint32_t speaker) {
  for (std::uint32_t slot = 0; slot < federates_.size(); ++slot)
    messages_.forget_final(slot, management_->earliest(slot));
  while (messages_.is_full()) {
    const std::uint32_t culprit = find_culprit();
    if (culprit == speaker || culprit == no_federate) return;
    expel_(culprit, Violation::over_limit, ResignReason::lost,
           "more waits for its time than the federation keeps");
    if (messages_.is_full()) settle();  // deliver what it held up
  }
}

/// Finds the regulating federate that is furthest behind.
std::uint32_t TimeService::find_last_regulating() const {
  std::uint32_t last = no_federate;
  for (std::uint32_t slot = 0; slot < basis_.federates.size(); ++slot)
    if (basis_.federates[slot].is_joined && management_->is_regulating(slot) &&
        (last == no_federate || management_->earliest(slot) < management_->earliest(last)))
      last = slot;
  return last;
}

/// Finds the federate to blame for most messages. A message that can still be retracted counts for
/// its sender, one that waits for its receiver's next request for the receiver, and one that could
/// not be delivered even on request for the regulating federate that is furthest behind.
std::uint32_t TimeService::find_culprit() const {
  const std::uint32_t count = basis_.federates.size(), last = find_last_regulating();
  std::vector<std::size_t> blamed(count);
  std::vector<double> galt(count);
  for (std::uint32_t slot = 0; slot < count; ++slot)
    if (basis_.federates[slot].is_joined) galt[slot] = management_->galt(slot);
  for (const StampedMessage& message : messages_.all()) {
    const std::size_t weight = sizeof message + message.body.size();
    if (message.is_retractable) {
      blamed[basis_.federates.slot_of(message.sender)] += weight;
      continue;
    }
    for (const StampedMessage::Receiver& each : message.receivers) {
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

void TimeService::settle() {
  if (!management_) return;
  delivery_.distribute(*management_);
  management_->settle(*this);
  for (const std::uint32_t slot : asking_)
    basis_.federates[slot].outbox.after_updates(
        TimeBoundsMessage{management_->galt(slot), management_->lits(slot)});
  asking_.clear();
}

void TimeService::deliver(std::uint32_t federate, const TimedEntry& entry) {
  delivery_.deliver(federate, entry, management_->is_constrained(federate));
}

void TimeService::discard(std::uint32_t, const TimedEntry& entry) { delivery_.discard(entry); }

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
