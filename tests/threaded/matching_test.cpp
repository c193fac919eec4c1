// Half of a match on a second core: the same pairs and changes in the same order as alone, and
// nobody woken for little.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <random>
#include <thread>
#include <vector>

#include "im/matching/batch_matcher.h"
#include "im/schemes/overlap_filter.h"
#include "rti/second_core.h"
#include "tests/im/cases.h"
#include "tests/im/long_play.h"

namespace rink::im {
namespace {

/// Whole coordinates, so that many regions touch.
std::vector<Region> regions(std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<Region> all;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = std::uniform_int_distribution<int>(0, 99)(random),
                 y = std::uniform_int_distribution<int>(0, 99)(random);
    const double side = std::uniform_int_distribution<int>(0, 3)(random);
    all.push_back({x, y, x + side, y + side});
  }
  return all;
}

struct Answer {
  std::vector<std::vector<std::uint32_t>> found;
  std::uint64_t pairs_tested;
  friend bool operator==(const Answer&, const Answer&) = default;
};

Answer answer_of(const BatchMatcher& matcher) {
  Answer answer{{}, matcher.pairs_tested()};
  matcher.for_each_subscription(
      [&](std::uint32_t subscription, std::span<const std::uint32_t> updates) {
        answer.found.emplace_back(1, subscription);
        answer.found.back().insert(answer.found.back().end(), updates.begin(), updates.end());
      });
  return answer;
}

TEST(ThreadedMatching, ABatchIsTheSameWithASecondCore) {
  rti::SecondCore second_core;
  second_core.worth_sharing = {8'192, 2'048};
  BatchMatcher alone, shared;
  alone.set_world(world), shared.set_world(world);
  shared.share_with(&second_core);
  for (const std::size_t count : {5000u, 4096u, 20'000u, 4097u}) {
    auto updates = regions(count, count), subscriptions = regions(count, count + 1);
    updates[7].low_x = NAN, subscriptions[3].high_y = -1.0,
    subscriptions[count - 1].low_x = INFINITY;
    alone.match(updates, subscriptions), shared.match(updates, subscriptions);
    EXPECT_EQ(answer_of(alone), answer_of(shared)) << count;
    ASSERT_EQ(shared.rejections().size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(alone.rejections()[i], shared.rejections()[i]);
  }
  EXPECT_EQ(second_core.task_count(), 2u * 4u) << "indexing and joining of each";
}

TEST(ThreadedMatching, ChangesAreTheSameWithASecondCoreWhateverPartMoves) {
  for (const std::size_t subscriber_count : {1'000u, 12'000u}) {
    const Shape shape = subscriber_count == 1'000u ? Shape::disc : Shape::rectangle;
    rti::SecondCore second_core;
    second_core.worth_sharing = {8'192, 2'048};
    OverlapFilter alone(world, Instructions::best, shape), shared(world, Instructions::best, shape);
    shared.share_with(&second_core);
    std::mt19937_64 random(5);
    auto entities = regions(12'000, 1), subscribers = regions(subscriber_count, 2);
    for (const double share : {1.0, 1.0, 0.1, 0.14, 0.01, 0.5, 0.0, 1.0}) {
      for (OverlapFilter* filter : {&alone, &shared}) {
        for (std::uint32_t i = 0; i < entities.size(); ++i)
          filter->set_update_region(i, entities[i]);
        for (std::uint32_t i = 0; i < subscribers.size(); ++i)
          filter->set_subscription_region(i, subscribers[i]);
        if (share == 0.5) filter->remove_entity(17), filter->remove_subscriber(5);
      }
      const auto expected = alone.match(), changes = shared.match();
      EXPECT_EQ(std::vector<Change>(expected.begin(), expected.end()),
                std::vector<Change>(changes.begin(), changes.end()))
          << share;
      EXPECT_EQ(alone.counters().pairs_tested, shared.counters().pairs_tested);
      for (std::vector<Region>* side : {&entities, &subscribers})
        for (Region& region : *side) {
          if (std::uniform_real_distribution<double>(0.0, 1.0)(random) >= share) continue;
          const double step = std::uniform_int_distribution<int>(-1, 1)(random);
          region = {region.low_x + step, region.low_y - step, region.high_x + step,
                    region.high_y - step};
        }
    }
    EXPECT_GE(second_core.task_count(), 4u);
  }
}

/// A worker that is asked for everything: each scheme, and what stands on top of schemes, on
/// layouts that are small enough for many turns.
TEST(ThreadedMatching, EverySchemeIsTheSameWithASecondCore) {
  std::vector<std::string> all = filter_names();
  for (const char* composed :
       {"aura and not sight", "region with hysteresis(margin=0.5) with dwell(matches=3)",
        "aura with tiers(at=0.3 at=0.6)"})
    all.emplace_back(composed);
  for (const std::string& scheme : all) {
    rti::SecondCore second_core;
    second_core.worth_sharing = {0, 0};
    for (const Layout& layout : layouts) {
      SCOPED_TRACE(scheme + " on " + layout.name);
      const auto alone = make_filter(scheme, settings_for(3)),
                 shared = make_filter(scheme, settings_for(3));
      shared->share_with(&second_core);
      Random random(6);
      for (const double share : {1.0, 0.05, 1.0, 0.3, 0.02, 0.0, 1.0}) {
        for (std::uint32_t id = 0; id < 60; ++id) {
          if (between(random, 0.0, 1.0) >= share) continue;
          const Region place = layout.draw(random, 0.5), view = layout.draw(random, 3.0);
          for (Filter* filter : {alone.get(), shared.get()}) {
            filter->set_update_region(id, place);
            if (id < 15) filter->set_subscription_region(id, view);
          }
        }
        const auto expected = alone->match(), changes = shared->match();
        ASSERT_TRUE(std::equal(expected.begin(), expected.end(), changes.begin(), changes.end()))
            << "a share of " << share;
        ASSERT_EQ(alone->counters().pairs_tested, shared->counters().pairs_tested);
      }
    }
    EXPECT_GT(second_core.task_count(), 0u) << scheme;
  }
}

TEST(ThreadedMatching, NobodyIsWokenForLittle) {
  rti::SecondCore second_core;
  OverlapFilter filter(world);
  filter.share_with(&second_core);
  for (int tick = 0; tick < 3; ++tick) {
    const auto entities = regions(2'000, static_cast<std::uint64_t>(tick));
    for (std::uint32_t i = 0; i < entities.size(); ++i)
      filter.set_update_region(i, entities[i]),
          filter.set_subscription_region(i, entities[entities.size() - 1 - i]);
    EXPECT_FALSE(filter.match().empty());
  }
  EXPECT_EQ(second_core.task_count(), 0u);
}

TEST(ThreadedMatching, ASecondCoreThatWasNeverNeededEnds) {
  const auto thread_count = [] {
    return std::distance(std::filesystem::directory_iterator("/proc/self/task"), {});
  };
  // A thread that has been joined is listed for some microseconds more, and the thread sanitizer
  // starts one of its own beside the first.
  const auto comes_to = [&](std::ptrdiff_t count) {
    for (int waits = 0; waits < 5000 && thread_count() != count; ++waits)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return thread_count() == count;
  };
  { const rti::SecondCore first; }
  std::this_thread::sleep_for(std::chrono::milliseconds(10));
  const auto before = thread_count();
  for (int i = 0; i < 50; ++i) {
    const rti::SecondCore idle;
    EXPECT_TRUE(comes_to(before + 1));
    EXPECT_EQ(idle.task_count(), 0u);
  }
  EXPECT_TRUE(comes_to(before));
}

TEST(ThreadedMatching, EveryTaskHasRunWhenItsWaitReturns) {
  rti::SecondCore second_core;
  int sum = 0;
  for (int i = 1; i <= 2000; ++i) {
    int own = 0;
    run_both(
        &second_core, [&own, i] { own = i; }, [&sum, i] { sum += i; });
    ASSERT_EQ(own, i);
    ASSERT_EQ(sum, i * (i + 1) / 2);
  }
}

}  // namespace
}  // namespace rink::im
