// Shared memory between processes of one machine: a ring in each direction, no system call while
// both ends are busy.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "rti/transport/transport.h"

namespace rink::rti {

struct SharedMemorySettings {
  std::size_t ring_size = 256 * 1024;  ///< of each direction, a power of two from 4 KiB to 1 GiB
                                       ///< [bytes]; untouched pages cost nothing
  std::size_t queue_max =
      1u << 20;  ///< queued for a peer whose ring is full, before it is closed [bytes]
  std::chrono::nanoseconds spin{20'000};  ///< that a poll looks at the rings before it sleeps; none
                                          ///< where there is one processor only
};

/// Connections are made over a Unix-domain socket of an abstract name, by which the server hands
/// each client its memory; the socket then wakes who sleeps, and its end tells that the peer is
/// gone, however it went. Nothing has a name in a file system, so nothing is left behind. Only
/// processes of the same user are let in. A poll looks at every connection's ring: made for tens or
/// hundreds of federates, not for ten thousand.
class SharedMemoryTransport final : public Transport {
 public:
  explicit SharedMemoryTransport(const SharedMemorySettings& settings = {});
  ~SharedMemoryTransport() override;
  SharedMemoryTransport(const SharedMemoryTransport&) = delete;
  SharedMemoryTransport& operator=(const SharedMemoryTransport&) = delete;

  /// At most 90 bytes. Throws TransportError: in_use, too_many_files or failed.
  void listen(const std::string& name);
  /// `on_open` or `on_close` (refused, failed) follows in a poll.
  ConnectionId connect(const std::string& name);

  void poll(std::chrono::nanoseconds longest_wait, TransportListener& listener) override;
  void send(ConnectionId connection, std::span<const Bytes> parts) override;
  void close(ConnectionId connection) override;
  std::size_t queued_bytes(ConnectionId connection) const override;
  TransportCounters counters(ConnectionId connection) const override;
  /// Sum over all connections that ever were.
  TransportCounters totals() const;
  /// How often a poll slept, and woke a sleeper; each is a system call.
  std::uint64_t sleeps() const;
  std::uint64_t wakes() const;

 private:
  class Core;
  std::unique_ptr<Core> core_;
};

}  // namespace rink::rti
