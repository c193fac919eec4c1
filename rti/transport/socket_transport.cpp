// Makes the transport that a name stands for.
#include "rti/transport/socket_transport.h"

#include <unistd.h>

#include <cassert>

namespace rink::rti {

namespace {

std::string shared_name(std::uint16_t port) { return "port-" + std::to_string(port); }

std::uint16_t listen_at(SharedMemoryTransport& transport, std::uint16_t port) {
  if (port != 0) {
    transport.listen(shared_name(port));
    return port;
  }
  constexpr int first = 20'000, count = 40'000;
  for (int i = 0; i < count; ++i) {
    port = static_cast<std::uint16_t>(first + (static_cast<int>(::getpid()) + i) % count);
    try {
      transport.listen(shared_name(port));
      return port;
    } catch (const TransportError& error) {
      if (error.kind() != TransportError::Kind::in_use) throw;
    }
  }
  throw TransportError(TransportError::Kind::in_use, "no shared-memory port is free");
}

}  // namespace

SocketTransport::SocketTransport(std::string_view name) {
  assert(name == "tcp" || name == "udp" || name == "shm");
  if (name == "udp") transport_.emplace<UdpTransport>();
  if (name == "shm") transport_.emplace<SharedMemoryTransport>();
}

Transport& SocketTransport::get() {
  return std::visit([](auto& transport) -> Transport& { return transport; }, transport_);
}

std::uint16_t SocketTransport::listen(const std::string& address, std::uint16_t port) {
  if (auto* shared = std::get_if<SharedMemoryTransport>(&transport_))
    return listen_at(*shared, port);
  if (auto* udp = std::get_if<UdpTransport>(&transport_)) return udp->listen(address, port);
  return std::get<TcpTransport>(transport_).listen(address, port);
}

ConnectionId SocketTransport::connect(const std::string& address, std::uint16_t port) {
  if (auto* shared = std::get_if<SharedMemoryTransport>(&transport_))
    return shared->connect(shared_name(port));
  if (auto* udp = std::get_if<UdpTransport>(&transport_)) return udp->connect(address, port);
  return std::get<TcpTransport>(transport_).connect(address, port);
}

TransportCounters SocketTransport::totals() const {
  return with_datagrams(
      std::visit([](const auto& transport) { return transport.totals(); }, transport_));
}

TransportCounters with_datagrams(TransportCounters counters) {
  counters.bytes_sent += counters.datagram_bytes_sent;
  counters.bytes_received += counters.datagram_bytes_received;
  counters.segments_sent += counters.datagrams_sent;
  if (counters.kernel_segments_sent) *counters.kernel_segments_sent += counters.datagrams_sent;
  if (counters.kernel_bytes_sent) *counters.kernel_bytes_sent += counters.datagram_bytes_sent;
  if (counters.kernel_bytes_received)
    *counters.kernel_bytes_received += counters.datagram_bytes_received;
  return counters;
}

}  // namespace rink::rti
