// Replications condensed: means over the seeds of the valid runs, ratios to the unfiltered baseline, and whether all cells played the same game.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "loadgen/run_record.h"

namespace rink::loadgen {

/// A figure over replications. Absent (no value in `mean`) unless every valid run has it: a mean over the runs that happened to support a percentile
/// would favour the quiet ones.
struct Statistic {
  std::optional<double> mean;
  std::optional<double> deviation;  ///< sample standard deviation (n - 1); absent for fewer than two runs
  std::optional<double> min, max;
};

/// One figure of a run: the column's name in summary.csv, its unit being part of it, and how to read it.
struct Figure {
  const char* name;
  std::optional<double> (*of)(const RunRecord&);
};

/// All figures that are summarised, in the order of summary.csv.
std::span<const Figure> figures();

/// What all replications of one mode x scheme x policy x clients say.
struct SummaryRow {
  std::string mode, scheme, policy;
  std::uint32_t clients = 0;
  std::size_t valid_runs = 0, invalid_runs = 0;
  std::vector<Statistic> statistics;             ///< one per figure, in the order of `figures()`
  std::optional<double> down_bytes_ratio_to_none;  ///< mean down bytes / those of scheme `none` with the same mode, policy and clients

  /// The statistic of the figure called `name`, which must be one of `figures()`.
  const Statistic& of(const char* name) const;
};

/// One row per mode x scheme x policy x clients, in order of first appearance but with clients ascending last. Invalid runs are counted, never averaged in.
std::vector<SummaryRow> summarise(std::span<const RunRecord> runs);

/// Whether runs that were given the same keys ended in the same state. Only valid runs with replayed keys take part; those of one seed (and, when the
/// population follows the clients, of one client count) are compared.
struct Agreement {
  std::size_t games = 0;             ///< games that two or more runs played
  std::vector<std::string> differing;  ///< for each game whose runs differ: its name and the hashes seen
};
Agreement agreement_of(std::span<const RunRecord> runs);

/// The rows as CSV (RFC 4180): mode, scheme, policy, clients, valid_runs, invalid_runs, down_bytes_ratio_to_none, then NAME_mean, NAME_sd, NAME_min and
/// NAME_max of every figure. What is absent is empty.
std::string to_csv(std::span<const SummaryRow> rows);

}  // namespace rink::loadgen
