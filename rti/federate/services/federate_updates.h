// The services by which a federate sends updates and interactions in receive order: they are
// checked, kept back if nobody subscribes, coded, and sent.
#pragma once

#include <cstddef>
#include <vector>

#include "rti/federate/ambassador_basis.h"
#include "rti/federate/services/sparing.h"

namespace rink::rti {

class FederateUpdates {
 public:
  struct Uses {
    const ObjectBook& objects;
    const OwnershipBook& ownership;
    const DeclaredClasses& classes;
    Sparing& sparing;
    UpdateSender& sender;
  };
  FederateUpdates(const AmbassadorBasis& basis, const Uses& uses) : basis_(basis), uses_(uses) {}

  /// Throws FederateNotExecutionMember, ObjectInstanceNotKnown, AttributeNotDefined,
  /// AttributeNotOwned, InvalidLogicalTime, and RTIinternalError for malformed values.
  void update(ObjectHandle object, AttributeSet attributes, Bytes values, const Stamp& stamp);
  /// Sends to `receiver` alone if it names a federate. Throws InteractionClassNotPublished or its
  /// like.
  void send(InteractionClassHandle interaction_class, FederateHandle receiver, Bytes parameters,
            const Stamp& stamp);
  /// True if such an interaction has subscribers; throws if it may not be sent.
  bool may_send(InteractionClassHandle interaction_class, Bytes parameters, const Stamp& stamp);

  void require_values(ObjectClassHandle object_class, AttributeSet attributes, Bytes values) const;
  static void require_parameters(Bytes parameters);
  std::size_t memory_bytes() const { return coded_.capacity(); }

 private:
  const KnownObject& require_updatable(ObjectHandle object, AttributeSet attributes) const;

  AmbassadorBasis basis_;
  Uses uses_;
  std::vector<std::byte> coded_;  ///< of one update
};

}  // namespace rink::rti
