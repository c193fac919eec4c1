// Lines of runs, each begun by what names its cell.
#include "loadgen/report/tidy.h"

#include "loadgen/experiment/csv_number.h"
#include "loadgen/experiment/csv_text.h"
#include "loadgen/experiment/parameter.h"
#include "loadgen/measure/summary.h"
#include "loadgen/report/dictionary.h"

namespace rink::loadgen {
namespace {

std::string names_of_run(const RunRecord& run) {
  const Cell& cell = run.cell;
  std::string names;
  for (const std::string& text : {cell.part, cell.mode, cell.scheme, cell.policy})
    names += csv_text(text) + ",";
  for (const std::uint32_t count : {cell.clients, cell.pucks, cell.bats, cell.server_cores})
    names += std::to_string(count) + ",";
  for (const ParameterKind& kind : parameter_kinds())
    names += csv_number(kind.of(cell.parameters)) + ",";
  return names + std::to_string(cell.seed) + (run.valid ? ",true," : ",false,");
}

}  // namespace

std::string tidy_csv(std::span<const RunRecord> runs) {
  std::string csv = "part,mode,scheme,policy,clients,pucks,bats,server_cores";
  for (const ParameterKind& kind : parameter_kinds()) csv += std::string(",") + kind.key;
  csv += ",seed,valid,figure,unit,value\n";
  for (const RunRecord& run : runs) {
    const std::string names = names_of_run(run);
    for (const Figure& figure : figures()) {
      if (const auto value = figure.of(run))
        csv += names + figure.name + "," + unit_of(figure.name) + "," + csv_number(value) + "\n";
    }
  }
  return csv;
}

}  // namespace rink::loadgen
