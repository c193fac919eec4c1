// When contact comes to rest and when it ends: each threshold from both sides, and each end at the
// time of its closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "tests/physics/scenes.h"

namespace rink::physics::test {
namespace {

// Powers of two, so that touching places are exact.
constexpr double small_radius = 0.03125, thickness = 0.0625, half_width = 0.25;

std::vector<Event> events_of_kind(const World& world, EventKind kind) {
  std::vector<Event> found;
  for (const Event& event : world.events())
    if (event.kind == kind) found.push_back(event);
  return found;
}

/// Along `axis`, the bat leads to a puck that touches the middle of its face.
struct BatAndPuck {
  World world;
  BodyId bat, puck;

  BatAndPuck(const WorldSpec& spec, int axis, double along_face, const Vector2& bat_velocity,
             const Vector2& puck_velocity, double puck_mass = 0.5)
      : world(spec) {
    world.record_events(true);
    Vector2 half_extent(half_width, half_width), centre(2.0, 2.0), offset(along_face, along_face);
    half_extent[axis] = thickness;
    offset[axis] = thickness + small_radius;
    bat = world.add(BatSpec{
        .position = centre, .velocity = bat_velocity, .half_extent = half_extent, .mass = 3.0});
    puck = world.add(PuckSpec{.position = centre + offset,
                              .velocity = puck_velocity,
                              .radius = small_radius,
                              .mass = puck_mass});
  }
};

Vector2 along(int axis, double value, double across = 0.0) {
  return axis == 0 ? Vector2(value, across) : Vector2(across, value);
}

TEST(RestContact, BeginsWhereAPressedBodyComesSlowerThanTwentyContactTimes) {
  for (const double contact_time : {5e-4, 2e-3})
    for (const double restitution : {0.25, 0.5, 1.0})
      for (const double part : {0.999, 1.001}) {
        SCOPED_TRACE(testing::Message() << contact_time << " " << restitution << " " << part);
        WorldSpec spec = rink_of(4, 4, restitution);
        spec.contact_time = contact_time;
        World world(spec);
        // It falls from rest to the wall and arrives at the speed v = sqrt(2 a d).
        const double thrust = 6.0, speed = part * 20.0 * contact_time;
        BatSpec bat;
        bat.position = {bat.half_extent.x() + speed * speed / (2.0 * thrust), 2.0};
        const BodyId falling = world.add(bat);
        world.set_thrust(falling, {-thrust, 0.0});
        const double later = 1e-3 * speed / thrust;
        world.advance(speed / thrust + later);
        EXPECT_EQ(world.counters().wall_impacts, 1u);
        EXPECT_EQ(world.counters().rests, part < 1.0 ? 1u : 0u);
        EXPECT_EQ(world.is_held(falling), part < 1.0);
        const double bounced = restitution * speed - thrust * later;
        EXPECT_NEAR(world.velocity(falling).x(), part < 1.0 ? 0.0 : bounced, 1e-12);
      }
}

TEST(RestContact, NeverBeginsWhereNothingPresses) {
  for (const double restitution : {0.25, 0.5, 1.0})
    for (const double thrust : {0.0, 0.5e-7, 2e-7}) {
      SCOPED_TRACE(testing::Message() << restitution << " " << thrust);
      World world(rink_of(4, 4, restitution));
      BatSpec bat{.position = {0.0, 2.0}, .velocity = {-0.005, 0.0}};
      bat.position.x() = bat.half_extent.x() + 0.001;
      const BodyId slow = world.add(bat);
      world.set_thrust(slow, {-thrust, 0.0});
      world.advance(0.3);
      EXPECT_EQ(world.counters().rests, thrust > 1e-7 ? 1u : 0u);
      EXPECT_NEAR(world.velocity(slow).x(), thrust > 1e-7 ? 0.0 : restitution * 0.005, 1e-7);
    }
}

/// The force on the puck is m M/(M + m) (a + (g - G) v): of a puck that drag slows more than the
/// bat, it pushes against a bat that brakes a little, until v has fallen to -a/(g - G).
TEST(RestContact, EndsWhereDragsThatDifferPullItApart) {
  const double M = 3.0, m = 0.5, G = 0.2, g = 2.0, thrust = -0.3, start = 1.0;
  const double terminal = M * thrust / (M * G + m * g), fading = (M * G + m * g) / (M + m);
  const double parting_speed = -thrust / (g - G);
  const double parting = std::log((start - terminal) / (parting_speed - terminal)) / fading;
  for (const int axis : {0, 1}) {
    SCOPED_TRACE(axis);
    const Vector2 velocity = along(axis, start);
    BatAndPuck scene(rink_of(8, 8, 0.5, g, G), axis, 0.0, velocity, velocity, m);
    World& world = scene.world;
    world.set_thrust(scene.bat, along(axis, thrust));
    world.advance(0.999 * parting);
    const double v = terminal + (start - terminal) * std::exp(-fading * 0.999 * parting);
    EXPECT_NEAR(world.velocity(scene.puck)[axis], v, 1e-12);
    EXPECT_EQ(world.velocity(scene.puck), world.velocity(scene.bat));
    EXPECT_TRUE(world.is_held(scene.puck));
    world.advance(parting + 0.5);
    const std::vector<Event> releases = events_of_kind(world, EventKind::release);
    ASSERT_EQ(releases.size(), 1u);
    EXPECT_NEAR(releases[0].time, parting, 1e-12);
    EXPECT_FALSE(world.is_held(scene.puck));
    const double alone = thrust / G + (parting_speed - thrust / G) * std::exp(-G * 0.5);
    EXPECT_NEAR(world.velocity(scene.puck)[axis], parting_speed * std::exp(-g * 0.5), 1e-12);
    EXPECT_NEAR(world.velocity(scene.bat)[axis], alone, 1e-12);
    EXPECT_EQ(world.counters().rests, 1u);
  }
}

TEST(RestContact, LastsWhereDragsThatDifferNeverPull) {
  // A bat that coasts or pushes is pressed on by a puck that drag slows more, for ever.
  for (const auto& [thrust, speed] : {std::pair{0.0, 1.0}, {0.3, 1.0}, {0.3, 0.1}}) {
    const Vector2 velocity(speed, 0.0);  // the terminal one at a thrust of 0.3 m/s^2 is 0.5625 m/s
    BatAndPuck scene(rink_of(80, 8, 0.5, 2.0, 0.2), 0, 0.0, velocity, velocity);
    scene.world.set_thrust(scene.bat, {thrust, 0.0});
    scene.world.advance(60.0);
    EXPECT_EQ(scene.world.velocity(scene.puck), scene.world.velocity(scene.bat));
    EXPECT_EQ(scene.world.counters().rests, 1u);
    EXPECT_EQ(scene.world.counters().releases, 0u);
  }
}

TEST(RestContact, EndsAtOnceWhereThrustPullsItApartByMoreThanRounding) {
  for (const double pull : {0.5e-9, 2e-9, 1e-4}) {
    SCOPED_TRACE(pull);
    BatAndPuck scene(rink_of(8, 8, 0.5), 0, 0.0, {0.0, 0.0}, {0.0, 0.0});
    scene.world.set_thrust(scene.bat, {6.0, 0.0});
    scene.world.advance(0.125);
    EXPECT_TRUE(scene.world.is_held(scene.puck));
    scene.world.set_thrust(scene.bat, {-pull, 0.0});
    scene.world.advance(0.25);
    EXPECT_EQ(scene.world.is_held(scene.puck), pull < 1e-9);
    EXPECT_EQ(scene.world.counters().releases, pull < 1e-9 ? 0u : 1u);
  }
}

/// A puck on the face of a bat, `margin` [m] from its end, that slides towards the end at
/// `outwards`.
World pushed_near_the_end_of_a_face(double margin, double outwards, int axis, double side,
                                    double duration) {
  BatAndPuck scene(rink_of(8, 8, 0.5), axis, side * (half_width - margin), {0.0, 0.0},
                   along(axis, 0.0, side * outwards));
  scene.world.set_thrust(scene.bat, along(axis, 6.0));
  scene.world.advance(duration);
  return std::move(scene.world);
}

TEST(RestContact, NeverBeginsAtTheEndOfAFaceThatIsBeingLeft) {
  for (const int axis : {0, 1})
    for (const double side : {-1.0, 1.0}) {
      SCOPED_TRACE(testing::Message() << "axis " << axis << ", side " << side);
      for (const double margin : {0.0, 0.5e-9}) {
        // Outwards, or at rest on the very end: the next instant would end it.
        for (const double outwards : {0.0, 0.01}) {
          if (outwards == 0.0 && margin > 0.0) continue;
          const World world = pushed_near_the_end_of_a_face(margin, outwards, axis, side, 1e-3);
          EXPECT_EQ(world.counters().rests, 0u) << margin;
        }
        const World inwards = pushed_near_the_end_of_a_face(margin, -0.01, axis, side, 0.1);
        const std::vector<Event> rests = events_of_kind(inwards, EventKind::rest);
        ASSERT_EQ(rests.size(), 1u) << margin;
        EXPECT_EQ(rests[0].time, 0.0) << margin;
        EXPECT_EQ(inwards.counters().releases, 0u) << margin;
      }
      const World beyond = pushed_near_the_end_of_a_face(-1e-9, -0.001, axis, side, 1e-7);
      EXPECT_EQ(beyond.counters().rests, 0u);
    }
}

TEST(RestContact, EndsWhereThePuckReachesTheEndOfTheFace) {
  for (const int axis : {0, 1})
    for (const double side : {-1.0, 1.0})
      for (const double margin : {2e-9, 1e-6, 0.1}) {
        SCOPED_TRACE(testing::Message() << axis << " " << side << " " << margin);
        const World world =
            pushed_near_the_end_of_a_face(margin, 0.5, axis, side, 2.0 * margin + 1e-6);
        const std::vector<Event> releases = events_of_kind(world, EventKind::release);
        ASSERT_EQ(world.counters().rests, 1u);
        ASSERT_EQ(releases.size(), 1u);
        EXPECT_NEAR(releases[0].time, margin / 0.5, 1e-15 / 0.5);
      }
}

/// A bat pushes two pucks in line, which slide along its face, each at a speed of its own.
World pushed_in_line(double near_across, double far_across) {
  BatAndPuck scene(rink_of(8, 8, 0.5), 0, 0.0, {0.0, 0.0}, {0.0, near_across});
  scene.world.add(PuckSpec{.position = {2.0 + thickness + 3.0 * small_radius, 2.0},
                           .velocity = {0.0, far_across},
                           .radius = small_radius,
                           .mass = 0.5});
  scene.world.set_thrust(scene.bat, {6.0, 0.0});
  scene.world.advance(0.05);
  return std::move(scene.world);
}

TEST(RestContact, OfTwoPucksNeedsThatNothingMovesThemSideways) {
  const auto rests_of_pucks = [](const World& world) {
    std::size_t count = 0;
    for (const Event& event : events_of_kind(world, EventKind::rest))
      count += event.body.index > 0 && event.other && event.other->index > 0;
    return count;
  };
  EXPECT_EQ(rests_of_pucks(pushed_in_line(0.0, 0.0)), 1u);
  EXPECT_EQ(rests_of_pucks(pushed_in_line(0.25, 0.25)), 1u);
  EXPECT_EQ(rests_of_pucks(pushed_in_line(0.0, 1e-3)), 0u);
  EXPECT_EQ(rests_of_pucks(pushed_in_line(0.25, -0.25)), 0u);
}

/// A bat pins two pucks in line to a wall; a third one hits the one at the wall squarely from the
/// side.
TEST(RestContact, OfTwoPucksEndsAtTheHitThatMovesOneOfThemSideways) {
  World world(rink_of(4, 4, 0.5));
  world.record_events(true);
  const auto add_puck = [&](double x, double y, double vy) {
    return world.add(
        PuckSpec{.position = {x, y}, .velocity = {0.0, vy}, .radius = small_radius, .mass = 0.5});
  };
  const BodyId at_wall = add_puck(small_radius, 2.0, 0.0);
  const BodyId behind = add_puck(3.0 * small_radius, 2.0, 0.0);
  const BodyId bat = world.add(BatSpec{.position = {4.0 * small_radius + thickness, 2.0},
                                       .half_extent = {thickness, half_width},
                                       .mass = 3.0});
  add_puck(small_radius, 3.0, -1.0);
  world.set_thrust(bat, {-6.0, 0.0});
  const double hit = 1.0 - 2.0 * small_radius;
  world.advance(0.99 * hit);
  EXPECT_TRUE(world.is_held(behind));
  EXPECT_EQ(world.counters().releases, 0u);
  world.advance(hit);
  const std::vector<Event> releases = events_of_kind(world, EventKind::release);
  ASSERT_FALSE(releases.empty());
  EXPECT_NEAR(releases[0].time, hit, 1e-15);
  EXPECT_EQ(releases[0].body, at_wall);
  EXPECT_EQ(releases[0].other, behind);
  EXPECT_NEAR(world.velocity(at_wall).y(), -0.75, 1e-13);  // (1 + e)/2 of the speed
}

TEST(RestContact, EndsForWhoeverStaysWhenTheOtherOneIsTakenOut) {
  for (int axis = 0; axis < 2; ++axis) {
    BatAndPuck scene(rink_of(4, 4, 0.5), axis, 0.0, {0.0, 0.0}, {0.0, 0.0});
    World& world = scene.world;
    world.set_thrust(scene.bat, along(axis, 1.0));
    world.advance(0.5);
    ASSERT_TRUE(world.is_held(scene.puck)) << "along " << axis;
    const Vector2 position = world.position(scene.puck), velocity = world.velocity(scene.puck);
    world.remove(scene.bat);
    EXPECT_FALSE(world.is_held(scene.puck)) << "along " << axis;
    world.advance(0.75);
    EXPECT_EQ(world.velocity(scene.puck), velocity);
    EXPECT_NEAR((world.position(scene.puck) - position - 0.25 * velocity).norm(), 0.0, 1e-15);
  }
}

}  // namespace
}  // namespace rink::physics::test
