// A federate's record of each object that it registered or discovered.
#pragma once

#include <cstdint>

#include "rti/federate_ambassador.h"
#include "rti/handles.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

struct KnownObject {
  static constexpr std::uint16_t unknown = 0xffff;
  std::uint16_t object_class = unknown;
  bool is_own = false;  ///< owns every attribute of it; an object owned in part has a holding
  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, object_class, is_own);
  }
};

/// An object of another federate that was deleted or forgotten here.
struct GoneObject {
  ObjectHandle object;
  bool is_settled = false;  ///< the RTI knows it, too
  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, object, is_settled);
  }
};

/// A deletion in time-stamp order, which may be retracted.
struct TimedDeletion {
  std::uint64_t number = 0;
  std::uint32_t object = 0;
  KnownObject known;
  double time = 0.0;
  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, number, object, known, time);
  }
};

}  // namespace rink::rti
