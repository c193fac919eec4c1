// What the UDP transport has counted, and its face.
#include <algorithm>

#include "rti/transport/udp/udp_core.h"

namespace rink::rti {

TransportCounters UdpTransport::Core::counters(ConnectionId connection) const {
  TransportCounters counters = tcp_.counters(connection);
  if (connection >= tallies_.size()) return counters;
  const Tally& tally = tallies_[connection];
  if (const Way* way = find(connection)) counters.queued_bytes += way->held_bytes;
  const auto without = [](std::uint64_t count, std::uint64_t ours) {
    return count > ours ? count - ours : 0;
  };
  counters.writes = without(counters.writes, tally.stream_sent > 0 ? 1 : 0);
  counters.segments_sent = without(counters.segments_sent, tally.stream_sent > 0 ? 1 : 0);
  counters.bytes_sent = without(counters.bytes_sent, tally.stream_sent);
  counters.bytes_received = without(counters.bytes_received, tally.stream_received);
  if (counters.kernel_bytes_sent)
    *counters.kernel_bytes_sent = without(*counters.kernel_bytes_sent, tally.stream_sent);
  if (counters.kernel_bytes_received)
    *counters.kernel_bytes_received =
        without(*counters.kernel_bytes_received, tally.stream_received);
  counters.datagrams_sent = tally.datagrams_sent;
  counters.datagrams_received = tally.datagrams_received;
  counters.datagram_bytes_sent = tally.bytes_sent;
  counters.datagram_bytes_received = tally.bytes_received;
  return counters;
}

std::size_t UdpTransport::Core::queued_bytes(ConnectionId connection) const {
  const Way* way = find(connection);
  return tcp_.queued_bytes(connection) + (way == nullptr ? 0 : way->held_bytes);
}

TransportCounters UdpTransport::Core::totals() const {
  TransportCounters sum = tcp_.totals();
  for (const Tally& tally : tallies_) {
    sum.bytes_sent -= tally.stream_sent;
    sum.bytes_received -= tally.stream_received;
    *sum.kernel_bytes_sent -= std::min(*sum.kernel_bytes_sent, tally.stream_sent);
    *sum.kernel_bytes_received -= std::min(*sum.kernel_bytes_received, tally.stream_received);
    sum.datagrams_sent += tally.datagrams_sent;
    sum.datagrams_received += tally.datagrams_received;
    sum.datagram_bytes_sent += tally.bytes_sent;
    sum.datagram_bytes_received += tally.bytes_received;
  }
  return sum;
}

UdpCounters UdpTransport::Core::udp_counters() const {
  UdpCounters counters = counters_;
  counters.lost_datagrams = sender_.lost();
  counters.send_calls = sender_.calls();
  counters.uses_offload = sender_.uses_offload();
  return counters;
}

UdpTransport::UdpTransport(const UdpSettings& settings) : core_(std::make_unique<Core>(settings)) {}
UdpTransport::~UdpTransport() = default;
std::uint16_t UdpTransport::listen(const std::string& address, std::uint16_t port) {
  return core_->listen(address, port);
}
ConnectionId UdpTransport::connect(const std::string& address, std::uint16_t port) {
  return core_->connect(address, port);
}
void UdpTransport::poll(std::chrono::nanoseconds longest_wait, TransportListener& listener) {
  core_->poll(longest_wait, listener);
}
void UdpTransport::send(ConnectionId connection, std::span<const Bytes> parts) {
  core_->send(connection, parts);
}
void UdpTransport::close(ConnectionId connection) { core_->close(connection); }
std::size_t UdpTransport::queued_bytes(ConnectionId connection) const {
  return core_->queued_bytes(connection);
}
TransportCounters UdpTransport::counters(ConnectionId connection) const {
  return core_->counters(connection);
}
std::size_t UdpTransport::datagram_max(ConnectionId connection) const {
  return core_->datagram_max(connection);
}
void UdpTransport::send_datagrams(ConnectionId connection, std::span<const Datagram> datagrams) {
  core_->send_datagrams(connection, datagrams);
}
void UdpTransport::push() { core_->push(); }
TransportCounters UdpTransport::totals() const { return core_->totals(); }
UdpCounters UdpTransport::udp_counters() const { return core_->udp_counters(); }

}  // namespace rink::rti
