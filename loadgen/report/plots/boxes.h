// Horizontal box plots over replications, so that their names can be read.
#pragma once

#include <string>
#include <vector>

#include "loadgen/report/plots/chart.h"

namespace rink::loadgen {

/// The figures of a box plot (Tukey, Exploratory Data Analysis, 1977, 2): hinges are the medians of
/// the halves, each including the middle value of an odd sample; whiskers end at the outermost
/// values within 1.5 hinge spreads of the hinges; values beyond are outside.
struct BoxFigures {
  double low_whisker = 0.0, low_hinge = 0.0, median = 0.0, high_hinge = 0.0, high_whisker = 0.0;
  std::vector<double> outside;
};

/// `sample` must not be empty.
BoxFigures box_of(std::vector<double> sample);

inline constexpr std::size_t least_for_box = 5;

std::string svg_of_boxes(const Chart& chart);

}  // namespace rink::loadgen
