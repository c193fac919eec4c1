// Pictures as PNG files, and the difference of two.
#pragma once

#include <string>

#include "game/view/render/textures.h"

namespace rink::view {

/// The content of a framebuffer, rows from the top down, 3 channels. A context must be current.
Image read_pixels(unsigned framebuffer, int width, int height);

/// Throws std::runtime_error naming the file.
void write_png(const std::string& file, const Image& image);
Image read_png(const std::string& file);

/// The difference of two images: at most 255 per channel.
struct Difference {
  double mean = 255.0;         ///< over all pixels and channels
  double part_above_32 = 1.0;  ///< of the pixels, in any channel: other places or colours, not
                               ///< other rounding
};
/// The worst possible if sizes differ.
Difference difference(const Image& a, const Image& b);
/// The difference of each pixel and channel, four times brighter; white where one image has no
/// pixel.
Image difference_image(const Image& a, const Image& b);

}  // namespace rink::view
