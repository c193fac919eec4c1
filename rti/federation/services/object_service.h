// Objects from their registration to their removal (IEEE 1516.1-2010, 6.8 to 6.16).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "rti/distribution/data_distribution.h"
#include "rti/federation/delivery/arrival_orders.h"
#include "rti/federation/federation_basis.h"
#include "rti/federation/services/known_objects.h"
#include "rti/federation/services/newest_stamps.h"
#include "rti/federation/services/object_names.h"
#include "rti/federation/services/publications.h"
#include "rti/federation/services/transportation_types.h"
#include "rti/federation/status.h"
#include "rti/ownership/ownership.h"
#include "rti/wire/object_messages.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

class ObjectService {
 public:
  struct Uses {
    Ownership& ownership;
    DataDistribution& distribution;
    const Publications& publications;
    KnownObjects& known;
    ObjectNames& names;
    NewestStamps& newest;
    ArrivalOrders& arrivals;
    TransportationTypes& types;
  };
  ObjectService(const FederationBasis& basis, const Uses& uses) : basis_(basis), uses_(uses) {}

  Status handle_register(std::uint32_t slot, Reader& reader);
  Status handle_delete(std::uint32_t slot, Reader& reader);
  Status handle_local_delete(std::uint32_t slot, Reader& reader);

  /// All federates that know the object receive the removal, the one that deleted it too: until
  /// then it may receive updates.
  void remove(ObjectSlot object);
  /// Registers an object of the RTI's own, whose slot never joined; returns none if no block of
  /// handles is left.
  ObjectHandle register_own(std::uint32_t slot, ObjectClassHandle object_class);
  /// The number of handles that the federate has used of its present block.
  std::uint32_t registered(std::uint32_t slot) const {
    return slot < federates_.size() ? federates_[slot].count : 0;
  }
  /// Calls `visit(object)` for each living object that the federate has registered.
  template <class Visit>
  void for_each_registered(std::uint32_t slot, Visit visit) const {
    for (const std::uint32_t block : federates_[slot].former_blocks)
      basis_.objects.for_each_in_block(block, visit);
    basis_.objects.for_each_in_block(basis_.federates[slot].block, visit);
  }
  void joined(std::uint32_t slot);
  /// Takes back the federate's blocks of which no handle was seen.
  void left(std::uint32_t slot);
  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, federates_);
  }

 private:
  /// A federate's registrations.
  struct Registered {
    std::uint32_t count = 0;                     ///< in its present block
    std::optional<std::uint32_t> further_block;  ///< given for when this one is used up
    std::vector<std::uint32_t> former_blocks;    ///< used up
    std::size_t name_bytes = 0;                  ///< of all their names
    template <class Stream>
    bool keep(Stream& stream) {
      return keep_all(stream, count, further_block, former_blocks, name_bytes);
    }
  };
  Registered& of(std::uint32_t slot);
  std::size_t alive(std::uint32_t slot) const;
  bool extend_block(std::uint32_t slot);
  void promise_block(std::uint32_t slot);
  void refuse(std::uint32_t slot, ObjectHandle object);

  FederationBasis basis_;
  Uses uses_;
  std::vector<Registered> federates_;  ///< by slot
};

}  // namespace rink::rti
