// The collision library on cases whose answers are evident.
#include <gtest/gtest.h>

#include <cmath>

#include "game/physics/collision/dynamic_tests.h"
#include "game/physics/collision/static_tests.h"
#include "tests/physics/scenes.h"

namespace rink::physics::collision {
namespace {

using Point = Vector<double>;

const Disc<double> puck{{3.0, 4.0}, 1.0};
const Box<double> bat{{0.0, 0.0}, {2.0, 1.0}};

TEST(StaticTests, CountTouchingAsOverlap) {
  EXPECT_TRUE(is_point_in_circle({3.0, 5.0}, puck));
  EXPECT_FALSE(is_point_in_circle({3.0, 5.0 + 1e-15}, puck));
  EXPECT_TRUE(do_bounding_circles_overlap(puck, Disc<double>{{0.0, 0.0}, 4.0}));
  EXPECT_FALSE(do_bounding_circles_overlap(puck, Disc<double>{{0.0, 0.0}, 3.999}));
  EXPECT_TRUE(does_disc_overlap_box(Disc<double>{{5.0, 5.0}, 5.0}, bat));
  EXPECT_FALSE(does_disc_overlap_box(Disc<double>{{5.0, 5.0}, 4.999}, bat));
  EXPECT_TRUE(do_boxes_overlap(bat, Box<double>{{3.0, 3.0}, {1.0, 2.0}}));
  EXPECT_FALSE(do_boxes_overlap(bat, Box<double>{{3.0, 3.0}, {1.0, 1.999}}));
}

TEST(StaticTests, MeasureDistanceFromAPlaneWithItsSide) {
  const Plane<double> plane{{1.0, 1.0}, {0.6, 0.8}};
  EXPECT_DOUBLE_EQ(point_plane_distance(Point(4.0, 5.0), plane), 5.0);
  EXPECT_DOUBLE_EQ(point_plane_distance(Point(-2.0, -3.0), plane), -5.0);
}

TEST(StaticTests, BoundABoxByTheCircleThroughItsCorners) {
  const Disc<double> circle = bounding_circle(Box<double>{{1.0, 2.0}, {3.0, 4.0}});
  EXPECT_EQ(circle.center, Point(1.0, 2.0));
  EXPECT_EQ(circle.radius, 5.0);
}

TEST(PointAgainstEdge, MeetsItFromOutsideBetweenItsEnds) {
  const Edge<double> floor{{2.0, 0.0}, {-2.0, 0.0}};  // walking left, up is on the right
  const auto contact = time_point_meets_edge(Point(0.0, 3.0), Point(0.5, -1.5), floor);
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->time, 2.0);
  EXPECT_EQ(contact->normal, Point(0.0, 1.0));
  EXPECT_TRUE(time_point_meets_edge(Point(2.0, 1.0), Point(0.0, -1.0), floor));
  EXPECT_FALSE(time_point_meets_edge(Point(2.0 + 1e-15, 1.0), Point(0.0, -1.0), floor));
  EXPECT_FALSE(time_point_meets_edge(Point(0.0, -1.0), Point(0.0, 1.0), floor)) << "from inside";
  EXPECT_FALSE(time_point_meets_edge(Point(0.0, 3.0), Point(0.5, -1.5), floor, 1.999));
}

TEST(PointAgainstEdge, MeetsAnEdgeThatComesAtIt) {
  const Edge<double> floor{{2.0, 0.0}, {-2.0, 0.0}};
  const auto contact =
      time_point_meets_moving_edge(Point(1.0, 3.0), Point(1.0, 0.0), floor, Point(1.0, 1.5));
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->time, 2.0);
}

TEST(PointAgainstPlane, CountsBehindAsTouching) {
  const Plane<double> wall{{0.0, 0.0}, {1.0, 0.0}};
  EXPECT_EQ(time_point_meets_plane(Point(3.0, 7.0), Point(-1.5, 1.0), wall)->time, 2.0);
  EXPECT_EQ(time_point_meets_plane(Point(-1e-17, 7.0), Point(-1.5, 1.0), wall)->time, 0.0);
  EXPECT_FALSE(time_point_meets_plane(Point(-1e-17, 7.0), Point(1.5, 1.0), wall));
}

TEST(DiscAgainstDisc, MeetsHeadOnWithTheNormalTowardsTheFirst) {
  const Disc<double> a{{-3.0, 0.0}, 0.5}, b{{3.0, 0.0}, 1.5};
  const auto contact = time_disc_meets_disc(a, Point(1.0, 0.0), b, Point(-1.0, 0.0));
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->time, 2.0);
  EXPECT_EQ(contact->normal, Point(-1.0, 0.0));
  EXPECT_EQ(time_disc_meets_disc(a, Point(1.0, 0.0), b)->time, 4.0);
  EXPECT_FALSE(time_disc_meets_disc(a, Point(1.0, 0.0), b, 3.999));
}

