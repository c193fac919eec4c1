// The growth of a tick's cost and of bytes with clients, pucks and bats, from the runs of an
// experiment.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "loadgen/measure/run_record.h"
#include "loadgen/measure/statistics/linear_fit.h"
#include "loadgen/measure/statistics/power_fit.h"

namespace rink::loadgen {

/// A number of a cell over which cost may grow.
struct GrowthFactor {
  const char* name;
  std::uint32_t Cell::*number;
};
inline constexpr std::array growth_factors{GrowthFactor{"clients", &Cell::clients},
                                           GrowthFactor{"pucks", &Cell::pucks},
                                           GrowthFactor{"bats", &Cell::bats}};

/// One line of growth.csv: how `figure` of one scheme and policy grows with `factor` while all else
/// stays.
struct Growth {
  std::string mode, scheme, policy;
  std::string factor;  ///< clients, pucks or bats
  std::string held;    ///< the others' values, for a reader, e.g. "100 bats, 1000 pucks"
  std::string figure;  ///< the column of runs.jsonl, e.g. filter_us_per_tick; total_us_per_tick is
                       ///< the sum of the three parts
  PowerFit fit;
  LinearFit line;               ///< a constant and a proportional part
  bool is_line_better = false;  ///< of the two the one with the smaller residual of the logarithms
  double most = 0.0;            ///< largest number that ran
  double period_us = 0.0;       ///< of a tick
};

/// All growths that the valid runs show: wherever one of clients, pucks and bats takes three or
/// more values while the other two, mode, scheme, policy, parameters and cores are the same.
/// Replications over seeds are kept as points of their own.
std::vector<Growth> growths_of(std::span<const RunRecord> runs);

/// As CSV (RFC 4180), a line each; what is absent is empty.
std::string to_csv(std::span<const Growth> growths);

/// How many clients a server holds by the better of the two fits.
struct Capacity {
  Growth growth;  ///< of the tick's percentile over clients
  double fraction =
      0.99;  ///< of the ticks that end within their period: .9 where too few ran for .99
  std::optional<double> clients;  ///< whole; nothing if no number of clients fills a tick
};

/// One for each scheme and policy whose clients grow and of which such a percentile is known.
std::vector<Capacity> capacities_of(std::span<const Growth> growths);

/// The capacities in words, a line each; empty if there is none. A capacity beyond the runs is
/// marked as an extrapolation.
std::string capacity_text(std::span<const Growth> growths);

/// As text for a terminal, at most 100 columns; empty if there is none.
std::string growth_table(std::span<const Growth> growths);

}  // namespace rink::loadgen
