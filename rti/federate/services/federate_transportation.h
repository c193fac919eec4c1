// The services by which a federate changes and queries transportation types (IEEE 1516.1-2010, 6.23
// to 6.30).
#pragma once

#include "rti/federate/ambassador_basis.h"
#include "rti/federate/delivery/update_sender.h"
#include "rti/wire/stream.h"

namespace rink::rti {

class FederateTransportation {
 public:
  struct Uses {
    const ObjectBook& objects;
    const OwnershipBook& ownership;
    const DeclaredClasses& classes;
    UpdateSender& sender;
  };
  FederateTransportation(const AmbassadorBasis& basis, const Uses& uses)
      : basis_(basis), uses_(uses) {}

  void change(ObjectHandle object, AttributeSet attributes, Transportation transportation);
  void query(ObjectHandle object, AttributeHandle attribute);
  void change(InteractionClassHandle interaction_class, Transportation transportation);
  void query(FederateHandle federate, InteractionClassHandle interaction_class);
  bool handle_answer(Reader& reader);

 private:
  AmbassadorBasis basis_;
  Uses uses_;
};

}  // namespace rink::rti