TEST(DiscAgainstBox, MeetsFacesAndRoundedCorners) {
  const Disc<double> falling{{1.0, 4.0}, 1.0};
  const auto face = time_disc_meets_rounded_box(falling, Point(0.0, -1.0), bat, Point(0.0, 1.0));
  ASSERT_TRUE(face);
  EXPECT_EQ(face->time, 1.0);
  EXPECT_EQ(face->normal, Point(0.0, 1.0));
  // Over the corner (2, 1) by 0.6 of the radius: the centre stops at height 1 + 0.8.
  const auto corner = time_disc_meets_rounded_box(Disc<double>{{2.6, 4.0}, 1.0}, Point(0.0, -1.0),
                                                  bat, Point(0.0, 0.0));
  ASSERT_TRUE(corner);
  EXPECT_DOUBLE_EQ(corner->time, 2.2);
  EXPECT_NEAR((corner->normal - Point(0.6, 0.8)).norm(), 0.0, 1e-15);
  EXPECT_EQ(time_disc_meets_sharp_box(Disc<double>{{2.6, 4.0}, 1.0}, Point(0.0, -1.0), bat,
                                      Point(0.0, 0.0))
                ->time,
            2.0);
}

TEST(BoxAgainstBox, MeetsWithTheFaceThatComesLast) {
  const Box<double> a{{-5.0, 4.0}, {1.0, 1.0}};
  const auto contact = time_box_meets_box(a, Point(1.0, -1.0), bat, Point(0.0, 0.0));
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->time, 2.0);  // along x and y at once: a tie
  EXPECT_EQ(contact->normal, Point(-1.0, 0.0));
  EXPECT_EQ(time_box_meets_box(a, Point(1.0, -0.5), bat, Point(0.0, 0.0))->normal, Point(0.0, 1.0));
  EXPECT_FALSE(time_box_meets_box(a, Point(2.0, -0.1), bat, Point(0.0, 0.0)));
}

TEST(ShapesInContact, CollideNowIfTheyCloseAndNeverIfTheyPart) {
  const Disc<double> low{{2.5, 1.5}, 1.0};
  EXPECT_EQ(time_disc_meets_rounded_box(low, Point(-1.0, 0.0), bat, Point(0.0, 0.0))->time, 0.0);
  EXPECT_FALSE(time_disc_meets_rounded_box(low, Point(1.0, 0.0), bat, Point(0.0, 0.0)));
  EXPECT_EQ(time_disc_meets_disc(puck, Point(-1.0, 0.0), Disc<double>{{2.5, 4.0}, 1.0})->time, 0.0);
  EXPECT_FALSE(time_disc_meets_disc(puck, Point(1.0, 0.0), Disc<double>{{2.5, 4.0}, 1.0}));
  EXPECT_EQ(
      time_box_meets_box(bat, Point(0.0, 1.0), Box<double>{{0.0, 1.5}, {1.0, 1.0}}, Point(0.0, 0.0))
          ->time,
      0.0);
  EXPECT_FALSE(time_box_meets_box(bat, Point(0.0, -1.0), Box<double>{{0.0, 1.5}, {1.0, 1.0}},
                                  Point(0.0, 0.0)));
}

TEST(ShapesAtRest, NeverMeet) {
  const Point still(0.0, 0.0);
  EXPECT_FALSE(time_disc_meets_disc(puck, still, Disc<double>{{0.0, 0.0}, 1.0}, still));
  EXPECT_FALSE(time_disc_meets_rounded_box(puck, still, bat, still));
  EXPECT_FALSE(time_box_meets_box(bat, still, Box<double>{{0.5, 0.5}, {1.0, 1.0}}, still))
      << "even in overlap";
  EXPECT_FALSE(
      time_point_meets_edge(Point(0.0, 3.0), still, Edge<double>{{2.0, 0.0}, {-2.0, 0.0}}));
}

TEST(ShapesOfSinglePrecision, AreAnsweredInSinglePrecision) {
  const Disc<float> a{{-3.0F, 0.0F}, 0.5F}, b{{3.0F, 0.0F}, 1.5F};
  const MaybeContact<float> contact =
      time_disc_meets_disc(a, Vector<float>(1.0F, 0.0F), b, Vector<float>(-1.0F, 0.0F));
  EXPECT_EQ(contact->time, 2.0F);
}

TEST(SharpBox, IsTheFourEdgesMovedOutwardsByTheRadius) {
  std::mt19937_64 random(11);
  const double x = bat.half_extent.x() + 0.5, y = bat.half_extent.y() + 0.5;
  const Point corners[4] = {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
  int hits = 0;
  for (int i = 0; i < 20000; ++i) {
    SCOPED_TRACE(i);
    const Disc<double> disc{{test::uniform(random, -8.0, 8.0), test::uniform(random, -8.0, 8.0)},
                            0.5};
    const Point velocity(test::uniform(random, -1.0, 1.0), test::uniform(random, -1.0, 1.0)),
        bat_velocity(test::uniform(random, -1.0, 1.0), test::uniform(random, -1.0, 1.0));
    if (does_disc_overlap_box(disc, Box<double>{bat.center, {x, y}})) continue;
    double first = never<double>;
    for (int k = 0; k < 4; ++k) {
      const auto contact = time_point_meets_moving_edge(
          disc.center, velocity, Edge<double>{corners[k], corners[(k + 1) % 4]}, bat_velocity);
      if (contact) first = std::min(first, contact->time);
    }
    const auto sharp = time_disc_meets_sharp_box(disc, velocity, bat, bat_velocity);
    ASSERT_EQ(sharp.has_value(), first < never<double>);
    if (!sharp) continue;
    ++hits;
    EXPECT_NEAR(sharp->time, first, 4e-15 * (1.0 + first));
  }
  EXPECT_GT(hits, 2000);
}

}  // namespace
}  // namespace rink::physics::collision
