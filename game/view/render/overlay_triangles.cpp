// A line is a thin rectangle, a disc a square whose shader draws the circle.
#include "game/view/render/overlay_triangles.h"

#include <algorithm>
#include <cmath>

namespace rink::view {
namespace {

constexpr float line_pixels = 2.0f;

struct Box {
  float x0, y0, x1, y1;
};

/// In pixels; `half` is half of the square that the shader draws it in, 0 for a full square.
struct Circle {
  float half = 0.0f, radius = 0.0f, ring = 0.0f;
};

class Triangles {
 public:
  Triangles(float pixel, std::vector<float>& rows) : pixel_(pixel), rows_(rows) {}

  void rectangle(double low_x, double low_y, double high_x, double high_y, const Colour& colour) {
    if (colour.alpha <= 0.0f) return;
    const auto x0 = static_cast<float>(low_x), y0 = static_cast<float>(low_y),
               x1 = static_cast<float>(high_x), y1 = static_cast<float>(high_y);
    square({x0, y0, x1, y1}, {}, colour);
  }
  void outline(const OverlayRectangle& r) {
    const double width = static_cast<double>(line_pixels * pixel_);
    rectangle(r.low_x, r.low_y, r.high_x, r.low_y + width, r.outline);
    rectangle(r.low_x, r.high_y - width, r.high_x, r.high_y, r.outline);
    rectangle(r.low_x, r.low_y + width, r.low_x + width, r.high_y - width, r.outline);
    rectangle(r.high_x - width, r.low_y + width, r.high_x, r.high_y - width, r.outline);
  }
  void disc(const OverlayDisc& disc) {
    const float radius = static_cast<float>(disc.radius) / pixel_, half = radius + 1.0f,
                x = static_cast<float>(disc.x), y = static_cast<float>(disc.y),
                reach = half * pixel_;
    square({x - reach, y - reach, x + reach, y + reach},
           {.half = half,
            .radius = radius,
            .ring = disc.is_filled ? radius : std::min(radius, 0.5f * line_pixels)},
           disc.colour);
  }

 private:
  void square(const Box& box, const Circle& circle, const Colour& colour) {
    const auto [half, radius, ring] = circle;
    for (const int corner : {0, 1, 3, 0, 3, 2}) {
      const bool is_right = (corner & 1) != 0, is_high = (corner & 2) != 0;
      rows_.insert(rows_.end(), {is_right ? box.x1 : box.x0, is_high ? box.y1 : box.y0,
                                 is_right ? half : -half, is_high ? half : -half, radius, ring,
                                 colour.red, colour.green, colour.blue, colour.alpha});
    }
  }

  float pixel_;
  std::vector<float>& rows_;
};

void add_grid(const Table& table, const Overlay& overlay, double width, Triangles& triangles) {
  const auto length = static_cast<double>(table.length), across = static_cast<double>(table.width);
  if (overlay.cell_size <= 0.0 || length / overlay.cell_size > 2000.0)
    return;  // finer than any window
  for (double x = overlay.cell_size; x < length; x += overlay.cell_size)
    triangles.rectangle(x - 0.5 * width, 0.0, x + 0.5 * width, across, overlay.cell_colour);
  for (double y = overlay.cell_size; y < across; y += overlay.cell_size)
    triangles.rectangle(0.0, y - 0.5 * width, length, y + 0.5 * width, overlay.cell_colour);
}

}  // namespace

void add_overlay(const Picture& picture, float pixel, std::vector<float>& rows) {
  Triangles triangles(pixel, rows);
  add_grid(picture.table, picture.overlay, static_cast<double>(pixel), triangles);
  for (const OverlayRectangle& rectangle : picture.overlay.rectangles) {
    triangles.rectangle(rectangle.low_x, rectangle.low_y, rectangle.high_x, rectangle.high_y,
                        rectangle.fill);
    triangles.outline(rectangle);
  }
  for (const OverlayDisc& disc : picture.overlay.discs) triangles.disc(disc);
}

}  // namespace rink::view
