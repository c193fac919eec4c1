// Each kind of chart has a file of its own.
#include "loadgen/report/plots/chart_svg.h"

#include <cassert>

#include "loadgen/report/plots/bars.h"
#include "loadgen/report/plots/boxes.h"
#include "loadgen/report/plots/lines.h"

namespace rink::loadgen {

std::string to_svg(const Chart& chart) {
  assert(!chart.lines.empty() + !chart.part_names.empty() + !chart.groups.empty() <= 1);
  if (!chart.part_names.empty()) return svg_of_bars(chart);
  return chart.groups.empty() ? svg_of_lines(chart) : svg_of_boxes(chart);
}

}  // namespace rink::loadgen
