// What the overlay of interest shows of the decisions that it is given.
#include "game/view/overlays/interest_overlay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

namespace rink::view {
namespace {

using game::InterestSeen;
using physics::BodyKind;

/// Two bats, 3 and 7, and two pucks; the player of bat 7 hears of bat 3 and puck 8, that of bat 3
/// of bat 7.
MatchSight decided_sight() {
  MatchSight sight;
  sight.field = {.length = 20.0, .width = 10.0};
  sight.things = {{7, BodyKind::bat, game::Team::left, {10.0, 5.0}, {0.0, 0.0}, {0.05, 0.15}},
                  {3, BodyKind::bat, game::Team::right, {2.0, 2.0}, {0.0, 0.0}, {0.05, 0.15}},
                  {8, BodyKind::puck, game::Team::none, {11.0, 5.0}, {0.0, 0.0}, {0.04, 0.04}},
                  {9, BodyKind::puck, game::Team::none, {10.5, 5.0}, {0.0, 0.0}, {0.04, 0.04}}};
  sight.interest = InterestSeen{
      .asked = 7,
      .cell_size = 0.5f,
      .view_count = 2,
      .heard_count = 2,
      .hearer_count = 1,
      .views = {{7, false, 8.0f, 3.0f, 12.0f, 7.0f}, {3, true, 0.0f, 0.0f, 4.0f, 4.0f}},
      .heard = {3, 8}};
  return sight;
}

TEST(InterestOverlay, ShowsWhatWasDecidedEvenWhereGeometryWouldSayOtherwise) {
  const Overlay overlay = interest_overlay(decided_sight(), {});
  EXPECT_EQ(overlay.cell_size, 0.5);
  ASSERT_EQ(overlay.rectangles.size(), 2u);
  EXPECT_EQ(overlay.rectangles.back().low_x, 8.0);
  EXPECT_GT(overlay.rectangles.back().fill.alpha, 0.0f);
  EXPECT_EQ(overlay.rectangles.front().fill.alpha, 0.0f) << "regions of others hide nothing";
  const std::ptrdiff_t on_unheard = std::ranges::count(overlay.discs, 10.5, &OverlayDisc::x);
  EXPECT_EQ(on_unheard, 0) << "puck 9 lies in the region, but its player was not told of it";
  EXPECT_EQ(std::ranges::count(overlay.discs, 11.0, &OverlayDisc::x), 1);
  EXPECT_EQ(std::ranges::count(overlay.discs, 2.0, &OverlayDisc::x), 2)
      << "bat 3 is heard of and hears";
}

/// Three bats of which two are played: the report has a region of each player, and no other.
TEST(InterestOverlay, CountsThePlayersWhoAreThereAndNotTheBats) {
  MatchSight sight = decided_sight();
  sight.things.push_back(
      {12, BodyKind::bat, game::Team::left, {15.0, 5.0}, {0.0, 0.0}, {0.05, 0.15}});
  const std::vector<std::string> played{"grid: cells of 0.5 m, regions of 2 players",
                                        "bat 7 (purple): 1 of 2 players hear of it (orange)",
                                        "its player hears of 2 of 5 bodies (green)",
                                        "Tab or a click asks of another, I hides this"};
  EXPECT_EQ(interest_overlay(sight, {}).lines, played);
  sight.interest->asked = 12;
  sight.interest->heard.clear();
  sight.interest->heard_count = sight.interest->hearer_count = 0;
  const std::vector<std::string> free{played[0],
                                      "bat 12 (purple): 0 of 2 players hear of it (orange)",
                                      "nobody plays it", played[3]};
  EXPECT_EQ(interest_overlay(sight, {}).lines, free);
}

TEST(InterestOverlay, SaysWhatItsColoursMean) {
  MatchSight sight = decided_sight();
  const Overlay overlay = interest_overlay(sight, {});
  ASSERT_EQ(overlay.legend.size(), 5u);
  for (const OverlayDisc& disc : overlay.discs)
    EXPECT_EQ(std::ranges::count(overlay.legend, disc.colour, &Overlay::Meaning::colour), 1);
  sight.interest->cell_size = 0.0f;
  EXPECT_EQ(interest_overlay(sight, {}).legend.size(), 4u) << "without cells they mean nothing";
}

TEST(InterestOverlay, IsEmptyUnlessSomethingWasToldAndItIsWanted) {
  MatchSight sight = decided_sight();
  for (const bool is_told : {true, false}) {
    const Overlay overlay = interest_overlay(sight, {.is_shown = !is_told});
    EXPECT_TRUE(overlay.rectangles.empty() && overlay.discs.empty() && overlay.lines.empty() &&
                overlay.cell_size == 0.0);
    sight.interest.reset();
  }
}

TEST(InterestOverlay, AsksOfBatsInTurnOrOfWhatWasPicked) {
  const MatchSight sight = decided_sight();
  EXPECT_EQ(asked_thing(sight, {})->id, 3u);
  EXPECT_EQ(asked_thing(sight, {.chosen = 1})->id, 7u);
  EXPECT_EQ(asked_thing(sight, {.chosen = 2})->id, 3u);
  EXPECT_EQ(asked_thing(sight, {.picked = 9})->id, 9u);
  EXPECT_EQ(asked_thing(sight, {.picked = 99})->id, 3u) << "what is gone is not asked of";
  EXPECT_EQ(asked_thing(MatchSight{}, {}), nullptr);
  EXPECT_EQ(thing_at(sight, {10.56, 5.0}, 0.1), 9u);
  EXPECT_EQ(thing_at(sight, {15.0, 5.0}, 0.1), std::nullopt);
}

TEST(InterestOverlay, AsksOfTheNearestThingUnderAClickInWhateverOrderTheyCome) {
  MatchSight sight;
  for (const bool is_nearest_first : {true, false}) {
    sight.things = {{.id = 1, .position = {1.0, 1.0}, .half_extent = {0.1, 0.1}},
                    {.id = 2, .position = {1.5, 1.0}, .half_extent = {0.1, 0.1}}};
    if (!is_nearest_first) std::swap(sight.things[0], sight.things[1]);
    EXPECT_EQ(thing_at(sight, {1.2, 1.0}, 0.5), 1u);
    EXPECT_EQ(thing_at(sight, {1.3, 1.0}, 0.5), 2u);
  }
}

}  // namespace
}  // namespace rink::view
