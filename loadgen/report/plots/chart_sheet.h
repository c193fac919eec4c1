// The sheet of every chart: title, legend, frame and axes.
#pragma once

#include <string>
#include <vector>

#include "loadgen/report/plots/chart.h"

namespace rink::loadgen {

/// Draws one thing after the other, each over those before it.
class ChartSheet {
 public:
  /// The data's axes run along the sides of `room`, which moves down by what `legend` takes.
  ChartSheet(const Chart& chart, const std::vector<LegendEntry>& legend, const Frame& room,
             const Axis& x, const Axis& y);

  const Frame& frame() const { return frame_; }
  const Axis& x() const { return x_; }
  const Axis& y() const { return y_; }

  void draw(const std::string& svg) { svg_ += svg; }
  void draw_x_axis(bool has_grid = false);
  void draw_y_axis();
  /// The whole picture, with room `below` the axis x and its title.
  std::string finished(double below = 0.0) const;

 private:
  const Chart& chart_;
  Frame frame_;
  Axis x_, y_;
  std::string svg_;
};

}  // namespace rink::loadgen
