// Textures made in code: no image file to find, the same pixels everywhere.
#pragma once

#include <cstdint>
#include <vector>

namespace rink::view {

/// Rows from the bottom up, `channels` bytes a pixel.
struct Image {
  int width = 0, height = 0, channels = 4;
  std::vector<std::uint8_t> pixels;
};

/// Walnut with its grain along x; repeats in both directions.
Image wood_image(int size);

/// The ten digits beside each other, as lit segments: brightness falls off around each.
Image digits_image();

}  // namespace rink::view
