// Writes a line for each figure of a run, which begins with the cell's keys.
#include "loadgen/report/tidy.h"

#include "loadgen/experiment/cell_key.h"
#include "loadgen/experiment/csv_number.h"
#include "loadgen/measure/summary.h"
#include "loadgen/report/dictionary.h"

namespace rink::loadgen {

std::string tidy_csv(std::span<const RunRecord> runs) {
  std::string csv = cell_csv_heading() + ",seed,valid,figure,unit,value\n";
  for (const RunRecord& run : runs) {
    const std::string names = cell_csv(run.cell) + "," + std::to_string(run.cell.seed) +
                              (run.valid ? ",true," : ",false,");
    for (const Figure& figure : figures()) {
      if (const auto value = figure.of(run))
        csv += names + figure.name + "," + unit_of(figure.name) + "," + csv_number(value) + "\n";
    }
  }
  return csv;
}

}  // namespace rink::loadgen
