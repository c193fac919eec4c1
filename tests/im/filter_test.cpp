// What a filter promises one case at a time: closed edges, net changes, ids used again, and that
// what rests costs nothing.
#include "im/filter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <random>

#include "tests/im/cases.h"
#include "tests/im/recount.h"

namespace rink::im {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr Region here{10.0, 10.0, 20.0, 20.0}, there{60.0, 60.0, 70.0, 70.0};

class TwoSchemes : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<Filter> filter_ = make_filter(GetParam(), {.world = world, .cell_size = 5.0});
};
INSTANTIATE_TEST_SUITE_P(Filter, TwoSchemes, testing::Values("grid", "region"),
                         [](const auto& info) { return info.param; });

TEST(Filter, IsFoundByItsNameAndOthersAreNot) {
  EXPECT_THAT(filter_names(),
              ElementsAre("always", "aura", "cone", "diamond", "grid", "hex", "hierarchical",
                          "hybrid", "nimbus", "none", "owner", "pvs", "region", "sight", "strips",
                          "team", "tiles", "zones"));
  for (const std::string& name : filter_names()) EXPECT_TRUE(make_filter(name, {}));
  EXPECT_FALSE(make_filter("nonesuch", {}));
}

TEST(Region, IsValidIfFiniteAndNotInverted) {
  constexpr double inf = std::numeric_limits<double>::infinity(),
                   nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(is_valid({0.0, 0.0, 0.0, 0.0}));
  EXPECT_TRUE(is_valid({-1e300, -1.0, 1e300, 1.0}));
  EXPECT_FALSE(is_valid({1.0, 0.0, 0.0, 1.0}));
  EXPECT_FALSE(is_valid({0.0, 1.0, 1.0, 0.0}));
  for (const double bad : {inf, -inf, nan})
    for (const Region& region :
         {Region{bad, 0, 1, 1}, Region{0, bad, 1, 1}, Region{0, 0, bad, 1}, Region{0, 0, 1, bad}})
      EXPECT_FALSE(is_valid(region));
}

TEST(RegionScheme, CountsTouchingAsOverlapToTheLastBit) {
  const auto filter = make_filter("region", {.world = world});
  filter->set_subscription_region(0, here);
  filter->set_update_region(0, point(20.0, 20.0));
  filter->set_update_region(1, point(std::nextafter(20.0, 21.0), 20.0));
  filter->set_update_region(2, {20.0, 0.0, 30.0, 10.0});
  filter->set_update_region(3, {20.0, 0.0, 30.0, std::nextafter(10.0, 0.0)});
  filter->set_update_region(4, here);
  filter->set_update_region(5, {0.0, 0.0, 100.0, 100.0});
  EXPECT_THAT(match(*filter),
              ElementsAre(Change{0, 0, Transition::entered}, Change{0, 2, Transition::entered},
                          Change{0, 4, Transition::entered}, Change{0, 5, Transition::entered}));
}

TEST(GridScheme, CountsTheCellOfTheCentreAgainstCellsTheSubscriptionTouches) {
  const auto filter = make_filter("grid", {.world = world, .cell_size = 5.0});
  filter->set_subscription_region(0, {11.0, 11.0, 14.0, 15.0});  // columns 2, rows 2 and 3
  filter->set_update_region(0, {9.0, 9.0, 12.0, 11.0});          // centre (10.5, 10): cell 2, 2
  filter->set_update_region(
      1, {14.0, 14.0, 16.0, 16.0});  // overlaps, but its centre (15, 15) is in cell 3, 3
  filter->set_update_region(2, point(10.0, 19.9));  // does not overlap, but is in cell 2, 3
  EXPECT_THAT(match(*filter),
              ElementsAre(Change{0, 0, Transition::entered}, Change{0, 2, Transition::entered}));
  filter->set_update_region(2, point(14.9, 15.0));  // another corner of the same cell
  EXPECT_THAT(match(*filter), IsEmpty());
  EXPECT_EQ(filter->counters().regions_moved, 4u);
}

TEST(NoneScheme, ChangesOnlyWhenSomeoneComes) {
  const auto filter = make_filter("none", {.world = world});
  filter->set_subscription_region(0, here);
  filter->set_update_region(0, there);
  EXPECT_THAT(match(*filter), ElementsAre(Change{0, 0, Transition::entered}));
  filter->set_update_region(0, here);
  filter->set_subscription_region(0, there);
  EXPECT_THAT(match(*filter), IsEmpty());
  filter->set_subscription_region(1, there);
  EXPECT_THAT(match(*filter), ElementsAre(Change{1, 0, Transition::entered}));
}

