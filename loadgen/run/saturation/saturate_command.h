// `rink compare --saturate`: the search for saturation, for every scheme and policy of an
// experiment.
#pragma once

#include <functional>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "loadgen/run/campaign.h"
#include "loadgen/run/saturation/saturation.h"

namespace rink::loadgen {

/// The result of one search.
struct Saturation {
  Cell cell;  ///< as in every probe, but for clients and seed
  Search search;
  std::optional<RunRecord>
      edge;  ///< the last run of `search.held` clients that held: cost and bytes at saturation
  std::string why;  ///< why `search.failed` clients did not hold, by the last run; empty if none
                    ///< failed
  std::optional<double>
      predicted;  ///< clients by the cost of the probes below the edge (capacities_of); nothing if
                  ///< they are of fewer than three numbers
  std::uint32_t predicted_from = 0;  ///< the largest number of clients among those probes
};

/// Runs `cell` and keeps its record. Nothing if it was interrupted. Throws OutputError if the
/// record cannot be kept.
using CellRunning = std::function<std::optional<RunRecord>(const Cell& cell)>;
/// Called after each search with all that ended so far, an interrupted one last, so that nothing is
/// lost.
using SaturationKeeping = std::function<void(std::span<const Saturation> found)>;

/// Where the search for `experiment` starts, and its ceiling: the least and the largest of its
/// clients, the latter replaced by `most` unless that is 0.
SearchLimits search_limits(const Experiment& experiment, std::uint32_t most, double resolution);

/// How a search probes.
struct SaturationProbing {
  const ServiceLevel& level;
  const SearchLimits& limits;
  CellRunning run;
  std::ostream& out;                     ///< receives a line for each probe
  std::span<const RunRecord> earlier{};  ///< runs of an interrupted search, not run again
};

/// Searches once for each of the experiment's cells that differ in more than clients and seed. The
/// first probe of a number of clients has the experiment's first seed, each repetition the next
/// whole number.
std::vector<Saturation> saturate(const Experiment& experiment, const SaturationProbing& probing,
                                 const SaturationKeeping& keep);

/// The options of `--saturate`.
struct SaturateOptions {
  bool is_wanted = false;
  ServiceLevel level;
  std::uint32_t most = 0;  ///< never more clients than this; 0: the experiment's largest number
  double resolution = 0.1;
  std::uint32_t allowed_clients = 0xffffffffu;  ///< the most that the limit on open files allows
};

/// Searches with real runs, each appended to the results, and writes saturation.csv and
/// saturation.json after each search; `found` are the results so far. The outcome holds all probes.
/// Throws ExperimentError if the scene cannot serve the first probe, or under a virtual clock,
/// where no tick is ever late.
CampaignResult run_saturation(const Campaign& campaign, const SaturateOptions& options,
                              std::ostream& out, std::vector<Saturation>& found);

/// The result in words, e.g. "at least 400", "905", "none".
std::string held_text(const Search& search);

/// The predicted clients and the largest number that the prediction used, e.g. "850 (400)"; "-" if
/// there is none.
std::string predicted_text(const Saturation& saturation);

/// saturation.csv (RFC 4180): a line per search, with cost per tick by part and bytes at the edge.
std::string to_csv(std::span<const Saturation> found);
/// saturation.json: the same, every probe and the service level.
std::string to_json_text(std::span<const Saturation> found, const ServiceLevel& level,
                         const SearchLimits& limits);
/// For a terminal, at most 120 columns.
std::string table_of(std::span<const Saturation> found, const ServiceLevel& level);

}  // namespace rink::loadgen
