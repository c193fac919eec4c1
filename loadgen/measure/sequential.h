// Adds replications until intervals are narrow enough, with the correction for repeated looks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "loadgen/measure/summary.h"

namespace rink::loadgen {

/// Intervals of fewer replications are not considered.
inline constexpr std::uint32_t least_replications = 3;
/// The default limit.
inline constexpr std::uint32_t replications_max = 100;

/// The confidence of the interval that is looked at for the `look`-th time, from 1 on, so that all
/// looks together err with a probability of at most 5 %: 0.05 x 6 / (pi look)^2, of which the sum
/// over all looks is 0.05 (Boole's inequality with the weights of Robbins, Annals of Mathematical
/// Statistics 41, 1970).
double confidence_of_look(std::uint32_t look);

/// A row whose interval is too wide.
struct WideRow {
  std::size_t runs = 0;
  std::string words;  ///< which, and how wide
};

/// Rows whose interval of the payload's mean, at the confidence of the `look`-th look, is wider on
/// either side than `width` of the mean, or that have no interval.
std::vector<WideRow> wider_rows(std::span<const SummaryRow> rows, double width, std::uint32_t look);

/// 0.05 for "5%" or "0.05". Throws ExperimentError unless the value is above 0 and below 1.
double width_in(const std::string& text);

}  // namespace rink::loadgen
