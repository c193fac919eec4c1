// Events of one time are taken in the order of ids: lower one first, higher one next, parts of the
// field after all bodies, whatever keeps the events.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "game/physics/events/event_heap.h"
#include "game/physics/events/event_queue.h"
#include "tests/physics/scenes.h"

namespace rink::physics::test {
namespace {

constexpr double tied_radius = 0.03125;

PuckSpec tied_puck(const Vector2& position, const Vector2& velocity = {0.0, 0.0}) {
  return {.position = position, .velocity = velocity, .radius = tied_radius};
}

/// Surfaces that may rub take simultaneous impacts one by one, even without friction.
WorldSpec one_by_one(QueuePolicy queue) {
  WorldSpec spec = rink_of(16, 16);
  spec.surface_friction = SurfaceFriction{PairTable(1, 0.0), RestitutionTable(1, 1.0)};
  spec.queue = queue;
  return spec;
}

constexpr std::array policies{QueuePolicy::calendar, QueuePolicy::heap, QueuePolicy::windows};

/// Two balls stand at 30 degrees to the way of a third. The first to be hit takes c = cos(30) of
/// its speed along their line, the second c (1 - n . n') = c/2.
TEST(Ties, OfOneBodyWithTwoGoToTheLowerId) {
  for (const QueuePolicy queue : policies) {
    std::vector<int> order{0, 1, 2};  // which of: coming, above, below
    do {
      SCOPED_TRACE(testing::Message() << order[0] << order[1] << order[2]);
      World world(one_by_one(queue));
      std::array<BodyId, 3> ids;
      for (const int which : order) {
        const double side = which == 1 ? 1.0 : -1.0;
        const PuckSpec puck = which == 0 ? tied_puck({0.5, 1.0}, {1.0, 0.0})
                                         : tied_puck({1.0, 1.0 + side * tied_radius});
        ids[static_cast<std::size_t>(which)] = world.add(puck);
      }
      world.advance(0.75);
      ASSERT_EQ(world.counters().disc_impacts, 2u);
      ASSERT_NEAR(world.motion(ids[1]).time, world.motion(ids[2]).time, 1e-15);
      const double first = std::sqrt(0.75), second = 0.5 * first;
      EXPECT_NEAR(world.velocity(ids[1]).norm(), ids[1] < ids[2] ? first : second, 1e-13);
      EXPECT_NEAR(world.velocity(ids[2]).norm(), ids[1] < ids[2] ? second : first, 1e-13);
    } while (std::next_permutation(order.begin(), order.end()));
  }
}

/// Two pucks that come down side by side, one faster towards the other, touch each other and the
/// wall at one time, which the engine finds without a rounding.
TEST(Ties, WithTheFieldComeAfterThoseOfBodies) {
  for (const QueuePolicy queue : policies)
    for (const bool is_left_first : {false, true}) {
      World world(one_by_one(queue));
      world.record_events(true);
      const PuckSpec left = tied_puck({1.0, 0.5 + tied_radius}, {1.0, -1.0});
      const PuckSpec right = tied_puck({1.5 + 2.0 * tied_radius, 0.5 + tied_radius}, {0.0, -1.0});
      world.add(is_left_first ? left : right);
      world.add(is_left_first ? right : left);
      world.advance(0.75);
      const auto events = world.events();
      ASSERT_EQ(events.size(), 3u);
      for (const Event& event : events) EXPECT_EQ(event.time, 0.5);
      EXPECT_EQ(events[0].kind, EventKind::puck_puck);
      EXPECT_EQ(events[1].kind, EventKind::wall);
      EXPECT_EQ(events[1].body, BodyId{0});
      EXPECT_EQ(events[2].kind, EventKind::wall);
      EXPECT_EQ(events[2].body, BodyId{1});
    }
}

/// 100 pairs that meet at one time, far from each other; who belongs to whom is drawn.
TEST(Ties, OfManyPairsAreTakenInOrderOfTheirIds) {
  for (const QueuePolicy queue : policies) {
    WorldSpec spec = rink_of(16, 16);
    spec.queue = queue;
    World world(spec);
    world.record_events(true);
    std::vector<PuckSpec> pucks;
    for (int pair = 0; pair < 100; ++pair) {
      const Vector2 place(1.0 + 1.5 * (pair % 10), 1.0 + 1.5 * (pair / 10));
      pucks.push_back(tied_puck(place, {1.0, 0.0}));
      pucks.push_back(tied_puck(place + Vector2(0.5, 0.0)));
    }
    std::mt19937_64 random(8);
    std::shuffle(pucks.begin(), pucks.end(), random);
    for (const PuckSpec& puck : pucks) world.add(puck);
    world.advance(0.5);
    ASSERT_EQ(world.events().size(), 100u);
    std::vector<std::pair<BodyId, BodyId>> met;
    for (const Event& event : world.events()) {
      EXPECT_EQ(event.time, 0.5 - 2.0 * tied_radius);
      met.emplace_back(event.body, event.other.value());
      EXPECT_LT(event.body, event.other.value());
    }
    EXPECT_TRUE(std::is_sorted(met.begin(), met.end()));
  }
}

/// Bodies 0, 1, ... have events in pairs `apart` [s] from each other, `gap` [s] from pair to pair.
template <class Queue>
void expect_every_close_pair_to_be_seen(double gap, double apart) {
  SCOPED_TRACE(testing::Message() << gap << " s from pair to pair");
  constexpr std::uint32_t count = 20'000;
  Queue queue;
  queue.resize(count);
  const auto time = [&](std::uint32_t body) {
    return gap * (body / 2 + 1) + (body % 2 == 0 ? -0.5 : 0.5) * apart;
  };
  for (std::uint32_t body = 0; body < count; ++body) queue.set(body, time(body), body, body);
  for (std::uint32_t body = 0; body < count; ++body) {
    ASSERT_EQ(queue.first(1e9), body);
    if (body % 2 == 0) {
      ASSERT_TRUE(queue.is_followed_within(1e-9)) << body;
    }
    queue.set(body, std::numeric_limits<double>::infinity(), body, body);
  }
}

/// Pairs around the edges of buckets: of a new calendar, a millisecond wide, and of whatever width
/// it learns, since pairs as close to each other as a bucket is to its next lie on all sides of
/// edges.
TEST(Ties, AreSeenAcrossTheEdgesOfBuckets) {
  for (const double gap : {1e-3, 1e-5, 3.7e-7, 2.3e-8}) {
    expect_every_close_pair_to_be_seen<EventQueue>(gap, 4e-10);
    expect_every_close_pair_to_be_seen<EventHeap>(gap, 4e-10);
  }
}

/// Equal times for eight bodies on the average, dense at first and then a thousand times as rare,
/// so that the buckets are made anew on the way.
TEST(Ties, KeepTheirOrderWhileBucketsAdapt) {
  constexpr std::uint32_t count = 3'000;
  constexpr std::uint64_t seed = 12;
  SCOPED_TRACE(seed);
  std::mt19937_64 random(seed);
  EventQueue queue;
  queue.resize(count);
  using Entry = std::tuple<double, std::uint32_t, std::uint32_t>;
  std::vector<Entry> all;
  for (std::uint32_t body = 0; body < count; ++body) {
    const bool is_early = body < count / 2;
    const double step = static_cast<double>(1 + random() % (count / 16));
    const double time = is_early ? 1e-6 * step : 1e-3 * (1.0 + step);
    const auto other = static_cast<std::uint32_t>(random() % 3);
    all.emplace_back(time, other, count + body);  // no two alike
    queue.set(body, time, other, count + body);
  }
  std::sort(all.begin(), all.end());
  for (const auto& [time, lower, higher] : all) {
    ASSERT_EQ(queue.first(1e9), higher - count);
    ASSERT_EQ(queue.time(higher - count), time);
    queue.set(higher - count, std::numeric_limits<double>::infinity(), 0, 0);
  }
}

}  // namespace
}  // namespace rink::physics::test
