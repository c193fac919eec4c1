// The RTI's central component: one federation execution. Bytes and time in, bytes out; no I/O, no
// clock, no thread.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "im/filter.h"
#include "rti/baselines/baseline_counters.h"
#include "rti/central_component.h"
#include "rti/federate_ambassador.h"
#include "rti/federation_services.h"
#include "rti/fom/fom.h"
#include "rti/management/federation_report.h"
#include "rti/wire/bytes.h"

namespace rink::rti {

/// Why the RTI dropped a connection on its own account.
enum class Violation : std::uint8_t {
  malformed,     ///< bytes that are no message, or a value out of its range
  oversized,     ///< a frame longer than its sender may send
  wrong_phase,   ///< anything but a join from one that has not joined, or a second join
  unknown_name,  ///< a class, attribute, object, region or label that does not exist
  undeclared,    ///< a class or attribute that its sender has not published
  not_owned,     ///< an object of somebody else
  over_limit,    ///< more objects or regions than allowed
  silent,        ///< nothing heard for too long
  refused,       ///< its join was refused
  untimely,      ///< a time stamp, lookahead or request that its logical time forbids
};
inline constexpr std::size_t violation_count = 10;
const char* to_string(Violation violation);
/// The same as a sentence about whoever did it, for the message with which it is dropped.
const char* explain(Violation violation);

struct FederationSettings {
  std::string federation = "rink";
  std::string filter = "none";  ///< an expression that `im::make_filter` takes
  im::FilterSettings filter_settings;
  im::Worker* match_worker = nullptr;   ///< takes half of a match where that pays; null: nobody. It
                                        ///< must outlive the federation
  std::vector<std::string> members{};   ///< names of the federates that may join; none: anybody
  std::uint32_t federate_max = 16'000;  ///< joined at once; below `object_block_max`
  std::uint32_t object_max = 1u << 20;  ///< registered at once; beyond it, who has more than an
                                        ///< even share of them gets no more
  std::uint32_t objects_per_federate_max = object_block;
  std::size_t name_bytes_per_federate_max = 8u
                                            << 20;  ///< of all the objects that it ever registers
  std::size_t interaction_bytes_per_flush_max =
      512u << 10;  ///< that one federate says to others between two flushes, 16 for each and its
                   ///< parameters
  std::size_t entry_bytes_per_flush_max =
      512u << 10;  ///< to one federate: of objects that came into scope, and their states; less
                   ///< what it has not taken yet
  std::uint32_t timed_max =
      1u
      << 20;  ///< messages in time-stamp order that wait for somebody, or can still be taken back
  std::size_t timed_bytes_max = 256u << 20;  ///< of what they say
  std::uint32_t timed_per_federate_max = 1u
                                         << 18;  ///< of those that their sender can still take back
  std::size_t timed_bytes_per_federate_max = 64u << 20;  ///< likewise
  Patience patience;
  std::uint32_t keyframe_period =
      1;  ///< every so-many-th flush with periodic state is a keyframe (docs/wire.md, "Baselines")
};

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

/// Where a federate subscribes, as it last committed it.
struct SubscribedRegion {
  FederateHandle federate;
  im::Region bounds;
};

/// Owns federates, declarations, objects with their latest values, synchronisation points and
/// regions. A tick is: any number of `receive`, then `match`, which alone decides who hears of
/// what, then `flush`. Connections that break a rule are forgotten at once, counted by reason, and
/// handed to `Outlet::drop` by the next flush; nobody else notices more than a lost federate.
class FederationExecution final : public CentralComponent {
 public:
  /// `fom` must outlive it. Throws std::invalid_argument naming the known filters if there is none
  /// called `settings.filter`.
  FederationExecution(const Fom& fom, const FederationSettings& settings,
                      const FederationServices& services = {});
  ~FederationExecution() override;
  FederationExecution(const FederationExecution&) = delete;
  FederationExecution& operator=(const FederationExecution&) = delete;

  /// Connection ids may be any numbers that are not connected now; small ones are dense.
  void connect(ConnectionId connection) override;
  void receive(ConnectionId connection, Bytes bytes) override;
  void receive_datagram(ConnectionId connection, Bytes datagram) override;
  void disconnect(ConnectionId connection, std::string_view why) override;
  /// `now` [s] never decreases. Drops who has been silent for too long.
  void advance_clock(double now) override;
  /// What the host of a federation knows of it and the filter may use (docs/rti.md, "What a filter
  /// knows beside regions"): who is of which team, whose he is and what is always relevant. What
  /// has the number of a federate's owner is told to it whatever the filter says. Who is not there
  /// is ignored; a role ends with who has it.
  void set_object_role(ObjectHandle object, const im::Role& role);
  void set_federate_role(FederateHandle federate, const im::Role& role);
  /// Where it looks, how it moves on from the region that it handed in last, and which time it is
  /// [s]: finite, and time never goes back.
  void set_federate_heading(FederateHandle federate, const im::Heading& heading);
  void set_object_flight(ObjectHandle object, const im::Flight& flight);
  void set_time(double now);
  /// Runs the filter and turns its changes into scope changes.
  void match() override;
  void flush(Outlet& outlet) override;

  const std::string& name() const;
  const Fom& fom() const;
  std::size_t federate_count() const;
  std::size_t object_count() const;
  /// True if `federate` is told of `object` since the last match; for tests against brute force.
  bool is_in_scope(FederateHandle federate, ObjectHandle object) const;
  /// Appends every object that `federate` is told of since the last match, in no particular order.
  void list_scope(FederateHandle federate, std::vector<ObjectHandle>& objects) const;
  /// Appends every region with bounds that a federate subscribes with.
  void list_subscribed_regions(std::vector<SubscribedRegion>& regions) const;
  const FederationCounters& counters() const;
  const BaselineCounters& baseline_counters() const;
  /// Worked out now, objects and scopes counted one by one; with the outlet's queues if there is
  /// one.
  FederationReport report(const Outlet* outlet = nullptr) const;
  const im::Filter& filter() const;
  const DataDistribution& distribution() const;

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace rink::rti
