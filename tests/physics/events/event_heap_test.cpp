// The binary heap gives the same events in the same order as the calendar, and as a search through
// all.
#include "game/physics/events/event_heap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <tuple>
#include <vector>

#include "game/physics/events/event_queue.h"
#include "tests/physics/scenes.h"

namespace rink::physics::test {
namespace {

TEST(EventHeap, AgreesWithTheCalendarAndWithASearchThroughAll) {
  constexpr std::uint32_t count = 60;
  constexpr std::uint64_t seed = 4;
  SCOPED_TRACE(seed);
  std::mt19937_64 random(seed);
  EventHeap heap;
  EventQueue calendar;
  heap.resize(count);
  calendar.resize(count);
  std::vector<std::tuple<double, std::uint32_t, std::uint32_t>> all(
      count, {std::numeric_limits<double>::infinity(), 0, 0});
  double now = 0.0;
  const auto set = [&](std::uint32_t body, double time) {
    const auto other = static_cast<std::uint32_t>(random() % count);
    all[body] = {time, std::min(body, other),
                 count * std::max(body, other) + body};  // no two alike
    heap.set(body, time, std::get<1>(all[body]), std::get<2>(all[body]));
    calendar.set(body, time, std::get<1>(all[body]), std::get<2>(all[body]));
  };
  for (int step = 0; step < 20'000; ++step) {
    // Coarse times, so that many are equal; now and then none at all.
    set(static_cast<std::uint32_t>(random() % count),
        random() % 20 == 0 ? std::numeric_limits<double>::infinity()
                           : now + 1e-3 * static_cast<double>(random() % 40));
    const auto best = std::min_element(all.begin(), all.end());
    const std::uint32_t expected = std::get<0>(*best) <= now + 0.02
                                       ? static_cast<std::uint32_t>(best - all.begin())
                                       : EventHeap::none;
    ASSERT_EQ(heap.first(now + 0.02), expected);
    ASSERT_EQ(calendar.first(now + 0.02), expected);
    if (expected == EventHeap::none) continue;
    now = std::get<0>(*best);
    ASSERT_EQ(heap.time(expected), now);
    const auto close = std::count_if(all.begin(), all.end(), [&](const auto& event) {
      return std::get<0>(event) <= now + 2e-3;
    });
    ASSERT_EQ(heap.is_followed_within(2e-3), close > 1);
    if (random() % 2 == 0) set(expected, now + 1e-3 * static_cast<double>(1 + random() % 40));
  }
  EXPECT_GT(now, 1.0);
}

}  // namespace
}  // namespace rink::physics::test
