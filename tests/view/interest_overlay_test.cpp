// What the overlay of interest marks, against its definition.
#include "game/view/interest_overlay.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rink::view {
namespace {

MatchSight sight_with(std::vector<Thing> things) {
  MatchSight sight;
  sight.field = {.length = 20.0, .width = 10.0};
  sight.things = std::move(things);
  return sight;
}

TEST(InterestOverlay, ColoursWhatTouchesTheViewOfTheChosenBatAndNothingElse) {
  using physics::BodyKind;
  const double half = 0.5 * std::sqrt(0.05 * 200.0);  // the square that is a twentieth of the field
  const MatchSight sight = sight_with({{7, BodyKind::bat, game::Team::left, {10.0, 5.0}, {0.0, 0.0}, {0.05, 0.15}},
                                       {3, BodyKind::bat, game::Team::right, {2.0, 2.0}, {0.0, 0.0}, {0.05, 0.15}},
                                       {8, BodyKind::puck, game::Team::none, {10.0 + half + 0.039, 5.0}, {0.0, 0.0}, {0.04, 0.04}},
                                       {9, BodyKind::puck, game::Team::none, {10.0 + half + 0.041, 5.0}, {0.0, 0.0}, {0.04, 0.04}}});
  const Overlay overlay = interest_overlay(sight, {.cell_size = 0.0, .view_fraction = 0.05, .chosen = 1});  // the second by id
  ASSERT_EQ(overlay.discs.size(), 1u);
  EXPECT_DOUBLE_EQ(overlay.discs[0].x, 10.0 + half + 0.039);
  ASSERT_EQ(overlay.rectangles.size(), 2u);
  EXPECT_DOUBLE_EQ(overlay.rectangles.back().low_x, 10.0 - half);
  EXPECT_GT(overlay.rectangles.back().fill.alpha, 0.0f);
  EXPECT_EQ(chosen_bat(sight, {.chosen = 3})->id, 7u);
}

TEST(InterestOverlay, IsEmptyUnlessAsked) {
  const Overlay overlay = interest_overlay(sight_with({{0, physics::BodyKind::bat, game::Team::left, {1.0, 1.0}, {0.0, 0.0}, {0.1, 0.1}}}), {});
  EXPECT_TRUE(overlay.rectangles.empty() && overlay.discs.empty() && overlay.lines.empty());
  EXPECT_EQ(chosen_bat(sight_with({}), {}), nullptr);
}

}  // namespace
}  // namespace rink::view
