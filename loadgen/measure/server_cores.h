// Compares the server on a processor of its own with both programs on any processor.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "loadgen/measure/run_record.h"
#include "loadgen/measure/statistics/statistics.h"

namespace rink::loadgen {

/// One figure of runs in which both programs ran wherever the kernel put them, as a multiple of the
/// same figure with the two apart. Runs are paired by seed.
struct CoresRatio {
  Cell cell;  ///< the pairs' common cell; seed and server_cores are those of the first run
  std::string figure;  ///< a column of runs.jsonl, or total_us_per_tick
  Ratio ratio;         ///< anywhere / apart
};

/// All ratios that the valid runs show, for each cell run with server_cores 1 and 2.
std::vector<CoresRatio> cores_ratios_of(std::span<const RunRecord> runs);

/// As CSV (RFC 4180), a line each; what is absent is empty.
std::string to_csv(std::span<const CoresRatio> ratios);
/// For a terminal, at most 100 columns; empty if there is none.
std::string cores_table(std::span<const CoresRatio> ratios);

}  // namespace rink::loadgen
