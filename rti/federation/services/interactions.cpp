// Delivers interactions to the groups of their classes.
#include "rti/federation/services/interactions.h"

#include <cassert>

namespace rink::rti {

void Interactions::joined(std::uint32_t slot) {
  if (slot >= federates_.size()) federates_.resize(slot + 1);
  assert(basis_.federates[slot].is_joined);
  federates_[slot] = {};
  federates_[slot].subscribed.resize(basis_.fom.interaction_classes().size());
}

void Interactions::left(std::uint32_t slot) {
  groups_.remove_federate(slot);
  federates_[slot] = {};
}

void Interactions::flushed() {
  for (Federate& each : federates_) each.bytes_sent = 0;
}

Status Interactions::handle_subscribe(std::uint32_t slot, Reader& reader) {
  SubscribeInteractionClassMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  if (message.interaction_class >= basis_.fom.interaction_classes().size())
    return Violation::unknown_name;
  federates_[slot].subscribed[message.interaction_class] =
      static_cast<Listening>(message.is_declared);
  join_groups(slot);
  return std::nullopt;
}

Status Interactions::handle_subscribe_within(std::uint32_t slot, Reader& reader) {
  RegionalInteractionMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  if (message.interaction_class >= basis_.fom.interaction_classes().size())
    return Violation::unknown_name;
  for (const RegionHandle region : regions_of(message.regions))
    if (!distribution_.subscribe_interaction(slot, message.interaction_class, region,
                                             static_cast<Listening>(message.is_subscribed)))
      return Violation::unknown_name;
  join_groups(slot);
  return std::nullopt;
}

void Interactions::join_groups(std::uint32_t slot) {
  for (std::uint32_t i = 0; i < basis_.fom.interaction_classes().size(); ++i) {
    if (listening(slot, static_cast<std::uint16_t>(i)) != Listening::none) groups_.join(i, slot);
    else groups_.leave(i, slot);
  }
}

Listening Interactions::listening(std::uint32_t slot, std::uint16_t interaction_class) const {
  Listening found = distribution_.subscribes_interaction(slot, interaction_class);
  for (InteractionClassHandle each{interaction_class}; each && found != Listening::active;
       each = basis_.fom.at(each).parent)
    if (const Listening here = federates_[slot].subscribed[each.value]; here != Listening::none)
      found = here;
  return found;
}

bool Interactions::receives_everywhere(std::uint32_t slot, std::uint16_t interaction_class) const {
  for (InteractionClassHandle each{interaction_class}; each; each = basis_.fom.at(each).parent)
    if (federates_[slot].subscribed[each.value] != Listening::none) return true;
  return false;
}

Status Interactions::read(Reader& reader, InteractionMessage& message) const {
  if (!exchange(reader, message)) return Violation::malformed;
  return message.interaction_class < basis_.fom.interaction_classes().size()
             ? Status()
             : Violation::unknown_name;
}

Status Interactions::read_within(std::uint32_t slot, Reader& reader, InteractionMessage& message,
                                 std::vector<RegionHandle>& regions) const {
  InteractionWithinMessage within;
  if (!exchange(reader, within)) return Violation::malformed;
  if (within.interaction_class >= basis_.fom.interaction_classes().size())
    return Violation::unknown_name;
  regions = regions_of(within.regions);
  for (const RegionHandle region : regions)
    if (!distribution_.has_region(slot, region)) return Violation::unknown_name;
  message = {within.interaction_class, FederateHandle::none, within.stamp, within.parameters};
  return std::nullopt;
}

Status Interactions::accept(std::uint32_t slot, const InteractionMessage& message,
                            Receivers& receivers) {
  if (!publications_.has_interaction(slot, message.interaction_class)) return Violation::undeclared;
  ++basis_.counters.interactions_received;
  ++basis_.federates[slot].counts.interactions_sent;
  // Interactions are never held back, so one sender of too many would fill the queues of its
  // receivers, which would be closed instead of it.
  receivers = groups_.receivers(message.interaction_class, slot);
  if (!receivers.empty()) federates_[slot].bytes_sent += head_size + message.parameters.size();
  return std::nullopt;
}

Status Interactions::deliver(std::uint32_t slot, InteractionMessage& message, Receivers receivers,
                             std::span<const RegionHandle> regions) {
  assert(message.interaction_class < basis_.fom.interaction_classes().size());
  if (federates_[slot].bytes_sent > basis_.settings.interaction_bytes_per_flush_max)
    return Violation::over_limit;
  const std::uint32_t only = message.federate;
  message.federate = basis_.federates[slot].handle.value;
  for (const std::uint32_t receiver : receivers) {
    if (only != FederateHandle::none && basis_.federates[receiver].handle.value != only) continue;
    if (!regions.empty() && !receives_everywhere(receiver, message.interaction_class) &&
        !distribution_.receives(receiver, message.interaction_class, slot, regions))
      continue;
    deliver_to(receiver, message);
  }
  return std::nullopt;
}

void Interactions::deliver_to(std::uint32_t receiver, InteractionMessage& message) {
  JoinedFederate& federate = basis_.federates[receiver];
  federate.outbox.after_updates(message);
  basis_.counters.interaction_bytes_sent += measure(message);
  ++basis_.counters.interactions_sent;
  ++federate.counts.interactions_received;
}

void Interactions::report(std::uint32_t asking, InteractionClassHandle interaction_class,
                          Bytes parameters) {
  InteractionMessage message{
      static_cast<std::uint16_t>(interaction_class.value), FederateHandle::none, {}, parameters};
  const Receivers receivers = groups_.receivers(interaction_class.value, no_federate);
  if (!receivers.empty()) federates_[asking].bytes_sent += head_size + parameters.size();
  for (const std::uint32_t receiver : receivers) deliver_to(receiver, message);
}

}  // namespace rink::rti
