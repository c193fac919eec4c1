// Fields of view and shadows case by case: closed edges to the last bit, where a subscriber looks,
// what a post hides, and exact sums.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "im/basics/exact.h"
#include "im/view/shadow.h"
#include "tests/im/cases.h"
#include "tests/im/long_play.h"

namespace rink::im {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr Region arena{0.0, 0.0, 100.0, 100.0}, viewer{40.0, 40.0, 60.0, 60.0};

std::vector<Entity> entered(Filter& filter) {
  std::vector<Entity> entities;
  for (const Change& change : filter.match())
    if (change.transition == Transition::entered) entities.push_back(change.entity);
  return entities;
}

TEST(Exact, TellsSumsApartThatDoublesTakeForEqual) {
  const auto square_less = [](const auto& n) {
    return (n[0] - n[1]) * (n[0] - n[1]) - n[2] * n[2];
  };
  EXPECT_EQ(sign_of(std::array{0x1p60, 0x1p-60, 0x1p60}, square_less), -1);
  EXPECT_EQ(sign_of(std::array{0x1p60, -0x1p-60, 0x1p60}, square_less), 1);
  EXPECT_EQ(sign_of(std::array{0x1p60, 0.0, -0x1p60}, square_less), 0);
  EXPECT_EQ(sign_of(std::array{0x1p-200, 0.0, 0x1p-200}, square_less), 0);
  EXPECT_EQ(sign_of(std::array{0x1p200, 0x1p-200, 0x1p200}, square_less), -1);
}

TEST(ConeScheme, IsClosedAtItsEdgesAndItsReachToTheLastBit) {
  const auto filter = make_filter("cone", {.world = arena, .half_angle_deg = 45.0});
  filter->set_subscription_region(0, viewer);
  filter->set_heading(0, {3.0, 0.0});
  filter->set_update_region(0, point(55.0, 55.0));
  filter->set_update_region(1, point(std::nextafter(55.0, 0.0), 55.0));
  filter->set_update_region(2, point(60.0, 50.0));
  filter->set_update_region(3, {std::nextafter(60.0, 61.0), 49.0, 61.0, 51.0});
  filter->set_update_region(
      4, {54.0, 55.0, 58.0, 58.0});  // only its corner (58, 55) side is inside, past the edge
  filter->set_update_region(5, point(50.0, 50.0));         // at the eye
  filter->set_update_region(6, point(45.0, 50.0));         // behind
  filter->set_update_region(7, {40.0, 40.0, 50.0, 50.0});  // behind, but it touches the eye
  EXPECT_THAT(entered(*filter), ElementsAre(0, 2, 4, 5, 7));
}

TEST(ConeScheme, LooksWhereItWasToldElseWhereItWentElseEverywhere) {
  const auto filter = make_filter("cone", {.world = arena, .half_angle_deg = 60.0});
  filter->set_subscription_region(0, viewer);
  filter->set_update_region(0, point(55.0, 50.0));
  filter->set_update_region(1, point(45.0, 50.0));
  EXPECT_THAT(entered(*filter), ElementsAre(0, 1)) << "it has not moved yet";
  filter->set_subscription_region(0, {40.5, 40.0, 60.5, 60.0});
  EXPECT_THAT(match(*filter), ElementsAre(Change{0, 1, Transition::left}))
      << "it went to the right";
  EXPECT_THAT(match(*filter), IsEmpty()) << "at rest it goes on looking there";
  filter->set_heading(0, {-1.0, 0.0});
  EXPECT_THAT(match(*filter),
              ElementsAre(Change{0, 0, Transition::left}, Change{0, 1, Transition::entered}));
  filter->set_subscription_region(0, viewer);
  filter->set_subscription_region(0, {41.0, 40.0, 61.0, 60.0});
  EXPECT_THAT(match(*filter), IsEmpty()) << "told is told";
  filter->set_heading(0, {});
  EXPECT_THAT(match(*filter), IsEmpty()) << "until it moves";
  filter->set_subscription_region(0, {41.5, 40.0, 61.5, 60.0});
  EXPECT_THAT(match(*filter),
              ElementsAre(Change{0, 0, Transition::entered}, Change{0, 1, Transition::left}));
}

TEST(ConeScheme, LetsANewSubscriberLookEverywhereThoughOneOfItsNumberWentBefore) {
  for (const bool was_told : {true, false}) {
    const auto filter = make_filter("cone", {.world = arena, .half_angle_deg = 60.0});
    filter->set_update_region(0, point(55.0, 50.0));
    filter->set_update_region(1, point(45.0, 50.0));
    filter->set_subscription_region(0, viewer);
    EXPECT_THAT(entered(*filter), ElementsAre(0, 1));
    if (was_told) filter->set_heading(0, {1.0, 0.0});
    else filter->set_subscription_region(0, {40.5, 40.0, 60.5, 60.0});
    EXPECT_THAT(match(*filter), ElementsAre(Change{0, 1, Transition::left}));
    filter->remove_subscriber(0);
    match(*filter);
    filter->set_subscription_region(0, viewer);
    EXPECT_THAT(entered(*filter), ElementsAre(0, 1)) << (was_told ? "told" : "moved");
  }
}

TEST(ConeScheme, IsNetAndCostsNothingWhereNobodyTurns) {
  const auto filter = make_filter("cone", {.world = arena});
  filter->set_subscription_region(0, viewer);
  filter->set_heading(0, {1.0, 0.0});
  for (Entity entity = 0; entity < 100; ++entity)
    filter->set_update_region(entity, point(entity, 50.0));
  filter->match();
  const FilterCounters before = filter->counters();
  filter->set_heading(0, {1.0, 0.0});
  EXPECT_THAT(match(*filter), IsEmpty());
  EXPECT_EQ(filter->counters().pairs_tested, before.pairs_tested);
  EXPECT_EQ(filter->counters().regions_moved, before.regions_moved);
  filter->set_heading(0, {-1.0, 0.0});
  filter->set_heading(0, {1.0, 0.0});
  EXPECT_THAT(match(*filter), IsEmpty()) << "net";
  filter->set_heading(77, {1.0, 0.0});  // nobody
  EXPECT_THAT(match(*filter), IsEmpty());
}

/// Who was told to look along the longest vector there is, then left alone, and then goes another
/// way: what rested in view is out of it.
TEST(ConeScheme, SeesATurnWhateverTheLengthOfTheHeading) {
  for (const double length : {1e308, 1.0, 1e-160, 5e-324}) {
    const auto filter =
        make_filter("cone", {.world = {0.0, 0.0, 1000.0, 1000.0}, .half_angle_deg = 45.0});
    filter->set_subscription_region(0, {300.0, 300.0, 700.0, 700.0});
    filter->set_heading(0, {length, 0.0});
    filter->set_update_region(0, point(586.6, 450.0));  // 30 degrees to the right
    EXPECT_THAT(entered(*filter), ElementsAre(0)) << length;
    filter->set_heading(0, {});
    filter->set_subscription_region(0, {301.9, 300.8, 701.9, 700.8});  // 23 degrees to the left
    EXPECT_THAT(match(*filter), ElementsAre(Change{0, 0, Transition::left})) << length;
  }
}

TEST(ConeScheme, HasTheShareOfTheDiscThatItsAngleHas) {
  Random random(5);
  std::vector<Region> places;
  for (int i = 0; i < 40'000; ++i) {
    const double x = between(random, 0.0, 100.0);
    places.push_back(point(x, between(random, 0.0, 100.0)));
  }
  const auto count = [&places](const char* scheme, double half_angle_deg) {
    const auto filter = make_filter(scheme, {.world = arena, .half_angle_deg = half_angle_deg});
    Random own(6);
    for (Subscriber i = 0; i < 200; ++i) {
      const double x = between(own, 20.0, 80.0), y = between(own, 20.0, 80.0),
                   angle = between(own, 0.0, 2.0 * std::numbers::pi);
      filter->set_subscription_region(i, around(x, y, 15.0));
      filter->set_heading(i, {std::cos(angle), std::sin(angle)});
    }
    for (Entity i = 0; i < places.size(); ++i) filter->set_update_region(i, places[i]);
    return static_cast<double>(filter->match().size());
  };
  const double disc = count("aura", 60.0);
  for (const double half_angle : {30.0, 60.0, 90.0, 135.0, 180.0})
    EXPECT_NEAR(count("cone", half_angle) / disc / (half_angle / 180.0), 1.0, 0.01) << half_angle;
}

TEST(SightScheme, HidesWhatOnePostCoversAndSeesPastItsRim) {
  const auto filter = make_filter("sight", {.world = arena, .posts = {{50.0, 55.0, 1.0}}});
  filter->set_subscription_region(0, viewer);
  filter->set_update_region(0, point(50.0, 58.0));         // straight behind the post
  filter->set_update_region(1, point(50.0, 53.0));         // before it
  filter->set_update_region(2, {49.5, 58.0, 50.5, 58.5});  // all of it behind
  filter->set_update_region(3, {49.5, 58.0, 55.0, 58.5});  // one end looks out
  filter->set_update_region(4, point(50.0, 55.0));         // in the post
  filter->set_update_region(5, point(51.0, 55.0));  // on its rim, away from the eye's tangent
  filter->set_update_region(6, point(50.0, 54.0));  // on its rim, before it
  EXPECT_THAT(entered(*filter), ElementsAre(1, 3, 6));
}

TEST(SightScheme, LetsAWayPassThatOnlyTouchesAPost) {
  // From (50, 50) straight up along x = 50 past a post whose rim is there.
  const auto sees = [](double middle_x) {
    const auto filter = make_filter("sight", {.world = arena, .posts = {{middle_x, 54.0, 2.0}}});
    filter->set_subscription_region(0, viewer);
    filter->set_update_region(0, point(50.0, 58.0));
    return filter->match().size() == 1;
  };
  EXPECT_TRUE(sees(52.0));
  EXPECT_FALSE(sees(std::nextafter(52.0, 0.0)));
  EXPECT_TRUE(sees(std::nextafter(52.0, 100.0)));
}

TEST(SightScheme, IsNotBlindedByAPostAroundItsEye) {
  const auto filter = make_filter("sight", {.world = arena, .posts = {{50.0, 50.5, 1.0}}});
  filter->set_subscription_region(0, viewer);
  filter->set_update_region(0, point(50.0, 58.0));
  filter->set_subscription_region(1, {40.0, 39.5, 60.0, 59.5});  // its eye is on the rim
  EXPECT_THAT(match(*filter), ElementsAre(Change{0, 0, Transition::entered}));
}

TEST(Shadow, IsConvexSoThatFourCornersDecide) {
  Random random(9);
  int hidden = 0;
  for (int i = 0; i < 20'000; ++i) {
    const double x = between(random, -4.0, 4.0), y = between(random, 1.0, 8.0),
                 radius = between(random, 0.1, 3.0), half = between(random, 0.0, 1.0);
    const double box_x = between(random, -6.0, 6.0), box_y = between(random, 2.0, 12.0);
    const Disc post{x, y, radius};
    const Region eye = point(0.0, 0.0), box = around(box_x, box_y, half);
    if (!hides(post, Eye(eye), box)) continue;
    ++hidden;
    for (int k = 0; k < 20; ++k) {
      const double inner_x = between(random, box.low_x, box.high_x),
                   inner_y = between(random, box.low_y, box.high_y);
      ASSERT_TRUE(is_in_shadow(post, eye, inner_x, inner_y)) << "seed 9, case " << i;
    }
  }
  EXPECT_GT(hidden, 1'000);
}

}  // namespace
}  // namespace rink::im
