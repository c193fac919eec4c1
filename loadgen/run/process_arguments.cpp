// Flags of rink serve and rink bots.
#include "loadgen/run/process_arguments.h"

#include "game/net/plugins.h"
#include "game/players/player_kinds.h"
#include "game/replication/update_policy.h"
#include "loadgen/experiment/parameter.h"
#include "loadgen/run/game_plan.h"
#include "rti/federation_execution.h"

namespace rink::loadgen {

void pin_apart(RunnerSettings& settings, const std::vector<int>& processors) {
  settings.server_processors.clear();
  settings.bots_processors.clear();
  if (processors.size() < 2) return;
  settings.server_processors = {processors.front()};
  settings.bots_processors.assign(processors.begin() + 1, processors.end());
}

std::vector<std::string> serve_arguments(const Experiment& experiment, const Cell& cell,
                                         const std::filesystem::path& key_log,
                                         const std::filesystem::path& report) {
  std::vector<std::string> arguments{"--scene", experiment.scene};
  const auto add = [&arguments](const char* flag, const std::string& value) {
    arguments.insert(arguments.end(), {flag, value});
  };
  if (experiment.population == Population::per_client) add("--bats", std::to_string(cell.clients));
  add("--seed", std::to_string(cell.seed));
  add("--address", "127.0.0.1");
  add("--port", "0");
  add("--transport", to_string(experiment.transport));
  add("--scheme", cell.scheme);
  for (const std::string& file : game::plugin_files()) add("--plugin", file);
  if (cell.bats > 0) add("--bat-count", std::to_string(cell.bats));
  if (cell.pucks > 0) add("--puck-count", std::to_string(cell.pucks));
  if (cell.parameters.cell_size > 0.0) add("--cell-size", decimal(cell.parameters.cell_size));
  if (im::names_scheme(cell.scheme, "always"))
    for (const std::string& kind : experiment.always) add("--always", kind);
  if (cell.parameters.sweep_ticks > 0)
    add("--sweep-ticks", std::to_string(cell.parameters.sweep_ticks));
  add("--policy", cell.policy);
  if (game::takes_threshold(cell.policy)) add("--threshold", decimal(cell.parameters.threshold));
  add("--rate", decimal(cell.parameters.tick_rate_hz));
  if (cell.parameters.output_rate_hz > 0.0)
    add("--output-rate", decimal(cell.parameters.output_rate_hz));
  add("--duration", decimal(experiment.warm_up_s + experiment.duration_s));
  add("--warm-up", decimal(experiment.warm_up_s));
  add("--clients", std::to_string(cell.clients));
  if (experiment.keys == KeySource::replay) add("--keys", key_log.string());
  if (experiment.start_s > 0.0) add("--from-state", state_file_of(key_log).string());
  add("--report", report.string());
  if (experiment.counts_fields) arguments.emplace_back("--bytes-by-field");
  return arguments;
}

namespace {

/// The flags that server and bots over DDS share.
std::vector<std::string> dds_arguments(const std::string& role, const Experiment& experiment,
                                       const Cell& cell, const std::filesystem::path& key_log,
                                       const std::filesystem::path& report) {
  return {role,
          "--seed",
          std::to_string(cell.seed),
          "--keys",
          key_log.string(),
          "--duration",
          decimal(experiment.warm_up_s + experiment.duration_s),
          "--warm-up",
          decimal(experiment.warm_up_s),
          "--report",
          report.string()};
}

}  // namespace

std::vector<std::string> dds_serve_arguments(const Experiment& experiment, const Cell& cell,
                                             const std::filesystem::path& key_log,
                                             const std::filesystem::path& report) {
  std::vector<std::string> arguments = dds_arguments("serve", experiment, cell, key_log, report);
  const auto add = [&arguments](const char* flag, const std::string& value) {
    arguments.insert(arguments.end(), {flag, value});
  };
  add("--scene", experiment.scene);
  if (experiment.population == Population::per_client) add("--bats", std::to_string(cell.clients));
  if (cell.bats > 0) add("--bat-count", std::to_string(cell.bats));
  if (cell.pucks > 0) add("--puck-count", std::to_string(cell.pucks));
  add("--scheme", cell.scheme);
  if (cell.parameters.cell_size > 0.0) add("--cell-size", decimal(cell.parameters.cell_size));
  add("--rate", decimal(cell.parameters.tick_rate_hz));
  add("--clients", std::to_string(cell.clients));
  if (experiment.start_s > 0.0) add("--from-state", state_file_of(key_log).string());
  return arguments;
}

std::vector<std::string> dds_bots_arguments(const Experiment& experiment, const Cell& cell,
                                            const std::filesystem::path& key_log,
                                            const std::string& domain,
                                            const std::filesystem::path& report) {
  std::vector<std::string> arguments = dds_arguments("bots", experiment, cell, key_log, report);
  const auto add = [&arguments](const char* flag, const std::string& value) {
    arguments.insert(arguments.end(), {flag, value});
  };
  add("--domain", domain);
  add("--count", std::to_string(cell.clients));
  add("--view", decimal(cell.parameters.view_fraction));
  if (experiment.view_area > 0.0) add("--view-area", decimal(experiment.view_area));
  add("--view-margin", decimal(cell.parameters.view_margin));
  if (!cell.parameters.extrapolates) arguments.emplace_back("--no-extrapolate");
  if (experiment.start_s > 0.0) add("--start", decimal(experiment.start_s));
  return arguments;
}

std::vector<std::string> bots_arguments(const Experiment& experiment, const Cell& cell,
                                        const std::filesystem::path& key_log,
                                        const std::string& address,
                                        const std::filesystem::path& report) {
  std::vector<std::string> arguments{"--connect", address};
  const auto add = [&arguments](const char* flag, const std::string& value) {
    arguments.insert(arguments.end(), {flag, value});
  };
  add("--transport", to_string(experiment.transport));
  if (experiment.bundles > 1) add("--bundle", std::to_string(experiment.bundles));
  add("--count", std::to_string(cell.clients));
  add("--seed", std::to_string(cell.seed));
  if (experiment.keys == KeySource::live && experiment.players != "random" &&
      game::is_player_kind(experiment.players)) {
    add("--players", experiment.players);
    add("--scene", experiment.scene);
  } else {
    add("--plan", key_log.string());
  }
  add("--view", decimal(cell.parameters.view_fraction));
  if (experiment.view_area > 0.0) add("--view-area", decimal(experiment.view_area));
  add("--view-margin", decimal(cell.parameters.view_margin));
  if (!has_regions(cell)) arguments.emplace_back("--no-regions");
  if (!cell.parameters.extrapolates) arguments.emplace_back("--no-extrapolate");
  if (experiment.start_s > 0.0) add("--start", decimal(experiment.start_s));
  add("--duration", decimal(experiment.warm_up_s + experiment.duration_s));
  add("--warm-up", decimal(experiment.warm_up_s));
  add("--report", report.string());
  return arguments;
}

}  // namespace rink::loadgen
