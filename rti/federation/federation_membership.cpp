// Who is connected, who has joined, who waits for whom.
#include <algorithm>

#include "rti/buffering/newest_state.h"
#include "rti/distribution/interest.h"
#include "rti/federation/federation_parts.h"
#include "rti/fom/fom_digest.h"
#include "rti/groups/member_lists.h"
#include "rti/refusal_words.h"
#include "rti/wire/fom_messages.h"
#include "rti/wire/membership_messages.h"

namespace rink::rti {

namespace {

std::unique_ptr<DataDistribution> distribution_of(const FederationServices& services,
                                                  const Fom& fom, const ObjectTable& objects,
                                                  const Ownership& ownership,
                                                  std::unique_ptr<im::Filter> filter) {
  if (services.data_distribution)
    return services.data_distribution(fom, objects, ownership, std::move(filter));
  return std::make_unique<Interest>(fom, objects, ownership, std::move(filter));
}

std::unique_ptr<GroupCommunication> groups_of(const FederationServices& services) {
  if (services.group_communication) return services.group_communication();
  return std::make_unique<MemberLists>();
}

std::unique_ptr<Buffering> buffering_of(const FederationServices& services) {
  if (services.buffering) return services.buffering();
  return std::make_unique<NewestState>();
}

}  // namespace

FederationParts::FederationParts(const Fom& fom, const FederationSettings& settings,
                                 const FederationServices& services,
                                 std::unique_ptr<im::Filter> filter)
    : fom_(fom),
      settings_(settings),
      publications_(fom),
      names_(federates_, 2 * std::size_t{settings.object_max}),
      objects_(fom),
      ownership_(fom, objects_),
      distribution_(distribution_of(services, fom, objects_, ownership_, std::move(filter))),
      interest_(*distribution_),
      buffering_(buffering_of(services)),
      known_(objects_, ownership_, interest_, counters_),
      newest_(objects_, ownership_),
      arrivals_(fom),
      transportation_(basis_, ownership_, publications_, known_),
      best_effort_sender_(basis_, transportation_, *buffering_),
      updates_(basis_,
               {ownership_, publications_, known_, newest_, arrivals_, best_effort_sender_}),
      best_effort_receiver_(basis_, {transportation_, ownership_, known_, newest_, arrivals_,
                                     best_effort_sender_, updates_}),
      groups_(groups_of(services)),
      interactions_(basis_, *groups_, interest_, publications_),
      update_requests_(basis_, ownership_, interest_, known_),
      object_service_(basis_, {ownership_, interest_, publications_, known_, names_, newest_,
                               arrivals_, transportation_}),
      regions_(basis_, {interest_, ownership_, known_, update_requests_}),
      owners_(basis_, {ownership_, interest_, publications_, known_, newest_, object_service_}),
      declarations_(basis_, {interest_, ownership_, publications_, interactions_, owners_}),
      announcements_(basis_, {interest_, owners_, update_requests_, newest_}),
      periodic_(basis_),
      turns_(basis_, interest_, newest_),
      sender_(basis_,
              {interest_, *buffering_, newest_, announcements_, periodic_, turns_,
               best_effort_sender_, best_effort_receiver_},
              expulsion()),
      time_(basis_,
            {publications_, ownership_, known_, interest_, interactions_, object_service_, newest_,
             announcements_},
            services.time_management, expulsion()),
      management_(fom),
      management_objects_(basis_,
                          {interest_, ownership_, declarations_, object_service_, update_requests_,
                           time_, *buffering_},
                          management_),
      management_interactions_(basis_,
                               {interest_, publications_, synchronization_, interactions_,
                                update_requests_, management_objects_},
                               management_),
      census_(basis_, interest_, ownership_, time_) {}

Expulsion FederationParts::expulsion() {
  return
      [this](std::uint32_t slot, Violation violation, ResignReason reason, std::string_view why) {
        expel(federates_[slot].connection, violation, reason, why);
      };
}

void FederationParts::connect(ConnectionId connection) {
  if (connection >= connections_.size()) connections_.resize(connection + 1);
  connections_[connection] = {};
  connections_[connection].phase = Phase::connected;
  connections_[connection].last_heard = now_;
}

void FederationParts::disconnect(ConnectionId connection, std::string_view) {
  if (connection >= connections_.size()) return;
  if (connections_[connection].phase == Phase::joined)
    remove_federate(connections_[connection].federate, ResignReason::lost);
  connections_[connection] = {};
  for (std::vector<Farewell>* words : {&answers_, &farewells_})
    std::erase_if(*words,
                  [connection](const Farewell& each) { return each.connection == connection; });
}

void FederationParts::advance_clock(double now) {
  now_ = now;
  for (ConnectionId id = 0; id < connections_.size(); ++id) {
    Connection& connection = connections_[id];
    if (connection.phase == Phase::unknown) continue;
    if (connection.has_spoken) connection.last_heard = now;
    connection.has_spoken = false;
    if (now - connection.last_heard > settings_.patience.lost_after_s)
      expel(id, Violation::silent, ResignReason::lost, explain(Violation::silent));
  }
}

void FederationParts::expel(ConnectionId connection, Violation violation, ResignReason reason,
                            std::string_view why) {
  ++counters_.drops[static_cast<std::size_t>(violation)];
  // A stranger who breaks a rule gets no answer: it may be another program altogether.
  const bool was_joined = connections_[connection].phase == Phase::joined;
  if (was_joined) remove_federate(connections_[connection].federate, reason);
  connections_[connection] = {};
  farewells_.push_back({connection, std::string(why),
                        was_joined ? framed(ExpelledMessage{why}) : std::vector<std::byte>()});
}

Outcome FederationParts::join(ConnectionId connection, Reader& reader) {
  JoinMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  if (message.version != protocol_version)
    return refuse(connection, Refusal::wrong_version,
                  refused_version(message.version, protocol_version)),
           std::nullopt;
  if (message.fom_hash != fom_.hash())
    return refuse(connection, Refusal::wrong_fom, refused_fom(message.fom_hash, fom_.hash())),
           std::nullopt;
  if (message.federation != settings_.federation)
    return refuse(connection, Refusal::wrong_federation), std::nullopt;
  if (message.name.empty()) return refuse(connection, Refusal::bad_name), std::nullopt;
  if (!settings_.members.empty() &&
      std::ranges::find(settings_.members, message.name) == settings_.members.end())
    return refuse(connection, Refusal::not_listed), std::nullopt;
  if (federates_.is_taken(message.name))
    return refuse(connection, Refusal::name_taken), std::nullopt;
  const bool is_full =
      federates_.joined_count() >= settings_.federate_max || !federates_.has_block();
  if (is_full) return refuse(connection, Refusal::federation_full), std::nullopt;
  admit(connection, message);
  return std::nullopt;
}

void FederationParts::refuse(ConnectionId connection, Refusal refusal, const std::string& why) {
  expel(connection, Violation::refused, ResignReason::misbehaved, why);
  std::vector<std::byte>& bytes = farewells_.back().bytes;
  if (refusal == Refusal::wrong_fom) bytes = framed_digest();
  const std::vector<std::byte> refused =
      framed(RefusedMessage{static_cast<std::uint8_t>(refusal), why});
  bytes.insert(bytes.end(), refused.begin(), refused.end());
}

/// The federate finds out from the digest where its own model differs; nothing of a model too large
/// for one.
std::vector<std::byte> FederationParts::framed_digest() const {
  const std::vector<FomDigestEntry> entries = digest(fom_);
  if (entries.size() > FomDigestMessage::count_max) return {};
  return framed(FomDigestMessage{static_cast<std::uint16_t>(entries.size()),
                                 std::as_bytes(std::span(entries))});
}

void FederationParts::admit(ConnectionId connection, const JoinMessage& message) {
  const std::uint32_t slot = federates_.admit(connection, message.name, message.type);
  Federate& federate = federates_[slot];
  publications_.joined(slot);
  transportation_.joined(slot);
  newest_.joined(slot);
  arrivals_.joined(slot);
  updates_.joined(slot);
  best_effort_receiver_.joined(slot);
  update_requests_.joined(slot);
  interactions_.joined(slot);
  object_service_.joined(slot);
  owners_.joined(slot);
  declarations_.joined(slot);
  time_.joined(slot);
  federate.last_said = now_;
  interest_.add_federate(slot);
  connections_[connection].phase = Phase::joined;
  connections_[connection].federate = slot;
  ++counters_.joins;
  federate.outbox.before_updates(JoinedMessage{federate.handle.value, federate.block});
  for (Federate& other : federates_)
    if (other.is_watching)
      other.outbox.before_updates(
          FederateJoinedMessage{federate.handle.value, federate.name, federate.type});
  synchronization_.joined(slot);
  management_objects_.joined(slot);
}

void FederationParts::remove_federate(std::uint32_t slot, ResignReason reason) {
  owners_.left(slot);
  interest_.remove_federate(slot);
  update_requests_.left(slot);
  buffering_->remove_federate(slot);
  periodic_.left(slot);
  object_service_.left(slot);
  federates_.retire(slot);
  subscribed(slot);
  management_objects_.left(slot);
  interactions_.left(slot);
  names_.left(slot);
  synchronization_.left(slot);
  const Federate& federate = federates_[slot];
  for (Federate& other : federates_)
    if (other.is_watching)
      other.outbox.after_updates(FederateResignedMessage{
          federate.handle.value, static_cast<std::uint8_t>(reason), federate.name, federate.type});
  ++counters_.resigns;
  time_.left(slot);
  publications_.left(slot);
  transportation_.left(slot);
  newest_.left(slot);
  arrivals_.left(slot);
  best_effort_receiver_.left(slot);
  declarations_.left(slot);
  federates_.release(slot);
}

/// Publishers hear at once of what a federate subscribes now, and so do the RTI's own objects.
void FederationParts::subscribed(std::uint32_t slot) {
  declarations_.subscriptions_changed(slot);
  management_objects_.subscribed(slot);
}

Outcome FederationParts::resign(std::uint32_t slot) {
  const ConnectionId connection = federates_[slot].connection;
  remove_federate(slot, ResignReason::resigned);
  connections_[connection] = {};
  farewells_.push_back({connection, "resigned", {}});
  return std::nullopt;
}

Outcome FederationParts::watch(Federate& federate) {
  if (federate.is_watching) return std::nullopt;
  federate.is_watching = true;
  for (const Federate& other : federates_)
    if (other.is_joined)
      federate.outbox.before_updates(
          FederateJoinedMessage{other.handle.value, other.name, other.type});
  return std::nullopt;
}

}  // namespace rink::rti
