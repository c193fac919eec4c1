// The figures of a run that several exhibits draw.
#pragma once

#include <optional>

#include "loadgen/run_record.h"

namespace rink::loadgen {

inline std::optional<double> payload(const RunRecord& run) { return run.down_bytes_per_client_per_s; }
inline std::optional<double> on_the_wire(const RunRecord& run) { return run.wire_bytes_per_client_per_s; }
inline std::optional<double> displayed_rms(const RunRecord& run) { return run.truth.displayed_error_mm.rms; }
inline std::optional<double> displayed_p99(const RunRecord& run) { return run.truth.displayed_error_mm.p99; }
inline std::optional<double> filter_precision(const RunRecord& run) { return run.truth.filter_precision; }
inline std::optional<double> filter_recall(const RunRecord& run) { return run.truth.filter_recall; }
inline std::optional<double> delivered_recall(const RunRecord& run) { return run.truth.delivered_recall; }

}  // namespace rink::loadgen
