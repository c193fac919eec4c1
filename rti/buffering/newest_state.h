// The RTI's own buffering: a federate that reads receives every update, one that has stopped for a
// while receives the newest state.
#pragma once

#include <cstdint>
#include <vector>

#include "rti/buffering/buffering.h"

namespace rink::rti {

/// Two marks, so that a federate near one of them doesn't get whole states in turns with single
/// updates.
struct NewestStateSettings {
  std::size_t hold_above = 64 * 1024;  ///< a federate with more than this unread is held back
                                       ///< [bytes]; below the transport's own limit, which closes
  std::size_t resume_below =
      8 * 1024;  ///< and until no more than this waits [bytes]; at most `hold_above`
};

/// A queue to a destination is thus at most `hold_above`, one flush and what is never held back,
/// however long the destination does not read.
class NewestState final : public Buffering {
 public:
  explicit NewestState(const NewestStateSettings& settings = {});

  void append(const ObjectUpdate& update) override { runs_.append(update); }
  std::span<const UpdateRun> seal() override;
  void clear() override { runs_.clear(); }
  bool holds_back(std::uint32_t federate, std::size_t waiting_bytes) override;
  void remove_federate(std::uint32_t federate) override;

 private:
  NewestStateSettings settings_;
  UpdateRuns runs_;
  std::vector<bool> is_held_;  ///< by federate
};

}  // namespace rink::rti
