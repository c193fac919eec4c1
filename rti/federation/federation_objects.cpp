// Object management at the RTI beyond updates: local deletion, requests for updates,
// transportation.
#include <algorithm>

#include "rti/federation/federation_management_objects.h"
#include "rti/wire/region_messages.h"

namespace rink::rti {

namespace {
std::string as_text(Bytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}
}  // namespace

/// Its confirmation comes before whatever makes the object discovered anew.
Outcome FederationParts::delete_locally(std::uint32_t slot, Reader& reader) {
  LocalDeleteMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  const ObjectSlot object = objects_.find({message.object});
  if (object == no_object) return is_late({message.object}) ? Outcome() : Violation::unknown_name;
  if (!ownership_.owned_by(slot, object).is_empty()) return Violation::not_owned;
  FederateInterest& interest = interest_.of(slot);
  if (!interest.known.contains(object)) return ++counters_.late_requests, std::nullopt;
  interest.known.erase(object);
  interest.in_scope.erase(object);
  interest.fresh.erase(object);
  interest.unannounced.erase(object);
  federates_[slot].outbox.before_updates(RemoveObjectMessage{message.object});
  return std::nullopt;
}

Outcome FederationParts::request_update(std::uint32_t slot, Reader& reader) {
  RequestUpdateMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  const AttributeSet attributes{message.attributes};
  if (message.is_class == 0) {
    ObjectSlot object = no_object;
    if (const Outcome outcome = find_known(slot, {message.number}, object);
        outcome || object == no_object)
      return outcome;
    if (!ownership_.all(object).includes(attributes)) return Violation::unknown_name;
    ask_owners(slot, object, attributes, message.tag);
    return std::nullopt;
  }
  if (message.number >= fom_.object_classes().size() ||
      !fom_.attributes(ObjectClassHandle{message.number}).includes(attributes))
    return Violation::unknown_name;
  AttributeSet& asked =
      update_requests_[{slot, RegionHandle{}.value, static_cast<std::uint16_t>(message.number),
                        as_text(message.tag)}];
  asked = asked | attributes;
  return std::nullopt;
}

/// Nobody is asked for what is its own.
void FederationParts::ask_owners(std::uint32_t slot, ObjectSlot object, AttributeSet attributes,
                                 Bytes tag) {
  if (attributes.is_empty()) return;
  const Object& asked = objects_[object];
  if (management_objects_ && management_objects_->owns(object))
    return management_objects_->ask(object, attributes);
  const auto ask = [&](std::uint32_t owner) {
    const AttributeSet owned = owner == slot
                                   ? AttributeSet()
                                   : attributes & ownership_.owned_by(owner, object) &
                                         fom_.attributes(ObjectClassHandle{asked.object_class});
    if (owned.is_empty()) return;
    AttributeSet& told = updates_to_provide_[{owner, asked.handle.value, as_text(tag)}];
    told = told | owned;
  };
  if (asked.owner != no_federate) ask(asked.owner);
  else ownership_.for_each_owner(object, ask);
}

/// Those that may travel by datagram: what the model says may become reliable, and only what it
/// says travels so at all.
AttributeSet FederationParts::by_datagram(ObjectSlot object) const {
  const AttributeSet* changed = changed_transportation_.size() > 0
                                    ? changed_transportation_.find(objects_[object].handle)
                                    : nullptr;
  const AttributeSet best_effort = best_effort_[objects_[object].object_class];
  return changed != nullptr ? *changed & best_effort : best_effort;
}

Outcome FederationParts::change_transportation(std::uint32_t slot, Reader& reader) {
  ChangeTransportationMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  const auto transportation = static_cast<Transportation>(message.transportation);
  TransportationMessage answer{message.is_interaction, 1, message.number, message.attributes,
                               message.transportation};
  Federate& federate = federates_[slot];
  if (message.is_interaction != 0) {
    if (message.number >= fom_.interaction_classes().size()) return Violation::unknown_name;
    if (!publications_.has_interaction(slot, message.number)) return Violation::undeclared;
    std::erase_if(federate.changed_transportation,
                  [&](const auto& each) { return each.first == message.number; });
    federate.changed_transportation.emplace_back(static_cast<std::uint16_t>(message.number),
                                                 transportation);
    federate.outbox.after_updates(answer);
    return std::nullopt;
  }
  const ObjectSlot object = objects_.find({message.number});
  if (object == no_object) return is_late({message.number}) ? Outcome() : Violation::unknown_name;
  const AttributeSet attributes{message.attributes};
  if (!fom_.attributes(ObjectClassHandle{objects_[object].object_class}).includes(attributes))
    return Violation::unknown_name;
  if (!ownership_.owned_by(slot, object).includes(attributes)) return Violation::not_owned;
  const AttributeSet* changed = changed_transportation_.find(objects_[object].handle);
  const AttributeSet before =
      changed != nullptr ? *changed : best_effort_[objects_[object].object_class];
  changed_transportation_[objects_[object].handle] = transportation == Transportation::best_effort
                                                         ? before | attributes
                                                         : before.without(attributes);
  federate.outbox.after_updates(answer);
  return std::nullopt;
}

Outcome FederationParts::query_transportation(std::uint32_t slot, Reader& reader) {
  QueryTransportationMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  TransportationMessage answer{message.is_interaction, 0, message.number, message.which, 0};
  Transportation found = Transportation::reliable;
  if (message.is_interaction != 0) {
    if (message.number >= fom_.interaction_classes().size()) return Violation::unknown_name;
    found = fom_.at(InteractionClassHandle{message.number}).transportation;
    if (const auto sender = federates_.joined({message.which}))
      for (const auto& [interaction_class, transportation] :
           federates_[*sender].changed_transportation)
        if (interaction_class == message.number) found = transportation;
  } else {
    ObjectSlot object = no_object;
    if (const Outcome outcome = find_known(slot, {message.number}, object);
        outcome || object == no_object)
      return outcome;
    if (!fom_.attributes(ObjectClassHandle{objects_[object].object_class})
             .contains({message.which}))
      return Violation::unknown_name;
    const AttributeSet* changed = changed_transportation_.find(objects_[object].handle);
    const AttributeSet best_effort =
        changed != nullptr ? *changed : best_effort_[objects_[object].object_class];
    if (best_effort.contains({message.which})) found = Transportation::best_effort;
  }
  answer.transportation = static_cast<std::uint8_t>(found);
  federates_[slot].outbox.after_updates(answer);
  return std::nullopt;
}

}  // namespace rink::rti
