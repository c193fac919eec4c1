// Shared memory between processes of one machine: a ring in each direction, no system call while
// both ends are busy.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "rti/transport/modelled/delayed_acknowledgements.h"
#include "rti/transport/readiness.h"
#include "rti/transport/shared_memory/shared_ring.h"
#include "rti/transport/transport.h"

namespace rink::rti {

struct SharedMemorySettings {
  std::size_t ring_size = 256 * 1024;  ///< of each direction, a power of two from 4 KiB to 1 GiB
                                       ///< [bytes]; untouched pages cost nothing
  std::size_t queue_max =
      1u << 20;  ///< queued for a peer whose ring is full, before it is closed [bytes]
  std::chrono::nanoseconds spin{20'000};  ///< for which a poll looks at the rings before it sleeps;
                                          ///< 0 on one processor
};

/// A mapping that ends with its owner.
class Mapping {
 public:
  Mapping() = default;
  /// Maps `size` bytes of `file` for reading and writing; empty if the system refuses.
  Mapping(int file, std::size_t size);
  ~Mapping();
  Mapping(Mapping&& other) noexcept { swap(other); }
  Mapping& operator=(Mapping&& other) noexcept {
    swap(other);
    return *this;
  }
  std::byte* data() const { return data_; }

 private:
  void swap(Mapping& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
  }
  std::byte* data_ = nullptr;
  std::size_t size_ = 0;
};

/// Connections are made over a Unix-domain socket of an abstract name, by which the server passes
/// each client its memory; the socket then wakes a sleeping end, and its close shows that the peer
/// is gone, also after a crash. Nothing has a name in a file system, so nothing is left behind.
/// Only processes of the same user may connect. A poll looks at every connection's ring: this suits
/// hundreds of federates, not ten thousand.
class SharedMemoryTransport final : public Transport {
 public:
  explicit SharedMemoryTransport(const SharedMemorySettings& settings = {});
  SharedMemoryTransport(const SharedMemoryTransport&) = delete;
  SharedMemoryTransport& operator=(const SharedMemoryTransport&) = delete;

  /// `name` has at most 90 bytes. Throws TransportError: in_use, too_many_files or failed.
  void listen(const std::string& name);
  /// `on_open` or `on_close` (refused, failed) follows in a poll.
  ConnectionId connect(const std::string& name);

  void poll(std::chrono::nanoseconds longest_wait, TransportListener& listener) override;
  void send(ConnectionId connection, std::span<const Bytes> parts) override;
  void close(ConnectionId connection) override;
  std::size_t queued_bytes(ConnectionId connection) const override {
    return counters(connection).queued_bytes;
  }
  TransportCounters counters(ConnectionId connection) const override;
  /// Sum over all connections that ever were.
  TransportCounters totals() const;
  /// How often this end slept, and woke a sleeping peer; each is a system call.
  std::uint64_t sleeps() const { return sleeps_; }
  std::uint64_t wakes() const { return wakes_; }

 private:
  struct Peer {
    File socket;
    bool is_open = false;  ///< has its memory; a client's waits for it
    Mapping memory;
    SharedRing in, out;
    std::vector<std::byte> queue;  ///< from `queue_from` on: what the ring had no room for
    std::size_t queue_from = 0;
    std::string place;
  };
  struct News {
    ConnectionId connection;
    std::optional<CloseReason> closed;  ///< nothing: it has opened
    std::string detail;
  };
  static std::int64_t now_ns();
  Peer* find(ConnectionId connection) const {
    return connection < peers_.size() ? peers_[connection].get() : nullptr;
  }
  ConnectionId add(File socket);
  void accept(std::size_t listening);
  bool turn_away(std::size_t listening);
  bool offer_memory(ConnectionId connection);
  void adopt_memory(ConnectionId connection);
  void opened(ConnectionId connection, Mapping memory, std::size_t ring_size, bool is_server);
  void report();
  void look_at_rings();
  void read(ConnectionId connection);
  void drain(ConnectionId connection);
  std::size_t put(ConnectionId connection, Bytes bytes);
  void wake(const Peer& peer);
  void handle_events();
  void handle_socket(ConnectionId connection);
  void spin_and_sleep(std::chrono::nanoseconds longest_wait);
  bool has_something() const;
  void end(ConnectionId connection, CloseReason reason, const std::string& detail);

  SharedMemorySettings settings_;
  Readiness readiness_;
  std::vector<File> listening_;
  File spare_;                                ///< a server's, for use when there are no more files
  std::vector<std::unique_ptr<Peer>> peers_;  ///< by connection; null once closed
  std::vector<ConnectionId> open_;            ///< those with rings
  std::vector<TransportCounters> counters_;   ///< by connection
  std::vector<DelayedAcknowledgements> acknowledgements_;  ///< by connection
  std::vector<News> news_;
  std::vector<std::byte> buffer_;
  TransportListener* listener_ = nullptr;  ///< while polling
  std::uint64_t callbacks_ = 0;            ///< to listeners so far
  std::uint32_t polls_ = 0;
  std::uint64_t sleeps_ = 0, wakes_ = 0;
};

}  // namespace rink::rti
