// Tukey's five figures and their drawing.
#include "loadgen/report/plots/boxes.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <span>

#include "loadgen/report/plots/chart_sheet.h"
#include "loadgen/report/plots/text.h"

namespace rink::loadgen {
namespace {

constexpr double row_height = 17.0, name_height = 14.0, group_height = 22.0;

double median_of(std::span<const double> sorted) {
  assert(!sorted.empty());
  const std::size_t half = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[half] : 0.5 * (sorted[half - 1] + sorted[half]);
}

std::string svg_row(const BoxRow& row, const Axis& x, double y) {
  if (row.values.empty()) return "";
  const std::string colour = "s" + std::to_string(row.style.colour % colour_count);
  std::string svg;
  if (row.values.size() >= least_for_box) {
    const BoxFigures box = box_of(row.values);
    svg += svg_line(x.clamped_at(box.low_whisker), y, x.clamped_at(box.high_whisker), y,
                    "whisker " + colour);
    const double left = x.clamped_at(box.low_hinge), right = x.clamped_at(box.high_hinge);
    svg += "<rect" +
           attributes({{"x", left}, {"y", y - 5.5}, {"width", right - left}, {"height", 11.0}}) +
           " class=\"box " + colour + "\"/>\n";
    svg += svg_line(x.clamped_at(box.median), y - 5.5, x.clamped_at(box.median), y + 5.5,
                    "median " + colour);
  }
  for (const double value : row.values) {
    svg += "<circle" + attributes({{"cx", x.clamped_at(value)}, {"cy", y}, {"r", 2.4}}) +
           " class=\"dot " + colour + "\"><title>" +
           escaped(row.name + ": " + short_number(value)) + "</title></circle>\n";
  }
  return svg;
}

Axis value_axis(const Chart& chart) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const BoxGroup& group : chart.groups) {
    for (const BoxRow& row : group.rows) {
      for (const double value : row.values) {
        if (chart.x.is_logarithmic && value <= 0.0) continue;
        low = std::min(low, value);
        high = std::max(high, value);
      }
    }
  }
  return high < low ? axis_around(1.0, 10.0, chart.x.is_logarithmic)
                    : axis_around(low, high, chart.x.is_logarithmic, 4.0);
}

}  // namespace

BoxFigures box_of(std::vector<double> sample) {
  assert(!sample.empty());
  std::sort(sample.begin(), sample.end());
  const std::size_t half = (sample.size() + 1) / 2;
  BoxFigures box;
  box.median = median_of(sample);
  box.low_hinge = median_of(std::span(sample).first(half));
  box.high_hinge = median_of(std::span(sample).last(half));
  const double reach = 1.5 * (box.high_hinge - box.low_hinge);
  const auto is_outside = [&](double value) {
    return value < box.low_hinge - reach || value > box.high_hinge + reach;
  };
  box.low_whisker = *std::find_if_not(sample.begin(), sample.end(), is_outside);
  box.high_whisker = *std::find_if_not(sample.rbegin(), sample.rend(), is_outside);
  std::copy_if(sample.begin(), sample.end(), std::back_inserter(box.outside), is_outside);
  assert(box.low_hinge <= box.median && box.median <= box.high_hinge);
  assert(box.low_whisker <= box.high_whisker && box.outside.size() < sample.size());
  return box;
}

std::string svg_of_boxes(const Chart& chart) {
  double names_width = 0.0, height = 4.0, rows = 0.0;
  for (const BoxGroup& group : chart.groups) {
    height += group.name.empty() ? 6.0 : group_height;
    for (const BoxRow& row : group.rows)
      ++rows, names_width = std::max(names_width, text_width(row.name));
  }
  const bool are_names_above =
      names_width + 14.0 > 0.6 * chart.width;  // long ones would leave no room for the data
  const double above = are_names_above ? name_height : 0.0;
  height += rows * (row_height + above);
  ChartSheet sheet(
      chart, {},
      {are_names_above ? 14.0 : names_width + 14.0, chart.width - 14.0, 28.0, 28.0 + height},
      value_axis(chart), {});
  const Frame& frame = sheet.frame();
  sheet.draw_x_axis(true);
  double y = frame.top + 4.0;
  for (const BoxGroup& group : chart.groups) {
    y += group.name.empty() ? 6.0 : group_height;
    if (!group.name.empty()) sheet.draw(svg_text(0.0, y - 6.0, "axis", group.name));
    for (const BoxRow& row : group.rows) {
      sheet.draw(are_names_above ? svg_text(0.0, y + 11.0, "tick", fitted(row.name, chart.width))
                                 : svg_text(frame.left - 8.0, y + 0.5 * row_height + 4.0,
                                            "tick end", row.name));
      sheet.draw(svg_row(row, sheet.x(), y + above + 0.5 * row_height));
      y += row_height + above;
    }
  }
  return sheet.finished();
}

}  // namespace rink::loadgen
