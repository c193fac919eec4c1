// Events kept by windows come in the same order as from the heap and from a search through all.
#include "game/physics/events/window_queue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <tuple>
#include <vector>

#include "game/physics/events/event_heap.h"

namespace rink::physics {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// Random times, on a raster of `step` [s] so that many are equal where that is coarse; now and
/// then none at all, or one far ahead.
void compare(std::uint32_t count, double step, std::uint64_t seed) {
  SCOPED_TRACE(testing::Message() << "seed " << seed << ", " << count << " bodies, " << step);
  std::mt19937_64 random(seed);
  WindowQueue queue;
  EventHeap heap;
  queue.resize(count), heap.resize(count);
  std::vector<std::tuple<double, std::uint32_t, std::uint32_t>> all(count, {never, 0, 0});
  double now = 0.0;
  const auto set = [&](std::uint32_t body, double time) {
    const auto other = static_cast<std::uint32_t>(random() % count);
    all[body] = {time, std::min(body, other),
                 count * std::max(body, other) + body};  // no two alike
    queue.set(body, time, std::get<1>(all[body]), std::get<2>(all[body]));
    heap.set(body, time, std::get<1>(all[body]), std::get<2>(all[body]));
  };
  for (int turn = 0; turn < 5'000; ++turn) {
    const double ahead = step * static_cast<double>(random() % 40);
    set(static_cast<std::uint32_t>(random() % count), random() % 20 == 0   ? never
                                                      : random() % 20 == 0 ? now + 1e6 * ahead
                                                                           : now + ahead);
    const auto best = std::min_element(all.begin(), all.end());
    const double until = now + 20.0 * step;
    const std::uint32_t expected = std::get<0>(*best) <= until
                                       ? static_cast<std::uint32_t>(best - all.begin())
                                       : WindowQueue::none;
    ASSERT_EQ(queue.first(until), expected);
    ASSERT_EQ(heap.first(until), expected);
    if (expected == WindowQueue::none) {
      now = until;
      continue;
    }
    now = std::get<0>(*best);
    ASSERT_EQ(queue.time(expected), now);
    if (heap.is_followed_within(2.0 * step)) {
      ASSERT_TRUE(queue.is_followed_within(2.0 * step));
    }
    if (random() % 2 == 0) set(expected, now + step * static_cast<double>(1 + random() % 40));
  }
  EXPECT_GT(now, step * 100.0);
}

TEST(WindowQueue, AgreesWithTheHeapAndWithASearchThroughAll) {
  std::uint64_t seed = 1;
  for (const std::uint32_t count : {1u, 2u, 7u, 60u, 500u})
    for (const double step : {1e-3, 1e-9, 0.37, 2.0}) compare(count, step, seed++);
}

TEST(WindowQueue, AnImpactOfTwoIsNotItsOwnSuccessorAndAThirdOneIs) {
  WindowQueue queue;
  queue.resize(6);
  queue.set(0, 1e-4, 0, 1), queue.set(1, 1e-4, 0, 1);
  for (std::uint32_t body = 2; body < 6; ++body) queue.set(body, 0.5 + body, body, body);
  ASSERT_LE(queue.first(1.0), 1u);  // of either body: it is one impact
  queue.set(2, 1e-4, 1, 2);         // a third one touches the second at the same time
  ASSERT_LE(queue.first(1.0), 1u);
  EXPECT_TRUE(queue.is_followed_within(1e-12));
}

TEST(WindowQueue, AsksNobodyWhoHasNoEvent) {
  WindowQueue queue;
  queue.resize(1'000'000);
  queue.set(7, 1.0, 7, 7);
  for (int turn = 1; turn < 200'000; ++turn) {  // minutes, if each window looked at all
    ASSERT_EQ(queue.first(never), 7u);
    queue.set(7, 1.0 + turn, 7, 7);
  }
}

}  // namespace
}  // namespace rink::physics
