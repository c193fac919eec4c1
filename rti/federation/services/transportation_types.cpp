// Changes transportation types, and answers queries for them.
#include "rti/federation/services/transportation_types.h"

#include "rti/wire/datagram.h"

namespace rink::rti {

TransportationTypes::TransportationTypes(const FederationBasis& basis, const Ownership& ownership,
                                         const Publications& publications, KnownObjects& known)
    : basis_(basis), ownership_(ownership), publications_(publications), known_(known) {
  for (const ObjectClass& each : basis.fom.object_classes()) {
    best_effort_.push_back(best_effort_attributes(each));
    has_best_effort_ |= !best_effort_.back().is_empty();
  }
}

void TransportationTypes::joined(std::uint32_t slot) {
  if (slot >= interactions_.size()) interactions_.resize(slot + 1);
  assert(interactions_[slot].empty());
}

Status TransportationTypes::handle_change(std::uint32_t slot, Reader& reader) {
  ChangeTransportationMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  return message.is_interaction != 0 ? change_interaction(slot, message)
                                     : change_object(slot, message);
}

Status TransportationTypes::change_interaction(std::uint32_t slot,
                                               const ChangeTransportationMessage& message) {
  if (message.number >= basis_.fom.interaction_classes().size()) return Violation::unknown_name;
  if (!publications_.has_interaction(slot, message.number)) return Violation::undeclared;
  std::erase_if(interactions_[slot],
                [&](const auto& each) { return each.first == message.number; });
  interactions_[slot].emplace_back(static_cast<std::uint16_t>(message.number),
                                   static_cast<Transportation>(message.transportation));
  basis_.federates[slot].outbox.after_updates(TransportationMessage{
      message.is_interaction, 1, message.number, message.attributes, message.transportation});
  return std::nullopt;
}

Status TransportationTypes::change_object(std::uint32_t slot,
                                          const ChangeTransportationMessage& message) {
  ObjectSlot object = no_object;
  if (const Status status = known_.find({message.number}, object); status || object == no_object)
    return status;
  const AttributeSet attributes{message.attributes};
  const ObjectClassHandle object_class{basis_.objects[object].object_class};
  if (!basis_.fom.attributes(object_class).includes(attributes)) return Violation::unknown_name;
  if (!ownership_.owned_by(slot, object).includes(attributes)) return Violation::not_owned;
  const AttributeSet before = chosen(object);
  objects_[basis_.objects[object].handle] =
      static_cast<Transportation>(message.transportation) == Transportation::best_effort
          ? before | attributes
          : before.without(attributes);
  basis_.federates[slot].outbox.after_updates(TransportationMessage{
      message.is_interaction, 1, message.number, message.attributes, message.transportation});
  return std::nullopt;
}

Transportation TransportationTypes::of_interaction(std::uint16_t interaction_class,
                                                   FederateHandle sender) const {
  if (const auto slot = basis_.federates.joined(sender))
    for (const auto& [changed, transportation] : interactions_[*slot])
      if (changed == interaction_class) return transportation;
  return basis_.fom.at(InteractionClassHandle{interaction_class}).transportation;
}

Status TransportationTypes::handle_query(std::uint32_t slot, Reader& reader) {
  QueryTransportationMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  Transportation found = Transportation::reliable;
  if (message.is_interaction != 0) {
    if (message.number >= basis_.fom.interaction_classes().size()) return Violation::unknown_name;
    found = of_interaction(static_cast<std::uint16_t>(message.number), {message.which});
  } else {
    ObjectSlot object = no_object;
    if (const Status status = known_.find_known(slot, {message.number}, object);
        status || object == no_object)
      return status;
    if (!basis_.fom.attributes(ObjectClassHandle{basis_.objects[object].object_class})
             .contains({message.which}))
      return Violation::unknown_name;
    if (chosen(object).contains({message.which})) found = Transportation::best_effort;
  }
  basis_.federates[slot].outbox.after_updates(TransportationMessage{
      message.is_interaction, 0, message.number, message.which, static_cast<std::uint8_t>(found)});
  return std::nullopt;
}

}  // namespace rink::rti
