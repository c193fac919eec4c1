// Texts, lines, markers, legends and axes.
#include "loadgen/report/plots/svg.h"

#include <algorithm>
#include <cassert>
#include <cstdio>

#include "loadgen/report/plots/text.h"

namespace rink::loadgen {
namespace {

/// Outlines about the origin, of equal weight to the eye.
std::string outline(std::size_t shape) {
  switch (shape % 6) {
    case 0:
      return "m-4 0a4 4 0 1 0 8 0a4 4 0 1 0 -8 0z";
    case 1:
      return "m-3.6 -3.6h7.2v7.2h-7.2z";
    case 2:
      return "m0 -4.8l4.6 8.2h-9.2z";
    case 3:
      return "m0 -5l5 5l-5 5l-5 -5z";
    case 4:
      return "m0 4.8l4.6 -8.2h-9.2z";
    default:
      return "m-1.6 -4.6h3.2v3h3v3.2h-3v3h-3.2v-3h-3v-3.2h3z";
  }
}

constexpr double title_size = 1.35;  // of a title's letters, which are larger and bold, to others

}  // namespace

std::string coordinate(double value) {
  char text[48];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text == std::string("-0.0") ? "0.0" : text;
}

std::string attributes(std::initializer_list<std::pair<const char*, double>> pairs) {
  std::string text;
  for (const auto& [name, value] : pairs)
    text += std::string(" ") + name + "=\"" + coordinate(value) + "\"";
  return text;
}

std::string svg_text(double x, double y, const std::string& classes, const std::string& content) {
  return "<text" + attributes({{"x", x}, {"y", y}}) + " class=\"" + classes + "\">" +
         escaped(content) + "</text>\n";
}

std::string svg_line(double x1, double y1, double x2, double y2, const std::string& classes) {
  return "<line" + attributes({{"x1", x1}, {"y1", y1}, {"x2", x2}, {"y2", y2}}) + " class=\"" +
         classes + "\"/>\n";
}

std::string svg_path(const std::string& path, const std::string& classes) {
  return "<path d=\"" + path + "\" class=\"" + classes + "\"/>\n";
}

std::string svg_marker(const Style& style, double x, double y, const std::string& title) {
  const std::string opening = "<path d=\"M" + coordinate(x) + " " + coordinate(y) +
                              outline(style.shape) + "\" class=\"mark s" +
                              std::to_string(style.colour % colour_count) + "\"";
  if (title.empty()) return opening + "/>\n";
  return opening + "><title>" + escaped(title) + "</title></path>\n";
}

double text_width(const std::string& text) {
  const auto letters =
      std::count_if(text.begin(), text.end(), [](char byte) { return (byte & 0xC0) != 0x80; });
  return 6.9 * static_cast<double>(letters);
}

std::string fitted(const std::string& text, double width) {
  if (text_width(text) <= width) return text;
  std::vector<std::string> letters;
  for (const char byte : text) {
    if ((byte & 0xC0) != 0x80) letters.emplace_back();
    if (!letters.empty()) letters.back() += byte;
  }
  const std::size_t kept = static_cast<std::size_t>(std::max(width / text_width("x"), 2.0)) - 1,
                    head = kept / 2;
  assert(kept >= 1 && "the sign that something is left out has room");
  std::string result;
  for (std::size_t i = 0; i < letters.size(); ++i) {
    if (i < head || i + (kept - head) >= letters.size()) result += letters[i];
    if (i == head) result += "\xE2\x80\xA6";
  }
  return result;
}

std::string svg_opening(double width, double height, const std::string& title,
                        const std::string& alternative) {
  assert(width > 0.0 && height > 0.0);
  return "<svg viewBox=\"0 0 " + coordinate(width) + " " + coordinate(height) +
         "\" role=\"img\" aria-label=\"" + escaped(title + ". " + alternative) +
         "\" xmlns=\"http://www.w3.org/2000/svg\">\n" +
         svg_text(0.0, 15.0, "title", fitted(title, width / title_size));
}

std::string svg_legend(const std::vector<LegendEntry>& entries, double left, double width,
                       double top, double& height) {
  constexpr double row = 17.0, sample = 26.0, gap = 16.0;
  const double room = width - sample - 6.0;
  assert(room > 0.0);
  std::string svg;
  double x = left, y = top;
  for (const LegendEntry& entry : entries) {
    const std::string name = fitted(entry.name, room);
    const double taken = sample + 6.0 + text_width(name);
    if (x > left && x + taken > left + width) x = left, y += row;
    if (entry.bar_class.empty()) {
      svg += svg_line(x, y, x + sample, y,
                      "line s" + std::to_string(entry.style.colour % colour_count) + " d" +
                          std::to_string(entry.style.dash % 4));
      svg += svg_marker(entry.style, x + sample / 2.0, y);
    } else {
      svg += "<rect" +
             attributes({{"x", x + 8.0}, {"y", y - 6.0}, {"width", 12.0}, {"height", 12.0}}) +
             " class=\"bar " + entry.bar_class + "\"/>\n";
    }
    svg += svg_text(x + sample + 6.0, y + 4.0, "legend", name);
    x += taken + gap;
  }
  if (!entries.empty()) height += y + row - top;
  return svg;
}

std::string svg_y_axis(const Frame& frame, const Axis& axis, const Ticks& ticks,
                       const std::string& title) {
  std::string svg;
  for (const double value : ticks.minor)
    svg += svg_line(frame.left - 3.0, axis.at(value), frame.left, axis.at(value), "base");
  for (const auto& [value, text] : ticks.major) {
    svg += svg_line(frame.left - 5.0, axis.at(value), frame.right, axis.at(value), "grid");
    svg += svg_text(frame.left - 8.0, axis.at(value) + 4.0, "tick end", text);
  }
  return svg + svg_line(frame.left, frame.top, frame.left, frame.bottom, "base") +
         svg_text(0.0, frame.top - 10.0, "axis", title);
}

std::string svg_x_axis(const Frame& frame, const Axis& axis, const Ticks& ticks,
                       const std::string& title, bool has_grid) {
  std::string svg;
  for (const double value : ticks.minor)
    svg += svg_line(axis.at(value), frame.bottom, axis.at(value), frame.bottom + 3.0, "base");
  for (const auto& [value, text] : ticks.major) {
    if (has_grid) svg += svg_line(axis.at(value), frame.top, axis.at(value), frame.bottom, "grid");
    svg += svg_line(axis.at(value), frame.bottom, axis.at(value), frame.bottom + 5.0, "base");
    svg += svg_text(axis.at(value), frame.bottom + 18.0, "tick middle", text);
  }
  svg += svg_line(frame.left, frame.bottom, frame.right, frame.bottom, "base");
  return svg +
         svg_text((frame.left + frame.right) / 2.0, frame.bottom + 35.0, "axis middle", title);
}

}  // namespace rink::loadgen
