// Finds the objects that federates name, and forgives names of objects that were just deleted.
#pragma once

#include <cassert>
#include <cstdint>

#include "rti/distribution/data_distribution.h"
#include "rti/federation/status.h"
#include "rti/federation_counters.h"
#include "rti/objects/object_table.h"
#include "rti/ownership/ownership.h"

namespace rink::rti {

class KnownObjects {
 public:
  KnownObjects(const ObjectTable& objects, const Ownership& ownership,
               const DataDistribution& distribution, FederationCounters& counters)
      : objects_(objects),
        ownership_(ownership),
        distribution_(distribution),
        counters_(counters) {}

  /// True, and counted, if an object of that handle existed: it was deleted while the message was
  /// on its way, which breaks no rule.
  bool is_late(ObjectHandle handle) {
    const bool was_here = objects_.was_registered(handle);
    counters_.late_requests += was_here ? 1u : 0u;
    return was_here;
  }
  bool is_known_to(std::uint32_t slot, ObjectSlot object) const {
    assert(object < objects_.slot_count());
    return objects_[object].owner == slot || distribution_.of(slot).known.contains(object) ||
           !ownership_.owned_by(slot, object).is_empty();
  }
  /// The object of the handle, or `no_object` if it was deleted meanwhile.
  Status find(ObjectHandle handle, ObjectSlot& object) {
    object = objects_.find(handle);
    return object != no_object || is_late(handle) ? Status() : Violation::unknown_name;
  }
  /// The object of the handle, which the federate must know.
  Status find_known(std::uint32_t slot, ObjectHandle handle, ObjectSlot& object) {
    const Status status = find(handle, object);
    if (status || object == no_object) return status;
    return is_known_to(slot, object) ? Status() : Violation::unknown_name;
  }

 private:
  const ObjectTable& objects_;
  const Ownership& ownership_;
  const DataDistribution& distribution_;
  FederationCounters& counters_;
};

}  // namespace rink::rti
