// The calendar queue: the order of its events is that of their times, and its work does not depend
// on how it was asked.
#include "game/physics/events/event_queue.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "game/physics/events/event_heap.h"
#include "tests/physics/scenes.h"

namespace rink::physics {
namespace {

constexpr std::uint32_t body_count = 10'000;
constexpr double gap_s = 20e-6, pair_gap_s = 1e-9;

/// Events in pairs: 2 `gap_s` from pair to pair, `pair_gap_s` within one, for ever.
class PairedEvents {
 public:
  PairedEvents() {
    queue_.resize(body_count);
    for (std::uint32_t body = 0; body < body_count; ++body) set(body, time(body));
  }
  EventQueue& queue() { return queue_; }
  double next_time() const { return time(taken_); }
  void take(std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i, ++taken_) {
      const std::uint32_t body = queue_.first(1e9);
      ASSERT_EQ(body, taken_ % body_count);
      ASSERT_EQ(queue_.time(body), next_time());
      set(body, time(taken_ + body_count));
    }
  }

 private:
  static double time(std::uint64_t number) {
    return 1e-3 + static_cast<double>(number / 2) * 2.0 * gap_s +
           static_cast<double>(number % 2) * pair_gap_s;
  }
  void set(std::uint32_t body, double time) { queue_.set(body, time, body, body); }

