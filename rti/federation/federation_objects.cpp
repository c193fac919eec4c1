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
  ObjectSlot object = no_object;
  if (const Outcome outcome = known_.find({message.object}, object); outcome || object == no_object)
    return outcome;
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
    if (const Outcome outcome = known_.find_known(slot, {message.number}, object);
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

}  // namespace rink::rti
