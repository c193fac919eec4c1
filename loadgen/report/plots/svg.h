// The pieces that plots are drawn from, as inline SVG that needs no script and takes its colours
// from the page's style sheet.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "loadgen/report/plots/axis.h"

namespace rink::loadgen {

inline constexpr std::size_t colour_count = 8;

/// A line's distinguishing style: the page's colour classes s0 to s7, dash classes d0 to d3, and
/// one of six shapes, so that colour is never the only difference.
struct Style {
  std::size_t colour = 0, dash = 0, shape = 0;
};

/// The rectangle that the data fill.
struct Frame {
  double left = 0.0, right = 0.0, top = 0.0, bottom = 0.0;
};

std::string coordinate(double value);
/// ` name="value"` for each pair.
std::string attributes(std::initializer_list<std::pair<const char*, double>> pairs);
std::string svg_text(double x, double y, const std::string& classes, const std::string& content);
std::string svg_line(double x1, double y1, double x2, double y2, const std::string& classes);
std::string svg_path(const std::string& path, const std::string& classes);
/// A marker centred at (x, y); `title` is its tooltip.
std::string svg_marker(const Style& style, double x, double y, const std::string& title = "");

/// Width [user units] that `text` takes at the page's 12 px, on the safe side.
double text_width(const std::string& text);

/// `text` if it takes no more than `width`, or as much of its beginning and its end as does; names
/// of schemes differ at their ends as often as at their beginnings.
std::string fitted(const std::string& text, double width);

/// The first lines of a picture: its size, its title, and `alternative` for readers who cannot see
/// it.
std::string svg_opening(double width, double height, const std::string& title,
                        const std::string& alternative);

/// A line's name beside a sample of it; bars have only a colour class.
struct LegendEntry {
  std::string name;
  Style style;
  std::string bar_class;  ///< a filled square of this class if not empty
};

/// Entries in rows that wrap at `width`, the first row's middle at `top`. `height` grows by what
/// they take.
std::string svg_legend(const std::vector<LegendEntry>& entries, double left, double width,
                       double top, double& height);

/// Grid, ticks and their labels along both sides, and the axes' titles: x below, y above the
/// frame's left corner.
std::string svg_y_axis(const Frame& frame, const Axis& axis, const Ticks& ticks,
                       const std::string& title);
std::string svg_x_axis(const Frame& frame, const Axis& axis, const Ticks& ticks,
                       const std::string& title, bool has_grid = false);

}  // namespace rink::loadgen
