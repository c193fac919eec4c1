// One bracketing search per scheme, policy and parameters; every probe is an ordinary run.
#include "loadgen/run/saturation/saturate_command.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <system_error>

#include "game/control/key_log_file.h"
#include "loadgen/measure/formatted.h"
#include "loadgen/measure/growth.h"
#include "loadgen/run/game_plan.h"

namespace rink::loadgen {
namespace {

std::string title_of(const Cell& cell) {
  const std::string variant = variant_of(cell);
  return cell.scheme + ", " + cell.policy + (variant.empty() ? "" : ", " + variant);
}

std::string figures_text(const RunRecord& record) {
  const auto age = record.update_age_ms.p99 ? record.update_age_ms.p99 : record.update_age_ms.max;
  return formatted("%.4g %% of ticks on time, age %s %.3g ms",
                   100.0 * record.ticks_on_time_fraction.value_or(0.0),
                   record.update_age_ms.p99 ? "p99" : "max", age.value_or(0.0));
}

/// One search and the runs of its probes.
class SaturationSearch {
 public:
  SaturationSearch(const Cell& cell, const SaturationProbing& probing) : probing_(probing) {
    found_.cell = cell;
  }

  Saturation find() {
    found_.search = find_largest(
        probing_.limits,
        [this](std::uint32_t clients, std::uint32_t attempt) { return probe(clients, attempt); });
    for (const RunRecord& record : records_) {
      const Judgement judgement = judgement_of(record, probing_.level);
      if (record.cell.clients == found_.search.held && judgement.verdict == Verdict::holds)
        found_.edge = record;
      if (record.cell.clients == found_.search.failed && judgement.verdict != Verdict::holds)
        found_.why = judgement.why;
    }
    predict();
    return std::move(found_);
  }

 private:
  std::optional<Verdict> probe(std::uint32_t clients, std::uint32_t attempt) {
    Cell cell = found_.cell;
    cell.clients = clients;
    cell.seed += attempt;
    const auto before = std::ranges::find_if(
        probing_.earlier, [&cell](const RunRecord& record) { return record.cell == cell; });
    const bool is_known = before != probing_.earlier.end();
    const std::optional<RunRecord> record = is_known ? std::optional(*before) : probing_.run(cell);
    if (!record) return std::nullopt;
    const Judgement judgement = judgement_of(*record, probing_.level);
    const char* verdict =
        judgement.verdict == Verdict::holds
            ? " clients hold: "
            : (judgement.verdict == Verdict::fails ? " clients fail: "
                                                   : " clients, does not count: ");
    probing_.out << title_of(cell) << ": " << clients << verdict
                 << (judgement.verdict == Verdict::holds ? figures_text(*record) : judgement.why)
                 << (is_known ? " (measured before)" : "") << "\n"
                 << std::flush;
    records_.push_back(*record);
    return judgement.verdict;
  }

  /// The edge itself and larger crowds are left out, since a fit through them would use the answer.
  void predict() {
    std::vector<RunRecord> below;
    std::ranges::copy_if(records_, std::back_inserter(below), [this](const RunRecord& record) {
      return record.cell.clients < found_.search.held.value_or(0);
    });
    for (const Capacity& capacity : capacities_of(growths_of(below))) {
      found_.predicted = capacity.clients;
      found_.predicted_from = static_cast<std::uint32_t>(capacity.growth.most);
    }
  }

  const SaturationProbing& probing_;
  Saturation found_;
  std::vector<RunRecord> records_;
};

}  // namespace

SearchLimits search_limits(const Experiment& experiment, std::uint32_t most, double resolution) {
  const auto [least, largest] =
      std::minmax_element(experiment.clients.begin(), experiment.clients.end());
  SearchLimits limits{
      .first = *least, .most = most > 0 ? most : *largest, .resolution = resolution};
  limits.first = std::min(limits.first, limits.most);
  return limits;
}

std::vector<Saturation> saturate(const Experiment& experiment, const SaturationProbing& probing,
                                 const SaturationKeeping& keep) {
  Experiment one = experiment;
  one.clients = {probing.limits.first};
  one.seeds = {experiment.seeds.front()};
  std::vector<Saturation> found;
  for (const Cell& cell : cells_of(one)) {
    found.push_back(SaturationSearch(cell, probing).find());
    probing.out << title_of(cell) << ": " << held_text(found.back().search) << "\n" << std::flush;
    keep(found);
    if (found.back().search.end == SearchEnd::interrupted) break;
  }
  return found;
}

CampaignResult run_saturation(const Campaign& campaign, const SaturateOptions& options,
                              std::ostream& out, std::vector<Saturation>& found) {
  const Experiment& experiment = campaign.experiment;
  if (!experiment.parts.empty())
    throw ExperimentError("experiment " + experiment.name +
                          ": it has several parts; a search for the largest number of clients "
                          "needs an experiment without [[parts]]");
  if (experiment.transport == TransportKind::virtual_time) {
    throw ExperimentError("experiment " + experiment.name +
                          ": transport = \"virtual\": under a virtual clock no tick is ever late, "
                          "so nothing saturates; allowed are \"tcp\", \"udp\", \"shm\"");
  }
  SearchLimits limits = search_limits(experiment, options.most, options.resolution);
  if (options.allowed_clients < limits.most) {
    out << "the limit on open files allows " << options.allowed_clients << " clients instead of "
        << limits.most << "\n";
    limits.most = options.allowed_clients;
    limits.first = std::min(limits.first, limits.most);
  }
  CampaignResult outcome;
  const std::filesystem::path keys = campaign.results.subdirectory("keys");
  const CellRunning run = [&](const Cell& cell) -> std::optional<RunRecord> {
    const std::filesystem::path key_log = keys / (name_of(cell) + ".keys");
    campaign.write_key_log(cell, key_log);
    const auto record = run_cell(campaign.settings, experiment, cell, key_log);
    std::error_code ignored;
    std::filesystem::remove(state_file_of(key_log), ignored);
    std::filesystem::remove(key_log, ignored);  // its seed reproduces it, and plans of thousands of
                                                // players fill a disk
    if (!record) return std::nullopt;
    outcome.runs.push_back(*record);
    campaign.results.append(*record);
    return record;
  };
  const SaturationKeeping keep = [&](std::span<const Saturation> so_far) {
    found.assign(so_far.begin(), so_far.end());
    campaign.results.write("saturation.csv", to_csv(so_far));
    campaign.results.write("saturation.json", to_json_text(so_far, options.level, limits));
  };
  try {
    saturate(experiment, {.level = options.level, .limits = limits, .run = run, .out = out}, keep);
    outcome.was_interrupted = !found.empty() && found.back().search.end == SearchEnd::interrupted;
  } catch (const OutputError& error) {
    outcome.output_failure = error.what();
  }
  return outcome;
}

}  // namespace rink::loadgen
