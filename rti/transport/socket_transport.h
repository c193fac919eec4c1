// One interface to the transports between processes, for commands that let their user choose.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "rti/transport/shared_memory/shared_memory.h"
#include "rti/transport/tcp/tcp.h"
#include "rti/transport/udp/udp.h"

namespace rink::rti {

inline constexpr std::array<const char*, 3> socket_transport_names{"tcp", "udp", "shm"};

/// TCP, UDP beside TCP, or shared memory, by name. Shared memory ignores the address: a port is one
/// of this machine's.
class SocketTransport {
 public:
  /// `name` must be one of `socket_transport_names`.
  explicit SocketTransport(std::string_view name);

  Transport& get();
  /// The port; 0 takes any free one. Throws TransportError.
  std::uint16_t listen(const std::string& address, std::uint16_t port);
  ConnectionId connect(const std::string& address, std::uint16_t port);
  /// Sums over all connections that ever were; bytes sent and received, by own count and the
  /// kernel's, include datagrams.
  TransportCounters totals() const;

 private:
  std::variant<TcpTransport, UdpTransport, SharedMemoryTransport> transport_;
};

/// Adds a connection's datagrams to its bytes: what it carried altogether.
TransportCounters with_datagrams(TransportCounters counters);

}  // namespace rink::rti
