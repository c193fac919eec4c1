// Sorts runs into lines of plots over client counts, each point the replications of one cell.
#pragma once

#include <concepts>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "loadgen/measure/run_record.h"
#include "loadgen/measure/statistics/statistics.h"
#include "loadgen/report/plots/svg.h"

namespace rink::loadgen {

/// How to read a figure of a run, and the range of its values.
class FigureOf {
 public:
  using Reader = std::optional<double> (*)(const RunRecord&);
  template <std::convertible_to<Reader> Read>
  constexpr FigureOf(Read read, Scale values = Scale::positive)
      : scale(values), read_(read) {}  // a function that reads is a figure
  std::optional<double> operator()(const RunRecord& run) const { return read_(run); }

  Scale scale;

 private:
  Reader read_;
};

/// A mean with its 95 % interval (`interval_of_mean`), which is absent for a single value.
struct MeanInterval {
  double mean = 0.0;
  std::optional<std::pair<double, double>> interval{};
};
/// `values` must not be empty.
MeanInterval mean_interval(const std::vector<double>& values, Scale scale = Scale::positive);

/// The valid replications of one cell, seeds apart.
struct CellGroup {
  Cell cell;  ///< its seed is that of the first run
  std::vector<const RunRecord*> runs;
  std::size_t invalid_runs = 0;

  /// The figure of every run, in the runs' order; empty unless each has it, since a mean over those
  /// that happen to have it would be biased.
  std::vector<double> values(FigureOf figure) const;
  std::optional<MeanInterval> mean(FigureOf figure) const;
};

/// Cells that differ in clients and seed alone.
struct CellLine {
  std::string name;
  Style style;
  std::vector<CellGroup> groups;  ///< clients ascending
};

/// All lines, in order of first appearance. A name has the scheme, the policy if there are several,
/// and whatever else differs between lines of its scheme. Colours follow the scheme, dashes the
/// policy, shapes the line. The runs must outlive the result.
std::vector<CellLine> lines_of(std::span<const RunRecord> runs);

/// Names and styles `lines` as `lines_of` does.
void name_and_style(std::vector<CellLine>& lines);

/// The name of the line in `lines` that `cell` belongs to, empty if none.
std::string line_name(std::span<const CellLine> lines, const Cell& cell);

/// All client counts of `lines`, ascending.
std::vector<std::uint32_t> client_counts(std::span<const CellLine> lines);

/// At most `count` of `values`, the ends among them, so that there are not too many plots.
std::vector<std::uint32_t> thinned(const std::vector<std::uint32_t>& values, std::size_t count);

}  // namespace rink::loadgen