TEST_P(TwoSchemes, SayNothingOfWhoEntersAndLeavesBetweenMatches) {
  filter_->set_subscription_region(0, here);
  filter_->set_update_region(0, there);
  EXPECT_THAT(match(*filter_), IsEmpty());
  filter_->set_update_region(0, here);
  filter_->set_update_region(0, there);
  EXPECT_THAT(match(*filter_), IsEmpty());
  filter_->set_update_region(0, here);
  EXPECT_THAT(match(*filter_), ElementsAre(Change{0, 0, Transition::entered}));
  filter_->set_update_region(0, there);
  filter_->set_update_region(0, here);
  EXPECT_THAT(match(*filter_), IsEmpty());
}

TEST_P(TwoSchemes, TakeAnIdUsedAgainForSomeoneNew) {
  filter_->set_subscription_region(0, here);
  filter_->set_update_region(0, here);
  filter_->match();
  filter_->remove_entity(0);
  filter_->set_update_region(0, here);
  EXPECT_THAT(match(*filter_), ElementsAre(Change{0, 0, Transition::entered}))
      << "the removed one was forgotten by all";
  filter_->remove_entity(0);
  filter_->set_update_region(0, there);
  EXPECT_THAT(match(*filter_), IsEmpty())
      << "no left for the removed one, and the new one is elsewhere";
  filter_->set_update_region(0, here);
  filter_->match();
  filter_->remove_subscriber(0);
  filter_->set_subscription_region(0, here);
  EXPECT_THAT(match(*filter_), ElementsAre(Change{0, 0, Transition::entered}));
}

TEST_P(TwoSchemes, SayNothingOfTheRemovedAndIgnoreTheUnknown) {
  filter_->set_subscription_region(0, here);
  filter_->set_subscription_region(1, here);
  filter_->set_update_region(0, here);
  filter_->match();
  filter_->remove_subscriber(0);
  filter_->remove_subscriber(77);
  filter_->remove_entity(77);
  filter_->set_update_region(0, there);
  EXPECT_THAT(match(*filter_), ElementsAre(Change{1, 0, Transition::left}));
  filter_->remove_entity(0);
  filter_->remove_entity(0);
  EXPECT_THAT(match(*filter_), IsEmpty());
}

/// `count` points spread evenly at random.
void spread(Filter& filter, std::uint32_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> coordinate(0.0, 100.0);
  for (Entity entity = 0; entity < count; ++entity)
    filter.set_update_region(entity, point(coordinate(random), coordinate(random)));
}

