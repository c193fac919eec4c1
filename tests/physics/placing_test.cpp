// Where a body may be put, and that a puck that is put back into play begins anew.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tests/physics/scenes.h"

namespace rink::physics::test {
namespace {

/// 4 x 2 m with goals of 0.5 m, whose edges lie at 0.75 and 1.25 m.
WorldSpec field_with_goals() {
  WorldSpec spec = rink_of(4, 2);
  spec.field.goal_width = 0.5;
  return spec;
}

/// A world whose only puck, of `radius` and 0.5 kg, has scored at the right end, with a spin of
/// 10 rad/s if surfaces are rough. `wait` seconds have passed since.
struct AfterAGoal {
  World world;
  BodyId puck;

  explicit AfterAGoal(const WorldSpec& spec, double radius = 0.0625, double wait = 0.25)
      : world(spec) {
    PuckSpec scoring{.position = {3.5, 1.0}, .velocity = {2.0, 0.0}, .radius = radius, .mass = 0.5};
    scoring.spin = 10.0;
    puck = world.add(scoring);
    EXPECT_TRUE(world.advance(10.0));
    EXPECT_FALSE(world.advance(world.now() + wait));
  }
};

TEST(PlacedPuck, HasNoSpinWhateverItHadWhenItScored) {
  WorldSpec spec = field_with_goals();
  spec.surface_friction = SurfaceFriction{PairTable(1, 0.5), RestitutionTable(1, 0.5)};
  AfterAGoal scene(spec);
  EXPECT_EQ(scene.world.spin(scene.puck), 10.0);
  scene.world.place(scene.puck, {2.0, 1.0}, {0.0, -1.0});
  EXPECT_EQ(scene.world.spin(scene.puck), 0.0);
  EXPECT_EQ(scene.world.kinetic_energy(), 0.25);
  scene.world.advance(scene.world.now() + 1.5);
  // A spinning one would roll along the wall.
  EXPECT_EQ(scene.world.velocity(scene.puck), Vector2(0.0, 1.0));
}

TEST(PlacedPuck, FliesFromThereAndThenUnderDragAndFriction) {
  for (const double drag : {0.0, 0.5})
    for (const double friction : {0.0, 0.75}) {
      SCOPED_TRACE(testing::Message() << "drag " << drag << ", friction " << friction);
      WorldSpec spec = field_with_goals();
      spec.puck_drag = drag;
      spec.puck_friction = friction;
      AfterAGoal scene(spec);
      World& world = scene.world;
      const double begin = world.now(), speed = 1.0, wait = 0.5;
      const std::uint32_t version = world.motion_version(scene.puck);
      world.place(scene.puck, {1.0, 1.0}, {0.6 * speed, 0.8 * speed});
      EXPECT_TRUE(world.is_in_play(scene.puck));
      EXPECT_GT(world.motion_version(scene.puck), version);
      world.advance(begin + wait);
      // dv/dt = -g v - k along the way.
      const double s = drag > 0.0 ? -std::expm1(-drag * wait) / drag : wait;
      const double q = drag > 0.0 ? (wait - s) / drag : 0.5 * wait * wait;
      const double way = speed * s - friction * q;
      const double speed_left = speed * (1.0 - drag * s) - friction * s;
      const Vector2 there = Vector2(1.0, 1.0) + way * Vector2(0.6, 0.8);
      EXPECT_NEAR(world.velocity(scene.puck).x(), 0.6 * speed_left, 1e-14);
      EXPECT_NEAR((world.position(scene.puck) - there).norm(), 0.0, 1e-14);
    }
}

TEST(PlacedPuck, IsMetByThoseWhoComeTheWayAndMeetsThoseWhoLieThere) {
  AfterAGoal scene(field_with_goals());
  World& world = scene.world;
  const double begin = world.now(), reach = 2.0 * 0.0625;
  const BodyId coming = world.add(
      PuckSpec{.position = {1.0, 0.5}, .velocity = {1.0, 0.0}, .radius = 0.0625, .mass = 0.5});
  world.advance(begin + 0.25);
  world.place(scene.puck, {2.0, 0.5}, {0.0, 0.0});
  world.advance(begin + 1.25);
  EXPECT_NEAR(world.motion(scene.puck).time, begin + 1.0 - reach, 1e-14);
  EXPECT_NEAR(world.velocity(scene.puck).x(), 1.0, 1e-14);
  EXPECT_NEAR(world.velocity(coming).x(), 0.0, 1e-14);
}

TEST(PlacedPuck, BringsItsEnergyAndHadTakenItAway) {
  WorldSpec spec = field_with_goals();
  spec.accounts_energy = true;
  AfterAGoal scene(spec);
  EXPECT_NEAR(scene.world.energy_introduced(), 0.0, 1e-15);
  scene.world.place(scene.puck, {2.0, 1.0}, {3.0, 4.0});
  EXPECT_NEAR(scene.world.energy_introduced(), 0.5 * 0.5 * 25.0, 1e-14);
  EXPECT_NEAR(scene.world.kinetic_energy(), 0.5 * 0.5 * 25.0, 1e-14);
}

/// What it had when it left, in its spin too, went with it.
TEST(PlacedPuck, BringsNothingOfTheSpinThatItLeftWith) {
  WorldSpec spec = field_with_goals();
  spec.accounts_energy = true;
  spec.surface_friction = SurfaceFriction{PairTable(1, 0.5), RestitutionTable(1, 0.5)};
  AfterAGoal scene(spec);
  scene.world.place(scene.puck, {2.0, 1.0}, {3.0, 4.0});
  EXPECT_NEAR(scene.world.kinetic_energy(), 0.5 * 0.5 * 25.0, 1e-14);
  EXPECT_NEAR(
      scene.world.energy_introduced() + scene.world.work_of_thrust() - scene.world.dissipated(),
      scene.world.kinetic_energy(), 1e-14);
}

/// A field's length less a radius, and the length that a radius makes with that place, are rounded
/// twice: some places are free, for the puck ends with the field, and lie in the mouth, for its
/// centre is nearer than its radius. There the edge of the goal stops a puck that goes along the
/// goal line.
TEST(PlacedPuck, MeetsTheEdgeOfAGoalWhoseMouthItReachesByARounding) {
  int found = 0;
  for (double radius = 0.031; radius < 0.06; radius += 0.001) {
    const double x = std::nextafter(4.0 - radius, 4.0);
    for (const bool is_added : {false, true}) {
      AfterAGoal scene(field_with_goals(), radius);
      World& world = scene.world;
      if (x + radius > 4.0) {
        EXPECT_FALSE(world.is_free({x, 1.0}, radius)) << radius;
        continue;
      }
      ++found;
      if (is_added)
        world.add(PuckSpec{.position = {x, 1.0}, .velocity = {0.0, 1.0}, .radius = radius});
      else world.place(scene.puck, {x, 1.0}, {0.0, 1.0});
      world.advance(world.now() + 0.5);
      EXPECT_EQ(world.counters().post_impacts, 1u) << radius;
    }
  }
  EXPECT_GE(found, 10);
}

TEST(AddedPuck, InTheMouthOfAGoalMeetsItsEdgesScoresOrComesOut) {
  constexpr double radius = 0.0625;
  WorldSpec spec = field_with_goals();
  spec.allow_overlap = true;  // with the line of the wall
  for (const double end : {0.0, 4.0}) {
    SCOPED_TRACE(end);
    const double inwards = end == 0.0 ? 1.0 : -1.0;
    const Vector2 place(end + 0.5 * radius * inwards, 1.0);
    const auto thrown = [&](const Vector2& velocity) {
      World world(spec);
      world.record_events(true);
      world.add(PuckSpec{.position = place, .velocity = velocity, .radius = radius});
      return world;
    };
    for (const double side : {-1.0, 1.0}) {
      World world = thrown({0.0, side});
      // The edge is half a radius beside the way: the normal is at 30 degrees to it.
      const double hit = 0.25 - std::sqrt(0.75) * radius;
      EXPECT_FALSE(world.advance(hit + 0.1));
      ASSERT_EQ(world.events().size(), 1u);
      EXPECT_EQ(world.events()[0].kind, EventKind::post);
      EXPECT_NEAR(world.events()[0].time, hit, 1e-14);
      EXPECT_NEAR(world.velocity({0}).x(), inwards * std::sqrt(0.75), 1e-13);
      EXPECT_NEAR(world.velocity({0}).y(), -0.5 * side, 1e-13);
    }
    World scoring = thrown({-inwards, 0.0});
    const auto goal = scoring.advance(1.0);
    ASSERT_TRUE(goal);
    EXPECT_NEAR(goal->time, 0.5 * radius, 1e-15);
    World leaving = thrown({inwards, 0.0});
    EXPECT_FALSE(leaving.advance(1.0));
    EXPECT_EQ(leaving.position({0}), Vector2(place.x() + inwards, 1.0));
    EXPECT_EQ(leaving.counters().events(), 0u);
  }
}

TEST(FreePlaces, LieWithinTheWallsAndNotInAGoal) {
  constexpr double radius = 0.0625;
  const World world(field_with_goals());
  for (const double x : {radius, 4.0 - radius})
    for (const double y : {radius, 1.0, 2.0 - radius})
      EXPECT_TRUE(world.is_free({x, y}, radius)) << x << " " << y;
  const double outside = 1e-15;
  for (const double y : {0.5, 1.0}) {  // before the wall and before the goal
    EXPECT_FALSE(world.is_free({radius - outside, y}, radius)) << y;
    EXPECT_FALSE(world.is_free({4.0 - radius + outside, y}, radius)) << y;
    EXPECT_FALSE(world.is_free({0.5 * radius, y}, radius)) << y;
  }
  EXPECT_FALSE(world.is_free({2.0, radius - outside}, radius));
  EXPECT_FALSE(world.is_free({2.0, 2.0 - radius + outside}, radius));
  const Vector2 box(0.25, 0.125);
  for (const double x : {0.25, 3.75})
    for (const double y : {0.125, 1.875}) EXPECT_TRUE(world.is_free({x, y}, box)) << x << " " << y;
  EXPECT_FALSE(world.is_free({0.25 - outside, 1.0}, box));
  EXPECT_FALSE(world.is_free({1.0, 1.875 + outside}, box));
}

TEST(FreePlaces, MayTouchBodiesWhereTheyAreNow) {
  constexpr double radius = 0.0625;
  World world(rink_of(8, 8));
  const BodyId moving =
      world.add(PuckSpec{.position = {1.0, 2.0}, .velocity = {1.0, 0.0}, .radius = radius});
  world.add(PostSpec{.position = {4.0, 4.0}, .radius = 0.25});
  world.add(BatSpec{.position = {6.0, 6.0}, .half_extent = {0.25, 0.5}});
  const BodyId leaving = world.add(PuckSpec{.position = {2.0, 7.0}, .radius = radius});
  world.advance(1.0);
  const auto expect_edge = [&](const Vector2& touching, const Vector2& towards) {
    EXPECT_TRUE(world.is_free(touching, radius)) << touching.transpose();
    EXPECT_FALSE(world.is_free(touching + 1e-14 * towards, radius)) << touching.transpose();
  };
  EXPECT_TRUE(world.is_free({1.0, 2.0}, radius));  // where the moving one was
  expect_edge({2.0 + 2.0 * radius, 2.0}, {-1.0, 0.0});
  expect_edge({2.0, 2.0 - 2.0 * radius}, {0.0, 1.0});
  expect_edge({4.0, 4.0 + 0.25 + radius}, {0.0, -1.0});
  expect_edge({6.0 - 0.25 - radius, 6.5}, {1.0, 0.0});
  expect_edge({6.25, 6.5 + radius}, {0.0, -1.0});
  const Vector2 from_corner(0.6, 0.8);  // rounded, for a disc
  expect_edge(Vector2(6.25, 6.5) + (radius + 2e-15) * from_corner, -from_corner);
  EXPECT_TRUE(world.is_free({6.5, 6.0}, Vector2(0.25, 0.125)));
  EXPECT_FALSE(world.is_free({6.5 - 1e-14, 6.0}, Vector2(0.25, 0.125)));
  EXPECT_FALSE(world.is_free({2.0, 7.0}, radius));
  world.remove(leaving);
  EXPECT_TRUE(world.is_free({2.0, 7.0}, radius));
  world.remove(moving);
  EXPECT_TRUE(world.is_free({2.0, 2.0}, radius));
}

TEST(FreePlaces, AreThoseOfPucksThatHaveScored) {
  AfterAGoal scene(field_with_goals());
  EXPECT_TRUE(scene.world.is_free({4.0 - 0.0625, 1.0}, 0.0625));
}

#ifdef NDEBUG
constexpr bool has_asserts = false;
#else
constexpr bool has_asserts = true;
#endif

TEST(PlacingDeathTest, NamesWhatIsNotFreeOrNoLongerThere) {
  if (!has_asserts) GTEST_SKIP() << "asserts are off in this build";
  const auto place = [](const Vector2& position, const Vector2& velocity) {
    AfterAGoal scene(field_with_goals());
    scene.world.add(PuckSpec{.position = {2.0, 1.0}});
    scene.world.place(scene.puck, position, velocity);
    return scene;
  };
  const Vector2 still(0.0, 0.0), nowhere(std::numeric_limits<double>::quiet_NaN(), 1.0);
  EXPECT_DEATH(place({2.05, 1.0}, still), "is_free");
  EXPECT_DEATH(place({0.03, 1.0}, still), "is_free");  // in the mouth of a goal
  EXPECT_DEATH(place(nowhere, still), "allFinite");
  EXPECT_DEATH(place({1.0, 1.0}, nowhere), "allFinite");
  const auto place_removed = [&] {
    AfterAGoal scene = place({1.0, 1.0}, still);
    scene.world.remove(scene.puck);
    scene.world.place(scene.puck, {1.5, 1.0}, still);
  };
  EXPECT_DEATH(place_removed(), "removed|contains|is_there");
  EXPECT_DEATH(World(rink_of(4, 2)).add(PuckSpec{.position = {0.03, 1.0}}), "is_free");
  EXPECT_DEATH(World(rink_of(4, 2)).add(PuckSpec{.position = {1, 1}, .mass = 0.0}), "mass");
}

}  // namespace
}  // namespace rink::physics::test
