// What a tile takes back of the impacts in a window that is undone.
#include "game/physics/slabs/tile_impact.h"

#include <gtest/gtest.h>

#include <cstdint>

#include "game/physics/bodies/bodies.h"
#include "game/physics/engine/engine.h"
#include "tests/physics/scenes.h"

namespace rink::physics::test {
namespace {

BodyState body_at(BodyKind kind, const Vector2& place, double speed) {
  BodyState state;
  state.kind = kind;
  state.flight.x = place.x(), state.flight.y = place.y(), state.flight.vx = speed;
  if (kind == BodyKind::puck) state.flight.radius = 0.25;
  else state.half_extent = {0.25, 0.25};
  state.mass = 1.0;
  return state;
}

/// A puck and a bat that touch and close, in a world with some restitution.
struct Meeting {
  Engine engine;
  std::uint32_t puck, bat;
  TileImpact impact;

  explicit Meeting(double restitution)
      : engine(rink_of(4, 2, restitution)),
        puck(engine.add(body_at(BodyKind::puck, {1.0, 1.0}, 1.0)).index),
        bat(engine.add(body_at(BodyKind::bat, {1.5, 1.0}, -1.0)).index),
        impact(engine.parts()) {
    begin();
  }
  void begin() {
    engine.predict_pending();
    impact.begin_window(false);
  }
  const ImpactCounts& counts_of(std::uint32_t body) {
    return engine.parts().history.impact_counts()[body];
  }
};

TEST(TileImpact, TakesBackThatTwoHaveMetAtAnInstant) {
  Meeting meeting(1.0);
  meeting.engine.parts().history.count_meeting({meeting.puck, meeting.bat, {}}, 0.0);
  ASSERT_TRUE(meeting.impact.strike(meeting.puck, meeting.bat, 0.0));
  meeting.impact.count_meeting(0.0);
  for (const std::uint32_t body : {meeting.puck, meeting.bat})
    EXPECT_EQ(meeting.counts_of(body).first_contacts.count, 2u);
  meeting.impact.undo();
  for (const std::uint32_t body : {meeting.puck, meeting.bat})
    EXPECT_EQ(meeting.counts_of(body).first_contacts.count, 1u);
}

TEST(TileImpact, TakesBackTheImpactsThatLostEnergy) {
  Meeting meeting(0.5);
  ASSERT_FALSE(meeting.impact.strike(meeting.puck, meeting.bat, 0.0));
  const std::uint32_t other = meeting.engine.add(body_at(BodyKind::puck, {0.6, 0.7}, 3.0)).index;
  meeting.begin();
  ASSERT_TRUE(meeting.impact.bounce(meeting.puck, other, 0.0));
  meeting.impact.settle(0.0);
  EXPECT_EQ(meeting.counts_of(other).impacts, 1u);
  meeting.impact.undo();
  EXPECT_EQ(meeting.counts_of(other).impacts, 0u);
  EXPECT_EQ(meeting.counts_of(meeting.puck).impacts, 0u);
}

}  // namespace
}  // namespace rink::physics::test
