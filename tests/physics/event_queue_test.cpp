// The calendar queue: the order of its events is that of their times, and its work does not depend on how it was asked.
#include "game/physics/event_queue.h"

#include <gtest/gtest.h>

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
  static double time(std::uint64_t number) { return 1e-3 + static_cast<double>(number / 2) * 2.0 * gap_s + static_cast<double>(number % 2) * pair_gap_s; }
  void set(std::uint32_t body, double time) { queue_.set(body, time, body, body); }

  EventQueue queue_;
  std::uint64_t taken_ = 0;
};

TEST(EventQueue, IsNotMisledByManyQuestionsBetweenTwoEventsOfAPair) {
  PairedEvents events;
  events.take(20'000);
  for (int pair = 0; pair < 4; ++pair) {
    events.take(1);
    // As a server asks when a thousand players press keys within a microsecond.
    for (int i = 0; i < 400'000; ++i) ASSERT_EQ(events.queue().first(events.next_time() - 1e-10), EventQueue::none);
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
  const auto time = [](std::uint32_t body) { return 1e-3 * (body / 3 * 2 + (body % 3 == 2 ? 1 : 0)) + (body % 3 == 1 ? 1e-10 : 0.0); };
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

}  // namespace
}  // namespace rink::physics
