// The context in which a message from the RTI is read, passed to its handler.
#pragma once

#include <optional>

#include "rti/types.h"

namespace rink::rti {

/// There is one for each frame, each datagram, and each message inside one in time-stamp order.
struct ReadContext {
  std::optional<Stamp> stamp;         ///< of the updates that follow, once one was received
  const TimedStamp* timed = nullptr;  ///< of a message in time-stamp order, else null
  bool is_released = false;           ///< the message was put off; scope was changed at once
};

}  // namespace rink::rti
