// What a message from the RTI is read under, handed along to whoever handles it.
#pragma once

#include <optional>

#include "rti/types.h"

namespace rink::rti {

/// One for each frame, each datagram, and what is inside of a message that goes in time-stamp
/// order.
struct ReadContext {
  std::optional<Stamp> stamp;         ///< of the updates that follow, once it was sent
  const TimedStamp* timed = nullptr;  ///< of what was sent in time-stamp order
};

}  // namespace rink::rti
