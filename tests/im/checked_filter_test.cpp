// What a filter says to strangers' mistakes, and that it goes on as if they had not been made.
#include "im/checked_filter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/words.h"

namespace rink::im {
namespace {

using testing::IsEmpty;

constexpr double infinite = std::numeric_limits<double>::infinity(),
                 not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr Region low_corner{1.0, 1.0, 2.0, 2.0}, high_corner{8.0, 8.0, 9.0, 9.0};

class Strangers : public testing::TestWithParam<std::string> {
 protected:
  CheckedFilter filter_{
      make_filter(GetParam(), {.world = {0.0, 0.0, 10.0, 10.0}, .cell_size = 1.0}), 100};

  /// For schemes that go by roles: everybody belongs together.
  void befriend(Entity entity, Subscriber subscriber) {
    EXPECT_FALSE(
        filter_.set_entity_role(entity, {.team = 1, .owner = 1, .is_always_relevant = true}));
    EXPECT_FALSE(filter_.set_subscriber_role(subscriber, {.team = 1, .owner = 1}));
  }

  std::vector<Change> match() {
    const auto changes = filter_.match();
    return {changes.begin(), changes.end()};
  }
};

std::string words(const std::optional<Rejection>& rejection) {
  return rejection ? describe(*rejection) : "";
}

TEST_P(Strangers, AreToldWhatWasWrongAndWhoseItWas) {
  EXPECT_EQ(words(filter_.add_entity(7, {2.0, 1.0, 1.0, 2.0})),
            "update region 7 is inverted: its low exceeds its high");
  EXPECT_EQ(words(filter_.add_entity(7, {not_a_number, 1.0, 1.0, 2.0})),
            "update region 7 is not finite: a coordinate is infinite or not a number");
  EXPECT_EQ(words(filter_.move_entity(7, low_corner)), "update region 7 is not known");
  EXPECT_EQ(words(filter_.remove_entity(7)), "update region 7 is not known");
  EXPECT_EQ(words(filter_.add_entity(100, low_corner)),
            "update region 100 has an id that is too large");
  EXPECT_EQ(words(filter_.add_entity(7, low_corner)), "");
  EXPECT_EQ(words(filter_.add_entity(7, high_corner)), "update region 7 is there already");
  EXPECT_EQ(words(filter_.add_subscriber(3, low_corner)), "");
  EXPECT_EQ(words(filter_.add_subscriber(3, low_corner)), "subscription region 3 is there already");
  EXPECT_EQ(words(filter_.move_subscriber(3, {0.0, 0.0, infinite, 1.0})),
            "subscription region 3 is not finite: a coordinate is infinite or not a number");
  EXPECT_EQ(words(filter_.remove_subscriber(4)), "subscription region 4 is not known");
  befriend(7, 3);
  EXPECT_EQ(words(filter_.turn(3, {infinite, 0.0})),
            "the heading of subscriber 3 is not finite: a coordinate is infinite or not a number");
  EXPECT_EQ(words(filter_.turn(4, {1.0, 0.0})), "subscription region 4 is not known");
  EXPECT_EQ(words(filter_.set_entity_role(3, {})), "update region 3 is not known");
  EXPECT_EQ(words(filter_.set_subscriber_role(7, {})), "subscription region 7 is not known");
  EXPECT_EQ(words(filter_.fly_entity(7, {.velocity_x = not_a_number})),
            "the flight of entity 7 is not finite: a coordinate is infinite or not a number");
  EXPECT_EQ(words(filter_.fly_entity(7, {.velocity_x = 1e200})),
            "the flight of entity 7 goes beyond 1e150, where its places have no numbers");
  EXPECT_EQ(words(filter_.fly_subscriber(3, {.time = infinite})),
            "the flight of subscriber 3 is not finite: a coordinate is infinite or not a number");
  EXPECT_EQ(words(filter_.fly_entity(3, {})), "update region 3 is not known");
  EXPECT_EQ(words(filter_.set_time(0.0)), "") << "which it is to begin with";
  EXPECT_EQ(words(filter_.set_time(2.0)), "");
  EXPECT_EQ(words(filter_.set_time(2.0)), "") << "time may stand still";
  EXPECT_EQ(words(filter_.set_time(1.0)), "the time is before the one before");
  EXPECT_EQ(words(filter_.set_time(not_a_number)),
            "the time is not finite: a coordinate is infinite or not a number");
  const auto changes = match();
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(std::pair(changes[0].subscriber, changes[0].entity), std::pair(3u, 7u));
}

TEST_P(Strangers, ChangeNothingByAMistake) {
  filter_.add_entity(0, low_corner);
  filter_.add_subscriber(0, low_corner);
  befriend(0, 0);
  match();
  EXPECT_TRUE(filter_.move_entity(0, {9.0, 9.0, 8.0, 8.0}));
  EXPECT_TRUE(filter_.add_subscriber(0, high_corner));
  EXPECT_TRUE(filter_.remove_entity(1));
  EXPECT_THAT(match(), IsEmpty());
  EXPECT_FALSE(filter_.remove_entity(0));
  EXPECT_FALSE(filter_.add_entity(0, low_corner)) << "once removed, an id is free";
  befriend(0, 0);
  const auto changes = match();
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(changes[0].transition, Transition::entered);
}

/// Every scheme by itself, and every stage, behind combinations too.
std::vector<std::string> all_kinds() {
  std::vector<std::string> kinds = filter_names();
  for (const char* stage : {"hysteresis(margin=0.5)", "dwell(matches=1)", "tiers(at=0.5)",
                            "swept(horizon=1)", "priority", "psense", "von", "donnybrook",
                            "vfc(at=0.5 matches=1)", "dyconits(cell_size=1 error=0)"})
    for (const char* scheme : {"region", "(aura or cone) and not (team and grid) or always"})
      kinds.push_back(std::string(scheme) + " with " + stage);
  return kinds;
}

INSTANTIATE_TEST_SUITE_P(Filter, Strangers, testing::ValuesIn(all_kinds()),
                         [](const auto& info) { return test::words(info.param); });

TEST(FilterSettings, NeedAWorldWithAnAreaAndCellsWithASize) {
  const Region world{0.0, 0.0, 10.0, 10.0};
  EXPECT_FALSE(check({.world = world, .cell_size = 1.0}));
  EXPECT_EQ(words(check({.world = {0.0, 0.0, 0.0, 10.0}, .cell_size = 1.0})),
            "the world has no area");
  EXPECT_EQ(words(check({.world = {0.0, 5.0, 1.0, 1.0}, .cell_size = 1.0})),
            "the world is inverted: its low exceeds its high");
  for (const double bad : {0.0, -1.0, infinite, not_a_number})
    EXPECT_EQ(words(check({.world = world, .cell_size = bad})),
              "the cell size is not a positive finite number");
}

}  // namespace
}  // namespace rink::im