  EventQueue queue_;
  std::uint64_t taken_ = 0;
};

TEST(EventQueue, ThatIsToldHowManyEventsComeTakesThemInTheSameOrder) {
  EventQueue told, untold;
  std::mt19937_64 random(4);
  told.resize(body_count), untold.resize(body_count);
  told.expect(body_count);
  for (std::uint32_t body = 0; body < body_count; ++body) {
    const double time = test::uniform(random, 0.0, 2.0);
    told.set(body, time, body, body), untold.set(body, time, body, body);
  }
  told.expect(body_count);  // nothing is lost where some are there already
  for (std::uint32_t k = 0; k < body_count; ++k) {
    const std::uint32_t body = told.first(2.0);
    ASSERT_EQ(body, untold.first(2.0));
    ASSERT_NE(body, EventQueue::none);
    for (EventQueue* queue : {&told, &untold})
      queue->set(body, std::numeric_limits<double>::infinity(), body, body);
  }
  EXPECT_EQ(told.first(1e9), EventQueue::none);
}

TEST(EventQueue, IsNotMisledByManyQuestionsBetweenTwoEventsOfAPair) {
  PairedEvents events;
  events.take(20'000);
  for (int pair = 0; pair < 4; ++pair) {
    events.take(1);
    // As a server asks when a thousand players press keys within a microsecond.
    for (int i = 0; i < 400'000; ++i)
      ASSERT_EQ(events.queue().first(events.next_time() - 1e-10), EventQueue::none);
  }
  events.take(100);  // a queue may need a moment to adapt
  const std::uint64_t before = events.queue().looked_at();
  events.take(10'000);
  EXPECT_LE(events.queue().looked_at() - before, 8u * 10'000u);
}

TEST(EventQueue, KnowsWhetherAnotherEventFollowsClosely) {
  EventQueue queue;
  queue.resize(1000);
  std::uint64_t said_in_vain = 0;
  // Pairs 1e-10 s apart and single events, 1 ms from one to the next.
  const auto time = [](std::uint32_t body) {
    return 1e-3 * (body / 3 * 2 + (body % 3 == 2 ? 1 : 0)) + (body % 3 == 1 ? 1e-10 : 0.0);
  };
  for (std::uint32_t body = 0; body < 1000; ++body) queue.set(body, time(body), body, body);
  for (std::uint32_t body = 0; body < 1000; ++body) {
    ASSERT_EQ(queue.first(1e9), body);
    if (body % 3 == 0 && body < 999) {
      ASSERT_TRUE(queue.is_followed_within(1e-9)) << body;
    }
    if (body % 3 != 0) said_in_vain += queue.is_followed_within(1e-9);
    queue.set(body, std::numeric_limits<double>::infinity(), body, body);
  }
  EXPECT_LE(said_in_vain, 50u);
}

TEST(EventQueue, DoesNotTakeAnImpactForItsOwnSuccessorBecauseItIsNotedForBothBodies) {
  EventQueue calendar;
  EventHeap heap;
  const auto set = [&](std::uint32_t body, double time, std::uint32_t lower, std::uint32_t higher) {
    calendar.set(body, time, lower, higher), heap.set(body, time, lower, higher);
  };
  calendar.resize(6), heap.resize(6);
  set(0, 1e-4, 0, 1), set(1, 1e-4, 0, 1), set(4, 0.5, 4, 4), set(5, 0.5, 5, 5);
  ASSERT_LE(calendar.first(1.0), 1u);  // of either body: it is one impact
  ASSERT_LE(heap.first(1.0), 1u);
  EXPECT_FALSE(calendar.is_followed_within(1e-12));
  EXPECT_FALSE(heap.is_followed_within(1e-12));
  set(2, 1e-4, 1, 2);                  // a third one touches the second at the same time
  ASSERT_LE(calendar.first(1.0), 1u);  // of either body: it is one impact
  ASSERT_LE(heap.first(1.0), 1u);
  EXPECT_TRUE(calendar.is_followed_within(1e-12));
  EXPECT_TRUE(heap.is_followed_within(1e-12));
}

TEST(EventQueue, KeepsTheOrderOfASortedSetWhileBodiesComeRestAndGo) {
  EventQueue queue;
  queue.resize(5'000);
  std::mt19937_64 random(9);
  std::set<std::pair<double, std::uint32_t>> sorted;
  std::vector<double> times(5'000, std::numeric_limits<double>::infinity());
  const auto put = [&](std::uint32_t body, double time) {
    sorted.erase({times[body], body});
    times[body] = time;
    if (time < std::numeric_limits<double>::infinity()) sorted.insert({time, body});
    queue.set(body, time, body, body);
  };
  for (std::uint32_t body = 0; body < 5'000; ++body) put(body, test::uniform(random, 0.0, 1.0));
  double now = 0.0;
  for (int step = 0; step < 100'000; ++step) {
    const std::uint32_t body = queue.first(1e9);
    ASSERT_EQ(body, sorted.begin()->second) << "step " << step;
    now = times[body];
    // Busy at first, then nearly all rest for long, then busy again.
    const bool is_idle = step > 30'000 && step < 60'000;
    const double scale = is_idle ? 100.0 : 1.0;
    put(body, is_idle && sorted.size() > 20 ? std::numeric_limits<double>::infinity()
                                            : now + test::uniform(random, 0.0, scale));
    if (step >= 60'000 && step < 64'000)
      put(static_cast<std::uint32_t>(random() % 5'000), now + test::uniform(random, 0.0, 1.0));
  }
  EXPECT_LE(queue.looked_at(), 8u * 100'000u);
}

/// By roundings of the clock that is possible. The buckets are made anew when most bodies get their
/// first event, and what lies before the last that was taken must not fall behind the horizon.
TEST(EventQueue, LosesNoEventThatLiesBeforeTheLastWhereItIsMadeAnew) {
  constexpr std::uint32_t count = 1'000;
  EventQueue queue;
  queue.resize(count);
  queue.set(0, 1.0, 0, 0);
  ASSERT_EQ(queue.first(2.0), 0u);
  queue.set(1, std::nextafter(1.0, 0.0), 1, 1);
  for (std::uint32_t body = 2; body < count; ++body) queue.set(body, 1.0 + 1e-3 * body, body, body);
  for (const std::uint32_t body : {1u, 0u, 2u, 3u}) {
    EXPECT_EQ(queue.first(2.0), body);
    queue.set(body, std::numeric_limits<double>::infinity(), body, body);
  }
}

TEST(EventQueue, SaysThatNoEventIsLeftWhateverInstantItIsAskedFor) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr std::uint32_t count = 200;
  EventQueue queue;
  queue.resize(count);
  EXPECT_EQ(queue.first(infinity), EventQueue::none) << "before the first";
  for (std::uint32_t body = 0; body < count; ++body)  // most of them far beyond the buckets
    queue.set(body, 1e-3 * body * body, body, body);
  for (std::uint32_t body = 0; body < count; ++body) {
    ASSERT_EQ(queue.first(infinity), body);
    queue.set(body, infinity, body, body);
  }
  EXPECT_EQ(queue.first(infinity), EventQueue::none) << "all are taken";
  for (std::uint32_t body = 0; body < count; ++body) {
    queue.set(body, 50.0 + body, body, body);
    queue.set(body, infinity, body, body);
  }
  EXPECT_EQ(queue.first(infinity), EventQueue::none)
      << "only notes of what was called off are left";
  queue.set(7, 60.0, 7, 7);
  EXPECT_EQ(queue.first(infinity), 7u);
}

TEST(EventQueue, DoesNoMoreWorkForBodiesWithoutAnEvent) {
  const auto looked_at = [](std::uint32_t count) {
    EventQueue queue;
    queue.resize(count);
    std::mt19937_64 random(10);
    for (std::uint32_t body = 0; body < 100; ++body)
      queue.set(body, test::uniform(random, 0.0, 1.0), body, body);
    for (int step = 0; step < 20'000; ++step) {
      const std::uint32_t body = queue.first(1e9);
      queue.set(body, queue.time(body) + test::uniform(random, 0.0, 1.0), body, body);
    }
    return queue.looked_at();
  };
  EXPECT_EQ(looked_at(100), looked_at(1'000'000));
}

}  // namespace
}  // namespace rink::physics
