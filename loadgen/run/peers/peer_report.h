// Counts of peers under the names in reports of a server and its bots.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "game/net/peer/peer_node.h"
#include "game/net/peer/peer_trace.h"
#include "loadgen/experiment/experiment.h"
#include "loadgen/run/bots/probe.h"
#include "rti/transport/transport.h"

namespace rink::loadgen {

/// The traffic of all peers, and of each, since their start or within a span.
struct TrafficTotals {
  game::TrafficBytes by_subject{};  ///< with frames
  std::uint64_t messages = 0, bytes = 0, writes = 0, segments = 0, acknowledgements = 0,
                kernel_segments = 0;
  std::vector<std::uint64_t> sent, received;  ///< bytes by peer
  std::vector<std::uint64_t> link;            ///< by peer: sent and received with headers, those of
                                    ///< acknowledgements too; empty if it was not counted by link
  std::vector<std::uint64_t> events;  ///< of physics, by peer

  /// Adds the next peer's traffic.
  void add(const game::PeerNode& node, const rti::TransportCounters& counters);
  void add(const game::PeerLoad& load);
};
TrafficTotals operator-(TrafficTotals a, const TrafficTotals& b);

/// The last window that a run's peers play; it ends when the run does, or at the last instant
/// before that at which a window can.
std::uint64_t last_window(const Experiment& experiment, const Cell& cell);
/// Windows that end within the measured span, which the end of the last one closes.
std::uint64_t measured_windows(const Experiment& experiment, const Cell& cell);

struct PeerTotals {
  TrafficTotals measured, whole;
  double measured_s = 0.0;
  std::uint64_t windows = 0, measured_windows = 0, entities = 0, keys_unanswered = 0;
  std::uint64_t
      known = 0,
      on_time = 0;  ///< measured windows of each peer, and those known before the next one's end
  peer::PeerCounters counters;       ///< of all peers, from start to end
  std::uint64_t whole_received = 0;  ///< bytes; and the kernel's counts, if there is one:
  std::optional<std::uint64_t> kernel_sent, kernel_received, busiest_rss;  ///< bytes
  std::string error;  ///< why the players' part of the run does not count
  std::string state_hash;
};

/// The reports as a server's and as its bots': sent bytes count as downwards, received ones as
/// upwards, which are as many.
nlohmann::ordered_json peers_report(const Cell& cell, const PeerTotals& totals);
nlohmann::ordered_json players_report(const Cell& cell, const PeerTotals& totals,
                                      const Measurements& measured);

}  // namespace rink::loadgen
