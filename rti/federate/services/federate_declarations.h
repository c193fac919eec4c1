// The services of declaration management (IEEE 1516.1-2010, clause 5), and the advisories that a
// federate switches (10.27 to 10.34).
#pragma once

#include <cstddef>

#include "rti/federate/ambassador_basis.h"
#include "rti/federate/services/sparing.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

class FederateDeclarations {
 public:
  struct Uses {
    const ObjectBook& objects;
    RegionBook& regions;
    DeclaredClasses& classes;
    OwnershipBook& ownership;
    Sparing& sparing;
    UpdateSender& sender;
  };
  FederateDeclarations(const AmbassadorBasis& basis, const Uses& uses);

  void publish(ObjectClassHandle object_class, AttributeSet attributes);
  void publish(InteractionClassHandle interaction_class, bool is_published);
  void subscribe(ObjectClassHandle object_class, AttributeSet attributes, RegionHandle region,
                 bool is_active);
  void subscribe(InteractionClassHandle interaction_class, Listening listening);
  /// Setting a switch to the value that it has throws ObjectClassRelevanceAdvisorySwitchIsOn or its
  /// like.
  void switch_advisory(Advisory advisory, bool is_on);
  bool is_on(Advisory advisory) const {
    return (switches_ >> static_cast<unsigned>(advisory) & 1u) != 0;
  }

  /// Notifies the RTI of switches that are on from the start.
  void joined();
  bool handle_class_relevance(Reader& reader);
  bool handle_object_relevance(Reader& reader);
  std::size_t memory_bytes() const { return relevant_objects_.memory_bytes(); }
  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, relevant_objects_, switches_);
  }

 private:
  void advise(ObjectClassHandle object_class);
  void advise(InteractionClassHandle interaction_class);
  void advise_all(Advisory advisory);

  AmbassadorBasis basis_;
  Uses uses_;
  ObjectMap<AttributeSet> relevant_objects_;  ///< own objects: attributes in some federate's scope,
                                              ///< as last notified
  unsigned switches_;  ///< by `Advisory`, first as in the model; relevance of single attributes
                       ///< costs messages
};

}  // namespace rink::rti
