// Reads the delays that runs recorded, merges them by cell, writes lines.
#include "loadgen/measure/tables/discovery_table.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "game/model/report_schema.h"
#include "game/model/system_reason.h"
#include "loadgen/experiment/cell_key.h"
#include "loadgen/experiment/csv_number.h"
#include "loadgen/measure/results.h"

namespace rink::loadgen {
namespace {

std::optional<Discoveries> read(const std::filesystem::path& file) {
  std::ifstream stream(file);
  const nlohmann::json written = nlohmann::json::parse(stream, nullptr, false);
  if (!written.is_object() || written.value("schema", nlohmann::json()) != game::report_schema ||
      !written.contains("late_discovery") || !written.contains("missed_contact") ||
      !written.contains("displayed_error"))
    return std::nullopt;
  const auto late = SampleDistribution::from_json(written["late_discovery"]),
             missed = SampleDistribution::from_json(written["missed_contact"]);
  const auto errors = SampleDistribution::from_json(written["displayed_error"]);
  if (!late || !missed || !errors) return std::nullopt;
  return Discoveries{*late, *missed, *errors};
}

void append(std::string& csv, const std::string& names, const char* kind,
            const SampleDistribution& delays) {
  for (const SampleDistribution::Point& point : delays.distribution(discovery_points_max))
    csv += names + kind + "," + csv_number(point.thousandths) + "," + csv_number(point.fraction) +
           "," + std::to_string(delays.samples()) + "," + std::to_string(delays.never()) + "\n";
}

}  // namespace

std::filesystem::path discovery_file(const std::filesystem::path& cells, const Cell& cell) {
  return cells / (name_of(cell) + ".discovery.json");
}

void write_discoveries(const std::filesystem::path& file, const Discoveries& discoveries) {
  const nlohmann::ordered_json content{{"schema", game::report_schema},
                                       {"late_discovery", discoveries.late_discovery.to_json()},
                                       {"missed_contact", discoveries.missed_contact.to_json()},
                                       {"displayed_error", discoveries.displayed_error.to_json()}};
  errno = 0;
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  stream << content.dump() << '\n' << std::flush;
  if (!stream)
    throw OutputError(file.string() + ": cannot be written: " + game::system_reason(errno));
}

std::vector<CellDiscoveries> discoveries_in(const std::filesystem::path& cells,
                                            std::span<const RunRecord> runs) {
  std::vector<CellDiscoveries> all;
  for (const RunRecord& run : runs) {
    const auto own = run.valid ? read(discovery_file(cells, run.cell)) : std::nullopt;
    if (!own) continue;
    const Cell cell = without_seed(run.cell);
    const auto found = std::ranges::find(all, cell, &CellDiscoveries::cell);
    if (found == all.end()) all.push_back({cell, *own});
    else found->discoveries.merge(*own);
  }
  return all;
}

std::string discovery_csv(std::span<const CellDiscoveries> cells) {
  std::string csv = cell_csv_heading() + ",kind,delay_ms,fraction,samples,never\n";
  for (const CellDiscoveries& each : cells) {
    append(csv, cell_csv(each.cell) + ",", "late_discovery", each.discoveries.late_discovery);
    append(csv, cell_csv(each.cell) + ",", "missed_contact", each.discoveries.missed_contact);
  }
  return csv;
}

}  // namespace rink::loadgen
