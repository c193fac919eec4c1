// What an ambassador counts.
#pragma once

#include <cstdint>

namespace rink::rti {

/// Since the ambassador was made.
struct AmbassadorCounters {
  std::uint64_t bytes_received = 0, bytes_sent = 0;  ///< payload, frame headers included
  std::uint64_t frames_received = 0, frames_sent = 0;
  std::uint64_t updates_sent = 0, updates_reflected = 0;
  std::uint64_t interactions_sent = 0, interactions_received = 0;
  std::uint64_t updates_spared = 0, interactions_spared = 0;  ///< not sent, since nobody hears them
  std::uint64_t objects_discovered = 0, objects_removed = 0;
  std::uint64_t scope_changes = 0;
  std::uint64_t keyframes_acknowledged = 0,
                differences_refused = 0;  ///< of periodic state (docs/wire.md, "Baselines")
  std::uint64_t timed_sent = 0, timed_received = 0,
                time_advance_grants = 0;  ///< messages sent in time-stamp order; time management
  /// Of datagrams: that were applied; that were ignored, for they had come before or made no sense;
  /// updates in them that were older than what is known, or of objects out of scope.
  std::uint64_t datagrams_received = 0, datagrams_ignored = 0, updates_outdated = 0;
  /// Of one's own best-effort updates: datagrams sent (acknowledgements too), attributes said again
  /// since they may have been lost, and how often the way was given up and open again.
  std::uint64_t datagrams_sent = 0, updates_repaired = 0, datagram_fallbacks = 0,
                datagram_recoveries = 0;
};

}  // namespace rink::rti
