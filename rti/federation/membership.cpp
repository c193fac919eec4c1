// Admits federates, and notifies the others.
#include "rti/federation/membership.h"

#include <algorithm>
#include <cassert>

#include "rti/refusal_words.h"

namespace rink::rti {

std::optional<Membership::Objection> Membership::objection(const JoinMessage& message) const {
  if (message.version != protocol_version)
    return Objection{Refusal::wrong_version, refused_version(message.version, protocol_version)};
  if (message.fom_hash != basis_.fom.hash())
    return Objection{Refusal::wrong_fom, refused_fom(message.fom_hash, basis_.fom.hash())};
  if (const auto found = refusal(message)) return Objection{*found, to_string(*found)};
  return std::nullopt;
}

std::optional<Refusal> Membership::refusal(const JoinMessage& message) const {
  const FederationSettings& settings = basis_.settings;
  if (message.federation != settings.federation) return Refusal::wrong_federation;
  if (message.name.empty()) return Refusal::bad_name;
  if (basis_.save_phase == SavePhase::saving) return Refusal::save_in_progress;
  if (basis_.save_phase == SavePhase::restoring) return Refusal::restore_in_progress;
  if (!settings.members.empty() &&
      std::ranges::find(settings.members, message.name) == settings.members.end())
    return Refusal::not_listed;
  if (basis_.federates.is_taken(message.name)) return Refusal::name_taken;
  if (basis_.federates.joined_count() >= settings.federate_max || !basis_.federates.has_block())
    return Refusal::federation_full;
  return std::nullopt;
}

void Membership::joined(std::uint32_t slot) {
  JoinedFederate& federate = basis_.federates[slot];
  assert(federate.is_joined);
  ++basis_.counters.joins;
  federate.last_sent = basis_.now;
  federate.outbox.before_updates(JoinedMessage{federate.handle.value, federate.block});
  for (JoinedFederate& other : basis_.federates)
    if (other.is_watching)
      other.outbox.before_updates(
          FederateJoinedMessage{federate.handle.value, federate.name, federate.type});
}

void Membership::left(std::uint32_t slot, ResignReason reason) {
  const JoinedFederate& federate = basis_.federates[slot];
  for (JoinedFederate& other : basis_.federates)
    if (other.is_watching)
      other.outbox.after_updates(FederateResignedMessage{
          federate.handle.value, static_cast<std::uint8_t>(reason), federate.name, federate.type});
  ++basis_.counters.resigns;
}

Status Membership::handle_watch(std::uint32_t slot) {
  JoinedFederate& federate = basis_.federates[slot];
  if (federate.is_watching) return std::nullopt;
  federate.is_watching = true;
  for (const JoinedFederate& other : basis_.federates)
    if (other.is_joined)
      federate.outbox.before_updates(
          FederateJoinedMessage{other.handle.value, other.name, other.type});
  return std::nullopt;
}

}  // namespace rink::rti
