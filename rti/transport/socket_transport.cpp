// Makes the transport that a name stands for.
#include "rti/transport/socket_transport.h"

#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <utility>

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

/// The bundle limits what waits for each of its channels.
TcpSettings SocketTransport::Bundle::carrier_settings() {
  return {.queue_max = std::size_t{1} << 36};
}

/// A socket that has been closed is replaced, so that who comes back finds one.
ConnectionId SocketTransport::Bundle::connect(const std::string& address, std::uint16_t port) {
  const std::string leads_to = address + ':' + std::to_string(port);
  if (std::exchange(place, leads_to) != leads_to) trunks.clear();
  const std::size_t turn = connected++ % trunks_max;
  if (turn >= trunks.size()) trunks.push_back(carrier.connect(address, port));
  ConnectionId& trunk = trunks[std::min(turn, trunks.size() - 1)];
  if (!bundled.takes_more(trunk)) trunk = carrier.connect(address, port);
  return bundled.connect(trunk);
}

SocketTransport::SocketTransport(std::string_view name, std::uint32_t bundles) {
  assert(std::ranges::find(socket_transport_names, name) != socket_transport_names.end());
  assert(bundles > 0);
  if (name == "udp") transport_.emplace<UdpTransport>();
  if (name == "shm") transport_.emplace<SharedMemoryTransport>();
  if (name == "bundle") transport_.emplace<Bundle>().trunks_max = bundles;
}

Transport& SocketTransport::get() {
  if (auto* bundle = std::get_if<Bundle>(&transport_)) return bundle->bundled;
  if (auto* shared = std::get_if<SharedMemoryTransport>(&transport_)) return *shared;
  if (auto* udp = std::get_if<UdpTransport>(&transport_)) return *udp;
  return std::get<TcpTransport>(transport_);
}

std::uint16_t SocketTransport::listen(const std::string& address, std::uint16_t port) {
  if (auto* shared = std::get_if<SharedMemoryTransport>(&transport_))
    return listen_at(*shared, port);
  if (auto* udp = std::get_if<UdpTransport>(&transport_)) return udp->listen(address, port);
  if (auto* bundle = std::get_if<Bundle>(&transport_)) return bundle->carrier.listen(address, port);
  return std::get<TcpTransport>(transport_).listen(address, port);
}

ConnectionId SocketTransport::connect(const std::string& address, std::uint16_t port) {
  if (auto* shared = std::get_if<SharedMemoryTransport>(&transport_))
    return shared->connect(shared_name(port));
  if (auto* udp = std::get_if<UdpTransport>(&transport_)) return udp->connect(address, port);
  if (auto* bundle = std::get_if<Bundle>(&transport_)) return bundle->connect(address, port);
  return std::get<TcpTransport>(transport_).connect(address, port);
}

TransportCounters SocketTransport::totals() const {
  if (const auto* bundle = std::get_if<Bundle>(&transport_)) return bundle->carrier.totals();
  if (const auto* shared = std::get_if<SharedMemoryTransport>(&transport_)) return shared->totals();
  if (const auto* udp = std::get_if<UdpTransport>(&transport_))
    return with_datagrams(udp->totals());
  return std::get<TcpTransport>(transport_).totals();
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
