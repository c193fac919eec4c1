// Makes a server's report of its counts between two instants.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <utility>
#include <vector>

#include "game/net/server/serving.h"
#include "rti/ledger/byte_ledger.h"
#include "rti/transport/staged/ledger_stage.h"

namespace rink::game {

/// A server's counters at one instant.
struct ServingCounts {
  rti::FederationCounters federation;  ///< of the RTI, the server's own federate included
  rti::TransportCounters transport;    ///< of the clients' connections
  im::FilterCounters filter;
  std::vector<im::StageCount> stages;  ///< the figures of the filter's stages
  physics::Counters physics;
  std::vector<rti::TransportCounters> to_nodes{};  ///< of a node: what it sent each, by number
  std::vector<rti::LedgerRow> fields{};            ///< where the payload went, if a ledger is kept
  /// How many times each player's client was updated since it joined, by ascending federate.
  std::vector<std::pair<rti::FederateHandle, std::uint64_t>> times_updated{};
};

ServingCounts counts_of(const Serving& serving, const rti::TransportCounters& clients);

/// Counts on for the clients of `times_updated`, as long as each is there.
void follow_times_updated(const Serving& serving, ServingCounts& counts);

/// The part of a server's report that is independent of clocks: the state of the game, and counts
/// from `begin` to `end`; of a node also what it sent the others.
nlohmann::ordered_json counted_report(const Serving& serving, const ServingCounts& begin,
                                      const ServingCounts& end);

/// Puts a ledger of all that clients are sent and send on `transport`, below any other stage.
rti::LedgerStage& add_ledger(rti::StagedTransport& transport, const rti::Fom& fom);

/// Adds the traffic of connections from first to last, by own and kernel counts; null without a
/// kernel.
void add_totals(nlohmann::ordered_json& report, const rti::TransportCounters& total);

}  // namespace rink::game
