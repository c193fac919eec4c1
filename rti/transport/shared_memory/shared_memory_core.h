// The inside of the shared-memory transport; for its own sources only.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "rti/transport/modelled/delayed_acknowledgements.h"
#include "rti/transport/readiness.h"
#include "rti/transport/shared_memory/shared_memory.h"
#include "rti/transport/shared_memory/shared_ring.h"

namespace rink::rti {

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

class SharedMemoryTransport::Core {
 public:
  explicit Core(const SharedMemorySettings& settings);

  void listen(const std::string& name);
  ConnectionId connect(const std::string& name);
  void poll(std::chrono::nanoseconds longest_wait, TransportListener& listener);
  void send(ConnectionId connection, std::span<const Bytes> parts);
  void close(ConnectionId connection);
  TransportCounters counters(ConnectionId connection) const;
  TransportCounters totals() const;

  std::uint64_t sleeps = 0, wakes = 0;

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
  void take_memory(ConnectionId connection);
  void opened(ConnectionId connection, Mapping memory, std::size_t ring_size, bool is_server);
  void report();
  void look_at_rings();
  void read(ConnectionId connection);
  void drain(ConnectionId connection);
  std::size_t put(ConnectionId connection, Bytes bytes);
  void wake(const Peer& peer);
  void take_events();
  void take_socket(ConnectionId connection);
  void spin_and_sleep(std::chrono::nanoseconds longest_wait);
  bool has_something() const;
  void end(ConnectionId connection, CloseReason reason, const std::string& detail);

  SharedMemorySettings settings_;
  Readiness readiness_;
  std::vector<File> listening_;
  File spare_;                                ///< a server's, for when there are no more files
  std::vector<std::unique_ptr<Peer>> peers_;  ///< by connection; null once closed
  std::vector<ConnectionId> open_;            ///< those with rings
  std::vector<TransportCounters> counters_;   ///< by connection
  std::vector<DelayedAcknowledgements> acknowledgements_;  ///< likewise
  std::vector<News> news_;
  std::vector<std::byte> buffer_;
  TransportListener* listener_ = nullptr;  ///< while polling
  std::uint64_t told_ = 0;                 ///< to listeners so far
  std::uint32_t polls_ = 0;
};

}  // namespace rink::rti
