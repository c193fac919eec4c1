// Ownership management at the RTI: checks what federates ask, lets the state machine decide, tells
// everybody concerned.
#include <algorithm>

#include "rti/federation/federation_parts.h"
#include "rti/wire/object_block.h"
#include "rti/wire/ownership_messages.h"

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

/// Whose words the tag of a request are meant for.
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

Outcome FederationParts::take_resign_directive(std::uint32_t slot, Reader& reader) {
  ResignDirectiveMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  federates_[slot].resign_action = static_cast<ResignAction>(message.action);
  return std::nullopt;
}

Outcome FederationParts::take_ownership_requests(std::uint32_t slot, Reader& reader) {
  OwnershipRequestMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  Outcome outcome;
  const bool is_read = read_objects(reader, [&](ObjectHandle object) {
    outcome = take_ownership_request(slot, message, object);
    return !outcome;
  });
  return is_read || outcome ? outcome : Violation::malformed;
}

AttributeSet FederationParts::acquirable(std::uint32_t slot, ObjectSlot object) const {
  const AttributeSet published = publications_.of_class(slot, objects_[object].object_class);
  return published.is_empty() ? published : published | AttributeSet{privilege_to_delete_object};
}

Outcome FederationParts::take_ownership_request(std::uint32_t slot,
                                                const OwnershipRequestMessage& message,
                                                ObjectHandle handle) {
  ObjectSlot object = no_object;
  if (const Outcome outcome = known_.find_known(slot, handle, object);
      outcome || object == no_object)
    return outcome;
  const AttributeSet attributes{message.attributes};
  const auto request = static_cast<OwnershipRequest>(message.word);
  if (!ownership_.all(object).includes(attributes)) return Violation::unknown_name;
  if (is_of_owner(request) && !ownership_.owned_by(slot, object).includes(attributes))
    return Violation::not_owned;
  const bool is_acquisition =
      request == OwnershipRequest::acquire || request == OwnershipRequest::acquire_if_available;
  if (is_acquisition && !acquirable(slot, object).includes(attributes))
    return Violation::undeclared;
  serve_ownership(slot, object, request, attributes, message.tag);
  return std::nullopt;
}

void FederationParts::serve_ownership(std::uint32_t slot, ObjectSlot object,
                                      OwnershipRequest request, AttributeSet attributes,
                                      Bytes tag) {
  const Stamp newest = newest_.of(object);
  const AttributeSet before = ownership_.owned_by(slot, object);
  if (objects_[object].owner == slot)
    interest_.of(slot).known.insert(object);  // should it lose the object, it still knows it
  const auto tell = [&](Ownership::Events events) {
    say_ownership(slot, object, request, events, tag, newest);
  };
  switch (request) {
    case OwnershipRequest::divest:
      tell(ownership_.divest(slot, object, attributes));
      break;
    case OwnershipRequest::offer:
      tell(ownership_.offer(slot, object, attributes, tag));
      break;
    case OwnershipRequest::deny_release:
      tell(ownership_.deny_release(slot, object, attributes));
      break;
    case OwnershipRequest::withdraw_offer:
      tell(ownership_.withdraw_offer(slot, object, attributes));
      break;
    case OwnershipRequest::acquire:
      tell(ownership_.acquire(slot, object, attributes));
      break;
    case OwnershipRequest::acquire_if_available:
      tell(ownership_.acquire_if_available(slot, object, attributes));
      break;
    case OwnershipRequest::cancel_acquisition:
      tell(ownership_.cancel(slot, object, attributes));
      break;
    case OwnershipRequest::confirm:
    case OwnershipRequest::give_if_wanted:
      give_ownership(slot, object, request, attributes, tag);
      break;
  }
  if (ownership_.owned_by(slot, object) != before) ownership_moved(object, newest);
}

/// A confirmation without anybody to take it any more (who wanted it cancelled or left) gives the
/// attributes back, as does a divestiture of what nobody wants.
void FederationParts::give_ownership(std::uint32_t slot, ObjectSlot object,
                                     OwnershipRequest request, AttributeSet attributes, Bytes tag) {
  const Stamp newest = newest_.of(object);
  const bool is_confirmation = request == OwnershipRequest::confirm;
  const AttributeSet given =
      is_confirmation ? attributes & ownership_.confirming(object) : attributes;
  if (!given.is_empty())
    say_ownership(slot, object, request, ownership_.give(slot, object, given), tag, newest);
  const AttributeSet kept = attributes & ownership_.owned_by(slot, object),
                     offered = kept & ownership_.offered(object);
  const ObjectHandle handle = objects_[object].handle;
  if (!is_confirmation)
    notify(slot, OwnershipNotice::divested, handle, attributes.without(kept), {});
  notify(slot, OwnershipNotice::kept, handle, kept.without(offered), {});
  notify(slot, OwnershipNotice::kept_offered, handle, offered, {});
}

void FederationParts::ownership_moved(ObjectSlot object, const Stamp& newest) {
  newest_.inherit(object, newest);
  interest_.owner_changed(object);
  has_ownership_moved_ = true;
}

void FederationParts::notify(std::uint32_t slot, OwnershipNotice notice, ObjectHandle object,
                             AttributeSet attributes, Bytes tag) {
  if (attributes.is_empty()) return;
  federates_[slot].outbox.in_block(
      OwnershipNoticeMessage{static_cast<std::uint8_t>(notice), attributes.bits, tag},
      object.value);
  ++counters_.ownership_notices_sent;
}

