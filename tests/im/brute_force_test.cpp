// Every scheme against brute force on long random sequences of moves, arrivals, removals and
// returns.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <tuple>

#include "tests/im/long_play.h"

namespace rink::im {
namespace {

void play_scheme(const std::string& scheme, std::uint64_t seed, int matches) {
  play(seed, matches, [&] { return Judged(scheme, settings_for(seed)); });
}

class EveryScheme : public testing::TestWithParam<std::string> {};
/// A scheme, and which quarter of the seeds.
class EverySchemeLong : public testing::TestWithParam<std::tuple<std::string, std::uint64_t>> {};

TEST_P(EveryScheme, ReplaysToTheRecountOnEveryLayout) {
  for (std::uint64_t seed = 1; seed <= 12 && !HasFatalFailure(); ++seed)
    play_scheme(GetParam(), seed, 24);
}

/// Every tenth goes on for long.
TEST_P(EverySchemeLong, ReplaysToTheRecountOverThousandsOfSeeds) {
  const auto& [scheme, quarter] = GetParam();
  const std::uint64_t first = 1000 + 500 * quarter;
  for (std::uint64_t seed = first; seed < first + 500 && !HasFatalFailure(); ++seed)
    play_scheme(scheme, seed, seed % 10 == 0 ? 120 : 12);
}

/// Most pairs rest until their two could have come far enough; who rests too long is caught where
/// steps are small.
TEST_P(EveryScheme, ReplaysToTheRecountWhereAllDriftSlowly) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Judged judged(GetParam(), settings_for(seed));
    std::vector<Region> entities, subscribers;
    for (Entity entity = 0; entity < 40; ++entity) entities.push_back(draw_gridded(random, 0.25));
    for (Subscriber subscriber = 0; subscriber < 10; ++subscriber)
      subscribers.push_back(draw_gridded(random, 3.0));
    std::vector<Heading> steps;
    const auto step = [&] {
      return seed % 2 == 0 ? std::round(between(random, -2.0, 2.0)) / 32.0
                           : between(random, -0.05, 0.05);
    };
    for (int i = 0; i < 50; ++i) steps.push_back({step(), step()});
    for (int tick = 0; tick < 80; ++tick) {
      const auto on = [&](Region& region, const Heading& by) {
        region = {region.low_x + by.x, region.low_y + by.y, region.high_x + by.x,
                  region.high_y + by.y};
      };
      for (Entity entity = 0; entity < 40; ++entity)
        if (on(entities[entity], steps[entity]), tick == 0 || between(random, 0.0, 1.0) < 0.9)
          judged.move_entity(entity, entities[entity]);
      for (Subscriber subscriber = 0; subscriber < 10; ++subscriber) {
        if (on(subscribers[subscriber], steps[40 + subscriber]),
            tick == 0 || between(random, 0.0, 1.0) < 0.9)
          judged.move_subscriber(subscriber, subscribers[subscriber]);
        if (between(random, 0.0, 1.0) < 0.02) judged.turn(subscriber, draw_heading(random));
      }
      if (tick % 20 == 19) std::shuffle(steps.begin(), steps.end(), random);
      judged.check_match();
      if (HasFatalFailure()) return;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Im, EveryScheme, testing::ValuesIn(schemes_of_pairs()),
                         [](const auto& info) { return info.param; });
INSTANTIATE_TEST_SUITE_P(Im, EverySchemeLong,
                         testing::Combine(testing::ValuesIn(schemes_of_pairs()),
                                          testing::Range<std::uint64_t>(0, 4)),
                         [](const auto& info) {
                           return std::get<0>(info.param) + "_" +
                                  std::to_string(std::get<1>(info.param));
                         });

TEST(Filter, GivesTheSameChangesForTheSameCallsInAnyOrderWithinATick) {
  Random random(7);
  const auto forwards = make_filter("region", {.world = {0.0, 0.0, side, side}}),
             backwards = make_filter("region", {.world = {0.0, 0.0, 1.0, 1.0}});
  for (int tick = 0; tick < 20; ++tick) {
    std::vector<Region> regions;
    for (int i = 0; i < 200; ++i) regions.push_back(draw_random(random, 2.0));
    for (std::uint32_t i = 0; i < 200; ++i) {
      const std::uint32_t j = 199 - i;
      i < 180 ? forwards->set_update_region(i, regions[i])
              : forwards->set_subscription_region(i, regions[i]);
      j < 180 ? backwards->set_update_region(j, regions[j])
              : backwards->set_subscription_region(j, regions[j]);
    }
    const auto a = forwards->match(), b = backwards->match();
    ASSERT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end())) << "tick " << tick;
  }
}

}  // namespace
}  // namespace rink::im
