// Axes, ticks, lines, whiskers, bars and labels.
#include "loadgen/svg_plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace rink::loadgen {
namespace {

std::string coordinate(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

std::string attributes(std::initializer_list<std::pair<const char*, double>> pairs) {
  std::string text;
  for (const auto& [name, value] : pairs) text += std::string(" ") + name + "=\"" + coordinate(value) + "\"";
  return text;
}

std::string svg_text(double x, double y, const std::string& classes, const std::string& content, const std::string& more = "") {
  return "<text" + attributes({{"x", x}, {"y", y}}) + " class=\"" + classes + "\"" + more + ">" + escaped(content) + "</text>\n";
}

std::string svg_line(double x1, double y1, double x2, double y2, const std::string& classes) {
  return "<line" + attributes({{"x1", x1}, {"y1", y1}, {"x2", x2}, {"y2", y2}}) + " class=\"" + classes + "\"/>\n";
}

/// Maps values of one axis to coordinates.
struct Axis {
  double low = 0.0, high = 1.0, from = 0.0, to = 1.0;
  bool is_logarithmic = false;
  double at(double value) const {
    const double share = is_logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
    return from + share * (to - from);
  }
};

std::vector<double> linear_ticks(double high) {
  const double rough = high / 5.0, decade = std::pow(10.0, std::floor(std::log10(rough)));
  const double step = decade * (rough / decade > 5.0 ? 10.0 : rough / decade > 2.0 ? 5.0 : rough / decade > 1.0 ? 2.0 : 1.0);
  std::vector<double> ticks;
  for (double tick = 0.0; tick <= high * 1.0001; tick += step) ticks.push_back(tick);
  return ticks;
}

/// 1, 2 and 5 of each decade, or the decades alone if that were too many to read.
std::vector<double> logarithmic_ticks(double low, double high) {
  const bool is_wide = high / low > 2e3;
  std::vector<double> ticks;
  for (double decade = std::pow(10.0, std::floor(std::log10(low))); decade <= high; decade *= 10.0) {
    for (const double digit : {1.0, 2.0, 5.0}) {
      if (is_wide && digit != 1.0) continue;
      if (decade * digit >= low * 0.9999 && decade * digit <= high * 1.0001) ticks.push_back(decade * digit);
    }
  }
  return ticks;
}

struct Frame {
  double left, right, top, bottom;
};

std::string opening(double width, double height, const std::string& title) {
  return "<svg viewBox=\"0 0 " + coordinate(width) + " " + coordinate(height) + "\" role=\"img\" aria-label=\"" + escaped(title) +
         "\" xmlns=\"http://www.w3.org/2000/svg\">\n" + svg_text(0.0, 15.0, "title", title);
}

std::string axis_titles(const Frame& frame, double height, const std::string& x_title, const std::string& y_title) {
  return svg_text((frame.left + frame.right) / 2.0, height - 6.0, "axis middle", x_title) + svg_text(0.0, 33.0, "axis", y_title);
}

std::string y_grid(const Axis& axis, const std::vector<double>& ticks, const Frame& frame) {
  std::string svg;
  for (const double tick : ticks) {
    svg += svg_line(frame.left, axis.at(tick), frame.right, axis.at(tick), "grid");
    svg += svg_text(frame.left - 6.0, axis.at(tick) + 4.0, "tick end", short_number(tick));
  }
  return svg;
}

/// A marker whose shape, not only its colour, tells the series.
std::string marker(std::size_t style, double x, double y) {
  const std::string classes = " class=\"mark s" + std::to_string(style % 6) + "\"";
  switch (style % 3) {
    case 0: return "<circle" + attributes({{"cx", x}, {"cy", y}, {"r", 4.0}}) + classes + "/>\n";
    case 1: return "<rect" + attributes({{"x", x - 3.8}, {"y", y - 3.8}, {"width", 7.6}, {"height", 7.6}}) + classes + "/>\n";
    default:
      return "<path d=\"M" + coordinate(x) + " " + coordinate(y - 5.0) + "l4.8 8.6h-9.6z\"" + classes + "/>\n";
  }
}

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = 0.0;
  void take(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

bool is_shown(const LinePlot& plot, const Series::Point& point) {
  return std::isfinite(point.y) && (!plot.is_y_logarithmic || point.y > 0.0) && (!plot.is_x_logarithmic || point.x > 0.0);
}

Axis x_axis(const LinePlot& plot, const Frame& frame) {
  Range range;
  for (const auto& [x, text] : plot.x_ticks) range.take(x);
  if (plot.x_ticks.empty()) range.low = range.high = 1.0;
  if (plot.is_x_logarithmic) return {range.low / 1.25, range.high * 1.25, frame.left, frame.right, true};
  return {range.low - 0.35, range.high + 0.35, frame.left, frame.right, false};
}

Axis y_axis(const LinePlot& plot, const Frame& frame) {
  Range range;
  for (const Series& series : plot.series) {
    for (const Series::Point& point : series.points) {
      if (is_shown(plot, point)) range.take(point.y);
    }
  }
  if (range.high == 0.0) range = {1.0, 10.0};
  if (!plot.is_y_logarithmic) return {0.0, plot.y_high.value_or(range.high * 1.08), frame.bottom, frame.top, false};
  double low = plot.y_low.value_or(range.low), high = plot.y_high.value_or(range.high);
  // At least a decade, lest a small difference fill the plot.
  if (high / low < 10.0) {
    const double widening = std::sqrt(10.0 * low / high);
    low /= widening;
    high *= widening;
  }
  return {low / 1.15, high * 1.15, frame.bottom, frame.top, true};
}

std::string lines_of(const LinePlot& plot, const Axis& x, const Axis& y) {
  std::string svg;
  for (const Series& series : plot.series) {
    const std::string style = std::to_string(series.style % 6);
    std::string path, marks;
    for (const Series::Point& point : series.points) {
      if (!is_shown(plot, point)) continue;
      path += (path.empty() ? "M" : "L") + coordinate(x.at(point.x)) + " " + coordinate(y.at(point.y));
      if (point.high > point.low && (!plot.is_y_logarithmic || point.low > 0.0)) {
        marks += svg_line(x.at(point.x), y.at(point.low), x.at(point.x), y.at(point.high), "whisker s" + style);
      }
      marks += marker(series.style, x.at(point.x), y.at(point.y));
    }
    if (!path.empty()) svg += "<path d=\"" + path + "\" class=\"line s" + style + "\"/>\n" + marks;
  }
  return svg;
}

/// Names at the right ends, pushed apart downwards so that none covers another.
std::string direct_labels(const LinePlot& plot, const Axis& x, const Axis& y, const Frame& frame) {
  struct Label {
    double y, x;
    const Series* series;
  };
  std::vector<Label> labels;
  for (const Series& series : plot.series) {
    const auto last = std::find_if(series.points.rbegin(), series.points.rend(), [&](const auto& point) { return is_shown(plot, point); });
    if (last != series.points.rend()) labels.push_back({y.at(last->y), x.at(last->x), &series});
  }
  std::sort(labels.begin(), labels.end(), [](const Label& a, const Label& b) { return a.y < b.y; });
  const double spacing = 15.0;
  for (std::size_t i = 1; i < labels.size(); ++i) labels[i].y = std::max(labels[i].y, labels[i - 1].y + spacing);
  double lowest = frame.bottom;
  for (std::size_t i = labels.size(); i-- > 0; lowest = labels[i].y - spacing) labels[i].y = std::min(labels[i].y, lowest);
  std::string svg;
  for (const Label& label : labels) {
    svg += svg_text(frame.right + 6.0, label.y + 4.0, "label s" + std::to_string(label.series->style % 6), label.series->name);
  }
  return svg;
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char letter : text) {
    switch (letter) {
      case '&': safe += "&amp;"; break;
      case '<': safe += "&lt;"; break;
      case '>': safe += "&gt;"; break;
      case '"': safe += "&quot;"; break;
      case '\'': safe += "&#39;"; break;
      default: {
        const bool is_control = static_cast<unsigned char>(letter) < 0x20 && letter != '\n' && letter != '\t';
        safe += is_control ? std::string("\xEF\xBF\xBD") : std::string(1, letter);
      }
    }
  }
  return safe;
}

std::string short_number(double value) {
  const char* unit = "";
  for (const char* larger : {" k", " M", " G"}) {
    if (std::abs(value) < 999.5) break;
    value /= 1000.0;
    unit = larger;
  }
  char text[32];
  std::snprintf(text, sizeof text, "%.3g%s", value, unit);
  return text;
}

std::string to_svg(const LinePlot& plot) {
  std::size_t longest = 0;
  for (const Series& series : plot.series) longest = std::max(longest, series.name.size());
  const double label_width = plot.has_direct_labels ? 16.0 + 7.6 * static_cast<double>(longest) : 10.0;
  const Frame frame{52.0, plot.width - label_width, 44.0, plot.height - 42.0};
  const Axis x = x_axis(plot, frame), y = y_axis(plot, frame);
  std::string svg = opening(plot.width, plot.height, plot.title) + axis_titles(frame, plot.height, plot.x_title, plot.y_title);
  svg += y_grid(y, y.is_logarithmic ? logarithmic_ticks(y.low, y.high) : linear_ticks(y.high), frame);
  for (const auto& [value, text] : plot.x_ticks) {
    svg += svg_line(x.at(value), frame.bottom, x.at(value), frame.bottom + 4.0, "base");
    svg += svg_text(x.at(value), frame.bottom + 17.0, "tick middle", text);
  }
  svg += svg_line(frame.left, frame.bottom, frame.right, frame.bottom, "base") + lines_of(plot, x, y);
  if (plot.has_direct_labels) svg += direct_labels(plot, x, y, frame);
  return svg + "</svg>\n";
}

std::string to_svg(const StackedBars& plot) {
  Range range;
  std::size_t slots = 0;
  for (const auto& group : plot.groups) {
    slots += group.bars.size() + 1;
    for (const auto& bar : group.bars) {
      double sum = 0.0;
      for (const double part : bar.parts) sum += part;
      range.take(sum);
    }
  }
  const Frame frame{52.0, plot.width - 10.0, 62.0, plot.height - 84.0};
  const Axis y{0.0, range.high > 0.0 ? range.high * 1.05 : 1.0, frame.bottom, frame.top, false};
  std::string svg = opening(plot.width, plot.height, plot.title) + axis_titles(frame, plot.height, plot.x_title, plot.y_title);
  double legend_x = frame.left;
  for (std::size_t part = 0; part < plot.part_names.size(); ++part) {
    svg += "<rect" + attributes({{"x", legend_x}, {"y", 42.0}, {"width", 11.0}, {"height", 11.0}}) + " class=\"bar p" + std::to_string(part % 3) + "\"/>\n";
    svg += svg_text(legend_x + 16.0, 52.0, "tick", plot.part_names[part]);
    legend_x += 34.0 + 7.0 * static_cast<double>(plot.part_names[part].size());
  }
  svg += y_grid(y, linear_ticks(y.high), frame);
  const double slot = (frame.right - frame.left) / static_cast<double>(std::max<std::size_t>(slots, 1));
  const double bar_width = std::min(slot * 0.8, 40.0);
  double x = frame.left + 0.5 * slot;
  for (const auto& group : plot.groups) {
    const double start = x;
    for (const auto& bar : group.bars) {
      double base = 0.0;
      for (std::size_t part = 0; part < bar.parts.size(); ++part) {
        const double top = y.at(base + bar.parts[part]);
        svg += "<rect" + attributes({{"x", x + 0.5 * (slot - bar_width)}, {"y", top}, {"width", bar_width}, {"height", y.at(base) - top}}) +
               " class=\"bar p" + std::to_string(part % 3) + "\"><title>" +
               escaped(group.name + ", " + bar.name + ": " + (part < plot.part_names.size() ? plot.part_names[part] : "") + " " +
                       short_number(bar.parts[part])) +
               "</title></rect>\n";
        base += bar.parts[part];
      }
      const double middle = x + 0.5 * slot + 3.0, below = frame.bottom + 8.0;
      svg += svg_text(middle, below, "tick end small", bar.name, " transform=\"rotate(-45 " + coordinate(middle) + " " + coordinate(below) + ")\"");
      x += slot;
    }
    svg += svg_text((start + x) / 2.0, frame.bottom + 58.0, "tick middle", group.name);
    x += slot;
  }
  return svg + svg_line(frame.left, frame.bottom, frame.right, frame.bottom, "base") + "</svg>\n";
}

}  // namespace rink::loadgen
