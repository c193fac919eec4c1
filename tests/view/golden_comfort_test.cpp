// What makes the window everybody's, against golden images: colours, hints, shapes of windows.
#include <gtest/gtest.h>

#include "tests/view/golden_images.h"

namespace rink::view {
namespace {

TEST_F(GoldenImages, OfOtherColoursWhoseNamesTheTeamsHave) {
  MatchSight sight = match_sight();
  sight.left_name = "left", sight.right_name = "right";
  Settings settings = shared_camera();
  settings.palette = PaletteKind::no_red_green;
  play(sight, settings);
  expect_golden("orange_blue");
  settings.palette = PaletteKind::no_blue_yellow;
  sight.phase = Phase::over;
  sight.winner = game::Team::right;
  play(sight, settings);
  expect_golden("red_green");
}

}  // namespace
}  // namespace rink::view
