// Handles the RTI's notices about ownership: notes them in `OwnershipBook` and calls back.
#include "rti/federate/services/federate_ownership.h"
#include "rti/wire/object_block.h"

namespace rink::rti {

bool FederateOwnership::handle_owner(Reader& reader) {
  InformOwnershipMessage message;
  if (!exchange(reader, message)) return false;
  const ObjectHandle object{message.object};
  if (uses_.objects.find(object) == nullptr) return uses_.objects.is_gone(object);
  if (message.federate == FederateHandle::none)
    basis_.callbacks.attribute_is_not_owned(object, {message.attribute});
  else basis_.callbacks.inform_attribute_ownership(object, {message.attribute}, {message.federate});
  return true;
}

bool FederateOwnership::handle_notices(Reader& reader) {
  OwnershipNoticeMessage message;
  if (!exchange(reader, message)) return false;
  const AttributeSet attributes(message.attributes);
  const bool is_read = read_objects(reader, [&](ObjectHandle object) {
    const KnownObject* known = uses_.objects.find(object);
    if (known == nullptr) return uses_.objects.is_gone(object);
    if (!uses_.book.all_of(*known).includes(attributes)) return false;
    note(object, static_cast<OwnershipNotice>(message.word), attributes, message.tag);
    return basis_.phase.is_joined();
  });
  return is_read || !basis_.phase.is_joined();
}

void FederateOwnership::note(ObjectHandle object, OwnershipNotice notice, AttributeSet attributes,
                             Bytes tag) {
  const AttributeSet pending = attributes & uses_.book.pending_of(object);
  const AttributeSet concerned = change(object, notice, attributes);
  if (!concerned.is_empty()) call_back(object, notice, concerned, tag);
  const bool is_kept = notice == OwnershipNotice::kept || notice == OwnershipNotice::kept_offered;
  if (is_kept && !pending.is_empty())
    call_back(object, OwnershipNotice::acquired, pending,
              {});  // acquired again before the notice that it had stayed
}

/// Returns the attributes to notify the federate of: a notice that crossed an own request is about
/// attributes that are no longer owned or wanted, and is ignored.
AttributeSet FederateOwnership::change(ObjectHandle object, OwnershipNotice notice,
                                       AttributeSet attributes) {
  AttributeSet concerned = attributes;
  uses_.book.change(object, [&](Holding& holding) {
    const AttributeSet pending = attributes & holding.pending();
    switch (notice) {
      case OwnershipNotice::assumption_requested:
        concerned = attributes.without(holding.owned).without(pending);
        break;
      case OwnershipNotice::confirmation_requested:
        concerned = attributes & holding.offered;
        holding.confirmable = holding.confirmable | concerned;
        break;
      case OwnershipNotice::release_requested:
        concerned = attributes & holding.owned;
        break;
      case OwnershipNotice::unavailable:
      case OwnershipNotice::acquisition_cancelled:
        concerned = pending;
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
  });
  return concerned;
}

void FederateOwnership::call_back(ObjectHandle object, OwnershipNotice notice,
                                  AttributeSet attributes, Bytes tag) {
  FederateAmbassador& callbacks = basis_.callbacks;
  switch (notice) {
    case OwnershipNotice::assumption_requested:
      return callbacks.request_attribute_ownership_assumption(object, attributes, tag);
    case OwnershipNotice::confirmation_requested:
      return callbacks.request_divestiture_confirmation(object, attributes);
    case OwnershipNotice::release_requested:
      return callbacks.request_attribute_ownership_release(object, attributes, tag);
    case OwnershipNotice::unavailable:
      return callbacks.attribute_ownership_unavailable(object, attributes);
    case OwnershipNotice::acquisition_cancelled:
      return callbacks.confirm_attribute_ownership_acquisition_cancellation(object, attributes);
    case OwnershipNotice::acquired:
      return callbacks.attribute_ownership_acquisition_notification(object, attributes, tag);
    case OwnershipNotice::kept:
    case OwnershipNotice::kept_offered:
      return callbacks.attribute_ownership_kept(object, attributes);
    case OwnershipNotice::divested:
      return callbacks.attribute_ownership_divested(object, attributes);
  }
}

}  // namespace rink::rti
