// What a federation execution has counted.
#pragma once

#include <array>
#include <cstdint>

#include "rti/violation.h"

namespace rink::rti {

struct FederationCounters {
  std::uint64_t bytes_received = 0, bytes_sent = 0;  ///< payload, frame headers included
  /// Parts of `bytes_sent`: changes of scope (discoveries, entries, exits, removals), the full
  /// state of what came into scope, updates, and interactions; the rest is frame headers,
  /// membership, synchronisation and heartbeats. Interactions and removals count when they are
  /// queued.
  std::uint64_t scope_bytes_sent = 0, entry_bytes_sent = 0, update_bytes_sent = 0,
                interaction_bytes_sent = 0;
  std::uint64_t frames_received = 0, frames_sent = 0;
  std::uint64_t updates_received = 0,
                updates_sent = 0,  ///< records; one sent to n federates counts n times
      residuals_sent = 0,          ///< of these, as residuals
      companions_sent = 0;         ///< of these, to what another object's update says, too
  std::uint64_t updates_put_off =
      0;  ///< records held back from a federate by its filter's tiers or budget,
  std::uint64_t updates_caught_up =
      0;  ///< and newest states that were sent for them later: the rest was saved
  std::uint64_t updates_held_back = 0;  ///< records that a federate which doesn't read was not
                                        ///< sent; its newest state follows when it does
  std::uint64_t interactions_received = 0, interactions_sent = 0;
  std::uint64_t scope_entries = 0, scope_exits = 0;
  std::uint64_t entries_held = 0;            ///< of those, whose values the federate held already
  std::uint64_t entries_postponed = 0;       ///< of those, sent by a later flush for want of room
  std::uint64_t ownership_notices_sent = 0;  ///< objects in relevance notices; one with n notices
                                             ///< counts n times
  std::uint64_t late_requests = 0;           ///< of objects that were deleted meanwhile: ignored
  std::uint64_t joins = 0, resigns = 0;
  std::uint64_t timed_received = 0, timed_sent = 0, time_advance_grants = 0,
                retractions = 0;  ///< messages in time-stamp order; time management
  std::array<std::uint64_t, violation_count> drops{};  ///< by `Violation`
  std::uint64_t management_updates =
      0;  ///< of objects of the management object model that the RTI said
  /// Of best-effort updates: datagrams sent (their bytes are in those above), datagrams ignored as
  /// malformed, records sent again since they may have been lost, and how often a federate fell
  /// back to the stream alone because its datagrams went unanswered, and returned to datagrams.
  std::uint64_t datagrams_received = 0,
                updates_outdated = 0;  ///< of federates' own: new ones, and records in them that
                                       ///< were older than what is known
  std::uint64_t datagrams_sent = 0, datagrams_ignored = 0, updates_repaired = 0,
                datagram_fallbacks = 0, datagram_recoveries = 0;
};

}  // namespace rink::rti
