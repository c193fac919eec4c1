// A federate's messages about synchronisation points, and those that it receives.
#include "rti/federate/services/federate_synchronization.h"

#include "rti/federate/books/require.h"
#include "rti/wire/federation_messages.h"

namespace rink::rti {

void FederateSynchronization::register_point(std::string_view label, Bytes tag,
                                             std::span<const FederateHandle> members) {
  require_text(label, "the synchronisation point's label");
  if (tag.size() > synchronization_tag_max)
    throw RtiException(HlaError::rti_internal_error,
                       "a synchronisation point's tag has at most 1024 bytes");
  if (members.size() > HandleList::count_max)
    throw RtiException(HlaError::rti_internal_error,
                       "a synchronisation point's set names at most 16000 federates");
  basis_.frames.enqueue(RegisterSynchronizationPointMessage{label, tag, list_of(members)});
}

void FederateSynchronization::achieve(std::string_view label, bool is_success) {
  basis_.phase.require_joined();
  if (std::erase(announced_, label) == 0)
    throw RtiException(
        HlaError::synchronization_point_label_not_announced,
        "'" + std::string(label) + "' is not announced to this federate, or it has achieved it");
  basis_.frames.enqueue(
      SynchronizationPointAchievedMessage{label, static_cast<std::uint8_t>(is_success)});
}

bool FederateSynchronization::handle_registered(Reader& reader) {
  SynchronizationPointRegisteredMessage message;
  if (!exchange(reader, message)) return false;
  if (message.failure == 0)
    basis_.callbacks.synchronization_point_registration_succeeded(message.label);
  else
    basis_.callbacks.synchronization_point_registration_failed(
        message.label, static_cast<SynchronizationFailure>(message.failure));
  return true;
}

bool FederateSynchronization::handle_announced(Reader& reader) {
  AnnounceSynchronizationPointMessage message;
  if (!exchange(reader, message)) return false;
  announced_.emplace_back(message.label);
  basis_.callbacks.announce_synchronization_point(message.label, message.tag);
  return true;
}

bool FederateSynchronization::handle_synchronized(Reader& reader) {
  FederationSynchronizedMessage message;
  if (!exchange(reader, message)) return false;
  basis_.callbacks.federation_synchronized(message.label, handles_of(message.failed));
  return true;
}

}  // namespace rink::rti
