// Decides the fate of every packet of a virtual network by its conditions: reliable lines as TCP
// makes them, and datagrams as UDP leaves them.
#pragma once

#include <cstdint>
#include <vector>

#include "rti/transport/modelled/link_stream.h"
#include "rti/transport/modelled/loss_chain.h"
#include "rti/transport/modelled/network_conditions.h"
#include "rti/transport/modelled/virtual_network.h"

namespace rink::rti {

/// IPv4 and TCP with timestamps, IPv4 and UDP [bytes]; what an Ethernet packet of 1500 bytes leaves
/// of each.
inline constexpr std::size_t segment_header = 52, datagram_header = 28, segment_max = 1448;

/// Counts of packets over all links; a segment counts again each time it is sent.
struct NetworkCounters {
  std::uint64_t segments = 0, datagrams = 0;  ///< sent
  std::uint64_t lost = 0;                     ///< of both, to the chain of losses
  std::uint64_t cut = 0;                      ///< of both, to partitions
  std::uint64_t dropped = 0;                  ///< datagrams, by full queues
  std::uint64_t retransmitted = 0;            ///< segments
  std::uint64_t held = 0,
                duplicated = 0;  ///< packets that others may overtake; datagrams that came twice
};

/// A reliable line is a model of TCP. A write travels as segments of at most `segment_max` bytes of
/// payload and is there when its last one is. A lost segment is sent again after the retransmission
/// time-out of RFC 6298, or after one round trip if three segments of its own write follow it (fast
/// retransmit, RFC 5681 3.2). The time-out is 1 s until the first round trip is known, then SRTT +
/// 4 RTTVAR with gains 1/8 and 1/4 (RFC 6298 2), at least `timeout_min_ns` (Linux: 200 ms; the RFC
/// says 1 s), and doubles for each further try up to 60 s; after `retries_max` of them (Linux:
/// tcp_retries2 = 15) the sender gives up and its connection fails. What is sent again comes long
/// after the burst that took it: each try is lost with the long-run probability, and the chain of
/// losses goes on with what is new. Round trips are measured on segments sent once (Karn) and known
/// at once. What a retransmission takes at a limited rate is its own sending time, not a place in
/// the queue. Not modelled: windows (a limited rate makes the sender wait, and nothing of a
/// reliable line is dropped by a full queue), losses of acknowledgements, and fast retransmit by
/// segments of later writes, so that thin streams wait longer than with RACK (RFC 8985): delays are
/// an upper bound.
class NetworkModel final : public LinkModel {
 public:
  static constexpr std::int64_t timeout_first_ns = 1'000'000'000, timeout_min_ns = 200'000'000,
                                timeout_max_ns = 60'000'000'000;
  static constexpr int retries_max = 15;

  /// Conditions must have no objection().
  explicit NetworkModel(NetworkConditions conditions);

  /// Cuts links from now on as well as those of the conditions.
  void add(const Partition& partition) { conditions_.partitions.push_back(partition); }
  const NetworkCounters& counters() const { return counters_; }

  void open_line(std::uint32_t line, const LineIdentity& identity) override;
  Delivery deliver(std::uint32_t line, std::int64_t now_ns, std::size_t size) override;
  DatagramArrivals datagram(std::uint32_t line, std::int64_t now_ns, std::size_t size) override;
  /// Of both channels, with headers.
  std::size_t queued_bytes(std::uint32_t line, std::int64_t now_ns) const override;
  std::int64_t arrival_ns(std::uint32_t line, std::int64_t now_ns, std::size_t size) override {
    return deliver(line, now_ns, size).instant_ns;
  }

 private:
  struct Line {
    LinkConditions conditions;
    std::uint32_t link = 0;
    LinkDirection direction = LinkDirection::to_listener;
    LossChain loss;
    LinkStream jitter, order, copies,
        retries;               ///< apart, so that one property's numbers do not depend on another's
    std::int64_t idle_ns = 0;  ///< when all that was sent has left
    std::uint64_t remainder = 0;  ///< of its last division [1/rate ns], so that no rounding adds up
    std::int64_t last_datagram_ns = 0;  ///< no datagram that keeps its order arrives before
    std::int64_t back_ns = 0;           ///< delay of an acknowledgement
    std::int64_t smoothed_ns = 0, variation_ns = 0, timeout_ns = timeout_first_ns;  ///< RFC 6298
  };
  /// The instant at which `bytes` given at `now_ns` have left; occupies the line until then.
  std::int64_t departure_ns(Line& line, std::int64_t now_ns, std::size_t bytes);
  std::int64_t service_ns(const Line& line, std::size_t bytes) const;
  bool is_lost(Line& line, std::int64_t departed_ns, bool is_retry);
  bool is_cut(const Line& line, std::int64_t instant_ns) const;
  std::int64_t jitter_ns(Line& line);
  bool is_held(Line& line);
  Delivery deliver_segment(Line& line, std::int64_t now_ns, std::size_t bytes, std::size_t behind);
  static void learn(Line& line, std::int64_t round_trip_ns);

  NetworkConditions conditions_;
  std::vector<Line> lines_;
  NetworkCounters counters_;
};

}  // namespace rink::rti
