// What the UDP transport has counted.
#include <algorithm>

#include "rti/transport/udp/udp.h"

namespace rink::rti {

TransportCounters UdpTransport::counters(ConnectionId connection) const {
  TransportCounters counters = tcp_.counters(connection);
  if (connection >= tallies_.size()) return counters;
  const Tally& tally = tallies_[connection];
  if (const Channel* channel = find(connection)) counters.queued_bytes += channel->held_bytes;
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

std::size_t UdpTransport::queued_bytes(ConnectionId connection) const {
  const Channel* channel = find(connection);
  return tcp_.queued_bytes(connection) + (channel == nullptr ? 0 : channel->held_bytes);
}

TransportCounters UdpTransport::totals() const {
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

UdpCounters UdpTransport::udp_counters() const {
  UdpCounters counters = counters_;
  counters.lost_datagrams = sender_.lost();
  counters.send_calls = sender_.calls();
  counters.uses_offload = sender_.uses_offload();
  return counters;
}

}  // namespace rink::rti
