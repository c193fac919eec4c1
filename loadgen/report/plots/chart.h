// A chart as plain data: its axes, and lines, bars or boxes over them.
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
  std::string title;                                                ///< the tooltip of the mark
  std::string
      label{};  ///< written beside the mark where there is room; its title should contain it
};

struct PlotLine {
  std::string name;
  Style style;
  std::vector<PlotPoint> points;
  std::size_t mark_stride = 1;  ///< every so many points have a mark, at least 1
};

/// A faint reference curve, named where it begins or, if another name is there already, farther
/// along.
struct ReferenceCurve {
  std::string name;
  std::vector<std::pair<double, double>> points;
};

struct Bar {
  std::string name;
  std::vector<double> parts;
  std::string flag;  ///< written above the bar, e.g. that it was too much
};

/// A value to compare bars with.
struct BarMark {
  double value = 0.0;
  std::string name;
};

struct BoxRow {
  std::string name;
  Style style;
  std::vector<double> values;
};

struct BoxGroup {
  std::string name;
  std::vector<BoxRow> rows;
};

struct ChartAxis {
  std::string title{};
  bool is_logarithmic = false;
  std::optional<std::pair<double, double>>
      range{};                   ///< instead of the data's; to give several charts the same axis
  std::optional<Ticks> ticks{};  ///< instead of the axis' own
};

/// Of one kind:
/// Lines and scattered marks with error bars. Points that a logarithmic axis cannot show (not above
/// 0) are left out.
/// Bars, if there are `part_names`: their parts are stacked in that order (the page's classes p0 to
/// p3), each bar named below, or numbered with the names in a list where one is wider than its
/// bar's place.
/// Boxes, if there are `groups`: rows that lie, so that their names can be read. Every value is a
/// dot; a box is drawn around five or more, since fewer are told by their dots alone.
/// The legend wraps above the frame; boxes have none, and no axis y.
struct Chart {
  std::string title{};
  ChartAxis x{}, y{};
  std::string alternative{};  ///< a description for readers who cannot see the picture
  double width = 480.0, frame_height = 250.0;
  bool has_legend = true;

  std::vector<PlotLine> lines{};
  std::vector<ReferenceCurve> references{};

  std::vector<std::string> part_names{};
  std::vector<Bar> bars{};
  std::optional<BarMark> mark{};  ///< a dashed line across, if it lies within the axis

  std::vector<BoxGroup> groups{};
};

}  // namespace rink::loadgen
