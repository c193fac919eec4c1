// Ownership management at the RTI: checks federates' requests, lets the state machine decide, and
// notifies all concerned.
#pragma once

#include <cstdint>
#include <vector>

#include "rti/distribution/data_distribution.h"
#include "rti/federation/federation_basis.h"
#include "rti/federation/services/known_objects.h"
#include "rti/federation/services/newest_stamps.h"
#include "rti/federation/services/object_service.h"
#include "rti/federation/services/publications.h"
#include "rti/federation/status.h"
#include "rti/ownership/ownership.h"
#include "rti/wire/ownership_messages.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

class OwnershipService {
 public:
  struct Uses {
    Ownership& ownership;
    DataDistribution& distribution;
    const Publications& publications;
    KnownObjects& known;
    NewestStamps& newest;
    ObjectService& objects;
  };
  OwnershipService(const FederationBasis& basis, const Uses& uses) : basis_(basis), uses_(uses) {}

  Status handle_requests(std::uint32_t slot, Reader& reader);
  Status handle_query(std::uint32_t slot, Reader& reader);
  Status handle_resign_directive(std::uint32_t slot, Reader& reader);

  /// A federate that publishes less gives up what it owns of that (5.3); one that publishes more
  /// may be offered attributes without an owner.
  void published_changed(std::uint32_t slot, std::uint16_t object_class, AttributeSet before);
  /// Offers the discovered object's unowned attributes to the federate.
  void discovered(std::uint32_t slot, ObjectSlot object);
  /// The newest state precedes all else that the next flush sends to the federate.
  void send_state(std::uint32_t slot, ObjectSlot object, const Stamp& newest);
  /// Calls `visit(object)` for each object of which the federate owns an attribute.
  template <class Visit>
  void for_each_owned(std::uint32_t slot, Visit visit) const {
    if (!has_moved_) return uses_.objects.for_each_registered(slot, visit);
    for (ObjectSlot object = 0; object < basis_.objects.slot_count(); ++object)
      if (basis_.objects[object].is_alive && !uses_.ownership.owned_by(slot, object).is_empty())
        visit(object);
  }
  void joined(std::uint32_t slot);
  /// Divests or deletes what the federate owns, as it chose.
  void left(std::uint32_t slot);
  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, has_moved_, resign_actions_);
  }

 private:
  Status take(std::uint32_t slot, const OwnershipRequestMessage& message, ObjectHandle handle);
  AttributeSet acquirable(std::uint32_t slot, ObjectSlot object) const;
  void serve(std::uint32_t slot, ObjectSlot object, OwnershipRequest request,
             AttributeSet attributes, Bytes tag);
  Ownership::Events decide(std::uint32_t slot, ObjectSlot object, OwnershipRequest request,
                           AttributeSet attributes, Bytes tag);
  void give(std::uint32_t slot, ObjectSlot object, OwnershipRequest request,
            AttributeSet attributes, Bytes tag);
  void moved(ObjectSlot object, const Stamp& newest);
  void notify(std::uint32_t slot, OwnershipNotice notice, ObjectHandle object,
              AttributeSet attributes, Bytes tag);
  /// The context of one request.
  struct RequestContext {
    OwnershipRequest request;
    Bytes tag;
    Stamp newest;  ///< of the object, before anything moved
  };
  void notify_all(std::uint32_t slot, ObjectSlot object, Ownership::Events events,
                  const RequestContext& context);
  void offer_to_all(std::uint32_t from, ObjectSlot object, AttributeSet attributes, Bytes tag);
  void offer_to(std::uint32_t slot, ObjectSlot object, AttributeSet newly_published);

  FederationBasis basis_;
  Uses uses_;
  bool has_moved_ = false;                    ///< else all objects that a federate owns are in its
                                              ///< blocks
  std::vector<ResignAction> resign_actions_;  ///< by slot
};

}  // namespace rink::rti
