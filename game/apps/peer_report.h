// Makes the report of a peer and of its part of the game.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>

#include "game/apps/command.h"
#include "game/apps/peer_flags.h"
#include "game/model/report_fields.h"
#include "game/net/peer/shared_game.h"

namespace rink::game {

/// Processor time of this process [s].
double processor_s();

SharedGame game_of(const PeerOptions& options);

/// Adds the hash at the end, where readers look for it.
void add_hash(nlohmann::ordered_json& report, const PlayedPart& part);

/// The report of a part that was played over `network`, without the hash.
template <class Network>
nlohmann::ordered_json report_of(const PlayedPart& part, const Network& network, std::uint32_t bots,
                                 double playing_s) {
  const peer::PeerCounters& counters = part.counters.peer;
  return {{"peer", network.number()},
          {"peers", part.members},
          {"time", part.time},
          {report::windows, counters.windows},
          {report::repeats, counters.repeats},
          {"owned", part.owned},
          {"ghosts", part.ghosts},
          {report::mean_ghosts,
           static_cast<double>(counters.ghost_windows) / static_cast<double>(counters.windows + 1)},
          {report::held_max, counters.held_max},
          {"halo", part.halo},
          {report::own_events, counters.own_events},
          {report::ghost_events, counters.ghost_events},
          {report::hand_overs, counters.hand_overs},
          {"bots", bots},
          {"key_presses", part.presses},
          {"arrival_bytes", counters.arrival_bytes},
          {"claim_bytes", counters.claim_bytes},
          {"verdict_bytes", counters.verdict_bytes},
          {"result_bytes", part.result_bytes},
          {report::bytes_sent, network.bytes_sent()},
          {"strangers_dismissed", network.dismissed()},
          {"wall_s", playing_s},
          {"cpu_s", processor_s()},
          {report::rss_bytes, resident_bytes()},
          {"lost", part.lost},
          {"recoveries", part.counters.recoveries},
          {"shifts", part.counters.shifts},
          {"mirror_bytes", part.counters.replica_bytes},
          {"recovery_bytes", part.counters.recovery_bytes},
          {"entry_bytes", part.counters.entry_bytes}};
}

}  // namespace rink::game
