// Computes the figures of a run from its processes' reports, and decides whether the run counts.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "loadgen/measure/run_record.h"

namespace rink::loadgen {

/// Fills `record` from the reports of the server and the bots and judges it. It is valid if both
/// reports are complete and valid themselves, both counted the same clients and rate as the cell,
/// no client was lost, every due key was sent, and payload and kernel counts agree within 1 %. Keys
/// sent too late (`Measurements::schedule_trouble`) cost it only the figures of keys where a server
/// applies the planned keys at their instants whenever they come, and all elsewhere. In virtual
/// time there is neither a kernel nor a clock to measure costs by: such figures may be null in the
/// reports and stay absent.
void judge(RunRecord& record, const nlohmann::json& server_report,
           const nlohmann::json& bots_report);

}  // namespace rink::loadgen
