// What a filter says to strangers' mistakes, and that it goes on as if they had not been made.
#include "im/checked_filter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace rink::im {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr double infinite = std::numeric_limits<double>::infinity(), not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr Region here{1.0, 1.0, 2.0, 2.0}, there{8.0, 8.0, 9.0, 9.0};

class Strangers : public testing::TestWithParam<std::string> {
 protected:
  CheckedFilter filter_{make_filter(GetParam(), {.world = {0.0, 0.0, 10.0, 10.0}, .cell_size = 1.0}), 100};

  std::vector<Change> match() {
    const auto changes = filter_.match();
    return {changes.begin(), changes.end()};
  }
};

std::string words(const std::optional<Rejection>& rejection) { return rejection ? describe(*rejection) : ""; }

TEST_P(Strangers, AreToldWhatWasWrongAndWhoseItWas) {
  EXPECT_EQ(words(filter_.add_entity(7, {2.0, 1.0, 1.0, 2.0})), "update region 7 is inverted: its low exceeds its high");
  EXPECT_EQ(words(filter_.add_entity(7, {not_a_number, 1.0, 1.0, 2.0})), "update region 7 is not finite: a coordinate is infinite or not a number");
  EXPECT_EQ(words(filter_.move_entity(7, here)), "update region 7 is not known");
  EXPECT_EQ(words(filter_.remove_entity(7)), "update region 7 is not known");
  EXPECT_EQ(words(filter_.add_entity(100, here)), "update region 100 has an id that is too large");
  EXPECT_EQ(words(filter_.add_entity(7, here)), "");
  EXPECT_EQ(words(filter_.add_entity(7, there)), "update region 7 is there already");
  EXPECT_EQ(words(filter_.add_subscriber(3, here)), "");
  EXPECT_EQ(words(filter_.add_subscriber(3, here)), "subscription region 3 is there already");
  EXPECT_EQ(words(filter_.move_subscriber(3, {0.0, 0.0, infinite, 1.0})), "subscription region 3 is not finite: a coordinate is infinite or not a number");
  EXPECT_EQ(words(filter_.remove_subscriber(4)), "subscription region 4 is not known");
  EXPECT_THAT(match(), ElementsAre(Change{3, 7, Transition::entered}));
}

TEST_P(Strangers, ChangeNothingByAMistake) {
  filter_.add_entity(0, here);
  filter_.add_subscriber(0, here);
  match();
  EXPECT_TRUE(filter_.move_entity(0, {9.0, 9.0, 8.0, 8.0}));
  EXPECT_TRUE(filter_.add_subscriber(0, there));
  EXPECT_TRUE(filter_.remove_entity(1));
  EXPECT_THAT(match(), IsEmpty());
  EXPECT_FALSE(filter_.remove_entity(0));
  EXPECT_FALSE(filter_.add_entity(0, here)) << "once removed, an id is free";
  EXPECT_THAT(match(), ElementsAre(Change{0, 0, Transition::entered}));
}

INSTANTIATE_TEST_SUITE_P(Filter, Strangers, testing::ValuesIn(filter_names()), [](const auto& info) { return info.param; });

TEST(FilterSettings, NeedAWorldWithAnAreaAndCellsWithASize) {
  const Region world{0.0, 0.0, 10.0, 10.0};
  EXPECT_FALSE(check({.world = world, .cell_size = 1.0}));
  EXPECT_EQ(words(check({.world = {0.0, 0.0, 0.0, 10.0}, .cell_size = 1.0})), "the world has no area");
  EXPECT_EQ(words(check({.world = {0.0, 5.0, 1.0, 1.0}, .cell_size = 1.0})), "the world is inverted: its low exceeds its high");
  for (const double bad : {0.0, -1.0, infinite, not_a_number}) EXPECT_EQ(words(check({.world = world, .cell_size = bad})), "the cell size is not a positive finite number");
}

}  // namespace
}  // namespace rink::im
