// Wood from stretched value noise, digits from the distance to the nearest of their seven segments.
#include "game/view/render/textures.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace rink::view {
namespace {

/// A number within [0, 1) for a point of a lattice (integer hash of Wang's kind).
float hashed(unsigned x, unsigned y) {
  unsigned bits = x * 0x9e3779b1u ^ (y * 0x85ebca77u + 0x27d4eb2fu);
  bits = (bits ^ (bits >> 15)) * 0x2c1b3c6du;
  bits = (bits ^ (bits >> 12)) * 0x297a2d39u;
  return static_cast<float>((bits ^ (bits >> 15)) >> 8) * 0x1p-24f;
}

float eased(float t) { return t * t * (3.0f - 2.0f * t); }

/// Smooth noise with `cells_x` by `cells_y` cells over the unit square, which repeats.
float noise(float x, float y, unsigned cells_x, unsigned cells_y) {
  assert(cells_x > 0 && cells_y > 0 && x >= 0.0f && y >= 0.0f);
  const float across = x * static_cast<float>(cells_x), along = y * static_cast<float>(cells_y);
  const float left = std::floor(across), low = std::floor(along), u = eased(across - left),
              v = eased(along - low);
  const auto at = [&](unsigned dx, unsigned dy) {
    return hashed((static_cast<unsigned>(left) + dx) % cells_x,
                  (static_cast<unsigned>(low) + dy) % cells_y);
  };
  return std::lerp(std::lerp(at(0, 0), at(1, 0), u), std::lerp(at(0, 1), at(1, 1), u), v);
}

std::uint8_t byte(float part) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(part, 0.0f, 1.0f) * 255.0f));
}

/// Segments as bits: top, upper right, lower right, bottom, lower left, upper left, middle.
constexpr std::array<unsigned, 10> segments{0x3f, 0x06, 0x5b, 0x4f, 0x66,
                                            0x6d, 0x7d, 0x07, 0x7f, 0x6f};

struct Bar {
  float x0, y0, x1, y1;
};

/// Distance from (x, y) to the segment between the bar's two ends.
float distance(float x, float y, const Bar& bar) {
  const auto [x0, y0, x1, y1] = bar;
  const float dx = x1 - x0, dy = y1 - y0,
              part = std::clamp(((x - x0) * dx + (y - y0) * dy) / (dx * dx + dy * dy), 0.0f, 1.0f);
  return std::hypot(x - x0 - part * dx, y - y0 - part * dy);
}

/// Brightness of `digit` at (x, y) in a cell of 0 to 1 by 0 to 1.6.
float lit(unsigned digit, float x, float y) {
  constexpr float left = 0.24f, right = 0.76f, low = 0.22f, middle = 0.80f, high = 1.38f,
                  gap = 0.055f;
  const std::array<Bar, 7> bars{{{left + gap, high, right - gap, high},
                                 {right, middle + gap, right, high - gap},
                                 {right, low + gap, right, middle - gap},
                                 {left + gap, low, right - gap, low},
                                 {left, low + gap, left, middle - gap},
                                 {left, middle + gap, left, high - gap},
                                 {left + gap, middle, right - gap, middle}}};
  assert(digit < segments.size());
  float bright = 0.0f;
  for (std::size_t bar = 0; bar < bars.size(); ++bar) {
    const float away = distance(x, y, bars[bar]);
    const float core = std::clamp((0.062f - away) / 0.02f + 0.5f, 0.0f, 1.0f);
    if ((segments[digit] >> bar & 1u) != 0)
      bright = std::max(bright, std::max(core, 0.42f * std::exp(-away / 0.09f)));
    else bright = std::max(bright, 0.13f * core);
  }
  return bright;
}

}  // namespace

Image wood_image(int size) {
  assert(size > 0);
  Image image{size, size, 4, {}};
  image.pixels.reserve(static_cast<std::size_t>(size) * static_cast<std::size_t>(size) * 4);
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column) {
      const float x = static_cast<float>(column) / static_cast<float>(size),
                  y = static_cast<float>(row) / static_cast<float>(size);
      const float warp = noise(x, y, 3, 4) * 0.35f + noise(x, y, 6, 12) * 0.10f;
      const float rings = 0.5f + 0.5f * std::sin(6.2831853f * (5.0f * y + 2.0f * warp));
      const float fibre = noise(x, y, 8, 180), pore = noise(x, y, 24, 256);
      const float tone =
          0.30f + 0.38f * rings * rings + 0.26f * fibre - (pore > 0.86f ? 0.30f : 0.0f);
      image.pixels.insert(image.pixels.end(),
                          {byte(0.22f + 0.34f * tone), byte(0.12f + 0.22f * tone),
                           byte(0.075f + 0.13f * tone), 255});
    }
  assert(image.pixels.size() == static_cast<std::size_t>(size * size * image.channels));
  return image;
}

Image digits_image() {
  constexpr int cell_width = 80, cell_height = 128;
  Image image{cell_width * 10, cell_height, 1, {}};
  image.pixels.reserve(static_cast<std::size_t>(image.width) *
                       static_cast<std::size_t>(image.height));
  for (int row = 0; row < cell_height; ++row)
    for (unsigned digit = 0; digit < 10; ++digit)
      for (int column = 0; column < cell_width; ++column)
        image.pixels.push_back(byte(lit(digit, (static_cast<float>(column) + 0.5f) / cell_width,
                                        (static_cast<float>(row) + 0.5f) / cell_width)));
  return image;
}

}  // namespace rink::view
