// The options of rink serve.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "game/net/server/server.h"
#include "game/replication/update_policy.h"

namespace rink::game {

struct ServeOptions {
  std::string scene = "crowd", federation_file, address = "127.0.0.1", scheme = "region",
              policy = "periodic", keys, record, report, trace, status, pace = "realtime",
              transport = "tcp", hosted;
  std::string key_file, from_state;
  std::string name;               ///< of a hosted match on the local network; empty: the machine's
  bool is_announced = true;       ///< to the local network, where a match is hosted
  std::string continued;          ///< the record that the first hosted match goes on from
  std::string node_listen, join;  ///< where other nodes reach this one; any other node to join
  std::vector<std::string> always{};   ///< kinds that are relevant to everybody; none: the scene's
  std::vector<std::string> plugins{};  ///< files of plugins that the scheme may name
  std::vector<std::string> members{};  ///< of the federation file's list, if it has one
  std::uint16_t port = 4711;
  bool is_rank = false;       ///< of MPI, all of which share the simulation
  bool is_replicated = true;  ///< nodes keep copies of each other's parts
  std::uint32_t bats = 0, bat_count = 0, puck_count = 0, clients = 0, sweep_ticks = 0,
                threads = 1,  ///< that play parts of the field at once
      nodes = 0,              ///< that share the simulation; 0: this server alone, or `join`
      balance_windows = 25;   ///< after which their zones may shift; 0: never
  std::uint64_t seed = 0;
  bool is_time_managed = false, has_second_core = false, counts_fields = false;
  double rate_hz = 30.0, output_rate_hz = 0.0, duration_s = 0.0, warm_up_s = 0.0, cell_size = 0.0,
         patience_s = 30.0, node_patience_s = 30.0, countdown_s = 3.0, absence_s = 30.0,
         every_s = 0.0;
  double spread = 0.0;
  double threshold = threshold_default;                           ///< m
  double rate_limit_bytes_per_s = 16e6, frame_limit_per_s = 0.0;  ///< of each client; 0: none
  std::optional<std::uint32_t> address_limit{};                   ///< see GateSettings
  /// Of the physics in real time. More than a core plays in a second, so that only what would hang
  /// is slowed.
  std::uint64_t events_per_s = 2'000'000;
  double key_limit_per_s = key_limit_default;    ///< of each player; 0: none
  double push_limit_per_s = push_limit_default;  ///< of each player; 0: none
};

/// Whether other servers share the simulation.
inline bool is_node(const ServeOptions& options) {
  return options.nodes > 0 || !options.join.empty() || options.is_rank;
}

}  // namespace rink::game
