// Writes all true positions in the runs of a report, for programs that check the figures.
#pragma once

#include <cstddef>
#include <filesystem>

namespace rink::loadgen {

/// Replays each valid run of the report folder that has traces and writes cells/NAME.truth.jsonl
/// (loadgen/measure/truth/trace.h). Returns how many. Throws ReportFolderError if the folder was
/// altered, game::TraceError if a trace contradicts itself, std::runtime_error if a file cannot be
/// written.
std::size_t write_traces(const std::filesystem::path& folder);

}  // namespace rink::loadgen
