// The figures of a run that the comparison with the true state gives.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "loadgen/measure/statistics/histogram.h"

namespace rink::loadgen {

/// Root mean square, percentiles and maximum of distances [mm]; entities that were put back since
/// their last update are counted apart.
struct ErrorFigures {
  std::optional<double> rms, p99, max;
  std::optional<double> p50{}, p90{};
  std::optional<std::uint64_t> replaced_samples{};  ///< left out of all the above
  std::optional<double> replaced_rms{};             ///< of those
};

/// Quality of a run by its replay (docs/metrics.md); all absent if there was no trace.
struct TruthFigures {
  std::optional<double> filter_precision, filter_recall, delivered_precision, delivered_recall;
  std::optional<std::uint64_t> interactions, missed_interactions;  ///< of the watched players' bats
  Percentiles late_entry_ms;
  ErrorFigures position_error_mm, displayed_error_mm;
  std::optional<double> churn_per_client_per_s, flapping_fraction, wasted_bytes_fraction,
      control_bytes_fraction, fairness_jain;
  std::string relevance;  ///< the definition of true relevance in words, e.g. "square of 3.16 m
                          ///< around the bat, touched by the entity's box"
  std::string
      error;  ///< why the figures are absent; empty if they are not, or if no evidence was taken
};

}  // namespace rink::loadgen
