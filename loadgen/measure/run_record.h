// The figures of one run of a server and its bots: a line of runs.jsonl.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "loadgen/experiment/experiment.h"
#include "loadgen/measure/statistics/histogram.h"
#include "loadgen/measure/truth/truth_figures.h"

namespace rink::loadgen {

/// Bytes on the wire around each TCP segment: Ethernet 14, IPv4 20, TCP with timestamps 32 (RFC
/// 894, 791, 9293, 7323).
inline constexpr double segment_header_bytes = 66.0;

/// What one end of connections sent.
struct SentAmounts {
  double bytes = 0.0, segments = 0.0, acknowledgements = 0.0, kernel_segments = 0.0;

  /// Where the kernel's segments are larger than Ethernet's their receiver acknowledges fewer: one
  /// of each further two is missing.
  double all_acknowledgements() const {
    return acknowledgements + 0.5 * std::max(0.0, segments - kernel_segments);
  }
  double with_headers() const {
    return bytes + segment_header_bytes * (segments + all_acknowledgements());
  }
};

/// Traffic by purpose, in bytes for each client (or peer) and second (docs/metrics.md, "Nodes").
struct TrafficFigures {
  std::optional<double> halo, claims, agreement, interest, updates, keys, standby;
};

/// What one field of messages takes, both ways apart (docs/wire.md).
struct FieldFigures {
  std::string direction, channel, form, field;
  double bytes_per_client_per_s = 0.0, times_per_client_per_s = 0.0;
};

/// The load of the busiest node: the server, one of several, or one of the peers.
struct NodeFigures {
  std::optional<double> busiest_bytes_per_s;       ///< sent and received
  std::optional<double> busiest_link_bytes_per_s;  ///< with headers, of acknowledgements too
  std::optional<double> busiest_events_per_s;      ///< of physics, those of ghosts alone included
  std::optional<double> between_bytes_per_s;       ///< of all nodes to each other, with headers
  std::optional<double> busiest_cpu_s,
      mean_cpu_s;  ///< processor time from start to end; the mean is over all nodes: server and
                   ///< clients, or peers
};

/// The state of the load generator itself.
struct GeneratorHealth {
  std::optional<double>
      bots_cpu_share;  ///< processor time of the bots / (wall time x processors they may use)
  std::optional<double> histogram_ns_per_record;  ///< the cost of recording one latency
};

/// The figures of one cell. docs/metrics.md defines each; values that were not measured are absent
/// and null in JSON.
struct RunRecord {
  Cell cell;
  std::optional<std::uint64_t> entities;
  std::optional<std::uint64_t> ticks;
  std::optional<double> ticks_on_time_fraction;
  std::optional<double> down_bytes_per_client_per_s, up_bytes_per_client_per_s,
      wire_bytes_per_client_per_s;
  std::optional<double> messages_per_s;
  Percentiles update_age_ms, key_to_effect_ms;
  std::optional<std::uint64_t> update_age_samples;  ///< clients x ticks without those that brought
                                                    ///< no updates
  std::optional<double> physics_us_per_tick, filter_us_per_tick, send_us_per_tick;
  std::optional<std::uint64_t> server_rss_bytes;
  std::string state_hash;  ///< 16 hexadecimal digits, or empty if unknown
  bool valid = false;
  std::string why_invalid;  ///< empty if valid

  std::string scene, population, keys;
  double duration_s = 0.0, warm_up_s = 0.0, start_s = 0.0;
  std::optional<double> measured_s;
  std::optional<double> segments_per_s, writes_per_s;
  std::optional<double> acknowledgements_per_s;  ///< segments without payload
  std::optional<std::uint64_t> keys_due, keys_sent;
  std::optional<double> late_sends_fraction;
  std::string keys_trouble;  ///< why `key_to_effect_ms` is absent: the keys were sent too late;
                             ///< empty if it is not
  std::optional<double> server_cpu_s,
      bots_cpu_s;       ///< processor time of each process from start to end
  Percentiles tick_us;  ///< wall time of whole ticks
  TruthFigures truth;
  TrafficFigures traffic;
  std::vector<FieldFigures> fields{};  ///< their sum is the payload; empty if nobody asked
  NodeFigures nodes;
  GeneratorHealth health;
  std::string transport, players;
  double delay_ms = 0.0, view_area = 0.0;

  /// Physics, filter and send together; absent unless all three are there.
  std::optional<double> total_us_per_tick() const;
};

/// A record of `cell` without figures yet; not valid.
RunRecord record_for(const Experiment& experiment, const Cell& cell);

}  // namespace rink::loadgen
