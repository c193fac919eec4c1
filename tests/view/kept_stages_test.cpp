// Stages that are kept: how soon they are smooth, which one makes room, and that they look as if
// drawn anew.
#include "game/view/render/kept_stages.h"

#include <gtest/gtest.h>

#include "game/view/picture_of.h"
#include "game/view/render/image_file.h"
#include "tests/view/offscreen_test.h"
#include "tests/view/sights.h"

namespace rink::view {
namespace {

constexpr int stage_width = 160, stage_height = 90, band_count = 4;  // of 24 rows

/// Seen from the side, from `x` further along it.
Stage stage_from(float x, std::uint32_t score = 0) {
  const Picture picture =
      picture_of(match_sight(), {}, {.viewpoint = Viewpoint::side},
                 static_cast<double>(stage_width) / static_cast<double>(stage_height));
  Stage stage{picture.table, picture.board, picture.camera, stage_width, stage_height};
  stage.board.first = score;
  stage.camera.eye.x() += x;
  return stage;
}

class StagesThatAreKept : public OffscreenTest {
 protected:
  /// In a frame of its own.
  static const Target& show(KeptStages& stages, const Stage& stage) {
    stages.begin_frame();
    return stages.show(stage, Sight(stage.camera, static_cast<float>(stage.width) /
                                                      static_cast<float>(stage.height)));
  }
  static Image settled(KeptStages& stages, const Stage& stage) {
    const Target* target = &show(stages, stage);
    while (!stages.are_settled()) target = &show(stages, stage);
    return read_pixels(target->framebuffer(), stage.width, stage.height);
  }
  static Image drawn_anew(const Stage& stage) {
    KeptStages stages;
    return settled(stages, stage);
  }
};

TEST_F(StagesThatAreKept, AreSmoothAfterAsManyFramesAsTheyHaveBands) {
  KeptStages stages;
  EXPECT_FALSE(stages.holds(stage_from(0.2f)));
  show(stages, stage_from(0.2f));
  EXPECT_TRUE(stages.holds(stage_from(0.2f)));
  for (int band = 0; band < band_count; ++band) {
    EXPECT_FALSE(stages.are_settled()) << "after " << band << " bands";
    show(stages, stage_from(0.2f));
  }
  EXPECT_TRUE(stages.are_settled());
}

TEST_F(StagesThatAreKept, ShowTheTableRoughlyAtOnce) {
  KeptStages stages;
  const Stage stage = stage_from(0.2f);
  const Image rough = read_pixels(show(stages, stage).framebuffer(), stage_width, stage_height);
  const Difference apart = difference(rough, settled(stages, stage));
  EXPECT_GT(apart.mean, 0.0) << "it becomes smoother";
  EXPECT_LT(apart.mean, 10.0);
}

/// Another score redraws the board alone, and at once.
TEST_F(StagesThatAreKept, LookAsIfDrawnAnewAfterEachScore) {
  KeptStages stages;
  settled(stages, stage_from(0.2f, 0));
  for (const std::uint32_t score : {1u, 8u, 88u, 3u}) {
    const Stage stage = stage_from(0.2f, score);
    const Target& target = show(stages, stage);
    EXPECT_TRUE(stages.are_settled()) << "score " << score;
    const Image seen = read_pixels(target.framebuffer(), stage_width, stage_height);
    EXPECT_EQ(difference(seen, drawn_anew(stage)).mean, 0.0) << "score " << score;
    EXPECT_FALSE(stages.holds(stage_from(0.2f, score + 1)));
  }
  EXPECT_NE(drawn_anew(stage_from(0.2f, 1)).pixels, drawn_anew(stage_from(0.2f, 8)).pixels);
}

TEST_F(StagesThatAreKept, LoseTheOneThatWasNotUsedForLongest) {
  KeptStages stages;
  for (const float x : {0.0f, 0.1f, 0.2f, 0.3f}) settled(stages, stage_from(x));
  settled(stages, stage_from(0.0f));
  settled(stages, stage_from(0.4f));
  for (const float x : {0.0f, 0.2f, 0.3f, 0.4f}) EXPECT_TRUE(stages.holds(stage_from(x))) << x;
  EXPECT_FALSE(stages.holds(stage_from(0.1f)));
}

TEST_F(StagesThatAreKept, AreSmoothStillWhenACameraComesBack) {
  KeptStages stages;
  const Image before = settled(stages, stage_from(0.0f));
  settled(stages, stage_from(0.2f));
  const Target& again = show(stages, stage_from(0.0f));
  EXPECT_TRUE(stages.are_settled());
  EXPECT_EQ(read_pixels(again.framebuffer(), stage_width, stage_height).pixels, before.pixels);
}

TEST_F(StagesThatAreKept, LookAsIfDrawnAnewInAnotherSizeAndFromAbove) {
  KeptStages stages;
  for (int i = 0; i < 5; ++i) settled(stages, stage_from(0.1f * static_cast<float>(i)));
  Stage wide = stage_from(0.2f);
  wide.width = 200, wide.height = 50;
  Stage plan = stage_from(0.2f);
  plan.camera.is_plan = true;
  plan.camera.centre_x = 1.2f, plan.camera.centre_y = 0.6f;
  for (const Stage& stage : {wide, plan, wide})
    EXPECT_EQ(difference(settled(stages, stage), drawn_anew(stage)).mean, 0.0) << stage.width;
}

}  // namespace
}  // namespace rink::view
