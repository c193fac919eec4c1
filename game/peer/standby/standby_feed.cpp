// Cuts snapshots into pieces.
#include "game/peer/standby/standby_feed.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace rink::peer {

void StandbyFeed::begin(std::uint64_t step, std::vector<std::uint8_t> bytes) {
  assert(!bytes.empty());
  step_ = step, offset_ = 0, work_ = 0;
  rest_ = std::move(bytes);
}

SnapshotPiece StandbyFeed::next_piece() {
  const std::size_t size = std::min<std::size_t>(limits_.piece_bytes, rest_.size() - offset_);
  const auto first = rest_.begin() + static_cast<std::ptrdiff_t>(offset_);
  SnapshotPiece piece{.step = step_,
                      .total = rest_.size(),
                      .offset = offset_,
                      .bytes = {first, first + static_cast<std::ptrdiff_t>(size)}};
  offset_ += size;
  if (offset_ == rest_.size()) rest_ = {};
  return piece;
}

std::vector<SnapshotPiece> StandbyFeed::take(bool all) {
  std::vector<SnapshotPiece> pieces;
  while (!rest_.empty() && (all || pieces.empty())) pieces.push_back(next_piece());
  return pieces;
}

}  // namespace rink::peer
