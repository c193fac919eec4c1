// Writes the page last, so that a page always has its plots and tables.
#include "loadgen/report/write_report.h"

#include <system_error>

namespace rink::loadgen {

void write_report(const ResultsDirectory& results, const Experiment& experiment,
                  std::span<const RunRecord> runs, const Provenance& provenance,
                  std::span<const ReportSection> more_sections) {
  const Report report = report_of(experiment, runs, provenance,
                                  {.latencies = latencies_in(results.path() / "cells", runs),
                                   .discoveries = discoveries_in(results.path() / "cells", runs),
                                   .sections = more_sections});
  const std::filesystem::path plots = results.subdirectory("plots");
  std::error_code ignored;  // a file that cannot be removed is overwritten or stays
  for (const auto& entry : std::filesystem::directory_iterator(plots, ignored)) {
    const auto ending = entry.path().extension();
    if (ending == ".csv" || ending == ".svg")
      std::filesystem::remove(entry.path(),
                              ignored);  // plots of earlier runs that this report does not have
  }
  for (const PlotTable& table : report.tables)
    results.write("plots/" + table.name + ".csv", to_csv(table, provenance));
  for (const Picture& picture : report.pictures)
    results.write("plots/" + picture.name + ".svg", to_file(picture));
  results.write("report.html", report.html);
}

}  // namespace rink::loadgen
