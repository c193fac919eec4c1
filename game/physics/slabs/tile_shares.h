// Which worker plays which tile of a pass.
#pragma once

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cstdint>
#include <memory>
#include <optional>

namespace rink::physics {

/// Each worker has a share of its own, the same part of the field in every pass and window, so that
/// bodies stay in its core's cache: to fetch what the other core has written takes several times as
/// long. Whoever has finished takes from the shares of others.
class TileShares {
 public:
  explicit TileShares(std::uint32_t workers)
      : workers_(workers), shares_(std::make_unique<Share[]>(workers)) {
    assert(workers > 0);
  }

  /// Nobody has played any of `tiles`.
  void begin(std::uint32_t tiles) {
    for (std::uint32_t worker = 0; worker < workers_; ++worker) {
      shares_[worker].next.store(first_of(worker, tiles), std::memory_order_relaxed);
      shares_[worker].end = first_of(worker + 1, tiles);
    }
  }
  /// The number of a tile that is `worker`'s to play; nothing if all are played or being played.
  std::optional<std::uint32_t> next(std::uint32_t worker) {
    assert(worker < workers_);
    for (std::uint32_t k = 0; k < workers_; ++k) {
      Share& share = shares_[(worker + k) % workers_];
      if (share.next.load(std::memory_order_relaxed) >= share.end) continue;
      const std::uint32_t tile = share.next.fetch_add(1, std::memory_order_relaxed);
      if (tile < share.end) return tile;
    }
    return std::nullopt;
  }

 private:
  struct alignas(64) Share {
    std::atomic<std::uint32_t> next = 0;
    std::uint32_t end = 0;
  };

  std::uint32_t first_of(std::uint32_t worker, std::uint32_t tiles) const {
    return static_cast<std::uint32_t>(std::uint64_t{worker} * tiles / workers_);
  }

  std::uint32_t workers_;
  std::unique_ptr<Share[]> shares_;
};

}  // namespace rink::physics
