// PNG by stb's single-header coders.
#include "game/view/render/image_file.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <system_error>

#include <stb/stb_image.h>
#include <stb/stb_image_write.h>

namespace rink::view {

Image read_pixels(unsigned framebuffer, int width, int height) {
  Image image{width, height, 3, {}};
  const std::size_t row = static_cast<std::size_t>(width) * 3;
  std::vector<std::uint8_t> upward(row * static_cast<std::size_t>(height));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, upward.data());
  image.pixels.reserve(upward.size());
  for (std::size_t line = static_cast<std::size_t>(height); line-- > 0;)
    image.pixels.insert(image.pixels.end(),
                        upward.begin() + static_cast<std::ptrdiff_t>(line * row),
                        upward.begin() + static_cast<std::ptrdiff_t>((line + 1) * row));
  return image;
}

/// By a stream, for stb's own writing to a file does not hear of a disk that is full.
void write_png(const std::string& file, const Image& image) {
  std::string png;
  const auto keep = [](void* kept, void* bytes, int size) {
    static_cast<std::string*>(kept)->append(static_cast<const char*>(bytes),
                                            static_cast<std::size_t>(size));
  };
  const bool is_coded =
      stbi_write_png_to_func(keep, &png, image.width, image.height, image.channels,
                             image.pixels.data(), image.width * image.channels) != 0;
  errno = 0;
  std::ofstream stream(file, std::ios::binary);
  if (is_coded && stream << png << std::flush) return;
  const int error = is_coded ? errno : ENOMEM;
  throw std::runtime_error(
      "cannot write the image '" + file +
      "': " + (error != 0 ? std::generic_category().message(error) : "unknown reason"));
}

Image read_png(const std::string& file) {
  Image image{0, 0, 3, {}};
  const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(
      stbi_load(file.c_str(), &image.width, &image.height, nullptr, 3), stbi_image_free);
  if (!pixels) throw std::runtime_error("cannot read the image '" + file + "'");
  image.pixels.assign(pixels.get(), pixels.get() + static_cast<std::size_t>(image.width) *
                                                       static_cast<std::size_t>(image.height) * 3);
  return image;
}

Difference difference(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height || a.channels != b.channels) return {};
  double sum = 0.0;
  std::size_t far = 0;
  const auto channels = static_cast<std::size_t>(a.channels), count = a.pixels.size() / channels;
  for (std::size_t pixel = 0; pixel < count; ++pixel) {
    int most = 0;
    for (std::size_t channel = 0; channel < channels; ++channel) {
      const int apart = std::abs(int{a.pixels[pixel * channels + channel]} -
                                 int{b.pixels[pixel * channels + channel]});
      sum += apart;
      most = std::max(most, apart);
    }
    far += most > 32 ? 1u : 0u;
  }
  return {sum / static_cast<double>(a.pixels.size()),
          static_cast<double>(far) / static_cast<double>(count)};
}

Image difference_image(const Image& a, const Image& b) {
  Image image{a.width, a.height, a.channels, std::vector<std::uint8_t>(a.pixels.size(), 255)};
  if (a.width != b.width || a.height != b.height || a.channels != b.channels) return image;
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] =
        static_cast<std::uint8_t>(std::min(255, 4 * std::abs(int{a.pixels[i]} - int{b.pixels[i]})));
  return image;
}

}  // namespace rink::view
