// Keeps what federates could tell and not what follows from it: the next match decides scopes
// again, and who has an object in scope is sent its whole state.
#include "rti/save/kept_federation.h"

#include "rti/federation/federation_parts.h"
#include "rti/save/kept_distribution.h"

namespace rink::rti {

namespace {

/// The objects that a federate knows, and those that it was told are in its scope.
struct KeptScope {
  Bitmap known, announced;
  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, known, announced);
  }
};

template <class Visit>
void for_each_joined(const FederateTable& federates, Visit visit) {
  for (std::uint32_t slot = 0; slot < federates.size(); ++slot)
    if (federates[slot].is_joined) visit(slot);
}

template <class Stream>
bool keep_services(Stream& stream, FederationParts& parts) {
  ObjectServices& objects = parts.objects;
  return keep_all(stream, parts.ground.objects, parts.ground.ownership, objects.publications,
                  objects.names, objects.newest, objects.types, objects.objects, objects.requests,
                  parts.interactions, parts.owners, parts.synchronization, parts.time,
                  parts.management_objects);
}

std::vector<KeptScope> scopes_of(FederationParts& parts) {
  std::vector<KeptScope> scopes;
  for_each_joined(parts.ground.federates, [&](std::uint32_t slot) {
    const FederateInterest& interest = parts.ground.distribution->of(slot);
    KeptScope& kept = scopes.emplace_back();
    kept.known = interest.known;
    interest.in_scope.for_each([&](ObjectSlot object) {
      if (interest.known.contains(object) && !interest.unannounced.contains(object))
        kept.announced.insert(object);
    });
    kept.announced.insert_all(interest.unannounced_exits);
  });
  return scopes;
}

/// What the federate was not told is an event for the next flush; all in scope is due in full.
void tell_changes(FederateInterest& interest, const KeptScope& kept) {
  interest.known = kept.known;
  interest.events.clear();
  kept.announced.for_each([&](ObjectSlot object) {
    if (!interest.in_scope.contains(object))
      interest.events.push_back({object, im::Transition::left});
  });
  interest.in_scope.for_each([&](ObjectSlot object) {
    if (!kept.announced.contains(object))
      interest.events.push_back({object, im::Transition::entered});
  });
}

bool are_within(const std::vector<KeptScope>& scopes, const ObjectTable& objects) {
  bool are = true;
  const auto look = [&](ObjectSlot object) { are &= object < objects.slot_count(); };
  for (const KeptScope& each : scopes) {
    each.known.for_each(look);
    each.announced.for_each(look);
  }
  return are;
}

void join_again(FederationParts& parts, std::uint32_t slot) {
  parts.objects.joined(slot);
  parts.interactions.joined(slot);
  parts.owners.joined(slot);
  parts.declarations.joined(slot);
  parts.time.joined(slot);
  parts.ground.distribution->add_federate(slot);
  parts.rates.joined(slot);
  parts.rates.set_rate(slot, parts.ground.settings.update_rate);
}

}  // namespace

bool write_state(FederationParts& parts, std::vector<std::byte>& bytes) {
  const auto* const interest = dynamic_cast<const Interest*>(parts.ground.distribution.get());
  if (interest == nullptr) return false;
  parts.objects.requests.settle();
  Writer writer(bytes);
  KeptDistribution distribution;
  distribution.gather(*interest, parts.ground.federates);
  std::vector<KeptScope> scopes = scopes_of(parts);
  return keep_all(writer, parts.ground.federates, distribution) && keep_services(writer, parts) &&
         keep_all(writer, parts.declarations, scopes);
}

bool read_state(FederationParts& parts, Bytes bytes) {
  auto* const interest = dynamic_cast<Interest*>(parts.ground.distribution.get());
  if (interest == nullptr) return false;
  Reader reader(bytes);
  FederateTable& federates = parts.ground.federates;
  KeptDistribution distribution;
  std::vector<KeptScope> scopes;
  if (!keep_all(reader, federates, distribution)) return false;
  for_each_joined(federates, [&](std::uint32_t slot) { join_again(parts, slot); });
  if (!keep_services(reader, parts) || !keep_all(reader, parts.declarations, scopes) ||
      !reader.is_at_end() || scopes.size() != federates.joined_count() ||
      !are_within(scopes, parts.ground.objects) || !distribution.is_of(federates) ||
      !distribution.apply(parts.ground.fom, parts.ground.objects, *interest))
    return false;
  do interest->match();
  while (interest->subscriptions().waiting_count() > 0);
  auto kept = scopes.begin();
  for_each_joined(federates, [&](std::uint32_t slot) {
    tell_changes(interest->of(slot), *kept++);
    parts.interactions.join_groups(slot);
  });
  parts.declarations.restored();
  return true;
}

bool are_those_of(const FederationParts& parts, const std::vector<SavedFederate>& federates) {
  bool are = federates.size() == parts.ground.federates.joined_count();
  auto next = federates.begin();
  for_each_joined(parts.ground.federates, [&](std::uint32_t slot) {
    if (!are) return;
    const JoinedFederate& federate = parts.ground.federates[slot];
    const SavedFederate& saved = *next++;
    are = saved.slot == slot && saved.handle == federate.handle && saved.name == federate.name &&
          saved.type == federate.type &&
          saved.ambassador.size() <= AmbassadorStateMessage::state_max;
  });
  return are;
}

}  // namespace rink::rti
