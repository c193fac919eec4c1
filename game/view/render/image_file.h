// Pictures as PNG files, and how far two of them are apart.
#pragma once

#include <string>

#include "game/view/render/textures.h"

namespace rink::view {

/// What a framebuffer shows, rows from the top down, 3 channels. A context must be current.
Image read_pixels(unsigned framebuffer, int width, int height);

/// Throws std::runtime_error naming the file.
void write_png(const std::string& file, const Image& image);
Image read_png(const std::string& file);

/// How two images differ: by at most 255 per channel.
struct Difference {
  double mean = 255.0;         ///< over all pixels and channels
  double part_above_32 = 1.0;  ///< of the pixels, in any channel: what has another place or colour,
                               ///< not another rounding
};
/// The worst possible if sizes differ.
Difference difference(const Image& a, const Image& b);
/// How far each pixel and channel is off, four times brighter; white where one image has no pixel.
Image difference_image(const Image& a, const Image& b);

}  // namespace rink::view
