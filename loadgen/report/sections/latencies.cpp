// Merges the histograms that the bots wrote, cell by cell.
#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "game/model/report_fields.h"
#include "loadgen/report/report.h"

namespace rink::loadgen {
namespace {

CellLatencies& entry_for(std::vector<CellLatencies>& all, Cell cell) {
  cell.seed = 0;
  const auto found = std::find_if(
      all.begin(), all.end(), [&cell](const CellLatencies& other) { return other.cell == cell; });
  if (found != all.end()) return *found;
  return all.emplace_back(CellLatencies{cell, {}, {}, {}});
}

void merge_from(Histogram& into, const nlohmann::json& report, const char* key) {
  const auto found = report.find(key);
  if (found == report.end()) return;
  if (const auto histogram = Histogram::from_json(*found)) into.merge(*histogram);
}

}  // namespace

std::vector<CellLatencies> latencies_in(const std::filesystem::path& cells,
                                        std::span<const RunRecord> runs) {
  std::vector<CellLatencies> result;
  for (const RunRecord& run : runs) {
    if (!run.valid) continue;
    std::ifstream stream(cells / (name_of(run.cell) + ".bots.json"));
    const nlohmann::json report = nlohmann::json::parse(stream, nullptr, false);
    if (!report.is_object()) continue;
    CellLatencies& entry = entry_for(result, run.cell);
    merge_from(entry.update_latency, report, game::report::update_age_ms);
    if (run.keys_trouble.empty())
      merge_from(entry.input_latency, report, game::report::key_to_effect_ms);
    merge_from(entry.discovery_latency, report, "late_entry_ms");
  }
  return result;
}

}  // namespace rink::loadgen
