// Ownership management at the federate's side: its own part of each object's ownership, judged
// before anything is sent.
#include "rti/federate/ambassador_services.h"
#include "rti/federate/services/require.h"
#include "rti/wire/object_block.h"
#include "rti/wire/ownership_messages.h"

namespace rink::rti {

AttributeSet AmbassadorParts::all_of(const KnownObject& known) const {
  return fom_.attributes(ObjectClassHandle{known.object_class}) |
         AttributeSet{privilege_to_delete_object};
}

const KnownObject& AmbassadorParts::known_or_throw(ObjectHandle object, AttributeSet attributes) {
  phase_.require_joined();
  const KnownObject* known = objects_.find(object);
  require(known != nullptr, HlaError::object_instance_not_known, object,
          "it must have been registered or discovered");
  require(all_of(*known).includes(attributes), HlaError::attribute_not_defined, object,
          "its class has no such attribute");
  return *known;
}

AttributeSet AmbassadorParts::owned_of(ObjectHandle object, const KnownObject& known) const {
  if (known.is_own) return all_of(known);
  const Holding* holding = holdings_.find(object);
  return holding ? holding->owned : AttributeSet();
}

Holding& AmbassadorParts::holding_of(ObjectHandle object, const KnownObject& known) {
  if (Holding* holding = holdings_.find(object)) return *holding;
  Holding& holding = holdings_[object];
  if (known.is_own) holding.owned = all_of(known);
  return holding;
}

/// All or nothing, and nothing under way, is said by `is_own` alone.
void AmbassadorParts::settle_holding(ObjectHandle object, const KnownObject& known) {
  const Holding* holding = holdings_.find(object);
  objects_.set_own(object, holding->owned == all_of(known));
  if (holding->owned.is_empty())
    regions_.forget(object);  // its regions are the new owner's to associate
  if ((known.is_own || holding->owned.is_empty()) && holding->offered.is_empty() &&
      holding->pending().is_empty())
    holdings_.erase(object);
}

void AmbassadorParts::check_update(ObjectHandle object, AttributeSet attributes) {
  const KnownObject& known = known_or_throw(object, attributes);
  require(owned_of(object, known).includes(attributes), HlaError::attribute_not_owned, object,
          "an attribute that is updated must be owned");
}

/// What of the class is owned is given up with its publication, at the RTI too.
void AmbassadorParts::withdraw_publication(ObjectClassHandle object_class, AttributeSet attributes,
                                           bool is_all) {
  if (attributes.is_empty()) return;
  if (is_all) attributes.insert(privilege_to_delete_object);
  std::vector<ObjectHandle> owned;
  objects_.for_each([&](ObjectHandle object, const KnownObject& known) {
    if (known.object_class != object_class.value) return;
    const Holding* holding = holdings_.find(object);
    require(!holding || (holding->pending() & attributes).is_empty(),
            HlaError::ownership_acquisition_pending, object,
            "cancel the acquisition before its class is unpublished");
    if (!(owned_of(object, known) & attributes).is_empty()) owned.push_back(object);
  });
  for (const ObjectHandle object : owned) {
    const KnownObject& known = *objects_.find(object);
    holding_of(object, known).lose(attributes);
    settle_holding(object, known);
  }
}

AttributeSet AmbassadorParts::require_owned(ObjectHandle object, AttributeSet attributes) {
  const KnownObject& known = known_or_throw(object, attributes);
  require(owned_of(object, known).includes(attributes), HlaError::attribute_not_owned, object,
          "all of the attributes must be owned");
  const Holding* holding = holdings_.find(object);
  return holding ? holding->offered : AttributeSet();
}

void AmbassadorParts::ask_ownership(OwnershipRequest request, ObjectHandle object,
                                    AttributeSet attributes, Bytes tag) {
  if (attributes.is_empty()) return;
  release_spared(object);
  release_best_effort(object, AttributeSet(~0u));
  require(tag.size() <= ownership_tag_max, HlaError::rti_internal_error, object,
          "a tag of an ownership service has at most 1,024 bytes");
  frames_.enqueue_in_block(
      OwnershipRequestMessage{static_cast<std::uint8_t>(request), attributes.bits, tag}, object);
}

void AmbassadorParts::give_up(OwnershipRequest request, ObjectHandle object,
                              AttributeSet attributes, Bytes tag) {
  ask_ownership(request, object, attributes, tag);
  const KnownObject& known = *objects_.find(object);
  holding_of(object, known).lose(attributes);
  settle_holding(object, known);
}

void AmbassadorServices::unconditional_attribute_ownership_divestiture(ObjectHandle object,
                                                                       AttributeSet attributes) {
  require_owned(object, attributes);
  give_up(OwnershipRequest::divest, object, attributes, {});
}

void AmbassadorServices::negotiated_attribute_ownership_divestiture(ObjectHandle object,
                                                                    AttributeSet attributes,
                                                                    Bytes tag) {
  const AttributeSet offered = require_owned(object, attributes);
  require((offered & attributes).is_empty(), HlaError::attribute_already_being_divested, object,
          "an attribute is offered once");
  ask_ownership(OwnershipRequest::offer, object, attributes, tag);
  const KnownObject& known = *objects_.find(object);
  Holding& holding = holding_of(object, known);
  holding.offered = holding.offered | attributes;
  settle_holding(object, known);
}

void AmbassadorServices::confirm_divestiture(ObjectHandle object, AttributeSet attributes,
                                             Bytes tag) {
  const AttributeSet offered = require_owned(object, attributes);
  require(offered.includes(attributes), HlaError::attribute_divestiture_was_not_requested, object,
          "only what is offered can be confirmed");
  const Holding* holding = holdings_.find(object);
  require(attributes.is_empty() || holding->confirmable.includes(attributes),
          HlaError::no_acquisition_pending, object, "nobody has asked for it yet");
  give_up(OwnershipRequest::confirm, object, attributes, tag);
}

void AmbassadorServices::attribute_ownership_release_denied(ObjectHandle object,
                                                            AttributeSet attributes) {
  require_owned(object, attributes);
  ask_ownership(OwnershipRequest::deny_release, object, attributes, {});
}

void AmbassadorServices::attribute_ownership_divestiture_if_wanted(ObjectHandle object,
                                                                   AttributeSet attributes) {
  require_owned(object, attributes);
  give_up(OwnershipRequest::give_if_wanted, object, attributes, {});
}

void AmbassadorServices::cancel_negotiated_attribute_ownership_divestiture(
    ObjectHandle object, AttributeSet attributes) {
  const AttributeSet offered = require_owned(object, attributes);
  require(offered.includes(attributes), HlaError::attribute_divestiture_was_not_requested, object,
          "only an offer can be withdrawn");
  ask_ownership(OwnershipRequest::withdraw_offer, object, attributes, {});
  if (attributes.is_empty()) return;
  const KnownObject& known = *objects_.find(object);
  Holding& holding = holding_of(object, known);
  holding.offered = holding.offered.without(attributes);
  holding.confirmable = holding.confirmable.without(attributes);
  settle_holding(object, known);
}

AttributeSet AmbassadorParts::require_acquirable(ObjectHandle object, AttributeSet attributes) {
  const KnownObject& known = known_or_throw(object, attributes);
  const AttributeSet published = declared_.objects[known.object_class].published;
  require(!published.is_empty(), HlaError::object_class_not_published, object,
          "its class must be published");
  require((published | AttributeSet{privilege_to_delete_object}).includes(attributes),
          HlaError::attribute_not_published, object, "all of the attributes must be published");
  require((owned_of(object, known) & attributes).is_empty(), HlaError::federate_owns_attributes,
          object, "what is owned can't be acquired");
  const Holding* holding = holdings_.find(object);
  return holding ? holding->pending() : AttributeSet();
}

void AmbassadorServices::attribute_ownership_acquisition(ObjectHandle object,
                                                         AttributeSet attributes, Bytes tag) {
  require_acquirable(object, attributes);
  const Holding* before = holdings_.find(object);
  const AttributeSet asked =
      before ? attributes.without(before->acquiring) : attributes;  // asking twice is asking once
  ask_ownership(OwnershipRequest::acquire, object, asked, tag);
  if (asked.is_empty()) return;
  Holding& holding = holding_of(object, *objects_.find(object));
  holding.acquiring = holding.acquiring | asked;
  holding.acquiring_if_available = holding.acquiring_if_available.without(asked);
}

void AmbassadorServices::attribute_ownership_acquisition_if_available(ObjectHandle object,
                                                                      AttributeSet attributes) {
  const AttributeSet pending = require_acquirable(object, attributes);
  require((pending & attributes).is_empty(), HlaError::attribute_already_being_acquired, object,
          "its acquisition is under way");
  ask_ownership(OwnershipRequest::acquire_if_available, object, attributes, {});
  if (attributes.is_empty()) return;
  Holding& holding = holding_of(object, *objects_.find(object));
  holding.acquiring_if_available = holding.acquiring_if_available | attributes;
}

void AmbassadorServices::cancel_attribute_ownership_acquisition(ObjectHandle object,
                                                                AttributeSet attributes) {
  const KnownObject& known = known_or_throw(object, attributes);
  require((owned_of(object, known) & attributes).is_empty(), HlaError::attribute_already_owned,
          object, "what is owned is no longer being acquired");
  const Holding* holding = holdings_.find(object);
  require(attributes.is_empty() || (holding && holding->acquiring.includes(attributes)),
          HlaError::attribute_acquisition_was_not_requested, object, "nothing to cancel");
  ask_ownership(OwnershipRequest::cancel_acquisition, object, attributes, {});
}

void AmbassadorServices::query_attribute_ownership(ObjectHandle object, AttributeHandle attribute) {
  known_or_throw(object, AttributeSet{attribute});
  frames_.enqueue(QueryOwnershipMessage{object.value, static_cast<std::uint8_t>(attribute.value)});
}

bool AmbassadorServices::is_attribute_owned_by_federate(ObjectHandle object,
                                                        AttributeHandle attribute) {
  return owned_of(object, known_or_throw(object, AttributeSet{attribute})).contains(attribute);
}

void AmbassadorServices::set_automatic_resign_directive(ResignAction action) {
  phase_.require_joined();
  say_directive(action);
}

/// What outlives its federate must be known to the RTI.
void AmbassadorParts::say_directive(ResignAction action) {
  declared_.is_deleting = deletes(action);
  if (!declared_.is_deleting)
    release_spared(ObjectClassHandle{}, AttributeSet(~0u)), release_best_effort();
  frames_.enqueue(ResignDirectiveMessage{static_cast<std::uint8_t>(action)});
}

void AmbassadorServices::resign(ResignAction action) {
  phase_.require_joined();
  const bool cancels = action == ResignAction::cancel_pending_ownership_acquisitions ||
                       action == ResignAction::cancel_then_delete_then_divest;
  const bool deletes = action == ResignAction::delete_objects;
  const bool divests = action == ResignAction::unconditionally_divest_attributes ||
                       action == ResignAction::delete_objects_then_divest ||
                       action == ResignAction::cancel_then_delete_then_divest;
  const auto check = [&](ObjectHandle object, const KnownObject& known) {
    const AttributeSet owned = owned_of(object, known);
    const Holding* holding = holdings_.find(object);
    require(cancels || !holding || holding->pending().is_empty(),
            HlaError::ownership_acquisition_pending, object, "the action must cancel acquisitions");
    require(divests || owned.is_empty() || (deletes && owned.contains(privilege_to_delete_object)),
            HlaError::federate_owns_attributes, object,
            "the action must divest or delete what is owned");
  };
  objects_.for_each(check);
  say_directive(action);
  session_.resign();
}

bool AmbassadorParts::take_ownership(Reader& reader, std::uint8_t kind) {
  if (static_cast<MessageKind>(kind) == MessageKind::inform_ownership) {
    InformOwnershipMessage message;
    if (!exchange(reader, message)) return false;
    if (!objects_.find({message.object})) return objects_.is_gone({message.object});
    if (message.federate == FederateHandle::none)
      callbacks_.attribute_is_not_owned({message.object}, {message.attribute});
    else
      callbacks_.inform_attribute_ownership({message.object}, {message.attribute},
                                            {message.federate});
    return true;
  }
  OwnershipNoticeMessage message;
  if (!exchange(reader, message)) return false;
  const bool is_read = read_objects(reader, [&](ObjectHandle object) {
    const KnownObject* known = objects_.find(object);
    if (known == nullptr) return objects_.is_gone(object);
    if (!all_of(*known).includes(AttributeSet(message.attributes))) return false;
    take_notice(object, *known, static_cast<OwnershipNotice>(message.word),
                AttributeSet(message.attributes), message.tag);
    return phase_.is_joined();
  });
  return is_read || !phase_.is_joined();
}

/// What crossed a word of ours on its way is about what we no longer own or want, and passes in
/// silence.
void AmbassadorParts::take_notice(ObjectHandle object, const KnownObject& known,
                                  OwnershipNotice notice, AttributeSet attributes, Bytes tag) {
  Holding& holding = holding_of(object, known);
  const AttributeSet pending = attributes & holding.pending();
  AttributeSet told = attributes;
  switch (notice) {
    case OwnershipNotice::assumption_requested:
      told = attributes.without(holding.owned).without(pending);
      break;
    case OwnershipNotice::confirmation_requested:
      told = attributes & holding.offered;
      holding.confirmable = holding.confirmable | told;
      break;
    case OwnershipNotice::release_requested:
      told = attributes & holding.owned;
      break;
    case OwnershipNotice::unavailable:
    case OwnershipNotice::acquisition_cancelled:
      told = pending;
      holding.end_acquisition(attributes);
      break;
    case OwnershipNotice::acquired:
    case OwnershipNotice::kept:
      holding.gain(attributes);
      break;
    case OwnershipNotice::kept_offered:
      holding.gain(attributes);
      holding.offered = holding.offered | attributes;
      break;
    case OwnershipNotice::divested:
      break;
  }
  settle_holding(object, known);
  if (!told.is_empty()) call_back(object, notice, told, tag);
  const bool is_kept = notice == OwnershipNotice::kept || notice == OwnershipNotice::kept_offered;
  if (is_kept && !pending.is_empty())
    call_back(object, OwnershipNotice::acquired, pending,
              {});  // asked for again before it was clear that it had stayed
}

void AmbassadorParts::call_back(ObjectHandle object, OwnershipNotice notice,
                                AttributeSet attributes, Bytes tag) {
  switch (notice) {
    case OwnershipNotice::assumption_requested:
      return callbacks_.request_attribute_ownership_assumption(object, attributes, tag);
    case OwnershipNotice::confirmation_requested:
      return callbacks_.request_divestiture_confirmation(object, attributes);
    case OwnershipNotice::release_requested:
      return callbacks_.request_attribute_ownership_release(object, attributes, tag);
    case OwnershipNotice::unavailable:
      return callbacks_.attribute_ownership_unavailable(object, attributes);
    case OwnershipNotice::acquisition_cancelled:
      return callbacks_.confirm_attribute_ownership_acquisition_cancellation(object, attributes);
    case OwnershipNotice::acquired:
      return callbacks_.attribute_ownership_acquisition_notification(object, attributes, tag);
    case OwnershipNotice::kept:
    case OwnershipNotice::kept_offered:
      return callbacks_.attribute_ownership_kept(object, attributes);
    case OwnershipNotice::divested:
      return callbacks_.attribute_ownership_divested(object, attributes);
  }
}

}  // namespace rink::rti
