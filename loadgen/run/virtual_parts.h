// Helpers of runs in virtual time: instants, the network of an experiment, and files.
#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "game/model/key.h"
#include "game/model/scene.h"
#include "loadgen/experiment/experiment.h"
#include "loadgen/measure/run_record.h"
#include "loadgen/run/run_ending.h"
#include "rti/transport/modelled/network_model.h"

namespace rink::loadgen {

/// The record of `cell`, which `run` fills; nothing if it throws Interrupted. Throws
/// ExperimentError if the scene or the key log cannot be read.
std::optional<RunRecord> recorded(const Experiment& experiment, const Cell& cell,
                                  const std::function<void(RunRecord&)>& run);

/// The server's name in the network of a run.
inline constexpr const char* server_name = "server";

inline constexpr std::int64_t second_ns = 1'000'000'000;

inline std::int64_t nanoseconds(double seconds) { return std::llround(1e9 * seconds); }
/// The first whole nanosecond that is not before `instant_s` on a clock that shows 1e-9 times its
/// nanoseconds.
std::int64_t not_before(double instant_s);

/// The network's conditions, with random numbers of the replication's own. Cuts count from the
/// start, which is not known yet, so there are none.
rti::NetworkConditions network_conditions(const Experiment& experiment, const Cell& cell);
/// The time that one packet may take if it is lost once or twice, without waiting for others. At
/// the end all are silent meanwhile, so four of these must stay below the RTI's timeout.
std::int64_t settling_ns(const Experiment& experiment);

/// Throws OutputError.
void write_json(const std::filesystem::path& file, const nlohmann::ordered_json& content);
/// The keys of a log that must fit `scene`; none if there is no log. Throws game::SceneError.
std::vector<game::InputEvent> keys_in(const std::filesystem::path& key_log,
                                      const game::Scene& scene);

}  // namespace rink::loadgen
