// What a peer's standby is sent beside the records: snapshots, as often as a replay has become
// long.
#pragma once

#include <cassert>
#include <cstdint>
#include <vector>

#include "game/peer/standby/part_record.h"

namespace rink::peer {

/// When a snapshot is due, and how large its pieces are.
struct StandbyLimits {
  std::uint64_t replay_work = 200'000;  ///< PartRecord::work: half a second, as a rule
  std::size_t piece_bytes = 1 << 18;    ///< at most SnapshotPiece::bytes_max
};

/// Counts work instead of looking at a clock.
class StandbyFeed {
 public:
  static constexpr std::uint64_t work_of_step = 8;

  explicit StandbyFeed(const StandbyLimits& limits) : limits_(limits) {
    assert(limits.piece_bytes > 0 && limits.piece_bytes <= SnapshotPiece::bytes_max);
  }
  void note(const PartRecord& record) { work_ += work_of_step + record.work; }
  /// True if so much would be played again that the next snapshot is due, and none is on its way.
  bool is_due() const { return work_ >= limits_.replay_work && rest_.empty(); }
  /// A snapshot of this step is on its way, and none else any more.
  void begin(std::uint64_t step, std::vector<std::uint8_t> bytes);
  /// The pieces to send with this step: the next one, or all.
  std::vector<SnapshotPiece> take(bool all);

 private:
  SnapshotPiece next_piece();

  StandbyLimits limits_;
  std::uint64_t work_ = 0, step_ = 0, offset_ = 0;
  std::vector<std::uint8_t> rest_;  ///< the snapshot of which pieces are still to be sent
};

}  // namespace rink::peer
