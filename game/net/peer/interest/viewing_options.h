// The options of rink peer for interest beyond the peers' own parts.
#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "game/net/peer/network/greetings.h"
#include "game/net/peer/network/peer_network.h"
#include "game/net/peer/run_recorder.h"

namespace rink::game {

struct ViewingOptions {
  double view_fraction = 0.05, view_area = 0.0,
         view_margin = 0.0;  ///< as a bot's: of the field's area, or m^2; m
  std::string trace;         ///< file
  std::uint64_t evidence_seed = 1;
  double warm_up_s = 0.0;
  std::vector<std::string> always;  ///< of a first peer: kinds of bodies; none: as the scene has it
};

/// The fault of a scheme that a flag names, or nothing.
std::string objection_to(const std::string& scheme);
/// Throws std::invalid_argument for flags of a first peer that contradict each other.
void require_viewing(const Terms& terms, const ViewingOptions& options, const SharedGame& game,
                     std::uint32_t bots);

/// The viewer that the terms ask for, and a recorder if the options do; neither if they ask for
/// none. Throws std::invalid_argument if nothing can be recorded.
struct Viewing {
  std::unique_ptr<Viewer> viewer;
  RunRecorder* recorder = nullptr;  ///< the same, if it is one
};
Viewing make_viewing(const SharedGame& game, PeerNetwork& network, const ViewingOptions& options,
                     double (*now_s)());
/// Traffic by interest, for the report.
nlohmann::ordered_json report_of(const Viewer& viewer);
/// The transport's and the kernel's counts of the peer's connections.
nlohmann::ordered_json report_of(const rti::TransportCounters& counters);

}  // namespace rink::game
