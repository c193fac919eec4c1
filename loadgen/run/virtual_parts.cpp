// Instants, conditions and files of runs in virtual time.
#include "loadgen/run/virtual_parts.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "game/control/key_log_file.h"
#include "game/model/system_reason.h"
#include "loadgen/measure/results.h"
#include "rti/transport/modelled/link_stream.h"

namespace rink::loadgen {

std::optional<RunRecord> recorded(const Experiment& experiment, const Cell& cell,
                                  const std::function<void(RunRecord&)>& run) {
  RunRecord record = record_for(experiment, cell);
  try {
    run(record);
  } catch (const Failure& failure) {
    record.why_invalid = failure.why;
  } catch (const game::SceneError& error) {
    throw ExperimentError(error.what());
  } catch (const Interrupted&) {
    return std::nullopt;
  }
  return record;
}

std::int64_t not_before(double instant_s) {
  auto instant_ns = static_cast<std::int64_t>(std::floor(1e9 * instant_s)) - 1;
  while (1e-9 * static_cast<double>(instant_ns) < instant_s) ++instant_ns;
  return instant_ns;
}

rti::NetworkConditions network_conditions(const Experiment& experiment, const Cell& cell) {
  rti::NetworkConditions conditions = experiment.network;
  if (!experiment.network_is_modelled)
    conditions.to_listener.latency_ns = conditions.from_listener.latency_ns =
        nanoseconds(1e-3 * experiment.delay_ms);
  conditions.seed = rti::LinkStream::key_of(conditions.seed, cell.seed);
  conditions.partitions.clear();
  return conditions;
}

std::int64_t settling_ns(const Experiment& experiment) {
  const rti::NetworkConditions& network = experiment.network;
  const std::int64_t delay_ns = nanoseconds(1e-3 * experiment.delay_ms);
  if (!experiment.network_is_modelled) return delay_ns;
  const std::int64_t longest_ns =
      std::max({delay_ns, network.to_listener.longest_ns(), network.from_listener.longest_ns()});
  return std::max(delay_ns,
                  std::min(longest_ns + 2 * rti::NetworkModel::timeout_min_ns, second_ns));
}

void write_json(const std::filesystem::path& file, const nlohmann::ordered_json& content) {
  errno = 0;
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  stream << content.dump(2) << '\n' << std::flush;
  if (!stream)
    throw OutputError(file.string() + ": cannot be written: " + game::system_reason(errno));
}

std::vector<game::InputEvent> keys_in(const std::filesystem::path& key_log,
                                      const game::Scene& scene) {
  if (key_log.empty()) return {};
  game::KeyLog log = game::read_key_log(key_log);
  game::require_fit(log, scene, key_log);
  game::require_keys_alone(log, key_log, "an experiment");
  return std::move(log.events);
}

}  // namespace rink::loadgen
