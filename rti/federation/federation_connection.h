// A federation execution's record of one connection, and of one that it is about to drop.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "rti/pre_join_limits.h"
#include "rti/wire/bytes.h"
#include "rti/wire/frame.h"

namespace rink::rti {

struct FederationConnection {
  enum class Phase : std::uint8_t { unknown, connected, joined };
  Phase phase = Phase::unknown;
  std::uint32_t federate = 0;  ///< slot, once joined
  bool has_spoken = false;     ///< since the last `advance_clock`
  PreJoinLimits limits;
  double since = 0.0, last_received = 0.0;
  double excused_s = 0.0;  ///< of its silence, while not all could be read
  FrameReader reader;
};

struct PendingClose {
  ConnectionId connection;
  std::string why;
  std::vector<std::byte> bytes;  ///< sent before the connection is dropped
};

}  // namespace rink::rti
