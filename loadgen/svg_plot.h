// Plots as inline SVG that needs no script and takes its colours from the page's style sheet.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rink::loadgen {

/// `text` with &, <, >, " and ' as entities and control characters replaced, fit for HTML and SVG content and attributes.
std::string escaped(const std::string& text);

/// `value` with three digits and a k, M or G where it helps, e.g. `1.5 k`.
std::string short_number(double value);

/// One line of a plot. The colour and marker are those of `style` (the page's classes s0, s1, ...).
struct Series {
  struct Point {
    double x = 0.0, y = 0.0;
    double low = 0.0, high = 0.0;  ///< whisker; none if equal
  };
  std::string name;
  std::size_t style = 0;
  std::vector<Point> points;
};

/// A line plot. Points that a logarithmic axis cannot show (not above 0) are left out.
struct LinePlot {
  std::string title, x_title, y_title;
  std::vector<std::pair<double, std::string>> x_ticks;  ///< where and what
  std::vector<Series> series;
  bool is_x_logarithmic = false, is_y_logarithmic = true;
  bool has_direct_labels = true;  ///< each line's name at its right end
  double width = 640.0, height = 400.0;
  std::optional<double> y_low, y_high;  ///< to give several plots the same axis
};
std::string to_svg(const LinePlot& plot);

/// Bars in groups, each made of parts that are stacked in the order of `part_names` (the page's classes p0, p1, ...).
struct StackedBars {
  struct Bar {
    std::string name;
    std::vector<double> parts;
  };
  struct Group {
    std::string name;
    std::vector<Bar> bars;
  };
  std::string title, x_title, y_title;
  std::vector<std::string> part_names;
  std::vector<Group> groups;
  double width = 640.0, height = 400.0;
};
std::string to_svg(const StackedBars& plot);

}  // namespace rink::loadgen
