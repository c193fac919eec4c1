// What a federation execution has counted.
#pragma once

#include <array>
#include <cstdint>

#include "rti/violation.h"

namespace rink::rti {

struct FederationCounters {
  std::uint64_t bytes_received = 0, bytes_sent = 0;  ///< payload, frame headers included
  /// Of `bytes_sent`: what tells who is in scope (discoveries, entries, exits, removals), the state
  /// of what came into scope, updates, and interactions; the rest is frame headers, membership,
  /// synchronisation and heartbeats. Interactions and removals count when they are queued.
  std::uint64_t scope_bytes_sent = 0, entry_bytes_sent = 0, update_bytes_sent = 0,
                interaction_bytes_sent = 0;
  std::uint64_t frames_received = 0, frames_sent = 0;
  std::uint64_t updates_received = 0,
                updates_sent = 0;  ///< records; one sent to n federates counts n times
  std::uint64_t updates_put_off =
      0;  ///< records that a federate was not sent since its filter's tiers or budget said to wait,
  std::uint64_t updates_caught_up =
      0;  ///< and newest states that it was sent for them in the end: the rest was spared
  std::uint64_t updates_held_back = 0;  ///< records that a federate which doesn't read was not
                                        ///< sent; its newest state follows when it does
  std::uint64_t interactions_received = 0, interactions_sent = 0;
  std::uint64_t scope_entries = 0, scope_exits = 0;
  std::uint64_t entries_postponed = 0;  ///< of those, told by a later flush for want of room
  std::uint64_t ownership_notices_sent =
      0;                            ///< objects told of; one that is told n things counts n times
  std::uint64_t late_requests = 0;  ///< of objects that were deleted meanwhile: ignored
  std::uint64_t joins = 0, resigns = 0;
  std::uint64_t timed_received = 0, timed_sent = 0, time_advance_grants = 0,
                retractions = 0;  ///< messages in time-stamp order; time management
  std::array<std::uint64_t, violation_count> drops{};  ///< by `Violation`
  std::uint64_t management_updates =
      0;  ///< of objects of the management object model that the RTI said
  /// Of best-effort updates: datagrams sent (their bytes are in those above), ignored for they made
  /// no sense, records sent again since they may have been lost, and how often a federate's
  /// datagrams went unanswered, so that it got everything by the stream, and were answered again.
  std::uint64_t datagrams_received = 0,
                updates_outdated = 0;  ///< of federates' own: new ones, and records in them that
                                       ///< were older than what is known
  std::uint64_t datagrams_sent = 0, datagrams_ignored = 0, updates_repaired = 0,
                datagram_fallbacks = 0, datagram_recoveries = 0;
};

}  // namespace rink::rti
