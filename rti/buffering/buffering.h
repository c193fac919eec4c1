// The seam of buffering: how the updates of a flush are collected, and whether a destination gets
// them now or its newest state later. `NewestState` is the one that comes with the RTI.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "rti/buffering/update_runs.h"

namespace rink::rti {

/// Called by `FederationExecution` alone. Federates are dense slots, objects too.
class Buffering {
 public:
  virtual ~Buffering() = default;

  /// Updates of one object keep their order.
  virtual void append(const ObjectUpdate& update) = 0;
  /// What was appended since `clear`, for all who receive it; valid until `clear`. No `append` may
  /// follow before that.
  virtual std::span<const UpdateRun> seal() = 0;
  virtual void clear() = 0;

  /// True if `federate`, which has not taken `waiting_bytes` of what was sent to it, is sent no
  /// values by this flush. The RTI remembers which objects it would have received, and the first
  /// flush that does not hold back sends their newest state, once. Discoveries, scope changes,
  /// interactions, removals and all about the federation are sent in their order anyway. Asked once
  /// per flush of each federate for which there may be values.
  virtual bool holds_back(std::uint32_t federate, std::size_t waiting_bytes) = 0;
  /// The federate is gone; another may take its slot.
  virtual void remove_federate(std::uint32_t federate) = 0;
};

}  // namespace rink::rti
