// What a server counted between two instants, as its report says it.
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
  std::vector<im::StageCount> stages;  ///< what the filter's stages did
  physics::Counters physics;
};

ServingCounts counts_of(const Serving& serving, const rti::TransportCounters& clients);

/// The part of a server's report that no clock has a say in: what the game has come to, and what
/// was counted from `begin` to `end`.
nlohmann::ordered_json counted_report(const Serving& serving, const ServingCounts& begin,
                                      const ServingCounts& end);

/// Adds what the connections carried from first to last, as counted here and by the kernel; null
/// where no kernel had a part in it.
void add_totals(nlohmann::ordered_json& report, const rti::TransportCounters& total);

}  // namespace rink::game
