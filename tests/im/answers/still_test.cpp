// What rests costs nothing, also when a stage lets pairs go at a match before which nothing moved.
#include <gtest/gtest.h>

#include <string>

#include "im/filter.h"
#include "tests/im/layouts.h"

namespace rink::im {
namespace {

/// Everything moves at 20 matches and rests at the next 12, at which `dwell` releases what it kept.
void expect_no_test_at_rest(const std::string& expression) {
  SCOPED_TRACE(expression);
  const auto filter = make_filter(expression, {.world = {0.0, 0.0, side, side}, .cell_size = 1.0});
  ASSERT_TRUE(filter);
  Random random(1);
  std::size_t released = 0;
  for (int i = 0; i < 20; ++i) {
    for (std::uint32_t id = 0; id < 40; ++id) {
      filter->set_update_region(id, draw_random(random, 0.5));
      filter->set_subscription_region(id % 8, draw_random(random, 4.0));
    }
    filter->match();
  }
  for (int i = 0; i < 12; ++i) {
    const FilterCounters before = filter->counters();
    released += filter->match().size();
    EXPECT_EQ(filter->counters().pairs_tested, before.pairs_tested) << "still match " << i;
  }
  EXPECT_GT(released, 20u) << "nothing was kept that could be released";
}

TEST(StillMatch, TestsNoPairWhateverStagesRelease) {
  for (const char* scheme : {"region", "grid", "aura and not team"})
    for (const char* stages :
         {" with dwell(matches=9)", " with dwell(matches=9) with tiers(at=0.5)",
          " with dwell(matches=9) with hysteresis(margin=0.5)",
          " with hysteresis(margin=0.5) with dwell(matches=9) with tiers(at=0.5)",
          " with dwell(matches=9) with hysteresis(margin=0.5) with "
          "tiers(at=0.25 at=0.5) with priority"})
      expect_no_test_at_rest(std::string(scheme) + stages);
  expect_no_test_at_rest("(region with dwell(matches=9)) or (aura with dwell(matches=5))");
}

}  // namespace
}  // namespace rink::im
