// Where everything was in the runs of a report, for programs that judge them again.
#pragma once

#include <cstddef>
#include <filesystem>

namespace rink::loadgen {

/// Plays each valid run of the report folder that left evidence again and writes
/// cells/NAME.truth.jsonl (loadgen/measure/truth/trace.h). Returns how many. Throws
/// ReportFolderError if the folder is not as it was written, game::TraceError if evidence
/// contradicts itself, std::runtime_error if a file cannot be written.
std::size_t write_traces(const std::filesystem::path& folder);

}  // namespace rink::loadgen
