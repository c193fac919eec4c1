// What rink peer is asked for about what players see beyond what their peers have.
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

/// What is wrong with a scheme that a flag names, or nothing.
std::string objection_to(const std::string& scheme);
/// Throws std::invalid_argument for what the flags of a first peer cannot mean together.
void require_viewing(const Terms& terms, const ViewingOptions& options, const SharedGame& game,
                     std::uint32_t bots);

/// What the terms want of interest, for those who met, and evidence of it if the options do:
/// neither if they want none. Throws std::invalid_argument if there can be no evidence.
struct Viewing {
  std::unique_ptr<Viewer> viewer;
  RunRecorder* recorder = nullptr;  ///< the same, if it is one
};
Viewing make_viewing(const SharedGame& game, PeerNetwork& network, const ViewingOptions& options,
                     double (*now_s)());
/// What was sent and received, for the report.
nlohmann::ordered_json report_of(const Viewer& viewer);
/// What the transport and the kernel counted of the peer's connections.
nlohmann::ordered_json report_of(const rti::TransportCounters& counters);

}  // namespace rink::game
