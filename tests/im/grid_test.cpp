// The cell that `grid` remembers of each entity: what it skips must be what stays in its cell, and
// nothing else.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <vector>

#include "im/filter.h"
#include "im/schemes/cells.h"

namespace rink::im {
namespace {

TEST(Floored, IsTheLibrarysFloor) {
  std::mt19937_64 random(3);
  const auto expect = [](double number) {
    EXPECT_EQ(floored(number), std::floor(number)) << number;
  };
  for (const double edge : {0.0, -0.0, 0.5, -0.5, 1.0, -1.0, 0x1p31, -0x1p31, 0x1p52, -0x1p52,
                            0x1p53 + 2.0, 1e300, -1e300, 5e-324, -5e-324}) {
    expect(edge);
    expect(std::nextafter(edge, 1e308)), expect(std::nextafter(edge, -1e308));
  }
  for (int i = 0; i < 100'000; ++i) {
    const double mantissa = std::uniform_real_distribution<double>(-1.0, 1.0)(random);
    expect(std::ldexp(mantissa, std::uniform_int_distribution<int>(-5, 60)(random)));
  }
}

/// Both ways that a scheme learns of a move, after each a recount of every pair.
TEST(Grid, WhatItSkipsHasStayedInItsCell) {
  std::mt19937_64 random(11);
  const Region world{-3.0, 2.0, 5.0, 10.0};
  const double size = 0.75;
  const auto filter = make_filter("grid", {.world = world, .cell_size = size});
  constexpr std::uint32_t count = 40;
  std::vector<Region> entities(count), views(count);
  std::vector<bool> is_there(count, false);
  std::set<std::pair<Subscriber, Entity>> held;
  // Steps of a quarter of a cell, so that many centres lie on a cell's edge; some are farther away
  // than 32 bits count, or than any cell has a number of its own.
  const auto coordinate = [&random](double origin) {
    const int kind = std::uniform_int_distribution<int>(0, 40)(random);
    if (kind == 0) return 1e10;
    if (kind == 1) return -1e300;
    if (kind == 2) return 0x1p30 * 0.75 + origin;
    return origin + 0.75 * 0.25 * std::uniform_int_distribution<int>(-20, 60)(random);
  };
  for (std::uint32_t i = 0; i < count; ++i) {
    const double x = coordinate(world.low_x), y = coordinate(world.low_y);
    views[i] = {x, y, x + 2.0, y + 3.0};
    filter->set_subscription_region(i, views[i]);
  }
  std::uint64_t still = 0;
  for (int step = 0; step < 400; ++step) {
    const std::uint64_t moved_before = filter->counters().regions_moved;
    std::uint64_t crossed = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      const int what = std::uniform_int_distribution<int>(0, 19)(random);
      if (what == 0 && is_there[i]) {
        filter->remove_entity(i);
        is_there[i] = false;
        std::erase_if(held, [i](const auto& pair) { return pair.second == i; });
      }
      const Region before = cells_of(centre_of(entities[i]), world, size);
      const bool was_there = is_there[i];
      if (what > 12) {
        const double x = coordinate(world.low_x), y = coordinate(world.low_y);
        entities[i] = {x, y, x, y};
      } else if (what > 2 && is_there[i]) {
        const double shift = std::uniform_real_distribution<double>(-0.1, 0.1)(random);
        entities[i].low_x += shift, entities[i].high_x += shift;
      } else if (what > 1) {
        continue;  // not handed in at all
      }
      filter->set_update_region(i, entities[i]);
      is_there[i] = true;
      crossed += !was_there || !(cells_of(centre_of(entities[i]), world, size) == before);
      still += was_there && cells_of(centre_of(entities[i]), world, size) == before;
    }
    EXPECT_EQ(filter->counters().regions_moved - moved_before, crossed) << step;
    for (const Change& change : filter->match()) {
      if (change.transition == Transition::entered)
        EXPECT_TRUE(held.insert({change.subscriber, change.entity}).second);
      else EXPECT_EQ(held.erase({change.subscriber, change.entity}), 1u);
    }
    std::set<std::pair<Subscriber, Entity>> expected;
    for (std::uint32_t s = 0; s < count; ++s)
      for (std::uint32_t e = 0; e < count; ++e) {
        const Region touched = cells_of(views[s], world, size),
                     cell = cells_of(centre_of(entities[e]), world, size);
        if (is_there[e] && touched.low_x <= cell.low_x && cell.low_x <= touched.high_x &&
            touched.low_y <= cell.low_y && cell.low_y <= touched.high_y)
          expected.insert({s, e});
      }
    ASSERT_EQ(held, expected) << step;
  }
  EXPECT_GT(still, 1000u);
}

}  // namespace
}  // namespace rink::im
