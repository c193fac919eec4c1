// TCP between processes and machines, on Asio's reactor.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "rti/transport/transport.h"

namespace rink::rti {

struct TcpSettings {
  std::size_t queue_max =
      1u << 20;  ///< bytes queued for a peer that doesn't read, before it is closed [bytes]
  std::size_t read_buffer = 256 * 1024;  ///< shared by all connections [bytes]
  std::size_t bytes_per_poll =
      1u
      << 20;  ///< received from all together before a poll returns, give or take a buffer [bytes]
  /// How long a poll that may wait asks again and again before it sleeps: no wake-up, which is most
  /// of a round trip, but a core that nobody else gets meanwhile.
  std::chrono::nanoseconds spin{0};
};

/// Any number of connections on one thread, without Nagle's delay. `poll` wakes within the kernel's
/// own timer slack.
class TcpTransport final : public Transport {
 public:
  explicit TcpTransport(const TcpSettings& settings = {});
  ~TcpTransport() override;
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
  std::size_t queued_bytes(ConnectionId connection) const override;
  TransportCounters counters(ConnectionId connection) const override;
  /// Sum over all connections that ever were; where the kernel was not asked or could not tell, our
  /// own count stands in for its.
  TransportCounters totals() const;

  /// For a transport on top of this one: a file that can be read when a poll has something to tell,
  /// and that of an open connection's socket, -1 for others.
  int wait_file() const;
  int file(ConnectionId connection) const;

 private:
  class Core;
  std::unique_ptr<Core> core_;
};

/// Makes sure that this process may open `needed` files, raising the soft limit if the hard one
/// allows. Throws TransportError too_many_files that names both limits and what to do.
void ensure_file_limit(std::size_t needed);

}  // namespace rink::rti
