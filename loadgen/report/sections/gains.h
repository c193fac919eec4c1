// The savings by a filter and an update policy, alone and together, each against the named
// baseline.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "loadgen/measure/statistics/statistics.h"
#include "loadgen/report/sections/section_content.h"

namespace rink::loadgen {

/// The ratio of `figure` of `baseline` to that of `own`, paired by seed since both played the same
/// game. Nothing if no seed has both, or one of them is not above 0.
std::optional<Ratio> paired_ratio(const CellGroup& baseline, const CellGroup& own, FigureOf figure);

/// One cell beside the baseline of its client count.
struct Gain {
  enum class Kind : std::uint8_t { baseline, filter_alone, policy_alone, together, parameters };
  Kind kind = Kind::baseline;
  const CellLine* line = nullptr;
  const CellGroup* group = nullptr;
  std::optional<Ratio> bytes;  ///< how many times fewer
};

/// Every cell whose client count (and pucks, bats, cores, mode) has a baseline cell: the
/// experiment's baseline scheme and policy. In the order of the lines within a client count. They
/// point into `findings`.
std::vector<Gain> gains_of(const Findings& findings);

/// The largest gain at the largest client count in a sentence with its error; empty if there is no
/// notable gain.
std::string headline_of(const Findings& findings);

}  // namespace rink::loadgen
