// Bars made of stacked parts, one beside the other.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "loadgen/report/plots/svg.h"

namespace rink::loadgen {

/// Bars whose parts are stacked in the order of `part_names` (the page's classes p0 to p3), each
/// bar named below, or numbered with the names in a list where one is wider than its bar's place.
struct BarPlot {
  struct Bar {
    std::string name;
    std::vector<double> parts;
    std::string flag;  ///< written above the bar, e.g. that it was too much
  };
  std::string title, x_title, y_title;
  std::string alternative;  ///< what the picture shows, for those who cannot see it
  std::vector<std::string> part_names;
  std::vector<Bar> bars;
  std::optional<double> y_high;  ///< instead of the data's; to give several plots the same axis
  std::optional<double> mark;    ///< a dashed line across, if it lies within the axis
  std::string mark_name;
  double width = 380.0, frame_height = 190.0;
};
std::string to_svg(const BarPlot& plot);

}  // namespace rink::loadgen
