// Requests about ownership, each noted in `OwnershipBook` as soon as it is sent.
#include "rti/federate/services/federate_ownership.h"

#include "rti/federate/books/require.h"

namespace rink::rti {

void FederateOwnership::ask(OwnershipRequest request, ObjectHandle object, AttributeSet attributes,
                            Bytes tag) {
  if (attributes.is_empty()) return;
  uses_.sparing.release(object);
  uses_.sender.release(object, AttributeSet::all());
  require(tag.size() <= ownership_tag_max, HlaError::rti_internal_error, object,
          "a tag of an ownership service has at most 1,024 bytes");
  basis_.frames.enqueue_in_block(
      OwnershipRequestMessage{static_cast<std::uint8_t>(request), attributes.bits, tag}, object);
}

void FederateOwnership::give_up(OwnershipRequest request, ObjectHandle object,
                                AttributeSet attributes, Bytes tag) {
  ask(request, object, attributes, tag);
  uses_.book.change(object, [&](Holding& holding) { holding.lose(attributes); });
}

void FederateOwnership::divest(ObjectHandle object, AttributeSet attributes) {
  uses_.book.require_owned(object, attributes);
  give_up(OwnershipRequest::divest, object, attributes, {});
}

void FederateOwnership::offer(ObjectHandle object, AttributeSet attributes, Bytes tag) {
  uses_.book.require_owned(object, attributes);
  require((uses_.book.offered_of(object) & attributes).is_empty(),
          HlaError::attribute_already_being_divested, object,
          "an attribute can be offered only once");
  ask(OwnershipRequest::offer, object, attributes, tag);
  uses_.book.change(object,
                    [&](Holding& holding) { holding.offered = holding.offered | attributes; });
}

void FederateOwnership::confirm(ObjectHandle object, AttributeSet attributes, Bytes tag) {
  uses_.book.require_owned(object, attributes);
  require(uses_.book.offered_of(object).includes(attributes),
          HlaError::attribute_divestiture_was_not_requested, object,
          "only an offer can be confirmed");
  const Holding* holding = uses_.book.find(object);
  require(attributes.is_empty() || holding->confirmable.includes(attributes),
          HlaError::no_acquisition_pending, object, "no federate has asked for it yet");
  give_up(OwnershipRequest::confirm, object, attributes, tag);
}

void FederateOwnership::deny_release(ObjectHandle object, AttributeSet attributes) {
  uses_.book.require_owned(object, attributes);
  ask(OwnershipRequest::deny_release, object, attributes, {});
}

void FederateOwnership::divest_if_wanted(ObjectHandle object, AttributeSet attributes) {
  uses_.book.require_owned(object, attributes);
  give_up(OwnershipRequest::give_if_wanted, object, attributes, {});
}

void FederateOwnership::withdraw_offer(ObjectHandle object, AttributeSet attributes) {
  uses_.book.require_owned(object, attributes);
  require(uses_.book.offered_of(object).includes(attributes),
          HlaError::attribute_divestiture_was_not_requested, object,
          "only an offer can be withdrawn");
  ask(OwnershipRequest::withdraw_offer, object, attributes, {});
  if (attributes.is_empty()) return;
  uses_.book.change(object, [&](Holding& holding) {
    holding.offered = holding.offered.without(attributes);
    holding.confirmable = holding.confirmable.without(attributes);
  });
}

/// Returns the attributes of the object that are being acquired.
AttributeSet FederateOwnership::require_acquirable(ObjectHandle object,
                                                   AttributeSet attributes) const {
  const KnownObject& known = uses_.book.require_known(object, attributes);
  const AttributeSet published = uses_.classes.published({known.object_class});
  require(!published.is_empty(), HlaError::object_class_not_published, object,
          "its class must be published");
  require((published | AttributeSet{privilege_to_delete_object}).includes(attributes),
          HlaError::attribute_not_published, object, "all of the attributes must be published");
  require((uses_.book.owned_of(object, known) & attributes).is_empty(),
          HlaError::federate_owns_attributes, object,
          "an attribute that is owned here cannot be acquired");
  return uses_.book.pending_of(object);
}

void FederateOwnership::acquire(ObjectHandle object, AttributeSet attributes, Bytes tag) {
  require_acquirable(object, attributes);
  const Holding* before = uses_.book.find(object);
  const AttributeSet asked =
      before ? attributes.without(before->acquiring) : attributes;  // asking twice is asking once
  ask(OwnershipRequest::acquire, object, asked, tag);
  if (asked.is_empty()) return;
  uses_.book.acquire(object, [&](Holding& holding) {
    holding.acquiring = holding.acquiring | asked;
    holding.acquiring_if_available = holding.acquiring_if_available.without(asked);
  });
}

void FederateOwnership::acquire_if_available(ObjectHandle object, AttributeSet attributes) {
  const AttributeSet pending = require_acquirable(object, attributes);
  require((pending & attributes).is_empty(), HlaError::attribute_already_being_acquired, object,
          "its acquisition is under way");
  ask(OwnershipRequest::acquire_if_available, object, attributes, {});
  if (attributes.is_empty()) return;
  uses_.book.acquire(object, [&](Holding& holding) {
    holding.acquiring_if_available = holding.acquiring_if_available | attributes;
  });
}

void FederateOwnership::cancel_acquisition(ObjectHandle object, AttributeSet attributes) {
  const KnownObject& known = uses_.book.require_known(object, attributes);
  require((uses_.book.owned_of(object, known) & attributes).is_empty(),
          HlaError::attribute_already_owned, object,
          "an attribute that is owned here is no longer being acquired");
  const Holding* holding = uses_.book.find(object);
  require(attributes.is_empty() || (holding && holding->acquiring.includes(attributes)),
          HlaError::attribute_acquisition_was_not_requested, object, "nothing to cancel");
  ask(OwnershipRequest::cancel_acquisition, object, attributes, {});
}

void FederateOwnership::query(ObjectHandle object, AttributeHandle attribute) {
  uses_.book.require_known(object, AttributeSet{attribute});
  basis_.frames.enqueue(
      QueryOwnershipMessage{object.value, static_cast<std::uint8_t>(attribute.value)});
}

bool FederateOwnership::is_owned(ObjectHandle object, AttributeHandle attribute) const {
  const KnownObject& known = uses_.book.require_known(object, AttributeSet{attribute});
  return uses_.book.owned_of(object, known).contains(attribute);
}

void FederateOwnership::set_directive(ResignAction action) {
  basis_.phase.require_joined();
  uses_.book.set_directive(action);
  if (!uses_.book.is_deleting()) uses_.sparing.release_all(), uses_.sender.release_all();
  basis_.frames.enqueue(ResignDirectiveMessage{static_cast<std::uint8_t>(action)});
}

void FederateOwnership::prepare_to_resign(ResignAction action) {
  basis_.phase.require_joined();
  uses_.book.require_resignable(action);
  set_directive(action);
}

}  // namespace rink::rti
