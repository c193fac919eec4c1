// Puts the report and the tables behind its plots into the folder of results.
#pragma once

#include "loadgen/report/report.h"
#include "loadgen/results.h"

namespace rink::loadgen {

/// Writes report.html and plots/NAME.csv; whole histograms are taken from cells/. Growth is read off the runs. Throws OutputError.
void write_report(const ResultsDirectory& results, const Experiment& experiment, std::span<const RunRecord> runs, const Provenance& provenance,
                  std::span<const ReportSection> more_sections = {});

}  // namespace rink::loadgen
