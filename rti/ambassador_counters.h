// What an ambassador counts.
#pragma once

#include <cstdint>

namespace rink::rti {

/// All counts start when the ambassador is made.
struct AmbassadorCounters {
  std::uint64_t bytes_received = 0, bytes_sent = 0;  ///< payload, frame headers included
  std::uint64_t frames_received = 0, frames_sent = 0;
  std::uint64_t updates_sent = 0, updates_reflected = 0;
  std::uint64_t residuals_received = 0,  ///< of the updates reflected
      residuals_refused = 0;             ///< malformed, or to values that never came
  std::uint64_t interactions_sent = 0, interactions_received = 0;
  std::uint64_t updates_spared = 0, interactions_spared = 0;  ///< not sent, since nobody subscribes
  std::uint64_t objects_discovered = 0, objects_removed = 0;
  std::uint64_t scope_changes = 0;
  std::uint64_t keyframes_acknowledged = 0,
                differences_refused = 0;  ///< of periodic state (docs/wire.md, "Baselines")
  std::uint64_t timed_sent = 0, timed_received = 0,
                time_advance_grants = 0;  ///< messages sent in time-stamp order; time management
  /// Datagrams that were applied, datagrams that were ignored because they were duplicates or
  /// malformed, and updates in them that were older than the known value or of objects out of
  /// scope.
  std::uint64_t datagrams_received = 0, datagrams_ignored = 0, updates_outdated = 0;
  /// Of the own best-effort updates: datagrams sent (acknowledgements too), attributes sent again
  /// since they may have been lost, and how often the channel was given up and opened again.
  std::uint64_t datagrams_sent = 0, updates_repaired = 0, datagram_fallbacks = 0,
                datagram_recoveries = 0;
};

}  // namespace rink::rti
