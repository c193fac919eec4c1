// A recorded match as pictures.
#include "game/view/film/picture_sequence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "game/control/key_log_packed.h"
#include "game/control/replay.h"
#include "game/model/scene_file.h"
#include "game/view/render/image_file.h"
#include "tests/temporary_folder.h"
#include "tests/view/offscreen_test.h"

namespace rink::view {
namespace {

using ::testing::HasSubstr;

class APictureSequence : public OffscreenTest {
 protected:
  void SetUp() override {
    OffscreenTest::SetUp();
    if (IsSkipped()) return;
    const game::Scene scene = game::load_scene("match");
    game::Game game(scene);
    const game::InputEvent key = game.submit({.time = 0.1, .player = 0, .key = game::Key::left});
    game.advance(0.5);
    game::write_packed_key_log(folder_ / "match.keys",
                               log_of(game, scene, game::scene_text("match"), {key}));
  }
  std::size_t write(const std::string& folder) const {
    return write_pictures({.record = (folder_ / "match.keys").string(),
                           .folder = (folder_ / folder).string(),
                           .frames_per_s = 20.0,
                           .size = {160, 90, 1.0},
                           .view = {}});
  }
  Image picture(const std::string& folder, const std::string& name) const {
    return read_png((folder_ / folder / name).string());
  }
  std::string objection_to(const std::string& folder) const {
    try {
      write(folder);
    } catch (const std::exception& error) {
      return error.what();
    }
    return "";
  }

  test::TemporaryFolder folder_{"film"};
};

/// Of 0, 0.05 and so on to 0.5 s.
TEST_F(APictureSequence, HasOneOfEachInstantAndIsTheSameAgain) {
  EXPECT_EQ(write("film"), 11u);
  EXPECT_EQ(write("again/and/again"), 11u) << "folders are made";
  EXPECT_TRUE(std::filesystem::exists(folder_ / "film/frame-000011.png"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "film/frame-000012.png"));
  const Image early = picture("film", "frame-000001.png");
  EXPECT_EQ(early.width, 160);
  EXPECT_EQ(early.pixels, picture("again/and/again", "frame-000001.png").pixels);
  EXPECT_NE(early.pixels, picture("film", "frame-000011.png").pixels);
}

TEST_F(APictureSequence, OverwritesNothing) {
  std::filesystem::create_directory(folder_ / "full");
  std::ofstream(folder_ / "full/letter") << "dear";
  EXPECT_THAT(objection_to("full"), HasSubstr("has content already"));
  EXPECT_THAT(objection_to("match.keys"), HasSubstr("match.keys: this folder for pictures"));
  EXPECT_THAT(objection_to("match.keys/below"), HasSubstr("cannot be made: Not a directory"));
}

TEST(APicture, ThatCannotBeWrittenSaysWhy) {
  const Image image{1, 1, 3, {0, 0, 0}};
  try {
    write_png("/dev/full", image);
    ADD_FAILURE() << "no room";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("'/dev/full': No space left on device"));
  }
}

}  // namespace
}  // namespace rink::view
