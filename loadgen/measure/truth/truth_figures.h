// What truth finds out about a run, as figures.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "loadgen/measure/statistics/histogram.h"

namespace rink::loadgen {

/// Root mean square, percentiles and maximum of distances [mm]; apart from them, what had been put
/// back since it was last heard of.
struct ErrorFigures {
  std::optional<double> rms, p99, max;
  std::optional<double> p50{}, p90{};
  std::optional<std::uint64_t> replaced_samples{};  ///< left out of all the above
  std::optional<double> replaced_rms{};             ///< of those
};

/// What a re-simulation of the run says about its quality (docs/metrics.md); all absent if there
/// was no evidence.
struct TruthFigures {
  std::optional<double> filter_precision, filter_recall, delivered_precision, delivered_recall;
  std::optional<std::uint64_t> interactions, missed_interactions;  ///< of the watched players' bats
  Percentiles late_entry_ms;
  ErrorFigures position_error_mm, displayed_error_mm;
  std::optional<double> churn_per_client_per_s, flapping_fraction, wasted_bytes_fraction,
      control_bytes_fraction, fairness_jain;
  std::string relevance;  ///< what truth calls relevant, for a reader, e.g. "square of 3.16 m
                          ///< around the bat, touched by the entity's box"
  std::string
      error;  ///< why the figures are absent; empty if they are not, or if no evidence was taken
};

}  // namespace rink::loadgen
