// One check for each mode and setting.
#include "loadgen/experiment/experiment_limits.h"

#include <algorithm>

#include "game/model/listed.h"
#include "game/net/peer/network/greetings.h"
#include "game/players/player_kinds.h"
#include "game/replication/update_policy.h"
#include "loadgen/experiment/parameter.h"
#include "rti/federation_execution.h"

namespace rink::loadgen {
namespace {

/// Refuses what peers cannot do, before cells run that would fail.
void expect_what_peers_can(const Experiment& experiment, const std::string& file) {
  const auto has = [](const auto& list, const auto& value) {
    return std::find(list.begin(), list.end(), value) != list.end();
  };
  if (!has(experiment.modes, peer_mode)) return;
  const auto refuse = [&file](const std::string& what) {
    throw ExperimentError(file + ": modes = " + peer_mode + " " + what);
  };
  const bool is_virtual = experiment.transport == TransportKind::virtual_time;
  if (experiment.transport == TransportKind::udp)
    refuse(
        "needs transport = \"tcp\", \"shm\" or \"virtual\", not \"udp\": peers send no datagrams");
  if (experiment.transport == TransportKind::bundle)
    refuse("needs a socket for each peer: expected transport = \"tcp\", \"shm\" or \"virtual\"");
  for (const std::uint32_t count : experiment.clients)
    if (!is_virtual && (count < 2 || count > game::peers_max))
      refuse("over sockets is of 2 to " + std::to_string(game::peers_max) +
             " processes, not clients = " + std::to_string(count) +
             ": expected as many, or transport = \"virtual\"");
  if (experiment.keys != KeySource::replay) refuse("needs keys = \"replay\", which all peers know");
  for (const std::string& policy : experiment.policies)
    if (policy != "periodic" && policy != "on-event")
      refuse("knows the policies periodic and on-event, not " + policy);
  if (experiment.sweep_ticks != std::vector<double>{0.0})
    refuse("sweeps no regions: expected sweep_ticks = 0");
  if (experiment.server_cores != std::vector<std::uint32_t>{1})
    refuse("has no server: expected server_cores = 1");
  if (experiment.start_s > 0.0)
    refuse("begins with the scene, for no peer takes over a saved game: expected start_s = 0");
  if (experiment.network_carries_datagrams)
    refuse("sends no datagrams: expected a [network] without them");
}

/// Refuses what the engine over DDS cannot do, before cells run that would fail.
void expect_what_dds_can(const Experiment& experiment, const std::string& file) {
  const auto has = [](const auto& list, const auto& value) {
    return std::find(list.begin(), list.end(), value) != list.end();
  };
  if (!has(experiment.modes, dds_mode)) return;
  const auto refuse = [&file](const std::string& what) {
    throw ExperimentError(file + ": modes = " + dds_mode + " " + what);
  };
  if (experiment.transport != TransportKind::tcp)
    refuse(std::string("is of processes, Rink's beside it over TCP: expected transport = \"tcp\", "
                       "not \"") +
           to_string(experiment.transport) + "\"");
  if (experiment.keys != KeySource::replay) refuse("needs keys = \"replay\"");
  if (!has(experiment.policies, std::string("periodic")))
    refuse("sends every state at every tick: expected periodic among the policies");
  if (!has(experiment.schemes, std::string("none")) &&
      !has(experiment.schemes, std::string("grid")))
    refuse("has partitions alone: expected none or grid among the schemes");
  if (*std::ranges::max_element(experiment.nodes) > 1.0)
    refuse("is of one server: expected nodes = 1");
  if (*std::ranges::max_element(experiment.sweep_ticks) > 0.0)
    refuse("sweeps no regions: expected sweep_ticks = 0");
  if (*std::ranges::max_element(experiment.output_rates_hz) > 0.0)
    refuse("sends at each tick: expected output_rate_hz = 0");
}

/// Refuses what nodes cannot do, before cells run that would fail.
void expect_what_nodes_can(const Experiment& experiment, const std::string& file) {
  const double most = *std::ranges::max_element(experiment.nodes);
  if (most == 1.0) return;
  const auto refuse = [&](const std::string& what) {
    throw ExperimentError(file + ": nodes = " + shortest(most) + " " + what);
  };
  if (std::ranges::find(experiment.modes, peer_mode) != experiment.modes.end())
    refuse(std::string("is of servers that share a simulation, and peers have none: expected ") +
           "modes = \"client-server\"");
  if (experiment.transport != TransportKind::tcp)
    refuse(std::string("needs transport = \"tcp\", not \"") + to_string(experiment.transport) +
           "\": nodes play in threads and by clocks of their own, in real time");
  if (std::ranges::find(experiment.policies, game::exact_policy) != experiment.policies.end())
    refuse(std::string("knows no policy ") + game::exact_policy);
  if (experiment.keys != KeySource::live)
    refuse("needs keys = \"live\": nodes play what their clients press, and no key log");
  if (experiment.start_s > 0.0)
    refuse("begins with the scene, for no node takes over a saved game: expected start_s = 0");
  if (const std::uint32_t fewest = *std::ranges::min_element(experiment.clients); most > fewest)
    refuse("is more than clients = " + std::to_string(fewest) +
           ": expected a client for each node at least");
}

/// Refuses rates at which no client can be told, before cells run that would fail.
void expect_what_can_be_told(const Experiment& experiment, const std::string& file) {
  const double most = *std::ranges::max_element(experiment.output_rates_hz);
  if (most == 0.0) return;
  const auto refuse = [&](const std::string& what) {
    throw ExperimentError(file + ": output_rate_hz = " + shortest(most) + " " + what);
  };
  if (const double fewest = *std::ranges::min_element(experiment.tick_rates_hz); most > fewest)
    refuse("is more than tick_rate_hz = " + shortest(fewest) +
           ": expected as many ticks a second at least, or 0, by which each is told");
  if (*std::ranges::max_element(experiment.nodes) > 1.0)
    refuse("is of one server: expected nodes = 1");
}

/// A saved game is one of keys that are known beforehand.
void expect_what_can_start_warm(const Experiment& experiment, const std::string& file) {
  if (experiment.start_s == 0.0 || experiment.keys == KeySource::replay ||
      experiment.players == "random" || !game::is_player_kind(experiment.players))
    return;
  throw ExperimentError(
      file +
      ": start_s above 0 with keys = live: the keys of players that decide by what they see are "
      "not known beforehand; expected start_s = 0, keys = \"replay\", or players = \"random\"");
}

void expect_use_of_always(const Experiment& experiment, const std::string& file) {
  const auto has = [](const auto& list, const auto& is_one) {
    return std::any_of(list.begin(), list.end(), is_one);
  };
  if (experiment.always.empty() || has(experiment.schemes, [](const std::string& scheme) {
        return im::names_scheme(scheme, "always");
      }))
    return;
  if (!has(experiment.also_relevant, [](const std::string& more) { return more == "always"; }))
    throw ExperimentError(file + ": always = " + game::listed(experiment.always) +
                          " changes nothing: neither schemes nor also_relevant name always");
}

}  // namespace

void expect_what_can_run(const Experiment& experiment, const std::string& file) {
  expect_what_peers_can(experiment, file);
  expect_what_dds_can(experiment, file);
  expect_what_nodes_can(experiment, file);
  expect_what_can_be_told(experiment, file);
  expect_use_of_always(experiment, file);
  expect_what_can_start_warm(experiment, file);
}

}  // namespace rink::loadgen