void FederationParts::say_ownership(std::uint32_t slot, ObjectSlot object, OwnershipRequest request,
                                    Ownership::Events events, Bytes tag, const Stamp& newest) {
  for (const OwnershipEvent& each : events) {
    const Bytes words = carries_tag(request, each.kind) ? tag : Bytes();
    if (each.kind == OwnershipEvent::Kind::offered) {
      offer_to_all(slot, object, each.attributes, words);
      continue;
    }
    if (each.kind == OwnershipEvent::Kind::acquired) {
      say_last_state(each.federate, object, newest);
      ownership_moved(object, newest);
    }
    notify(each.federate, notice_of(each.kind), objects_[object].handle, each.attributes, words);
  }
}

void FederationParts::offer_to_all(std::uint32_t from, ObjectSlot object, AttributeSet attributes,
                                   Bytes tag) {
  for (std::uint32_t i = 0; i < federates_.size(); ++i)
    if (i != from && federates_[i].is_joined && known_.is_known_to(i, object))
      notify(i, OwnershipNotice::assumption_requested, objects_[object].handle,
             attributes & acquirable(i, object), tag);
}

/// To one who may own them since just now: it has published, or discovered the object.
void FederationParts::offer_to(std::uint32_t slot, ObjectSlot object,
                               AttributeSet newly_published) {
  const AttributeSet others = ownership_.offered(object)
                                  .without(ownership_.confirming(object))
                                  .without(ownership_.owned_by(slot, object));
  const AttributeSet set = newly_published & acquirable(slot, object);
  const ObjectHandle handle = objects_[object].handle;
  notify(slot, OwnershipNotice::assumption_requested, handle, others & set,
         ownership_.offer_tag(object));
  notify(slot, OwnershipNotice::assumption_requested, handle, ownership_.unowned(object) & set, {});
}

/// The newest state reaches the new owner before the notification. After it comes nothing more, for
/// what one owns is out of one's scope: neither what was said this tick nor what buffering held
/// back.
void FederationParts::say_last_state(std::uint32_t slot, ObjectSlot object, const Stamp& newest) {
  const Object& moved = objects_[object];
  const AttributeSet set = interest_.of(slot).told(object, moved.object_class) & moved.valued;
  if (set.is_empty()) return;
  std::vector<std::byte>& bytes = federates_[slot].outbox.head();
  const std::size_t before = bytes.size();
  say(bytes, StampMessage{newest});
  say(bytes, UpdatesMessage{moved.object_class, set.bits});
  write_handle(bytes, 0, moved.handle.value);
  objects_.append(object, set, bytes);
  bytes.push_back(std::byte{0});
  ++counters_.updates_sent;
  counters_.update_bytes_sent += bytes.size() - before;
}

Outcome FederationParts::query_ownership(std::uint32_t slot, Reader& reader) {
  QueryOwnershipMessage message;
  ObjectSlot object = no_object;
  if (!exchange(reader, message)) return Violation::malformed;
  if (const Outcome outcome = known_.find_known(slot, {message.object}, object);
      outcome || object == no_object)
    return outcome;
  if (!ownership_.all(object).contains({message.attribute})) return Violation::unknown_name;
  const std::uint32_t owner = ownership_.owner_of(object, {message.attribute});
  federates_[slot].outbox.after_updates(InformOwnershipMessage{
      message.object, message.attribute,
      owner == no_federate ? FederateHandle::none : federates_[owner].handle.value});
  return std::nullopt;
}

/// Publishing less gives up what it owns of it (5.3); publishing more, it may be asked to take what
/// has no owner.
void FederationParts::published_changed(std::uint32_t slot, std::uint16_t object_class,
                                        AttributeSet before) {
  const AttributeSet now = publications_.of_class(slot, object_class);
  AttributeSet lost = before.without(now), won = now.without(before);
  if (now.is_empty()) lost.insert(privilege_to_delete_object);
  if (before.is_empty()) won.insert(privilege_to_delete_object);
  if (!before.is_empty() && !before.without(now).is_empty()) {
    for_each_owned(slot, [&](ObjectSlot object) {
      const AttributeSet owned = ownership_.owned_by(slot, object) & lost;
      if (objects_[object].object_class == object_class && !owned.is_empty())
        serve_ownership(slot, object, OwnershipRequest::divest, owned, {});
    });
  }
  if (won.is_empty()) return;
  ownership_.for_each_record([&](ObjectSlot object) {
    if (objects_[object].object_class == object_class && known_.is_known_to(slot, object))
      offer_to(slot, object, won);
  });
}

void FederationParts::leave_objects(std::uint32_t slot) {
  const ResignAction action = federates_[slot].resign_action;
  const bool is_deleting = deletes(action);
  ownership_.forget_claims(slot);
  for_each_owned(slot, [&](ObjectSlot object) {
    if (is_deleting && ownership_.owner_of(object, privilege_to_delete_object) == slot)
      return delete_object(object);
    serve_ownership(slot, object, OwnershipRequest::divest, ownership_.owned_by(slot, object), {});
  });
}

}  // namespace rink::rti
