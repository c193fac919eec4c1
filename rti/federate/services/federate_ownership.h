// The services of ownership management (IEEE 1516.1-2010, clause 7), checked before anything is
// sent.
#pragma once

#include "rti/federate/ambassador_basis.h"
#include "rti/federate/books/ownership_book.h"
#include "rti/federate/services/sparing.h"
#include "rti/wire/ownership_messages.h"

namespace rink::rti {

class FederateOwnership {
 public:
  struct Uses {
    const ObjectBook& objects;
    const DeclaredClasses& classes;
    OwnershipBook& book;
    Sparing& sparing;
    UpdateSender& sender;
  };
  FederateOwnership(const AmbassadorBasis& basis, const Uses& uses) : basis_(basis), uses_(uses) {}

  void divest(ObjectHandle object, AttributeSet attributes);
  void offer(ObjectHandle object, AttributeSet attributes, Bytes tag);
  void confirm(ObjectHandle object, AttributeSet attributes, Bytes tag);
  void withdraw_offer(ObjectHandle object, AttributeSet attributes);
  void deny_release(ObjectHandle object, AttributeSet attributes);
  void divest_if_wanted(ObjectHandle object, AttributeSet attributes);
  void acquire(ObjectHandle object, AttributeSet attributes, Bytes tag);
  void acquire_if_available(ObjectHandle object, AttributeSet attributes);
  void cancel_acquisition(ObjectHandle object, AttributeSet attributes);
  void query(ObjectHandle object, AttributeHandle attribute);
  bool is_owned(ObjectHandle object, AttributeHandle attribute) const;
  /// Sets what happens to owned attributes when the federate leaves. Values that would outlive it
  /// are sent now.
  void set_directive(ResignAction action);
  /// Throws if the action leaves attributes or acquisitions that may not be left.
  void prepare_to_resign(ResignAction action);

  bool handle_notices(Reader& reader);
  bool handle_owner(Reader& reader);

 private:
  AttributeSet require_acquirable(ObjectHandle object, AttributeSet attributes) const;
  void ask(OwnershipRequest request, ObjectHandle object, AttributeSet attributes, Bytes tag);
  void give_up(OwnershipRequest request, ObjectHandle object, AttributeSet attributes, Bytes tag);
  void note(ObjectHandle object, OwnershipNotice notice, AttributeSet attributes, Bytes tag);
  AttributeSet change(ObjectHandle object, OwnershipNotice notice, AttributeSet attributes);
  void call_back(ObjectHandle object, OwnershipNotice notice, AttributeSet attributes, Bytes tag);

  AmbassadorBasis basis_;
  Uses uses_;
};

}  // namespace rink::rti
