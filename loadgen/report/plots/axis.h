// Axes of a plot: from values to coordinates, and the places of ticks.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace rink::loadgen {

/// Maps the values `low` to `high` to the coordinates `from` to `to`. A logarithmic axis has 0 <
/// low < high.
struct Axis {
  double low = 0.0, high = 1.0;
  double from = 0.0, to = 1.0;
  bool is_logarithmic = false;

  double at(double value) const;
  /// The coordinate, clamped to the ends; a value that a logarithmic axis cannot show gets its low
  /// end.
  double clamped_at(double value) const;
};

struct Ticks {
  std::vector<std::pair<double, std::string>> major;  ///< places and labels
  std::vector<double> minor;
};

/// 1, 2 or 5 times a power of ten apart on a linear axis; 1, 2 and 5 of each decade on a
/// logarithmic one, the decades alone where that is too many to read, with the other digits as
/// minor ticks. Labels are at least `spacing` coordinates apart.
Ticks ticks_of(const Axis& axis, double spacing);

/// The axis that shows `low` to `high` with a little air; a logarithmic one spans at least
/// `least_ratio`, lest a small difference fill the plot. A linear one starts at 0 unless a value
/// lies below it.
Axis axis_around(double low, double high, bool is_logarithmic, double least_ratio = 10.0);

}  // namespace rink::loadgen
