// Every scheme against brute force on long random sequences of moves, arrivals, removals and returns.
#include <gtest/gtest.h>

#include "tests/im/long_play.h"

namespace rink::im {
namespace {

void play_scheme(const std::string& scheme, std::uint64_t seed, int matches) {
  play(seed, matches, [&] { return Judged(scheme, settings_for(seed)); });
}

class EveryScheme : public testing::TestWithParam<std::string> {};
class EverySchemeLong : public testing::TestWithParam<std::string> {};

TEST_P(EveryScheme, ReplaysToTheRecountOnEveryLayout) {
  for (std::uint64_t seed = 1; seed <= 12 && !HasFatalFailure(); ++seed) play_scheme(GetParam(), seed, 24);
}

TEST_P(EverySchemeLong, ReplaysToTheRecountOverAThousandSeeds) {
  for (std::uint64_t seed = 1000; seed < 2000 && !HasFatalFailure(); ++seed) play_scheme(GetParam(), seed, 24);
}

INSTANTIATE_TEST_SUITE_P(Im, EveryScheme, testing::ValuesIn(filter_names()), [](const auto& info) { return info.param; });
INSTANTIATE_TEST_SUITE_P(Im, EverySchemeLong, testing::ValuesIn(filter_names()), [](const auto& info) { return info.param; });

TEST(Filter, GivesTheSameChangesForTheSameCallsInAnyOrderWithinATick) {
  Random random(7);
  const auto forwards = make_filter("region", {.world = {0.0, 0.0, side, side}}), backwards = make_filter("region", {.world = {0.0, 0.0, 1.0, 1.0}});
  for (int tick = 0; tick < 20; ++tick) {
    std::vector<Region> regions;
    for (int i = 0; i < 200; ++i) regions.push_back(draw_random(random, 2.0));
    for (std::uint32_t i = 0; i < 200; ++i) {
      const std::uint32_t j = 199 - i;
      i < 180 ? forwards->set_update_region(i, regions[i]) : forwards->set_subscription_region(i, regions[i]);
      j < 180 ? backwards->set_update_region(j, regions[j]) : backwards->set_subscription_region(j, regions[j]);
    }
    const auto a = forwards->match(), b = backwards->match();
    ASSERT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end())) << "tick " << tick;
  }
}

}  // namespace
}  // namespace rink::im