TEST_P(TwoSchemes, PayNothingForWhatRests) {
  spread(*filter_, 10'000, 3);
  for (Subscriber subscriber = 0; subscriber < 100; ++subscriber)
    filter_->set_subscription_region(subscriber, here);
  filter_->match();
  const FilterCounters before = filter_->counters();
  spread(*filter_, 10'000, 3);  // the same places again
  for (Subscriber subscriber = 0; subscriber < 100; ++subscriber)
    filter_->set_subscription_region(subscriber, here);
  EXPECT_THAT(match(*filter_), IsEmpty());
  EXPECT_EQ(filter_->counters().pairs_tested, before.pairs_tested);
  EXPECT_EQ(filter_->counters().regions_moved, before.regions_moved);
}

TEST_P(TwoSchemes, PayForOneMoverAtMostOneTestPerSubscriber) {
  spread(*filter_, 10'000, 4);
  for (Subscriber subscriber = 0; subscriber < 100; ++subscriber)
    filter_->set_subscription_region(subscriber, here);
  filter_->match();
  const auto before = filter_->counters().pairs_tested;
  filter_->set_update_region(5, here);
  filter_->match();
  EXPECT_LE(filter_->counters().pairs_tested - before, 100u);
}

TEST_P(TwoSchemes, PayForOneMovedSubscriberOnlyNearItsEdges) {
  spread(*filter_, 10'000, 5);
  filter_->set_subscription_region(0, {20.0, 20.0, 60.0, 60.0});  // 1,600 points within
  filter_->match();
  const auto before = filter_->counters().pairs_tested;
  filter_->set_subscription_region(0, {20.5, 20.0, 60.5, 60.0});
  filter_->match();
  // A ring of 160 m, at most 3 of the cells wide in which resting boxes are kept (2 m for four
  // points each, 5 m if the scheme's own cells are wider).
  EXPECT_LE(filter_->counters().pairs_tested - before,
            160.0 * 3.0 * (GetParam() == "grid" ? 5.0 : 2.0));
}

/// The share of what each of many subscribers gets that lies within `reach` of its centre.
double precision_within_circle(const std::string& scheme, double cell_size, double half_side,
                               double reach) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> coordinate(0.0, 100.0), inner(25.0, 75.0);
  const auto filter = make_filter(scheme, {.world = world, .cell_size = cell_size});
  std::vector<std::pair<double, double>> entities(20'000), subscribers(400);
  for (Entity i = 0; i < entities.size(); ++i) {
    entities[i] = {coordinate(random), coordinate(random)};
    filter->set_update_region(i, point(entities[i].first, entities[i].second));
  }
  for (Subscriber i = 0; i < subscribers.size(); ++i) {
    const auto [x, y] = subscribers[i] = {inner(random), inner(random)};
    filter->set_subscription_region(i,
                                    {x - half_side, y - half_side, x + half_side, y + half_side});
  }
  double wanted = 0.0, sent = 0.0;
  for (const Change& change : filter->match()) {
    const auto [x, y] = subscribers[change.subscriber];
    sent += 1.0;
    wanted +=
        std::hypot(entities[change.entity].first - x, entities[change.entity].second - y) <= reach
            ? 1.0
            : 0.0;
  }
  return wanted / sent;
}

TEST(Precision, OfASquareAgainstItsInscribedCircleIsAQuarterOfPi) {
  EXPECT_NEAR(precision_within_circle("region", 0.0, 10.0, 10.0) / (std::numbers::pi / 4.0), 1.0,
              0.01);
}

TEST(Precision, OfCellsThatASquareTouchesFollowsTheirSide) {
  // A side of 2 R touches 2 R / c + 1 cells on average.
  for (const double k : {0.25, 0.5, 1.0}) {
    const double expected = std::numbers::pi / ((2.0 + k) * (2.0 + k));
    for (const char* scheme : {"grid", "hierarchical"})
      EXPECT_NEAR(precision_within_circle(scheme, 10.0 * k, 10.0, 10.0) / expected, 1.0, 0.03)
          << scheme << ", cells of " << k << " R";
  }
}

TEST(Precision, OfHexagonsThatASquareTouchesFollowsTheirWidth) {
  // The middles of those that a square of side L touches fill its sum with a hexagon: L^2 + L
  // (width + height) + area.
  for (const double k : {0.25, 0.5, 1.0}) {
    const double height = 2.0 * k / std::numbers::sqrt3, area = 0.75 * k * height;
    const double expected = std::numbers::pi / (4.0 + 2.0 * (k + height) + area);
    EXPECT_NEAR(precision_within_circle("hex", 10.0 * k, 10.0, 10.0) / expected, 1.0, 0.03)
        << "hexagons of " << k << " R";
  }
}

TEST(Precision, OfCellsFollowedByTheSquareItselfIsThatOfTheSquare) {
  EXPECT_NEAR(precision_within_circle("hybrid", 5.0, 10.0, 10.0) / (std::numbers::pi / 4.0), 1.0,
              0.01);
}

TEST(HierarchicalScheme, KnowsALargeEntityByAllOfItsCell) {
  const auto grid = make_filter("grid", {.world = world, .cell_size = 5.0}),
             levels = make_filter("hierarchical", {.world = world, .cell_size = 5.0});
  for (Filter* filter : {grid.get(), levels.get()}) {
    filter->set_subscription_region(0, {1.0, 1.0, 2.0, 2.0});
    filter->set_update_region(0, {0.0, 0.0, 40.0, 40.0});
  }
  EXPECT_THAT(match(*grid), IsEmpty()) << "its centre is far";
  EXPECT_THAT(match(*levels), ElementsAre(Change{0, 0, Transition::entered}));
}

TEST(Precision, OfThreeByThreeCellsAsLargeAsTheReachIsANinthOfPi) {
  EXPECT_NEAR(precision_within_circle("grid", 10.0, 10.0, 10.0) / (std::numbers::pi / 9.0), 1.0,
              0.03);
}

}  // namespace
}  // namespace rink::im
