// Pictures as files: what is written is read, and what cannot be written is named.
#include "game/view/render/image_file.h"

#include <gmock/gmock.h>

#include <stdexcept>

#include "tests/temporary_folder.h"

namespace rink::view {
namespace {

Image some_picture() {
  Image image{5, 3, 3, {}};
  for (int i = 0; i < 5 * 3 * 3; ++i) image.pixels.push_back(static_cast<std::uint8_t>(17 * i));
  return image;
}

TEST(AnImageFile, HoldsThePicture) {
  const test::TemporaryFolder folder("image");
  const std::string file = (folder.path() / "picture.png").string();
  write_png(file, some_picture());
  EXPECT_EQ(read_png(file).pixels, some_picture().pixels);
}

TEST(AnImageFile, ThatCannotBeWrittenIsNamed) {
  for (const std::string file : {"/dev/full", "/nowhere/picture.png"}) {
    try {
      write_png(file, some_picture());
      ADD_FAILURE() << file << " was written";
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("cannot write the image '" + file + "'"));
    }
  }
}

}  // namespace
}  // namespace rink::view
