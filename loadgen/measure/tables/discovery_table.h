// Late discoveries and missed contacts of each cell, all its replications together, as distribution
// functions.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "loadgen/measure/run_record.h"
#include "loadgen/measure/truth/discovery.h"

namespace rink::loadgen {

struct CellDiscoveries {
  Cell cell;  ///< its seed is unused
  Discoveries discoveries;
};

/// The points of a curve in the table and in plots.
inline constexpr std::size_t discovery_points_max = 200;

/// The file that keeps the delays of the run of `cell` for a campaign that is continued:
/// NAME.discovery.json in `cells`.
std::filesystem::path discovery_file(const std::filesystem::path& cells, const Cell& cell);
/// Throws OutputError.
void write_discoveries(const std::filesystem::path& file, const Discoveries& discoveries);

/// The delays of the valid `runs` of which `cells` has a file, pooled over replications, in the
/// order of the runs; missing or unreadable files are left out.
std::vector<CellDiscoveries> discoveries_in(const std::filesystem::path& cells,
                                            std::span<const RunRecord> runs);

/// A line for each point: the cell's keys, `kind` (late_discovery or missed_contact), `delay_ms`,
/// `fraction` of the sample that took at most so long, `samples`, and how many of them `never`
/// ended. A kind without samples has no line.
std::string discovery_csv(std::span<const CellDiscoveries> cells);

}  // namespace rink::loadgen
