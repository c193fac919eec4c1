// Lines and scattered marks with error bars over two axes.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "loadgen/report/plots/svg.h"

namespace rink::loadgen {

struct PlotPoint {
  double x = 0.0, y = 0.0;
  std::optional<std::pair<double, double>> y_interval, x_interval;  ///< error bars
  std::string title;  ///< what a pointer held over the mark reads
  std::string
      label{};  ///< written beside the mark where there is room; its title should say the same
};

struct PlotLine {
  std::string name;
  Style style;
  std::vector<PlotPoint> points;
  std::size_t mark_stride = 1;  ///< every so many points have a mark, at least 1
};

/// A faint curve to read the data against, named where it begins or, where another name stands
/// already, farther along.
struct ReferenceCurve {
  std::string name;
  std::vector<std::pair<double, double>> points;
};

/// Points that a logarithmic axis cannot show (not above 0) are left out. The legend wraps above
/// the frame.
struct LinePlot {
  std::string title, x_title, y_title;
  std::string alternative;  ///< what the picture shows, for those who cannot see it
  bool is_x_logarithmic = true, is_y_logarithmic = true;
  std::vector<PlotLine> lines;
  std::vector<ReferenceCurve> references;
  std::optional<Ticks> x_ticks;  ///< instead of the axis' own
  std::optional<std::pair<double, double>> x_range,
      y_range;  ///< instead of the data's; to give several plots the same axis
  double width = 480.0, frame_height = 250.0;
  bool has_legend = true;
};
std::string to_svg(const LinePlot& plot);

/// Whether any point of `plot` can be shown.
bool has_points(const LinePlot& plot);

}  // namespace rink::loadgen
