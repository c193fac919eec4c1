// Writes traces and reports of peers under the names of a server's run.
#include "loadgen/run/peers/peer_judgement.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "loadgen/measure/judge_run.h"
#include "loadgen/measure/tables/discovery_table.h"
#include "loadgen/measure/truth/truth.h"
#include "loadgen/run/game_plan.h"
#include "loadgen/run/virtual_parts.h"

namespace rink::loadgen {

game::ServerTrace trace_of(const Experiment& experiment, const Cell& cell, const game::Game& start,
                           const std::vector<game::InputEvent>& keys,
                           const std::string& state_hash) {
  game::ServerTrace server;
  server.choice = choice_of(experiment, cell);
  server.scheme = cell.scheme, server.policy = cell.policy;
  server.clients = cell.clients;
  server.rate_hz = cell.parameters.tick_rate_hz;
  server.from_s = experiment.warm_up_s,
  server.until_s = experiment.warm_up_s + experiment.duration_s;
  server.end_s = static_cast<double>(last_window(experiment, cell)) / cell.parameters.tick_rate_hz;
  server.keys = keys;
  server.state_hash = std::stoull(state_hash, nullptr, 16);
  for (const game::Entity& entity : start.entities())
    server.objects.push_back({entity.id.index, entity.id.index});
  return server;
}

game::BotsTrace bots_trace_of(const game::ServerTrace& server) {
  game::BotsTrace bots;
  bots.clients = server.clients;
  bots.from_s = server.from_s, bots.until_s = server.until_s;
  return bots;
}

void judge_peers(const RunnerSettings& settings, const Experiment& experiment, RunRecord& record,
                 PeersFindings&& findings) {
  auto& [totals, measured, server, bots] = findings;
  const nlohmann::ordered_json peers = peers_report(record.cell, totals),
                               players = players_report(record.cell, totals, measured);
  const std::string name = name_of(record.cell);
  const std::string server_file = settings.directory / (name + ".server.jsonl"),
                    bots_file = settings.directory / (name + ".bots.jsonl");
  if (settings.wants_truth) {
    std::stable_sort(bots.samples.begin(), bots.samples.end(),
                     [](const auto& a, const auto& b) { return a.displayed_s < b.displayed_s; });
    game::write_trace(server_file, server);
    write_trace(bots_file, bots);
  }
  write_json(settings.directory / (name + ".peers.json"), peers);
  write_json(settings.directory / (name + ".bots.json"), players);
  judge(record, peers, players);
  if (settings.wants_truth)
    add_truth(record, experiment, server_file, bots_file,
              discovery_file(settings.directory, record.cell));
}

}  // namespace rink::loadgen
