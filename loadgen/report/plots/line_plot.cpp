// Draws reference curves, error bars, lines, marks and their labels, in this order, so that data
// cover what is said about them.
#include "loadgen/report/plots/line_plot.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace rink::loadgen {
namespace {

bool is_shown(const LinePlot& plot, double x, double y) {
  return std::isfinite(x) && std::isfinite(y) && (!plot.is_x_logarithmic || x > 0.0) &&
         (!plot.is_y_logarithmic || y > 0.0);
}

Axis fitted_axis(const LinePlot& plot, bool is_x) {
  const auto& fixed = is_x ? plot.x_range : plot.y_range;
  const bool is_logarithmic = is_x ? plot.is_x_logarithmic : plot.is_y_logarithmic;
  if (fixed) return {fixed->first, fixed->second, 0.0, 1.0, is_logarithmic};
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const PlotLine& line : plot.lines) {
    for (const PlotPoint& point : line.points) {
      if (!is_shown(plot, point.x, point.y)) continue;
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

std::string data_of(const LinePlot& plot, const Axis& x, const Axis& y) {
  std::string lines, marks;
  for (const PlotLine& line : plot.lines) {
    const std::string colour = "s" + std::to_string(line.style.colour % colour_count);
    std::string path;
    for (std::size_t i = 0; i < line.points.size(); ++i) {
      const PlotPoint& point = line.points[i];
      if (!is_shown(plot, point.x, point.y)) continue;
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

/// What text or mark takes.
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

/// Whether `box` lies within the frame and on nothing that is `taken`; if so it is taken too.
bool takes_place(const Box& box, const Axis& x, const Axis& y, std::vector<Box>& taken) {
  const bool is_inside =
      x.from <= box.left && box.right <= x.to && y.to <= box.top && box.bottom <= y.from;
  if (!is_inside || std::any_of(taken.begin(), taken.end(),
                                [&box](const Box& other) { return box.overlaps(other); }))
    return false;
  taken.push_back(box);
  return true;
}

/// Aslant of its mark, where no error bar runs, or else beside it, wherever nothing stands yet;
/// left out if all places are taken.
std::string labels_of(const LinePlot& plot, const Axis& x, const Axis& y, std::vector<Box> taken) {
  const auto for_each_shown = [&](const auto& visit) {
    for (const PlotLine& line : plot.lines)
      for (const PlotPoint& point : line.points)
        if (is_shown(plot, point.x, point.y))
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
std::string references_of(const LinePlot& plot, const Axis& x, const Axis& y,
                          std::vector<Box>& taken) {
  std::string svg;
  for (const ReferenceCurve& curve : plot.references) {
    std::string path;
    std::vector<std::pair<double, double>> places;
    for (const auto& [value_x, value_y] : curve.points) {
      if (!is_shown(plot, value_x, value_y) || value_x < x.low || value_x > x.high ||
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

bool has_points(const LinePlot& plot) {
  return std::any_of(plot.lines.begin(), plot.lines.end(), [&plot](const PlotLine& line) {
    return std::any_of(line.points.begin(), line.points.end(), [&plot](const PlotPoint& point) {
      return is_shown(plot, point.x, point.y);
    });
  });
}

std::string to_svg(const LinePlot& plot) {
  std::vector<LegendEntry> entries;
  for (const PlotLine& line : plot.lines) {
    if (plot.has_legend) entries.push_back({line.name, line.style, ""});
  }
  double above = 52.0;
  const std::string legend = svg_legend(entries, 0.0, plot.width, 34.0, above);
  const Frame frame{50.0, plot.width - 14.0, above, above + plot.frame_height};
  Axis x = fitted_axis(plot, true), y = fitted_axis(plot, false);
  x.from = frame.left, x.to = frame.right;
  y.from = frame.bottom, y.to = frame.top;
  std::string svg =
      svg_opening(plot.width, frame.bottom + 42.0, plot.title, plot.alternative) + legend;
  svg += svg_y_axis(frame, y, ticks_of(y, 26.0), plot.y_title);
  svg += svg_x_axis(frame, x, plot.x_ticks ? *plot.x_ticks : ticks_of(x, 40.0), plot.x_title);
  std::vector<Box> taken;
  svg += references_of(plot, x, y, taken);
  return svg + data_of(plot, x, y) + labels_of(plot, x, y, taken) + "</svg>\n";
}

}  // namespace rink::loadgen
