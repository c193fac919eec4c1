// What the functions that flush one federate hand along.
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

/// A federate's way for datagrams while it is used, and what fits into one of them.
struct DatagramChannel {
  DatagramWay* way = nullptr;
  std::size_t size_max = 0;
};

/// On the stack for one federate's flush; vectors are lent, so that their memory is used again.
struct FlushContext {
  std::uint32_t slot;
  JoinedFederate& federate;
  FederateInterest& interest;
  std::span<const UpdateRun> runs;  ///< all that this flush tells of
  GatheredFrame& frame;
  std::vector<ObjectSlot>& told_whole;  ///< their states on entry are in the frame
  DatagramChannel channel{};
  bool is_all_told = false;  ///< nothing stays fresh beyond this flush
};

}  // namespace rink::rti
