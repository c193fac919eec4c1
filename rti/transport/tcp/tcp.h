// TCP between processes and machines, on Asio's reactor.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "rti/transport/readiness.h"
#include "rti/transport/report_queue.h"
#include "rti/transport/transport.h"

namespace rink::rti {

struct TcpSettings {
  std::size_t queue_max =
      1u << 20;  ///< bytes queued for a peer that doesn't read, before it is closed [bytes]
  std::size_t read_buffer = 256 * 1024;  ///< shared by all connections [bytes]
  std::size_t bytes_per_poll =
      1u
      << 20;  ///< received from all together before a poll returns, give or take a buffer [bytes]
  /// How long a poll that may wait asks again and again before it sleeps: this saves the wake-up,
  /// which is most of a round trip, but occupies a core.
  std::chrono::nanoseconds spin{0};
};

/// Any number of connections on one thread, without Nagle's delay. `poll` wakes within the kernel's
/// own timer slack.
class TcpTransport final : public Transport {
 public:
  explicit TcpTransport(const TcpSettings& settings = {});
  TcpTransport(const TcpTransport&) = delete;
  TcpTransport& operator=(const TcpTransport&) = delete;

  /// Accepts on `address` ("127.0.0.1", "::1", "0.0.0.0", a host's name) and returns the port;
  /// `port` 0 takes any free one. A port that was in use a moment ago by a process that has ended
  /// is free at once. Throws TransportError: in_use, no_such_address, no_permission or failed.
  std::uint16_t listen(const std::string& address, std::uint16_t port);
  /// Starts to connect; `on_open` or `on_close` (refused, failed) follows in a poll. Throws
  /// TransportError no_such_address or too_many_files.
  ConnectionId connect(const std::string& address, std::uint16_t port);

  void poll(std::chrono::nanoseconds longest_wait, TransportListener& listener) override;
  void send(ConnectionId connection, std::span<const Bytes> parts) override;
  void close(ConnectionId connection) override;
  bool is_behind() const override { return is_behind_; }
  std::size_t queued_bytes(ConnectionId connection) const override;
  TransportCounters counters(ConnectionId connection) const override;
  /// Sum over all connections that ever were; where the kernel's counts are not known, the own ones
  /// stand in for them.
  TransportCounters totals() const;

  /// For a transport on top of this one: a file that can be read when a poll has something to
  /// report, and that of an open connection's socket, -1 for others.
  int wait_file() const { return readiness_.file(); }
  int file(ConnectionId connection) const;
  std::string peer_network(ConnectionId connection) const override;

 private:
  struct Peer {
    explicit Peer(ConnectionId id) : id(id) {}
    File file;
    ConnectionId id;
    std::string place;             ///< the address to connect to
    bool is_open = false;          ///< connected; may be sent to
    bool is_leaving = false;       ///< its end is in `ended_`, waiting to be reported
    bool is_writing = false;       ///< waits for room in the kernel's buffer
    std::vector<std::byte> queue;  ///< from `queue_from` on: accepted, not yet taken
    std::size_t queue_from = 0;
    TransportCounters counters;
  };
  struct Closed {
    ConnectionId connection;
    CloseReason reason;
    std::string detail;
  };
  /// The reason to close that an error of the operating system, a value of errno, stands for.
  static CloseReason reason_of(int error);
  Peer* find(ConnectionId connection) const {
    return connection < peers_.size() ? peers_[connection].get() : nullptr;
  }
  Peer& add(File file);
  void take(const Readiness::Event& event);
  void accept(std::size_t listening);
  void accept_later();
  void accept_again();
  void finish_connecting(Peer& peer);
  void opened(Peer& peer);
  void read(Peer& peer);
  void await_room(Peer& peer);
  void drain(Peer& peer);
  std::size_t write(Peer& peer, std::span<const Bytes> parts, bool& is_broken);
  void end(Peer& peer, CloseReason reason, const std::string& detail);
  void report_closed();
  void receive_pending();
  bool read_only_peer(std::chrono::nanoseconds longest_wait);

  TcpSettings settings_;
  Readiness readiness_;
  std::vector<File> listening_;
  File pause_;  ///< a timer that ends the time in which nobody is accepted
  std::vector<std::unique_ptr<Peer>> peers_;  ///< by connection; null once closed
  std::deque<std::pair<ConnectionId, TransportCounters>>
      last_counters_;  ///< of those that closed last
  TransportCounters closed_{.kernel_bytes_sent = 0,
                            .kernel_bytes_received = 0,
                            .kernel_segments_sent = 0};  ///< sum over all closed ones
  ReportQueue<Closed> ended_;
  std::vector<std::byte> read_buffer_;
  TransportListener* listener_ = nullptr;  ///< while polling
  std::size_t open_count_ = 0;
  ConnectionId newest_open_ = 0;
  std::uint32_t reads_ = 0;        ///< reads of an only peer without asking whether it is ready
  bool is_behind_ = false;         ///< since the last poll
  std::uint64_t bytes_taken_ = 0;  ///< received by all connections
};

/// Makes sure that this process may open `needed` files, raising the soft limit if the hard one
/// allows. Throws TransportError too_many_files that names both limits and what to do.
void ensure_file_limit(std::size_t needed);

}  // namespace rink::rti
