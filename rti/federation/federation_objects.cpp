// Object management at the RTI beyond updates: local deletion, requests for updates,
// transportation.
#include <algorithm>

#include "rti/federation/federation_management_objects.h"
#include "rti/wire/region_messages.h"

namespace rink::rti {

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

}  // namespace rink::rti
