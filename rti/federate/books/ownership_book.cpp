// Checks and changes of what a federate owns.
#include "rti/federate/books/ownership_book.h"

#include <vector>

#include "rti/federate/books/require.h"

namespace rink::rti {

AttributeSet OwnershipBook::owned_of(ObjectHandle object, const KnownObject& known) const {
  if (known.is_own) return all_of(known);
  const Holding* holding = holdings_.find(object);
  return holding ? holding->owned : AttributeSet();
}

AttributeSet OwnershipBook::owned_of(ObjectHandle object) const {
  const KnownObject* known = objects_.find(object);
  return known != nullptr ? owned_of(object, *known) : AttributeSet();
}

AttributeSet OwnershipBook::offered_of(ObjectHandle object) const {
  const Holding* holding = holdings_.find(object);
  return holding ? holding->offered : AttributeSet();
}

AttributeSet OwnershipBook::pending_of(ObjectHandle object) const {
  const Holding* holding = holdings_.find(object);
  return holding ? holding->pending() : AttributeSet();
}

const KnownObject& OwnershipBook::require_known(ObjectHandle object,
                                                AttributeSet attributes) const {
  basis_.phase.require_joined();
  const KnownObject* known = objects_.find(object);
  require(known != nullptr, HlaError::object_instance_not_known, object,
          "it must have been registered or discovered");
  require(all_of(*known).includes(attributes), HlaError::attribute_not_defined, object,
          "its class has no such attribute");
  return *known;
}

const KnownObject& OwnershipBook::require_owned(ObjectHandle object,
                                                AttributeSet attributes) const {
  const KnownObject& known = require_known(object, attributes);
  require(owned_of(object, known).includes(attributes), HlaError::attribute_not_owned, object,
          "all of the attributes must be owned");
  return known;
}

void OwnershipBook::require_resignable(ResignAction action) const {
  const bool cancels = action == ResignAction::cancel_pending_ownership_acquisitions ||
                       action == ResignAction::cancel_then_delete_then_divest;
  const bool deletes = action == ResignAction::delete_objects;
  const bool divests = action == ResignAction::unconditionally_divest_attributes ||
                       action == ResignAction::delete_objects_then_divest ||
                       action == ResignAction::cancel_then_delete_then_divest;
  objects_.for_each([&](ObjectHandle object, const KnownObject& known) {
    const AttributeSet owned = owned_of(object, known);
    require(cancels || pending_of(object).is_empty(), HlaError::ownership_acquisition_pending,
            object, "the action must cancel acquisitions");
    require(divests || owned.is_empty() || (deletes && owned.contains(privilege_to_delete_object)),
            HlaError::federate_owns_attributes, object,
            "the action must divest or delete what is owned");
  });
}

Holding& OwnershipBook::open(ObjectHandle object) {
  const KnownObject* known = objects_.find(object);
  assert(known != nullptr);
  if (Holding* holding = holdings_.find(object)) return *holding;
  Holding& holding = holdings_[object];
  if (known->is_own) holding.owned = all_of(*known);
  return holding;
}

void OwnershipBook::settle(ObjectHandle object) {
  const Holding& holding = *holdings_.find(object);
  const bool is_own = holding.owned == all_of(*objects_.find(object));
  objects_.set_own(object, is_own);
  if (holding.owned.is_empty()) regions_.forget(object);  // the new owner associates its regions
  if ((is_own || holding.owned.is_empty()) && holding.offered.is_empty() &&
      holding.pending().is_empty())
    holdings_.erase(object);
}

void OwnershipBook::withdraw(ObjectClassHandle object_class, AttributeSet attributes, bool is_all) {
  if (attributes.is_empty()) return;
  if (is_all) attributes.insert(privilege_to_delete_object);
  std::vector<ObjectHandle> owned;
  objects_.for_each([&](ObjectHandle object, const KnownObject& known) {
    if (known.object_class != object_class.value) return;
    require((pending_of(object) & attributes).is_empty(), HlaError::ownership_acquisition_pending,
            object, "cancel the acquisition before its class is unpublished");
    if (!(owned_of(object, known) & attributes).is_empty()) owned.push_back(object);
  });
  for (const ObjectHandle object : owned)
    change(object, [&](Holding& holding) { holding.lose(attributes); });
}

}  // namespace rink::rti
