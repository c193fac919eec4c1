// Handles ownership requests in the order in which they came, and notifies the federates concerned.
#include "rti/federation/services/ownership_service.h"

#include <algorithm>
#include <cassert>

#include "rti/wire/object_block.h"

namespace rink::rti {

namespace {

bool is_of_owner(OwnershipRequest request) { return request < OwnershipRequest::acquire; }

OwnershipNotice notice_of(OwnershipEvent::Kind kind) {
  switch (kind) {
    case OwnershipEvent::Kind::acquired:
      return OwnershipNotice::acquired;
    case OwnershipEvent::Kind::unavailable:
      return OwnershipNotice::unavailable;
    case OwnershipEvent::Kind::cancelled:
      return OwnershipNotice::acquisition_cancelled;
    case OwnershipEvent::Kind::release_requested:
      return OwnershipNotice::release_requested;
    case OwnershipEvent::Kind::confirmation_requested:
      return OwnershipNotice::confirmation_requested;
    case OwnershipEvent::Kind::offered:
      break;
  }
  return OwnershipNotice::assumption_requested;
}

/// True if the tag of a request is sent with this kind of notice.
bool carries_tag(OwnershipRequest request, OwnershipEvent::Kind kind) {
  switch (request) {
    case OwnershipRequest::offer:
      return kind == OwnershipEvent::Kind::offered;
    case OwnershipRequest::confirm:
      return kind == OwnershipEvent::Kind::acquired;
    case OwnershipRequest::acquire:
      return kind == OwnershipEvent::Kind::release_requested;
    default:
      return false;
  }
}

}  // namespace

void OwnershipService::joined(std::uint32_t slot) {
  if (slot >= resign_actions_.size()) resign_actions_.resize(slot + 1);
  resign_actions_[slot] = basis_.fom.switches().automatic_resign_action;
}

void OwnershipService::left(std::uint32_t slot) {
  const bool is_deleting = deletes(resign_actions_[slot]);
  uses_.ownership.forget_claims(slot);
  for_each_owned(slot, [&](ObjectSlot object) {
    if (is_deleting && uses_.ownership.owner_of(object, privilege_to_delete_object) == slot)
      return uses_.objects.remove(object);
    serve(slot, object, OwnershipRequest::divest, uses_.ownership.owned_by(slot, object), {});
  });
}

Status OwnershipService::handle_resign_directive(std::uint32_t slot, Reader& reader) {
  ResignDirectiveMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  resign_actions_[slot] = static_cast<ResignAction>(message.action);
  return std::nullopt;
}

Status OwnershipService::handle_requests(std::uint32_t slot, Reader& reader) {
  OwnershipRequestMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  Status status;
  const bool is_read = read_objects(reader, [&](ObjectHandle object) {
    status = take(slot, message, object);
    return !status;
  });
  return is_read || status ? status : Violation::malformed;
}

AttributeSet OwnershipService::acquirable(std::uint32_t slot, ObjectSlot object) const {
  const AttributeSet published =
      uses_.publications.of_class(slot, basis_.objects[object].object_class);
  return published.is_empty() ? published : published | AttributeSet{privilege_to_delete_object};
}

Status OwnershipService::take(std::uint32_t slot, const OwnershipRequestMessage& message,
                              ObjectHandle handle) {
  ObjectSlot object = no_object;
  if (const Status status = uses_.known.find_known(slot, handle, object);
      status || object == no_object)
    return status;
  const AttributeSet attributes{message.attributes};
  const auto request = static_cast<OwnershipRequest>(message.word);
  if (!uses_.ownership.all(object).includes(attributes)) return Violation::unknown_name;
  if (is_of_owner(request) && !uses_.ownership.owned_by(slot, object).includes(attributes))
    return Violation::not_owned;
  const bool is_acquisition =
      request == OwnershipRequest::acquire || request == OwnershipRequest::acquire_if_available;
  if (is_acquisition && !acquirable(slot, object).includes(attributes))
    return Violation::undeclared;
  serve(slot, object, request, attributes, message.tag);
  return std::nullopt;
}

void OwnershipService::serve(std::uint32_t slot, ObjectSlot object, OwnershipRequest request,
                             AttributeSet attributes, Bytes tag) {
  const Stamp newest = uses_.newest.of(object);
  const AttributeSet before = uses_.ownership.owned_by(slot, object);
  if (basis_.objects[object].owner == slot)
    uses_.distribution.of(slot).known.insert(
        object);  // should it lose the object, it still knows it
  if (request == OwnershipRequest::confirm || request == OwnershipRequest::give_if_wanted)
    give(slot, object, request, attributes, tag);
  else
    notify_all(slot, object, decide(slot, object, request, attributes, tag),
               {request, tag, newest});
  if (uses_.ownership.owned_by(slot, object) != before) moved(object, newest);
}

Ownership::Events OwnershipService::decide(std::uint32_t slot, ObjectSlot object,
                                           OwnershipRequest request, AttributeSet attributes,
                                           Bytes tag) {
  Ownership& ownership = uses_.ownership;
  switch (request) {
    case OwnershipRequest::divest:
      return ownership.divest(slot, object, attributes);
    case OwnershipRequest::offer:
      return ownership.offer(slot, object, attributes, tag);
    case OwnershipRequest::deny_release:
      return ownership.deny_release(slot, object, attributes);
    case OwnershipRequest::withdraw_offer:
      return ownership.withdraw_offer(slot, object, attributes);
    case OwnershipRequest::acquire:
      return ownership.acquire(slot, object, attributes);
    case OwnershipRequest::acquire_if_available:
      return ownership.acquire_if_available(slot, object, attributes);
    case OwnershipRequest::cancel_acquisition:
      return ownership.cancel(slot, object, attributes);
    case OwnershipRequest::confirm:
    case OwnershipRequest::give_if_wanted:
      break;
  }
  assert(false && "these give what somebody wants");
  return {};
}

/// A confirmation that no federate wants any more (the claimant cancelled or left) gives the
/// attributes back, as does a divestiture if wanted of what none wants.
void OwnershipService::give(std::uint32_t slot, ObjectSlot object, OwnershipRequest request,
                            AttributeSet attributes, Bytes tag) {
  Ownership& ownership = uses_.ownership;
  const Stamp newest = uses_.newest.of(object);
  const bool is_confirmation = request == OwnershipRequest::confirm;
  const AttributeSet given =
      is_confirmation ? attributes & ownership.confirming(object) : attributes;
  if (!given.is_empty())
    notify_all(slot, object, ownership.give(slot, object, given), {request, tag, newest});
  const AttributeSet kept = attributes & ownership.owned_by(slot, object),
                     offered = kept & ownership.offered(object);
  const ObjectHandle handle = basis_.objects[object].handle;
  if (!is_confirmation)
    notify(slot, OwnershipNotice::divested, handle, attributes.without(kept), {});
  notify(slot, OwnershipNotice::kept, handle, kept.without(offered), {});
  notify(slot, OwnershipNotice::kept_offered, handle, offered, {});
}

void OwnershipService::moved(ObjectSlot object, const Stamp& newest) {
  assert(basis_.objects[object].is_alive);
  uses_.newest.inherit(object, newest);
  uses_.distribution.owner_changed(object);
  has_moved_ = true;
}

void OwnershipService::notify(std::uint32_t slot, OwnershipNotice notice, ObjectHandle object,
                              AttributeSet attributes, Bytes tag) {
  if (attributes.is_empty()) return;
  basis_.federates[slot].outbox.in_block(
      OwnershipNoticeMessage{static_cast<std::uint8_t>(notice), attributes.bits, tag},
      object.value);
  ++basis_.counters.ownership_notices_sent;
}

void OwnershipService::notify_all(std::uint32_t slot, ObjectSlot object, Ownership::Events events,
                                  const RequestContext& context) {
  for (const OwnershipEvent& each : events) {
    const Bytes words = carries_tag(context.request, each.kind) ? context.tag : Bytes();
    if (each.kind == OwnershipEvent::Kind::offered) {
      offer_to_all(slot, object, each.attributes, words);
      continue;
    }
    if (each.kind == OwnershipEvent::Kind::acquired) {
      send_state(each.federate, object, context.newest);
      moved(object, context.newest);
    }
    notify(each.federate, notice_of(each.kind), basis_.objects[object].handle, each.attributes,
           words);
  }
}

void OwnershipService::offer_to_all(std::uint32_t from, ObjectSlot object, AttributeSet attributes,
                                    Bytes tag) {
  for (std::uint32_t i = 0; i < basis_.federates.size(); ++i)
    if (i != from && basis_.federates[i].is_joined && uses_.known.is_known_to(i, object))
      notify(i, OwnershipNotice::assumption_requested, basis_.objects[object].handle,
             attributes & acquirable(i, object), tag);
}

void OwnershipService::discovered(std::uint32_t slot, ObjectSlot object) {
  if (basis_.objects[object].negotiation != Object::no_negotiation)
    offer_to(slot, object, uses_.ownership.all(object));
}

/// Offers unowned attributes to a federate that may own them now, since it has published or
/// discovered the object.
void OwnershipService::offer_to(std::uint32_t slot, ObjectSlot object,
                                AttributeSet newly_published) {
  const AttributeSet others = uses_.ownership.offered(object)
                                  .without(uses_.ownership.confirming(object))
                                  .without(uses_.ownership.owned_by(slot, object));
  const AttributeSet set = newly_published & acquirable(slot, object);
  const ObjectHandle handle = basis_.objects[object].handle;
  notify(slot, OwnershipNotice::assumption_requested, handle, others & set,
         uses_.ownership.offer_tag(object));
  notify(slot, OwnershipNotice::assumption_requested, handle, uses_.ownership.unowned(object) & set,
         {});
}

/// The newest state reaches the new owner before the notification. Afterwards it receives no
/// updates, since own attributes are out of scope: neither this tick's nor those that buffering
/// held back.
void OwnershipService::send_state(std::uint32_t slot, ObjectSlot object, const Stamp& newest) {
  const Object& moved = basis_.objects[object];
  const AttributeSet set =
      uses_.distribution.of(slot).attributes_in_scope(object, moved.object_class) & moved.valued;
  if (set.is_empty()) return;
  std::vector<std::byte>& bytes = basis_.federates[slot].outbox.head();
  const std::size_t before = bytes.size();
  StampMessage stamp{newest};
  UpdatesMessage header{moved.object_class, set.bits};
  write(bytes, stamp);
  write(bytes, header);
  write_handle(bytes, 0, moved.handle.value);
  basis_.objects.append(object, set, bytes);
  bytes.push_back(std::byte{0});
  ++basis_.counters.updates_sent;
  basis_.counters.update_bytes_sent += bytes.size() - before;
}

Status OwnershipService::handle_query(std::uint32_t slot, Reader& reader) {
  QueryOwnershipMessage message;
  ObjectSlot object = no_object;
  if (!exchange(reader, message)) return Violation::malformed;
  if (const Status status = uses_.known.find_known(slot, {message.object}, object);
      status || object == no_object)
    return status;
  if (!uses_.ownership.all(object).contains({message.attribute})) return Violation::unknown_name;
  const std::uint32_t owner = uses_.ownership.owner_of(object, {message.attribute});
  basis_.federates[slot].outbox.after_updates(InformOwnershipMessage{
      message.object, message.attribute,
      owner == no_federate ? FederateHandle::none : basis_.federates[owner].handle.value});
  return std::nullopt;
}

void OwnershipService::published_changed(std::uint32_t slot, std::uint16_t object_class,
                                         AttributeSet before) {
  const AttributeSet now = uses_.publications.of_class(slot, object_class);
  AttributeSet lost = before.without(now), won = now.without(before);
  if (now.is_empty()) lost.insert(privilege_to_delete_object);
  if (before.is_empty()) won.insert(privilege_to_delete_object);
  if (!before.is_empty() && !before.without(now).is_empty()) {
    for_each_owned(slot, [&](ObjectSlot object) {
      const AttributeSet owned = uses_.ownership.owned_by(slot, object) & lost;
      if (basis_.objects[object].object_class == object_class && !owned.is_empty())
        serve(slot, object, OwnershipRequest::divest, owned, {});
    });
  }
  if (won.is_empty()) return;
  uses_.ownership.for_each_record([&](ObjectSlot object) {
    if (basis_.objects[object].object_class == object_class &&
        uses_.known.is_known_to(slot, object))
      offer_to(slot, object, won);
  });
}

}  // namespace rink::rti
