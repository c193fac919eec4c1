// Spreads the writes of a tick over a part of it, and measures how dense they were.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "rti/transport/staged/staged_transport.h"

namespace rink::rti {

/// Sends each connection's bytes at a phase of its own: writes of one instant leave in `slot_count`
/// groups over `window_s`, in order within each connection. A burst of a tick's writes fills the
/// queues of switches and receivers and keeps the sender from reading; the price is a copy of each
/// write, and up to the window of latency, always the same for a connection. Datagrams are not
/// delayed.
class Stagger final : public TransportStage {
 public:
  static constexpr std::size_t slot_count = 16;
  static constexpr double burst_s = 1e-3;

  /// With a window of 0 everything is sent at once, and only measured.
  Stagger(double window_s, Clock now_s) : window_s_(window_s), now_s_(std::move(now_s)) {}

  void poll(std::chrono::nanoseconds longest_wait, TransportListener& listener) override;
  void send(ConnectionId connection, std::span<const Bytes> parts) override;
  void close(ConnectionId connection) override;
  std::size_t queued_bytes(ConnectionId connection) const override {
    return TransportStage::queued_bytes(connection) +
           (connection < waiting_.size() ? waiting_[connection].size() : 0);
  }
  /// Counts the writes of the user; fewer leave where a waiting write takes up later ones.
  TransportCounters counters(ConnectionId connection) const override;
  void push() override;

  /// Starts to measure anew.
  void forget_bursts() { burst_bytes_ = burst_bytes_max_ = 0; }
  /// The most bytes that were passed down within a millisecond; milliseconds follow each other from
  /// the first write after a pause.
  std::size_t burst_bytes_max() const { return burst_bytes_max_; }
  /// Asserts that each connection waits in its own slot, and that slots are counted.
  void check() const;

 private:
  double due_s(std::size_t slot) const {
    return begun_s_ + window_s_ * static_cast<double>(slot) / slot_count;
  }
  void release(double now);
  void measure(std::size_t size, double now);
  void give_waiting(ConnectionId connection, double now);

  double window_s_;
  Clock now_s_;
  std::vector<std::vector<std::byte>> waiting_;  ///< by connection
  std::vector<std::uint64_t> joined_writes_;  ///< by connection: writes that went with one before
  std::array<std::vector<ConnectionId>, slot_count> slots_;  ///< connections that wait for it
  std::size_t slots_taken_ = 0;                              ///< slots with connections in them
  double begun_s_ = 0.0;  ///< when the first of the waiting writes was given
  double burst_begun_s_ = -1.0;
  std::size_t burst_bytes_ = 0, burst_bytes_max_ = 0;
};

}  // namespace rink::rti
