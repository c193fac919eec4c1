// The context of the functions that flush one federate.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rti/buffering/buffering.h"
#include "rti/distribution/data_distribution.h"
#include "rti/federation/delivery/gathered_frame.h"
#include "rti/federation/joined_federate.h"

namespace rink::rti {

/// A federate's datagram channel while it is used, and the size of a datagram.
struct DatagramPath {
  DatagramChannel* channel = nullptr;
  std::size_t size_max = 0;
};

/// On the stack for one federate's flush; vectors are lent, so that their memory is used again.
struct FlushContext {
  std::uint32_t slot;
  JoinedFederate& federate;
  FederateInterest& interest;
  std::span<const UpdateRun> runs;  ///< all that this flush sends
  GatheredFrame& frame;
  std::vector<ObjectSlot>& full_state_sent;  ///< their states on entry are in the frame
  DatagramPath path{};
  bool has_turns = false;    ///< the federate is not updated at every match
  bool is_all_sent = false;  ///< no full state stays due after this flush
};

}  // namespace rink::rti
