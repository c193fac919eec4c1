// Puts the report, its plots and the tables behind them into the folder of results.
#pragma once

#include "loadgen/measure/results.h"
#include "loadgen/report/report.h"

namespace rink::loadgen {

/// Writes report.html, plots/NAME.csv and plots/NAME.svg; whole histograms are taken from cells/.
/// Growth is read off the runs. Throws OutputError.
void write_report(const ResultsDirectory& results, const Experiment& experiment,
                  std::span<const RunRecord> runs, const Provenance& provenance,
                  std::span<const ReportSection> more_sections = {});

}  // namespace rink::loadgen
