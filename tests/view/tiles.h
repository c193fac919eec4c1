// Pictures compared piece by piece: a puck is 0.1 % of a picture, but a third of a tile.
#pragma once

#include <algorithm>
#include <ostream>

#include "game/view/render/image_file.h"

namespace rink::view {

/// How a part of two pictures differs.
struct Tile {
  static constexpr int size = 16;  ///< pixels each way
  int x = 0, y = 0;                ///< of its upper left pixel
  Difference apart{.mean = 0.0, .part_above_32 = 0.0};
  /// A line that lies half a pixel elsewhere is 16 of 256 pixels.
  bool is_alike() const { return apart.mean < 8.0 && apart.part_above_32 < 0.08; }
  friend std::ostream& operator<<(std::ostream& out, const Tile& tile) {
    return out << tile.x << ' ' << tile.y << ": mean " << tile.apart.mean << " (below 8), part "
               << tile.apart.part_above_32 << " (below 0.08)";
  }
};

/// `image` from (`x`, `y`) on, at most Tile::size each way.
inline Image tile_of(const Image& image, int x, int y) {
  Image tile{std::min(Tile::size, image.width - x),
             std::min(Tile::size, image.height - y),
             image.channels,
             {}};
  for (int row = y; row < y + tile.height; ++row) {
    const auto from = image.pixels.begin() + (row * image.width + x) * image.channels;
    tile.pixels.insert(tile.pixels.end(), from, from + tile.width * image.channels);
  }
  return tile;
}

/// That in which most pixels are off; anywhere if the sizes differ.
inline Tile worst_tile(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height || a.channels != b.channels) return {.apart = {}};
  Tile worst;
  for (int y = 0; y < a.height; y += Tile::size)
    for (int x = 0; x < a.width; x += Tile::size) {
      const Difference apart = difference(tile_of(a, x, y), tile_of(b, x, y));
      const auto badness = [](const Difference& each) {
        return std::max(each.mean / 8.0, each.part_above_32 / 0.08);
      };
      if (badness(apart) > badness(worst.apart)) worst = {.x = x, .y = y, .apart = apart};
    }
  return worst;
}

}  // namespace rink::view
