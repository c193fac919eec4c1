// Registers objects within each federate's share, and removes them for all federates that know
// them.
#include "rti/federation/services/object_service.h"

#include <cassert>
#include <utility>

#include "rti/wire/membership_messages.h"

namespace rink::rti {

ObjectService::Registered& ObjectService::of(std::uint32_t slot) {
  if (slot >= federates_.size()) federates_.resize(slot + 1);
  return federates_[slot];
}

void ObjectService::joined(std::uint32_t slot) { of(slot) = {}; }

void ObjectService::left(std::uint32_t slot) {
  Registered& registered = federates_[slot];
  if (registered.further_block) basis_.federates.give_back(*registered.further_block);
  const std::uint32_t block = basis_.federates[slot].block;
  if (registered.count == 0) basis_.federates.give_back(block);
  else basis_.objects.close_block(block);  // others have seen its handles
  registered = {};
}

Status ObjectService::handle_register(std::uint32_t slot, Reader& reader) {
  RegisterObjectMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  if (message.object_class >= basis_.fom.object_classes().size()) return Violation::unknown_name;
  if (uses_.publications.of_class(slot, message.object_class).is_empty())
    return Violation::undeclared;
  const FederationSettings& settings = basis_.settings;
  const std::size_t own = alive(slot);
  if (own >= settings.objects_per_federate_max) return Violation::over_limit;
  Registered& registered = federates_[slot];
  assert(registered.count <= object_block);
  if (registered.count == object_block && !extend_block(slot)) return Violation::over_limit;
  // Handles must come in order, so that no federate can make the table grow by naming a great one.
  if (message.object != basis_.federates[slot].block * object_block + registered.count)
    return Violation::unknown_name;
  if (++registered.count == object_block / 2) promise_block(slot);
  registered.name_bytes += message.name.size();
  // Federates with more than their share are refused first, so that none can keep others from
  // theirs.
  const bool is_full = basis_.objects.size() >= settings.object_max &&
                       own >= settings.object_max / basis_.federates.joined_count();
  if (is_full || registered.name_bytes > settings.name_bytes_per_federate_max)
    return refuse(slot, {message.object}), std::nullopt;
  const bool has_name = message.name.empty() || uses_.names.take(slot, message.name);
  uses_.distribution.object_registered(basis_.objects.insert(
      {message.object}, slot, message.object_class, has_name ? message.name : std::string_view()));
  return std::nullopt;
}

/// The number of living objects that the federate has registered.
std::size_t ObjectService::alive(std::uint32_t slot) const {
  std::size_t count = basis_.objects.alive_in(basis_.federates[slot].block);
  for (const std::uint32_t block : federates_[slot].former_blocks)
    count += basis_.objects.alive_in(block);
  return count;
}

/// Continues in the further block that the federate was given; false if none was left to give.
bool ObjectService::extend_block(std::uint32_t slot) {
  Registered& registered = federates_[slot];
  assert(registered.count == object_block);  // the present one is used up
  if (!registered.further_block) return false;
  std::uint32_t& block = basis_.federates[slot].block;
  basis_.objects.close_block(block);
  registered.former_blocks.push_back(block);
  block = *std::exchange(registered.further_block, std::nullopt);
  registered.count = 0;
  return true;
}

/// Gives the federate a further block before the present one is used up.
void ObjectService::promise_block(std::uint32_t slot) {
  if (!basis_.federates.has_block()) return;
  const std::uint32_t block = basis_.federates.take_block();
  assert(!federates_[slot].further_block);
  federates_[slot].further_block = block;
  basis_.federates[slot].outbox.before_updates(FurtherBlockMessage{block});
}

/// Notifies the registrar that the object is removed; messages about it meanwhile are late and
/// break no rule.
void ObjectService::refuse(std::uint32_t slot, ObjectHandle object) {
  basis_.objects.pass_over(object);
  basis_.federates[slot].outbox.after_updates(RemoveObjectMessage{object.value});
}

ObjectHandle ObjectService::register_own(std::uint32_t slot, ObjectClassHandle object_class) {
  assert(!basis_.federates[slot].is_joined);
  Registered& registered = of(slot);
  std::uint32_t& block = basis_.federates[slot].block;
  if (registered.count ==
      object_block) {  // those that come and go have used up all handles of the block
    if (!basis_.federates.has_block()) return {};
    basis_.objects.close_block(block);
    block = basis_.federates.take_block();
    registered.count = 0;
  }
  const ObjectHandle object{block * object_block + registered.count++};
  uses_.distribution.object_registered(
      basis_.objects.insert(object, slot, static_cast<std::uint16_t>(object_class.value), {}));
  return object;
}

Status ObjectService::handle_delete(std::uint32_t slot, Reader& reader) {
  DeleteObjectMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  ObjectSlot object = no_object;
  if (const Status status = uses_.known.find({message.object}, object);
      status || object == no_object)
    return status;
  if (basis_.objects[object].owner != slot &&
      uses_.ownership.owner_of(object, privilege_to_delete_object) != slot)
    return Violation::not_owned;
  ++basis_.federates[slot].objects_deleted;
  remove(object);
  return std::nullopt;
}

/// The confirmation precedes any message by which the object is discovered anew.
Status ObjectService::handle_local_delete(std::uint32_t slot, Reader& reader) {
  LocalDeleteMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  ObjectSlot object = no_object;
  if (const Status status = uses_.known.find({message.object}, object);
      status || object == no_object)
    return status;
  if (!uses_.ownership.owned_by(slot, object).is_empty()) return Violation::not_owned;
  FederateInterest& interest = uses_.distribution.of(slot);
  if (!interest.known.contains(object)) return ++basis_.counters.late_requests, std::nullopt;
  interest.known.erase(object);
  interest.in_scope.erase(object);
  interest.needs_full_state.erase(object);
  interest.unannounced.erase(object);
  interest.unannounced_exits.erase(object);
  basis_.federates[slot].outbox.before_updates(RemoveObjectMessage{message.object});
  return std::nullopt;
}

void ObjectService::remove(ObjectSlot object) {
  const Object& removed = basis_.objects[object];
  assert(removed.is_alive);
  uses_.distribution.object_deleted(object);
  uses_.ownership.forget(object);
  uses_.newest.forget(object);
  uses_.arrivals.forget(removed.handle);
  for (std::uint32_t slot = 0; slot < basis_.federates.size(); ++slot) {
    JoinedFederate& federate = basis_.federates[slot];
    if (!federate.is_joined) continue;
    FederateInterest& interest = uses_.distribution.of(slot);
    interest.unannounced.erase(object);
    interest.unannounced_exits.erase(object);
    if (!interest.known.contains(object)) continue;
    interest.known.erase(object);
    ++federate.objects_removed;
    RemoveObjectMessage removal{removed.handle.value};
    federate.outbox.after_updates(removal);
    basis_.counters.scope_bytes_sent += measure(removal);
  }
  if (!removed.name.empty()) uses_.names.give_back(removed.name);
  uses_.types.forget(removed.handle);
  basis_.objects.erase(object);
}

}  // namespace rink::rti
