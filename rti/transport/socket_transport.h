// One interface to the transports between processes, for commands that let their user choose.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "rti/transport/bundle.h"
#include "rti/transport/shared_memory/shared_memory.h"
#include "rti/transport/tcp/tcp.h"
#include "rti/transport/udp/udp.h"

namespace rink::rti {

inline constexpr std::array<const char*, 4> socket_transport_names{"tcp", "udp", "shm", "bundle"};

/// TCP, UDP beside TCP, shared memory, or a `BundledTransport` over TCP, by name. Shared memory
/// ignores the address: a port is one of this machine's.
class SocketTransport {
 public:
  /// `name` must be one of `socket_transport_names`; the connections that a bundle makes share
  /// `bundles` sockets by turns, at least 1.
  explicit SocketTransport(std::string_view name, std::uint32_t bundles = 1);

  Transport& get();
  /// The port; 0 takes any free one. Throws TransportError.
  std::uint16_t listen(const std::string& address, std::uint16_t port);
  ConnectionId connect(const std::string& address, std::uint16_t port);
  /// Sums over all connections that ever were; bytes sent and received, by own count and the
  /// kernel's, include datagrams. Those of a bundle are its sockets', with the records' headers.
  TransportCounters totals() const;

 private:
  struct Bundle {
    TcpTransport carrier{carrier_settings()};
    BundledTransport bundled{carrier};
    std::uint32_t trunks_max = 1, connected = 0;
    std::vector<ConnectionId> trunks{};  ///< of the connections made, by turns
    std::string place{};                 ///< where they lead

    static TcpSettings carrier_settings();
    ConnectionId connect(const std::string& address, std::uint16_t port);
  };

  std::variant<TcpTransport, UdpTransport, SharedMemoryTransport, Bundle> transport_;
};

/// Adds a connection's datagrams to its bytes: what it carried altogether.
TransportCounters with_datagrams(TransportCounters counters);

}  // namespace rink::rti
