// A region as it was last committed, and what uses it.
#pragma once

#include <cstdint>
#include <vector>

#include "im/change.h"
#include "im/region.h"
#include "rti/objects/object_table.h"
#include "rti/types.h"

namespace rink::rti {

/// Number of a region among those of all federates; used again after it is deleted.
using RegionSlot = std::uint32_t;
inline constexpr RegionSlot no_region = 0xffffffffu;

/// Over X and Y the filter knows it; other dimensions are compared one by one, for pairs that the
/// filter lets through or, where one of two regions lacks X or Y, for all pairs. The rejected
/// alternative, filters of more dimensions, would slow the common case of the plane for one in
/// which the plane leaves few pairs.
struct DistributedRegion {
  bool exists = false, is_committed = false;
  bool is_placed = false;   ///< over both X and Y: the filter decides
  bool is_planar = false;   ///< over nothing else: the filter alone decides
  bool is_changed = false;  ///< since the last match, in a way that the filter does not see
  std::uint32_t federate = 0;
  im::Entity entity = 0;  ///< the filter's number, if placed and used for updates
  DimensionSet dimensions;
  im::Region plane;
  std::vector<Range> ranges;        ///< by rank of the dimension; empty if planar
  std::vector<ObjectSlot> objects;  ///< that use it for updates, each once for every association
  std::uint32_t subscription_count = 0;  ///< to object classes
};

}  // namespace rink::rti
