// Box plots over replications, lying, so that their names can be read.
#pragma once

#include <string>
#include <vector>

#include "loadgen/report/plots/svg.h"

namespace rink::loadgen {

/// What a box plot draws of a sample (Tukey, Exploratory Data Analysis, 1977, 2): hinges are the
/// medians of the halves, each holding the middle value of an odd sample; whiskers end at the
/// outermost values within 1.5 hinge spreads of the hinges; what lies beyond is outside.
struct BoxFigures {
  double low_whisker = 0.0, low_hinge = 0.0, median = 0.0, high_hinge = 0.0, high_whisker = 0.0;
  std::vector<double> outside;
};

/// `sample` must not be empty.
BoxFigures box_of(std::vector<double> sample);

/// Rows in groups. Every value is a dot; a box is drawn around five or more, since fewer are told
/// by their dots alone.
struct BoxPlot {
  static constexpr std::size_t least_for_box = 5;
  struct Row {
    std::string name;
    Style style;
    std::vector<double> values;
  };
  struct Group {
    std::string name;
    std::vector<Row> rows;
  };
  std::string title, x_title;
  std::string alternative;  ///< what the picture shows, for those who cannot see it
  bool is_logarithmic = true;
  std::vector<Group> groups;
  double width = 480.0;
};
std::string to_svg(const BoxPlot& plot);

}  // namespace rink::loadgen
