// A federation execution's record of one connection, and of one that it is about to drop.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "rti/pre_join_limits.h"
#include "rti/wire/bytes.h"
#include "rti/wire/frame.h"
#include "rti/wire/silence.h"

namespace rink::rti {

struct FederationConnection {
  enum class Phase : std::uint8_t { unknown, connected, joined };
  Phase phase = Phase::unknown;
  std::uint32_t federate = 0;  ///< slot, once joined
  PreJoinLimits limits;
  double since = 0.0;  ///< when it was made [s]
  Silence silence;
  FrameReader reader;
};

struct PendingClose {
  ConnectionId connection;
  std::string why;
  std::vector<std::byte> bytes;  ///< sent before the connection is dropped
};

}  // namespace rink::rti
