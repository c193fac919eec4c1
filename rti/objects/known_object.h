// What a federate keeps of each object that it registered or discovered.
#pragma once

#include <cstdint>

#include "rti/federate_ambassador.h"
#include "rti/handles.h"

namespace rink::rti {

struct KnownObject {
  static constexpr std::uint16_t unknown = 0xffff;
  std::uint16_t object_class = unknown;
  bool is_own = false;  ///< every attribute of it; who owns some has a holding
};

/// One of others that was deleted or forgotten here.
struct GoneObject {
  ObjectHandle object;
  bool is_settled = false;  ///< the RTI has heard so, too
};

/// A deletion in time-stamp order, which may be taken back.
struct TimedDeletion {
  std::uint64_t number = 0;
  std::uint32_t object = 0;
  KnownObject known;
  double time = 0.0;
};

}  // namespace rink::rti
