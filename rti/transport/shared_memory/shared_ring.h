// A ring of bytes in memory that two processes share, one writing and one reading, neither trusting
// the other.
#pragma once

#include <algorithm>
#include <atomic>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>

#include "rti/wire/bytes.h"

namespace rink::rti {

/// The part of a ring that both processes write. Positions count all bytes ever written and read;
/// they may hold anything if the other process is hostile.
struct SharedRingState {
  alignas(64) std::atomic<std::uint64_t> written{0};
  alignas(64) std::atomic<std::uint64_t> read{0};
  alignas(64) std::atomic<std::uint32_t> reader_sleeps{
      0};                                      ///< wants to be woken when something is written
  std::atomic<std::uint32_t> writer_waits{0};  ///< wants to be woken when something is read
};
static_assert(std::atomic<std::uint64_t>::is_always_lock_free && sizeof(SharedRingState) == 192,
              "two processes must agree on it");

/// One end of a ring. Own positions are kept here and never read back, so that a hostile peer can
/// do no more than be recognised.
class SharedRing {
 public:
  SharedRing() = default;
  /// `capacity` [bytes], a power of two.
  SharedRing(SharedRingState* state, std::byte* bytes, std::size_t capacity)
      : state_(state), bytes_(bytes), capacity_(capacity) {
    assert(state != nullptr && bytes != nullptr && std::has_single_bit(capacity));
  }

  /// For the writer: bytes that fit now, or nothing if the reader's position is impossible.
  std::optional<std::size_t> room() const {
    const std::uint64_t used = position_ - state_->read.load(std::memory_order_acquire);
    return used <= capacity_ ? std::optional(capacity_ - static_cast<std::size_t>(used))
                             : std::nullopt;
  }
  /// Copies `bytes`, which must fit; the reader sees them after `publish`.
  void put(Bytes bytes) {
    assert(bytes.size() <= capacity_);
    if (bytes.empty()) return;
    const std::size_t at = place(), first = std::min(bytes.size(), capacity_ - at);
    std::memcpy(bytes_ + at, bytes.data(), first);
    std::memcpy(bytes_, bytes.data() + first, bytes.size() - first);
    position_ += bytes.size();
  }
  /// True if the reader must be woken.
  bool publish() {
    state_->written.store(position_, std::memory_order_seq_cst);
    return state_->reader_sleeps.load(std::memory_order_seq_cst) != 0 &&
           state_->reader_sleeps.exchange(0) != 0;
  }

  /// For the reader: bytes that wait, or nothing if the writer's position is impossible.
  std::optional<std::size_t> waiting() const {
    const std::uint64_t waiting = state_->written.load(std::memory_order_seq_cst) - position_;
    return waiting <= capacity_ ? std::optional(static_cast<std::size_t>(waiting)) : std::nullopt;
  }
  /// Copies `size` of the waiting bytes, since bytes in the ring may change while they are read.
  /// True if the writer must be woken.
  bool take(std::byte* to, std::size_t size) {
    assert(size <= capacity_);
    const std::size_t at = place(), first = std::min(size, capacity_ - at);
    std::memcpy(to, bytes_ + at, first);
    std::memcpy(to + first, bytes_, size - first);
    position_ += size;
    state_->read.store(position_, std::memory_order_seq_cst);
    return state_->writer_waits.load(std::memory_order_seq_cst) != 0 &&
           state_->writer_waits.exchange(0) != 0;
  }

  void set_sleeping(bool sleeps) {
    state_->reader_sleeps.store(sleeps ? 1 : 0, std::memory_order_seq_cst);
  }
  void set_waiting() { state_->writer_waits.store(1, std::memory_order_seq_cst); }
  std::size_t capacity() const { return capacity_; }

 private:
  std::size_t place() const { return static_cast<std::size_t>(position_) & (capacity_ - 1); }
  SharedRingState* state_ = nullptr;
  std::byte* bytes_ = nullptr;
  std::size_t capacity_ = 0;
  std::uint64_t position_ = 0;  ///< of this end
};

}  // namespace rink::rti
