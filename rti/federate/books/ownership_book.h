// A federate's own part of each object's ownership.
#pragma once

#include <cassert>
#include <cstddef>

#include "rti/distribution/region_book.h"
#include "rti/federate/ambassador_basis.h"
#include "rti/federate/books/object_book.h"
#include "rti/ownership/holding.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

/// An object that is owned whole or not at all, with no negotiation under way, has its entry alone;
/// only one that is owned in part or negotiated about has a holding.
class OwnershipBook {
 public:
  OwnershipBook(const AmbassadorBasis& basis, ObjectBook& objects, RegionBook& regions)
      : basis_(basis),
        objects_(objects),
        regions_(regions),
        is_deleting_(deletes(basis.fom.switches().automatic_resign_action)) {}

  AttributeSet all_of(const KnownObject& known) const {
    return basis_.fom.attributes(ObjectClassHandle{known.object_class}) |
           AttributeSet{privilege_to_delete_object};
  }
  AttributeSet owned_of(ObjectHandle object, const KnownObject& known) const;
  /// Empty if the object is not known.
  AttributeSet owned_of(ObjectHandle object) const;
  AttributeSet offered_of(ObjectHandle object) const;
  AttributeSet pending_of(ObjectHandle object) const;
  const Holding* find(ObjectHandle object) const { return holdings_.find(object); }
  /// True if objects that are owned whole are deleted when the federate leaves, in whatever way.
  bool is_deleting() const { return is_deleting_; }
  void set_directive(ResignAction action) { is_deleting_ = deletes(action); }

  /// Throw FederateNotExecutionMember, ObjectInstanceNotKnown, AttributeNotDefined; the second
  /// AttributeNotOwned too.
  const KnownObject& require_known(ObjectHandle object, AttributeSet attributes) const;
  const KnownObject& require_owned(ObjectHandle object, AttributeSet attributes) const;
  /// Throws FederateOwnsAttributes, OwnershipAcquisitionPending where the action leaves some.
  void require_resignable(ResignAction action) const;

  /// Calls `change(Holding&)`, and forgets the holding if the object's entry suffices. The object
  /// must be known.
  template <class Change>
  void change(ObjectHandle object, Change change) {
    change(open(object));
    settle(object);
  }
  /// An acquisition begins, which `change` notes.
  template <class Change>
  void acquire(ObjectHandle object, Change change) {
    change(open(object));
    assert(!pending_of(object).is_empty());
  }
  /// Gives up owned attributes of the class with its publication; the RTI does the same. `is_all`:
  /// the privilege to delete as well. Throws OwnershipAcquisitionPending.
  void withdraw(ObjectClassHandle object_class, AttributeSet attributes, bool is_all);
  void forget(ObjectHandle object) { holdings_.erase(object); }

  std::size_t memory_bytes() const { return holdings_.memory_bytes(); }
  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, holdings_, is_deleting_);
  }

 private:
  Holding& open(ObjectHandle object);
  void settle(ObjectHandle object);

  AmbassadorBasis basis_;
  ObjectBook& objects_;
  RegionBook& regions_;
  ObjectMap<Holding> holdings_;
  bool is_deleting_;
};

}  // namespace rink::rti
