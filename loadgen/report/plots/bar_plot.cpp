// Draws the bars from the bottom up, then the mark that they are held against.
#include "loadgen/report/plots/bar_plot.h"

#include <algorithm>

#include "loadgen/report/plots/text.h"

namespace rink::loadgen {
namespace {

double sum_of(const BarPlot::Bar& bar) {
  double sum = 0.0;
  for (const double part : bar.parts) sum += part;
  return sum;
}

std::string part_class(std::size_t part) { return "p" + std::to_string(part % 4); }

std::string svg_bar(const BarPlot& plot, const BarPlot::Bar& bar, const Axis& y, double middle,
                    double width, const std::string& name) {
  std::string svg;
  double base = 0.0;
  for (std::size_t part = 0; part < bar.parts.size(); ++part) {
    const double top = y.clamped_at(base + bar.parts[part]), bottom = y.clamped_at(base);
    const std::string title =
        plot.part_names[part] + ", " + bar.name + ": " + short_number(bar.parts[part]);
    svg += "<rect" +
           attributes({{"x", middle - width / 2.0},
                       {"y", top},
                       {"width", width},
                       {"height", std::max(bottom - top, 0.0)}}) +
           " class=\"bar " + part_class(part) + "\"><title>" + escaped(title) + "</title></rect>\n";
    base += bar.parts[part];
  }
  if (!bar.flag.empty()) svg += svg_text(middle, y.clamped_at(base) - 5.0, "note middle", bar.flag);
  return svg + svg_text(middle, y.from + 18.0, "tick middle", name);
}

constexpr double name_row = 17.0, gap = 4.0;

/// The names below the plot, each after the number that its bar has.
std::string svg_names(const BarPlot& plot, double top) {
  std::string svg;
  for (std::size_t i = 0; i < plot.bars.size(); ++i)
    svg += svg_text(0.0, top + name_row * static_cast<double>(i), "legend",
                    fitted(std::to_string(i + 1) + ": " + plot.bars[i].name, plot.width));
  return svg;
}

}  // namespace

std::string to_svg(const BarPlot& plot) {
  std::vector<LegendEntry> entries;
  for (std::size_t part = 0; part < plot.part_names.size(); ++part)
    entries.push_back({plot.part_names[part], {}, part_class(part)});
  double above = 52.0, highest = 0.0;
  const std::string legend = svg_legend(entries, 0.0, plot.width, 34.0, above);
  for (const BarPlot::Bar& bar : plot.bars) highest = std::max(highest, sum_of(bar));
  const Frame frame{50.0, plot.width - 10.0, above, above + plot.frame_height};
  Axis y = axis_around(0.0, plot.y_high.value_or(highest), false);
  y.from = frame.bottom, y.to = frame.top;
  const double slot =
      (frame.right - frame.left) / static_cast<double>(std::max<std::size_t>(plot.bars.size(), 1));
  const bool have_room = std::ranges::all_of(
      plot.bars, [&](const BarPlot::Bar& bar) { return text_width(bar.name) + gap <= slot; });
  const double below = have_room ? 0.0 : name_row * static_cast<double>(plot.bars.size()) + gap;
  std::string svg =
      svg_opening(plot.width, frame.bottom + 42.0 + below, plot.title, plot.alternative) + legend +
      svg_y_axis(frame, y, ticks_of(y, 26.0), plot.y_title);
  for (std::size_t i = 0; i < plot.bars.size(); ++i) {
    svg +=
        svg_bar(plot, plot.bars[i], y, frame.left + (static_cast<double>(i) + 0.5) * slot,
                std::min(slot * 0.7, 44.0), have_room ? plot.bars[i].name : std::to_string(i + 1));
  }
  if (!have_room) svg += svg_names(plot, frame.bottom + 42.0 + name_row - gap);
  svg += svg_x_axis(frame, {}, {}, plot.x_title);
  if (plot.mark && *plot.mark <= y.high) {
    svg += svg_line(frame.left, y.at(*plot.mark), frame.right, y.at(*plot.mark), "mark-line") +
           svg_text(frame.right - 2.0, y.at(*plot.mark) - 4.0, "note end", plot.mark_name);
  }
  return svg + "</svg>\n";
}

}  // namespace rink::loadgen
