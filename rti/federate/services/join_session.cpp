// Joins and resigns, and handles notices of other federates that do.
#include "rti/federate/services/join_session.h"

#include <algorithm>
#include <cassert>

#include "rti/federate/books/require.h"
#include "rti/fom/fom_digest.h"
#include "rti/wire/federation_messages.h"
#include "rti/wire/fom_messages.h"

namespace rink::rti {

void JoinSession::join(std::string_view federation, std::string_view federate_name,
                       std::string_view federate_type) {
  if (!phase_.is_idle())
    throw RtiException(HlaError::federate_already_execution_member, "an ambassador joins once");
  require_text(federation, "the federation execution's name");
  require_text(federate_name, "the federate's name");
  require_text(federate_type, "the federate's type");
  phase_.begin_joining();
  federates_ = {{FederateHandle{}, std::string(federate_name)}};
  JoinMessage message;
  message.fom_hash = basis_.fom.hash();
  message.federation = federation;
  message.name = federate_name;
  message.type = federate_type;
  basis_.frames.enqueue_alone(message);
  basis_.frames.count_from_here();
}

void JoinSession::resign() {
  if (phase_.may_send()) basis_.frames.enqueue(ResignMessage{});
  phase_.end();
}

void JoinSession::watch_federates() { basis_.frames.enqueue(WatchFederatesMessage{}); }

FederateHandle JoinSession::handle_of(std::string_view federate_name) const {
  for (const auto& [federate, each] : federates_)
    if (federate && each == federate_name) return federate;
  throw RtiException(HlaError::name_not_found,
                     "no federate is called '" + std::string(federate_name) + "'");
}

const std::string& JoinSession::name_of(FederateHandle federate) const {
  for (const auto& [each, name] : federates_)
    if (federate && each == federate) return name;
  throw RtiException(HlaError::name_not_found,
                     "no federate of handle " + std::to_string(federate.value) + " is known");
}

void JoinSession::joined(FederateHandle federate) {
  assert(!federates_.empty());
  phase_.joined(federate);
  federates_.front().first = federate;
}

bool JoinSession::handle_refused(Reader& reader) {
  RefusedMessage message;
  if (!exchange(reader, message)) return false;
  phase_.end();
  const std::string why =
      std::string(message.why) + (fom_difference_.empty() ? "" : ": " + fom_difference_);
  basis_.callbacks.join_refused(static_cast<Refusal>(message.refusal), why);
  return true;
}

bool JoinSession::handle_fom_digest(Reader& reader) {
  FomDigestMessage message;
  if (!exchange(reader, message)) return false;
  std::vector<FomDigestEntry> entries(message.count);
  std::ranges::copy(message.entries, std::as_writable_bytes(std::span(entries)).begin());
  fom_difference_ = difference(basis_.fom, entries);
  return true;
}

bool JoinSession::handle_federate_joined(Reader& reader) {
  FederateJoinedMessage message;
  if (!exchange(reader, message)) return false;
  if (FederateHandle{message.federate} != phase_.federate())
    federates_.emplace_back(FederateHandle{message.federate}, message.name);
  basis_.callbacks.federate_joined({message.federate}, message.name, message.type);
  return true;
}

bool JoinSession::handle_federate_resigned(Reader& reader) {
  FederateResignedMessage message;
  if (!exchange(reader, message)) return false;
  std::erase_if(federates_, [&](const auto& each) { return each.first.value == message.federate; });
  basis_.callbacks.federate_resigned({message.federate}, message.name, message.type,
                                     static_cast<ResignReason>(message.reason));
  return true;
}

}  // namespace rink::rti
