// Replications condensed: means over the seeds of the valid runs with intervals, ratios to the
// baseline, and whether all cells played the same game.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "loadgen/measure/run_record.h"
#include "loadgen/measure/statistics/statistics.h"

namespace rink::loadgen {

/// A figure over replications. Absent (no value in `mean`) unless every valid run has it: a mean
/// over the runs that happened to support a percentile would favour the quiet ones.
struct Statistic {
  std::optional<double> mean;
  std::optional<double>
      deviation;  ///< sample standard deviation (n - 1); absent for fewer than two runs
  std::optional<double> min, max;
  std::optional<Interval> interval;  ///< of the mean; absent for fewer than two runs
};

/// One figure of a run: the column's name in summary.csv, its unit being part of it, how to read
/// it, and what values it can have: but for fractions 0 or more.
struct Figure {
  const char* name;
  std::optional<double> (*of)(const RunRecord&);
  Scale scale = Scale::positive;
};

/// All figures that are summarised, in the order of summary.csv.
std::span<const Figure> figures();

/// The summary of all replications of a cell; its seed is unused.
struct SummaryRow : Cell {
  std::size_t valid_runs = 0, invalid_runs = 0;
  std::string
      relevance;  ///< the definition of true relevance, in words; empty if no run was compared with
                  ///< truth
  std::vector<Statistic> statistics;  ///< one per figure, in the order of `figures()`
  std::vector<std::optional<Ratio>>
      ratios;  ///< one per figure, in the same order: to the baseline cell (`baseline_of`), paired
               ///< by seed; absent without one and for the baseline itself

  /// The statistic of the figure called `name`, which must be one of `figures()`.
  const Statistic& of(const char* name) const;
  /// Its ratio to the baseline.
  const std::optional<Ratio>& ratio(const char* name) const;
};

/// One row per cell but for the seed, in order of first appearance, grouped by mode, then by
/// ascending clients, then by pucks, bats and cores. Invalid runs are counted, never averaged in.
std::vector<SummaryRow> summarise(std::span<const RunRecord> runs, const Baseline& baseline = {});

/// The comparison of final states of runs with the same keys. Only valid runs with replayed keys
/// take part; those of one seed (and, when the population follows the clients, of one client count)
/// are compared.
struct Agreement {
  std::size_t games = 0;  ///< games that two or more runs played
  std::vector<std::string>
      differing;  ///< for each game whose runs differ: its name and the hashes seen
};
Agreement agreement_of(std::span<const RunRecord> runs);

/// The rows as CSV (RFC 4180): the cell's keys, valid_runs, invalid_runs, relevance, then
/// NAME_mean, NAME_sd, NAME_low and NAME_high (the 95 % interval of the mean), NAME_min and
/// NAME_max of every figure. What is absent is empty.
std::string to_csv(std::span<const SummaryRow> rows);

/// Every ratio as CSV, a line each: the cell's keys, the figure, ratio to the baseline, its 95 %
/// interval, the pairs (seeds) behind it, and in words whether it differs.
std::string comparisons_csv(std::span<const SummaryRow> rows, const Baseline& baseline);

}  // namespace rink::loadgen
