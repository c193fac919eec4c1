// Cells in which clients look: which places they hold, and what is said of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include "game/node/cells.h"
#include "game/node/node_subscription.h"

namespace rink::game {
namespace {

physics::Field field_of(double length, double width) {
  physics::Field field;
  field.length = length, field.width = width;
  return field;
}

TEST(Cells, HoldEveryPlaceOfAMarkedRegionAndNothingFarFromIt) {
  const physics::Field field = field_of(10.0, 5.0);
  Cells cells(field, 0.7);
  const im::Region region{3.1, 1.2, 4.3, 2.2};
  cells.mark(region);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> x(-2.0, 12.0), y(-2.0, 7.0);
  for (int k = 0; k < 2'000; ++k) {
    const physics::Vector2 place(x(random), y(random));
    const double away = std::max({region.low_x - place.x(), place.x() - region.high_x,
                                  region.low_y - place.y(), place.y() - region.high_y});
    if (away > 0.0 && away <= 0.7) continue;  // as the cells lie
    EXPECT_EQ(cells.contains(place), away <= 0.0) << place.transpose();
  }
}

TEST(Cells, AtTheRimExtendWithoutEnd) {
  Cells cells(field_of(10.0, 5.0), 1.0);
  cells.mark({9.5, 2.0, 20.0, 2.5});
  EXPECT_TRUE(cells.contains({10.4, 2.2}));
  EXPECT_FALSE(cells.contains({10.4, 4.2}));
  cells.mark({-9.0, -9.0, -8.0, -8.0});
  EXPECT_TRUE(cells.contains({0.1, 0.1}));
  EXPECT_TRUE(Cells::all_of(field_of(3.0, 7.0)).contains({-1e9, 1e9}));
}

TEST(Cells, ComeBackFromTheirRuns) {
  const physics::Field field = field_of(10.0, 5.0);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> x(0.0, 10.0), y(0.0, 5.0);
  for (int k = 0; k < 50; ++k) {
    Cells cells(field, 0.25);
    for (int region = 0; region < k; ++region) {
      const double at_x = x(random), at_y = y(random);
      cells.mark({at_x, at_y, at_x + 0.6, at_y + 0.3});
    }
    EXPECT_EQ(Cells::of_runs(field, 0.25, cells.runs()), cells);
  }
  EXPECT_EQ(Cells::of_runs(field, 10.0, Cells::all_of(field).runs()), Cells::all_of(field));
}

TEST(Cells, AreRefusedThatAreNoGrid) {
  const physics::Field field = field_of(10.0, 5.0);
  EXPECT_TRUE(Cells::of_runs(field, 5.0, {1, 1}));
  for (const double side : {0.0, -1.0, 1e-3, 1e-300, std::numeric_limits<double>::quiet_NaN(),
                            std::numeric_limits<double>::infinity()})
    EXPECT_FALSE(Cells::of_runs(field, side, {1, 1})) << side;
  for (const std::vector<std::uint32_t>& runs :
       {std::vector<std::uint32_t>{}, {1}, {3}, {0xffffffffu, 3}, {2, 0xffffffffu}})
    EXPECT_FALSE(Cells::of_runs(field, 5.0, runs));
}

TEST(ANodesSubscription, HasAMarginOfHalfACellAndKeepsCellsForAnother) {
  const physics::Field field = field_of(40.0, 20.0);
  NodeSubscription subscription(field, {0.1, 0.1});
  const auto look = [&](double x) {  // views of 4 m, so cells of 1 m
    const im::Region region{x, 8.0, x + 4.0, 12.0};
    subscription.look({&region, 1}, false);
    return subscription.take();
  };
  const auto first = look(10.0);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->side(), 1.0);
  EXPECT_TRUE(first->contains({9.45, 10.0})) << "half a cell beyond the reach";
  EXPECT_FALSE(first->contains({8.9, 10.0}));
  EXPECT_FALSE(look(10.0)) << "nothing new";
  EXPECT_FALSE(look(10.3)) << "the cells to the right are there already";
  const auto second = look(10.7);
  ASSERT_TRUE(second);
  EXPECT_TRUE(second->contains({9.9, 10.0})) << "kept";
  EXPECT_TRUE(second->contains({15.5, 10.0}));
  const auto third = look(12.9);
  ASSERT_TRUE(third);
  EXPECT_FALSE(third->contains({9.9, 10.0}));
}

TEST(ANodesSubscription, IsOfEverythingWhereTheSchemeHasNoBoundsOrAClientSeesAll) {
  const physics::Field field = field_of(40.0, 20.0);
  const im::Region region{10.0, 8.0, 14.0, 12.0};
  NodeSubscription bounded(field, {0.1, 0.1});
  bounded.look({&region, 1}, false);
  ASSERT_TRUE(bounded.take());
  bounded.look({&region, 1}, true);
  EXPECT_EQ(bounded.take(), Cells::all_of(field));
  constexpr double infinity = std::numeric_limits<double>::infinity();
  NodeSubscription unbounded(field, {infinity, infinity});
  unbounded.look({&region, 1}, false);
  EXPECT_FALSE(unbounded.take()) << "it began with everything";
}

TEST(ANodesSubscription, FitsTheNarrowestField) {
  NodeSubscription subscription(field_of(1e6, 1.0), {0.1, 0.1});
  subscription.look(std::vector<im::Region>{{0.0, 0.0, 0.1, 0.1}}, false);
  const std::optional<Cells> cells = subscription.take();
  ASSERT_TRUE(cells);
  EXPECT_TRUE(cells->contains({0.05, 0.05}));
}

TEST(ANodesSubscription, IsOfNothingWithoutClients) {
  NodeSubscription subscription(field_of(40.0, 20.0), {0.1, 0.1});
  subscription.look({}, false);
  const auto cells = subscription.take();
  ASSERT_TRUE(cells);
  EXPECT_FALSE(cells->contains({10.0, 10.0}));
}

}  // namespace
}  // namespace rink::game
