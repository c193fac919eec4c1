// Runs one cell of several nodes: as many processes of rink serve that share the simulation, each
// with a process of bots, on loopback and in real time, from start to reports.
#pragma once

#include <cstdint>
#include <filesystem>

#include "loadgen/experiment/experiment.h"
#include "loadgen/measure/run_record.h"
#include "loadgen/run/process_arguments.h"

namespace rink::loadgen {

/// Runs `record.cell`, whose clients are spread evenly, and judges it: also by whether all nodes
/// end in one state, and one engine does so under the keys that they felt. Throws Failure,
/// std::system_error and Interrupted. All processes have ended when this returns or throws.
void run_nodes(const RunnerSettings& settings, const Experiment& experiment,
               const std::filesystem::path& key_log, RunRecord& record);

/// How many of `clients` play at node number `node` of `nodes`: as many as at any other, or one
/// more.
inline std::uint32_t clients_of_node(std::uint32_t clients, std::uint32_t nodes,
                                     std::uint32_t node) {
  return clients / nodes + (node < clients % nodes);
}

}  // namespace rink::loadgen
