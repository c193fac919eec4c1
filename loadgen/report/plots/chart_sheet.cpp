// Places the frame below the legend, however many rows that has.
#include "loadgen/report/plots/chart_sheet.h"

#include <cassert>

namespace rink::loadgen {
namespace {

constexpr double legend_top = 34.0, axis_room = 42.0;
constexpr double x_spacing = 40.0, y_spacing = 26.0;  // of the labels of ticks

}  // namespace

ChartSheet::ChartSheet(const Chart& chart, const std::vector<LegendEntry>& legend,
                       const Frame& room, const Axis& x, const Axis& y)
    : chart_(chart), frame_(room), x_(x), y_(y) {
  assert(room.left < room.right && room.top < room.bottom && chart.width > 0.0);
  double taken = 0.0;
  svg_ = svg_legend(legend, 0.0, chart.width, legend_top, taken);
  frame_.top += taken, frame_.bottom += taken;
  x_.from = frame_.left, x_.to = frame_.right;
  y_.from = frame_.bottom, y_.to = frame_.top;
}

void ChartSheet::draw_x_axis(bool has_grid) {
  const Ticks ticks = chart_.x.ticks ? *chart_.x.ticks : ticks_of(x_, x_spacing);
  svg_ += svg_x_axis(frame_, x_, ticks, chart_.x.title, has_grid);
}

void ChartSheet::draw_y_axis() {
  const Ticks ticks = chart_.y.ticks ? *chart_.y.ticks : ticks_of(y_, y_spacing);
  svg_ += svg_y_axis(frame_, y_, ticks, chart_.y.title);
}

std::string ChartSheet::finished(double below) const {
  return svg_opening(chart_.width, frame_.bottom + axis_room + below, chart_.title,
                     chart_.alternative) +
         svg_ + "</svg>\n";
}

}  // namespace rink::loadgen
