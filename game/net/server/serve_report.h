// Makes a server's report of its counts between two instants.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "game/net/server/serving.h"

namespace rink::game {

/// A server's counters at one instant.
struct ServingCounts {
  rti::FederationCounters federation;  ///< of the RTI, the server's own federate included
  rti::TransportCounters transport;    ///< of the clients' connections
  im::FilterCounters filter;
  std::vector<im::StageCount> stages;  ///< the figures of the filter's stages
  physics::Counters physics;
  std::vector<rti::TransportCounters> to_nodes{};  ///< of a node: what it sent each, by number
};

ServingCounts counts_of(const Serving& serving, const rti::TransportCounters& clients);

/// The part of a server's report that is independent of clocks: the state of the game, and counts
/// from `begin` to `end`; of a node also what it sent the others.
nlohmann::ordered_json counted_report(const Serving& serving, const ServingCounts& begin,
                                      const ServingCounts& end);

/// Adds the traffic of connections from first to last, by own and kernel counts; null without a
/// kernel.
void add_totals(nlohmann::ordered_json& report, const rti::TransportCounters& total);

}  // namespace rink::game
