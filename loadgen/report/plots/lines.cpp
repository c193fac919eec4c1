// Draws reference curves, error bars, lines, marks and their labels, in this order, so that data
// cover their labels.
#include "loadgen/report/plots/lines.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "loadgen/report/plots/chart_sheet.h"

namespace rink::loadgen {
namespace {

bool is_shown(const Chart& chart, double x, double y) {
  return std::isfinite(x) && std::isfinite(y) && (!chart.x.is_logarithmic || x > 0.0) &&
         (!chart.y.is_logarithmic || y > 0.0);
}

Axis fitted_axis(const Chart& chart, bool is_x) {
  const ChartAxis& wanted = is_x ? chart.x : chart.y;
  const bool is_logarithmic = wanted.is_logarithmic;
  if (wanted.range) return {wanted.range->first, wanted.range->second, 0.0, 1.0, is_logarithmic};
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const PlotLine& line : chart.lines) {
    for (const PlotPoint& point : line.points) {
      if (!is_shown(chart, point.x, point.y)) continue;
      const double value = is_x ? point.x : point.y;
      const auto& interval = is_x ? point.x_interval : point.y_interval;
      // An interval may reach to 0 and beyond, which a logarithmic axis would follow for ever: a
      // third of the mean is far enough.
      low = std::min(
          {low, value,
           interval ? std::max(interval->first, is_logarithmic ? value / 3.0 : interval->first)
                    : value});
      high = std::max({high, value, interval ? std::min(interval->second, 3.0 * value) : value});
    }
  }
  if (high < low) return axis_around(1.0, 10.0, is_logarithmic);
  return axis_around(low, high, is_logarithmic, is_x ? 4.0 : 10.0);
}

/// Bars end in a cap where the interval does; where the axis ends first, they run into its end
/// without one.
std::string error_bars(const PlotPoint& point, const std::string& colour, const Axis& x,
                       const Axis& y) {
  constexpr double cap = 3.0;
  const std::string classes = "whisker " + colour;
  const double px = x.clamped_at(point.x), py = y.clamped_at(point.y);
  const auto is_on = [](const Axis& axis, double value) {
    return value >= axis.low && value <= axis.high;
  };
  std::string path;
  if (point.y_interval && point.y_interval->second > point.y_interval->first) {
    const double low = y.clamped_at(point.y_interval->first),
                 high = y.clamped_at(point.y_interval->second);
    path += "M" + coordinate(px) + " " + coordinate(low) + "V" + coordinate(high);
    for (const double end : {point.y_interval->first, point.y_interval->second})
      if (is_on(y, end))
        path +=
            "M" + coordinate(px - cap) + " " + coordinate(y.at(end)) + "H" + coordinate(px + cap);
  }
  if (point.x_interval && point.x_interval->second > point.x_interval->first) {
    const double low = x.clamped_at(point.x_interval->first),
                 high = x.clamped_at(point.x_interval->second);
    path += "M" + coordinate(low) + " " + coordinate(py) + "H" + coordinate(high);
    for (const double end : {point.x_interval->first, point.x_interval->second})
      if (is_on(x, end))
        path +=
            "M" + coordinate(x.at(end)) + " " + coordinate(py - cap) + "V" + coordinate(py + cap);
  }
  return path.empty() ? "" : svg_path(path, classes);
}

std::string data_of(const Chart& chart, const Axis& x, const Axis& y) {
  std::string lines, marks;
  for (const PlotLine& line : chart.lines) {
    const std::string colour = "s" + std::to_string(line.style.colour % colour_count);
    std::string path;
    assert(line.mark_stride > 0);
    for (std::size_t i = 0; i < line.points.size(); ++i) {
      const PlotPoint& point = line.points[i];
      if (!is_shown(chart, point.x, point.y)) continue;
      path += (path.empty() ? "M" : "L") + coordinate(x.clamped_at(point.x)) + " " +
              coordinate(y.clamped_at(point.y));
      marks += error_bars(point, colour, x, y);
      if ((i + 1) % line.mark_stride == 0)
        marks += svg_marker(line.style, x.clamped_at(point.x), y.clamped_at(point.y), point.title);
    }
    if (path.find('L') != std::string::npos)
      lines += svg_path(path, "line " + colour + " d" + std::to_string(line.style.dash % 4));
  }
  return lines + marks;
}

/// The box that a text or mark takes.
struct Box {
  double left, top, right, bottom;
  bool overlaps(const Box& other) const {
    return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
  }
};

/// Of a line of 10.5 px letters whose left end is at (left, middle).
Box note_box(double left, double middle, const std::string& words) {
  return {left, middle - 6.0, left + 0.85 * text_width(words), middle + 6.0};
}

/// True if `box` lies within the frame and overlaps no `taken` box; it is taken then, too.
bool takes_place(const Box& box, const Axis& x, const Axis& y, std::vector<Box>& taken) {
  const bool is_inside =
      x.from <= box.left && box.right <= x.to && y.to <= box.top && box.bottom <= y.from;
  if (!is_inside || std::any_of(taken.begin(), taken.end(),
                                [&box](const Box& other) { return box.overlaps(other); }))
    return false;
  taken.push_back(box);
  return true;
}

/// Puts each label diagonally off its mark, where no error bar runs, or else beside it, at the
/// first free place; leaves it out if all are taken.
std::string labels_of(const Chart& chart, const Axis& x, const Axis& y, std::vector<Box> taken) {
  const auto for_each_shown = [&](const auto& visit) {
    for (const PlotLine& line : chart.lines)
      for (const PlotPoint& point : line.points)
        if (is_shown(chart, point.x, point.y))
          visit(x.clamped_at(point.x), y.clamped_at(point.y), point.label);
  };
  for_each_shown([&](double px, double py, const std::string&) {
    taken.push_back({px - 5.0, py - 5.0, px + 5.0, py + 5.0});
  });
  std::string svg;
  for_each_shown([&](double px, double py, const std::string& label) {
    if (label.empty()) return;
    const double width = 0.85 * text_width(label);
    const double right = px + 6.0, on_left = px - 6.0 - width;
    for (const auto& [left, middle] : {std::pair{right, py - 8.0},
                                       {right, py + 9.0},
                                       {on_left, py - 8.0},
                                       {on_left, py + 9.0},
                                       {right + 2.0, py},
                                       {on_left - 2.0, py}}) {
      if (!takes_place(note_box(left, middle, label), x, y, taken)) continue;
      svg += svg_text(left, middle + 4.0, "note", label);
      return;
    }
  });
  return svg;
}

/// Each curve's name stands where it begins or, if another's does already, farther along it; left
/// out if there is no place at all.
std::string references_of(const Chart& chart, const Axis& x, const Axis& y,
                          std::vector<Box>& taken) {
  std::string svg;
  for (const ReferenceCurve& curve : chart.references) {
    std::string path;
    std::vector<std::pair<double, double>> places;
    for (const auto& [value_x, value_y] : curve.points) {
      if (!is_shown(chart, value_x, value_y) || value_x < x.low || value_x > x.high ||
          value_y < y.low || value_y > y.high)
        continue;
      const double px = x.at(value_x), py = y.at(value_y);
      path += (path.empty() ? "M" : "L") + coordinate(px) + " " + coordinate(py);
      places.emplace_back(px + 6.0, py + 6.0);
    }
    if (places.size() < 2) continue;
    svg += svg_path(path, "reference");
    const auto place = std::ranges::find_if(places, [&](const auto& at) {
      return takes_place(note_box(at.first, at.second, curve.name), x, y, taken);
    });
    if (place != places.end())
      svg += svg_text(place->first, place->second + 4.0, "note", curve.name);
  }
  return svg;
}

}  // namespace

bool has_points(const Chart& chart) {
  return std::any_of(chart.lines.begin(), chart.lines.end(), [&chart](const PlotLine& line) {
    return std::any_of(line.points.begin(), line.points.end(), [&chart](const PlotPoint& point) {
      return is_shown(chart, point.x, point.y);
    });
  });
}

std::string svg_of_lines(const Chart& chart) {
  std::vector<LegendEntry> entries;
  for (const PlotLine& line : chart.lines) {
    if (chart.has_legend) entries.push_back({line.name, line.style, ""});
  }
  constexpr double top = 52.0;
  ChartSheet sheet(chart, entries, {50.0, chart.width - 14.0, top, top + chart.frame_height},
                   fitted_axis(chart, true), fitted_axis(chart, false));
  sheet.draw_y_axis();
  sheet.draw_x_axis();
  std::vector<Box> taken;
  sheet.draw(references_of(chart, sheet.x(), sheet.y(), taken));
  sheet.draw(data_of(chart, sheet.x(), sheet.y()));
  sheet.draw(labels_of(chart, sheet.x(), sheet.y(), taken));
  return sheet.finished();
}

}  // namespace rink::loadgen
