// The inside of the TCP transport: its peers, their queues and what is ready; for its own sources
// only.
#pragma once

#include <asio.hpp>
#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "rti/transport/readiness.h"
#include "rti/transport/tcp/tcp.h"

namespace rink::rti {

/// What an error of the operating system says of the peer.
CloseReason close_reason_of(const asio::error_code& error);

class TcpTransport::Core {
 public:
  explicit Core(const TcpSettings& settings);

  std::uint16_t listen(const std::string& address, std::uint16_t port);
  ConnectionId connect(const std::string& address, std::uint16_t port);
  void poll(std::chrono::nanoseconds longest_wait, TransportListener& listener);
  void send(ConnectionId connection, std::span<const Bytes> parts);
  void close(ConnectionId connection);
  std::size_t queued_bytes(ConnectionId connection) const;
  TransportCounters counters(ConnectionId connection) const;
  TransportCounters totals() const;
  int wait_file() const { return readiness_.file(); }
  int file(ConnectionId connection) const;

 private:
  struct Peer {
    explicit Peer(ConnectionId id) : id(id) {}
    File file;
    ConnectionId id;
    std::string place;             ///< whom we connect to
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
  asio::ip::tcp::endpoint resolve(const std::string& address, std::uint16_t port);
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
  void take_what_came();
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
  std::vector<Closed> ended_, reporting_;
  std::vector<std::byte> read_buffer_;
  TransportListener* listener_ = nullptr;  ///< while polling
  std::size_t open_count_ = 0;
  ConnectionId newest_open_ = 0;
  std::uint32_t reads_ = 0;        ///< of an only peer, without being told that there is something
  std::uint64_t bytes_taken_ = 0;  ///< received by all connections
};

}  // namespace rink::rti
