// The inside of the TCP transport: its peers, their queues and the reactor; for its own sources only.
#pragma once

#include <asio.hpp>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "rti/transport/tcp.h"

namespace rink::rti {

/// What an error of the operating system says of the peer.
CloseReason close_reason_of(const asio::error_code& error);

class TcpTransport::Core {
 public:
  explicit Core(const TcpSettings& settings) : settings_(settings), timer_(context_), read_buffer_(settings.read_buffer) {}

  std::uint16_t listen(const std::string& address, std::uint16_t port);
  ConnectionId connect(const std::string& address, std::uint16_t port);
  void poll(std::chrono::nanoseconds longest_wait, TransportListener& listener);
  void send(ConnectionId connection, std::span<const Bytes> parts);
  void close(ConnectionId connection);
  TransportCounters counters(ConnectionId connection) const;
  TransportCounters totals() const;

 private:
  struct Peer {
    Peer(asio::io_context& context, ConnectionId id) : socket(context), id(id) {}
    asio::ip::tcp::socket socket;
    ConnectionId id;
    std::string place;                  ///< whom we connect to
    bool is_open = false;               ///< connected; may be sent to
    bool is_leaving = false;            ///< its end is in `closed_`, waiting to be reported
    bool is_writing = false;            ///< waits for room in the kernel's buffer
    std::vector<std::byte> queue;       ///< from `queue_from` on: accepted, not yet taken
    std::size_t queue_from = 0;
    TransportCounters counters;
  };
  struct Closed {
    ConnectionId connection;
    CloseReason reason;
    std::string detail;
  };
  asio::ip::tcp::endpoint resolve(const std::string& address, std::uint16_t port);
  Peer* find(ConnectionId connection) const { return connection < peers_.size() ? peers_[connection].get() : nullptr; }
  Peer& add();
  void accept(asio::ip::tcp::acceptor& acceptor);
  void accept_later(asio::ip::tcp::acceptor& acceptor);
  void opened(Peer& peer);
  void await_bytes(Peer& peer);
  void read(Peer& peer);
  void await_room(Peer& peer);
  void drain(Peer& peer);
  std::size_t write(Peer& peer, std::span<const Bytes> parts, bool& is_broken);
  void end(Peer& peer, CloseReason reason, const std::string& detail);
  void report_closed();
  void wait(std::chrono::nanoseconds longest_wait);
  void take_what_came();

  TcpSettings settings_;
  asio::io_context context_{1};
  /// Without work left, say after the last connection closed, Asio would stop and refuse to wait.
  asio::executor_work_guard<asio::io_context::executor_type> work_{context_.get_executor()};
  asio::steady_timer timer_;
  bool is_timer_due_ = false;
  std::vector<std::unique_ptr<asio::ip::tcp::acceptor>> acceptors_;
  std::vector<std::unique_ptr<Peer>> peers_;      ///< by connection; null once closed
  std::vector<TransportCounters> last_counters_;  ///< of closed ones, by connection
  std::vector<Closed> closed_, reporting_;
  std::vector<std::byte> read_buffer_;
  TransportListener* listener_ = nullptr;         ///< while polling
  std::uint64_t reported_ = 0, before_ = 0;       ///< events told to listeners so far, and when this poll began
  std::uint64_t bytes_taken_ = 0;                 ///< received by all connections
};

}  // namespace rink::rti
