// Draws the bars from the bottom up, then the mark to compare them with.
#include "loadgen/report/plots/bars.h"

#include <algorithm>
#include <cassert>

#include "loadgen/report/plots/chart_sheet.h"
#include "loadgen/report/plots/text.h"

namespace rink::loadgen {
namespace {

double sum_of(const Bar& bar) {
  double sum = 0.0;
  for (const double part : bar.parts) sum += part;
  return sum;
}

Axis height_axis(const Chart& chart) {
  if (chart.y.range) return {chart.y.range->first, chart.y.range->second, 0.0, 1.0, false};
  double highest = 0.0;
  for (const Bar& bar : chart.bars) highest = std::max(highest, sum_of(bar));
  return axis_around(0.0, highest, false);
}

std::string part_class(std::size_t part) { return "p" + std::to_string(part % 4); }

struct BarPlace {
  double middle, width;
};

std::string svg_bar(const Chart& chart, const Bar& bar, const Axis& y, const BarPlace& place,
                    const std::string& name) {
  assert(bar.parts.size() <= chart.part_names.size() && "each part has a name");
  std::string svg;
  double base = 0.0;
  for (std::size_t part = 0; part < bar.parts.size(); ++part) {
    const double top = y.clamped_at(base + bar.parts[part]), bottom = y.clamped_at(base);
    const std::string title =
        chart.part_names[part] + ", " + bar.name + ": " + short_number(bar.parts[part]);
    svg += "<rect" +
           attributes({{"x", place.middle - place.width / 2.0},
                       {"y", top},
                       {"width", place.width},
                       {"height", std::max(bottom - top, 0.0)}}) +
           " class=\"bar " + part_class(part) + "\"><title>" + escaped(title) + "</title></rect>\n";
    base += bar.parts[part];
  }
  if (!bar.flag.empty())
    svg += svg_text(place.middle, y.clamped_at(base) - 5.0, "note middle", bar.flag);
  return svg + svg_text(place.middle, y.from + 18.0, "tick middle", name);
}

constexpr double name_row = 17.0, gap = 4.0;

/// The names below the plot, each after the number that its bar has.
std::string svg_names(const Chart& chart, double top) {
  std::string svg;
  for (std::size_t i = 0; i < chart.bars.size(); ++i)
    svg += svg_text(0.0, top + name_row * static_cast<double>(i), "legend",
                    fitted(std::to_string(i + 1) + ": " + chart.bars[i].name, chart.width));
  return svg;
}

}  // namespace

std::string svg_of_bars(const Chart& chart) {
  std::vector<LegendEntry> entries;
  for (std::size_t part = 0; part < chart.part_names.size(); ++part)
    entries.push_back({chart.part_names[part], {}, part_class(part)});
  constexpr double top = 52.0;
  ChartSheet sheet(chart, entries, {50.0, chart.width - 10.0, top, top + chart.frame_height}, {},
                   height_axis(chart));
  const Frame& frame = sheet.frame();
  const Axis& y = sheet.y();
  const double slot =
      (frame.right - frame.left) / static_cast<double>(std::max<std::size_t>(chart.bars.size(), 1));
  const bool have_room = std::ranges::all_of(
      chart.bars, [&](const Bar& bar) { return text_width(bar.name) + gap <= slot; });
  sheet.draw_y_axis();
  for (std::size_t i = 0; i < chart.bars.size(); ++i)
    sheet.draw(svg_bar(chart, chart.bars[i], y,
                       {.middle = frame.left + (static_cast<double>(i) + 0.5) * slot,
                        .width = std::min(slot * 0.7, 44.0)},
                       have_room ? chart.bars[i].name : std::to_string(i + 1)));
  if (!have_room) sheet.draw(svg_names(chart, frame.bottom + 42.0 + name_row - gap));
  sheet.draw(svg_x_axis(frame, {}, {}, chart.x.title));
  if (chart.mark && chart.mark->value <= y.high) {
    const double height = y.at(chart.mark->value);
    sheet.draw(svg_line(frame.left, height, frame.right, height, "mark-line") +
               svg_text(frame.right - 2.0, height - 4.0, "note end", chart.mark->name));
  }
  return sheet.finished(have_room ? 0.0 : name_row * static_cast<double>(chart.bars.size()) + gap);
}

}  // namespace rink::loadgen
