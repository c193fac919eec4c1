// Zones of peers over the field, from what one of them knows.
#include "game/view/overlays/zones_overlay.h"

#include <gmock/gmock.h>

namespace rink::view {
namespace {

MatchSight shared_sight() {
  MatchSight sight;
  sight.field.length = 4.0, sight.field.width = 2.0;
  for (std::uint32_t id = 0; id < 4; ++id)
    sight.things.push_back({.id = id, .position = {0.5 + id, 1.0}, .half_extent = {0.3, 0.4}});
  sight.own_thing = 1;
  sight.zones.emplace();
  sight.zones->own_peer = 1, sight.zones->halo = 0.25, sight.zones->own_count = 7;
  sight.zones->zones = {{0, 0.0, 0.0, 2.0, 2.0}, {1, 2.0, 0.0, 4.0, 2.0}};
  sight.zones->ghosts = {1}, sight.zones->received = {0};
  return sight;
}

TEST(ZonesOverlay, ShowsEachZoneTheOwnHaloWithinTheFieldAndWhoseBodiesAreOthers) {
  const Overlay overlay = zones_overlay(shared_sight(), true);
  ASSERT_EQ(overlay.rectangles.size(), 3u);
  EXPECT_GT(overlay.rectangles[1].fill.alpha, overlay.rectangles[0].fill.alpha) << "the own one";
  const OverlayRectangle& halo = overlay.rectangles[2];
  EXPECT_EQ(std::tuple(halo.low_x, halo.low_y, halo.high_x, halo.high_y),
            std::tuple(1.75, 0.0, 4.0, 2.0));
  EXPECT_EQ(overlay.discs.size(), 3u) << "the own bat, which is a ghost, and one told of";
  EXPECT_THAT(overlay.lines[0], testing::HasSubstr("peer 1 has 7 bodies and 1 ghosts"));
}

TEST(ZonesOverlay, HiddenMarksTheOwnBatOfACrowdAlone) {
  MatchSight sight = shared_sight();
  const Overlay overlay = zones_overlay(sight, false);
  EXPECT_TRUE(overlay.rectangles.empty() && overlay.lines.empty());
  ASSERT_EQ(overlay.discs.size(), 1u);
  EXPECT_EQ(overlay.discs[0].x, 1.5);
  sight.own_team = game::Team::left;
  EXPECT_TRUE(zones_overlay(sight, false).discs.empty()) << "a match of two needs no mark";
  sight.zones.reset();
  EXPECT_TRUE(zones_overlay(sight, true).discs.empty());
}

}  // namespace
}  // namespace rink::view
