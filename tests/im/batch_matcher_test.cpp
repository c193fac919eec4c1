// The batch matcher against brute force, its scalar path against the wide one, and what it says to
// bad input.
#include "im/matching/batch_matcher.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "tests/im/layouts.h"

namespace rink::im {
namespace {

/// (subscription, update), ascending.
using PairList = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

PairList brute_force(const std::vector<Region>& updates, const std::vector<Region>& subscriptions) {
  PairList pairs;
  for (std::uint32_t s = 0; s < subscriptions.size(); ++s)
    for (std::uint32_t u = 0; u < updates.size(); ++u) {
      const Region &a = subscriptions[s], &b = updates[u];
      if (is_valid(a) && is_valid(b) &&
          !(b.high_x < a.low_x || a.high_x < b.low_x || b.high_y < a.low_y || a.high_y < b.low_y))
        pairs.emplace_back(s, u);
    }
  return pairs;
}

/// In the order found.
PairList pairs_of(const BatchMatcher& matcher) {
  PairList pairs;
  matcher.for_each_subscription(
      [&](std::uint32_t subscription, std::span<const std::uint32_t> updates) {
        for (const std::uint32_t update : updates) pairs.emplace_back(subscription, update);
      });
  EXPECT_EQ(pairs.size(), matcher.pair_count());
  return pairs;
}

PairList sorted(PairList pairs) {
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::vector<Region> draw(Random& random, const Layout& layout, std::size_t count, double half_max) {
  std::vector<Region> regions;
  for (std::size_t i = 0; i < count; ++i) regions.push_back(layout.draw(random, half_max));
  return regions;
}

/// Expected ones, and others that make matching slow, never wrong.
constexpr std::array worlds{Region{0.0, 0.0, side, side}, Region{7.0, 7.0, 7.5, 7.01},
                            Region{-1e9, 1e9, -0.9e9, 1.1e9}, Region{0.0, 0.0, 1e-299, 1e300}};

void compare_with_brute_force(std::uint64_t first_seed, std::uint64_t end_seed) {
  BatchMatcher best, scalar(Instructions::scalar);
  for (std::uint64_t seed = first_seed; seed < end_seed; ++seed)
    for (const Layout& layout : layouts) {
      Random random(seed);
      const auto update_count = static_cast<std::size_t>(between(random, 0.0, 120.0));
      const auto subscription_count = static_cast<std::size_t>(between(random, 0.0, 60.0));
      const std::vector<Region> updates = draw(random, layout, update_count, 1.0),
                                subscriptions = draw(random, layout, subscription_count, 3.0);
      for (BatchMatcher* matcher : {&best, &scalar}) {
        ASSERT_FALSE(matcher->set_world(worlds[seed % worlds.size()]));
        matcher->match(updates, subscriptions);
        ASSERT_THAT(matcher->rejections(), testing::IsEmpty());
      }
      ASSERT_EQ(sorted(pairs_of(best)), brute_force(updates, subscriptions))
          << layout.name << " with seed " << seed;
      ASSERT_EQ(pairs_of(best), pairs_of(scalar))
          << layout.name << " with seed " << seed << ": " << best.instructions() << " differs from "
          << scalar.instructions();
    }
}

TEST(BatchMatcher, FindsWhatBruteForceFinds) { compare_with_brute_force(1, 1000); }
TEST(BatchMatcherLong, FindsWhatBruteForceFinds) { compare_with_brute_force(1000, 30'000); }

TEST(BatchMatcher, FindsWhatBruteForceFindsAmongManyOfMixedSizes) {
  for (const Layout& layout : layouts) {
    Random random(3);
    const std::vector<Region> updates = draw(random, layout, 4'000, 0.3),
                              subscriptions = draw(random, layout, 1'000, 0.3);
    BatchMatcher matcher;
    matcher.set_world({0.0, 0.0, side, side});
    matcher.match(updates, subscriptions);
    EXPECT_EQ(sorted(pairs_of(matcher)), brute_force(updates, subscriptions)) << layout.name;
  }
}

TEST(BatchMatcher, CountsTouchingAsOverlapToTheLastBit) {
  // Far from the origin and close together: single precision sees one place.
  const double x = 1e9, next = std::nextafter(x, 2e9);
  BatchMatcher matcher;
  matcher.match(std::vector<Region>{{x - 1.0, 0.0, x, 1.0}},
                std::vector<Region>{{x, 1.0, x + 1.0, 2.0},
                                    {next, 0.0, x + 1.0, 1.0},
                                    {x, std::nextafter(1.0, 2.0), x, 2.0}});
  EXPECT_EQ(pairs_of(matcher), (PairList{{0, 0}}));
}

TEST(BatchMatcher, TestsFewPairsWhateverTheSizesAndTheCrowding) {
  // One pair per region on average; a box thirty times as wide as the others must not make everyone
  // look far.
  for (const char* name : {"uniform", "mixed", "hotspot"}) {
    Random random(5);
    std::vector<Region> regions;
    for (int i = 0; i < 40'000; ++i) {
      const bool is_special =
          between(random, 0.0, 1.0) < (std::string(name) == "mixed" ? 0.01 : 0.9);
      const double spread = std::string(name) == "hotspot" && is_special ? 0.1 : 1.0,
                   half = (std::string(name) == "mixed" && is_special ? 0.05 : 0.05 / 30.0);
      const double cx = spread * between(random, 0.0, 1.0), cy = spread * between(random, 0.0, 1.0);
      regions.push_back(around(cx, cy, half));
    }
    BatchMatcher matcher;
    matcher.match(regions, regions);
    EXPECT_LT(static_cast<double>(matcher.pairs_tested()),
              3.0 * static_cast<double>(matcher.pair_count()) + 20.0 * 40'000.0)
        << name;
  }
}

TEST(BatchMatcher, RejectsBadRegionsByNameAndMatchesTheOthers) {
  constexpr double inf = std::numeric_limits<double>::infinity(),
                   nan = std::numeric_limits<double>::quiet_NaN();
  BatchMatcher matcher;
  matcher.match(std::vector<Region>{{0, 0, 1, 1}, {1, 0, 0, 1}, {0, nan, 1, 1}},
                std::vector<Region>{{0, 0, inf, 1}, {1, 1, 2, 2}, {0, 2, 1, 1}});
  EXPECT_EQ(pairs_of(matcher), (PairList{{1, 0}}));
  std::vector<std::string> words;
  for (const Rejection& rejection : matcher.rejections()) words.push_back(describe(rejection));
  EXPECT_THAT(words,
              testing::ElementsAre(
                  "update region 1 is inverted: its low exceeds its high",
                  "update region 2 is not finite: a coordinate is infinite or not a number",
                  "subscription region 0 is not finite: a coordinate is infinite or not a number",
                  "subscription region 2 is inverted: its low exceeds its high"));
}

TEST(BatchMatcher, RejectsAWorldOfNoAreaAndKeepsTheOneBefore) {
  BatchMatcher matcher;
  for (const Region& world : {Region{0, 0, 0, 1}, Region{2, 2, 2, 2}, Region{0, 0, 1, 0}}) {
    const auto rejection = matcher.set_world(world);
    ASSERT_TRUE(rejection);
    EXPECT_EQ(describe(*rejection), "the world has no area");
  }
  EXPECT_EQ(describe(*matcher.set_world({1, 0, 0, 1})),
            "the world is inverted: its low exceeds its high");
  EXPECT_EQ(describe(*matcher.set_world({-1e308, 0, 1.7e308, 1})),
            "the world is not finite: a coordinate is infinite or not a number");
  matcher.match(std::vector<Region>{{0, 0, 1, 1}}, std::vector<Region>{{1, 1, 2, 2}});
  EXPECT_EQ(matcher.pair_count(), 1u);
}

TEST(BatchMatcher, FindsNothingAmongNothing) {
  BatchMatcher matcher;
  matcher.match({}, {});
  EXPECT_EQ(matcher.pair_count(), 0u);
  matcher.match(std::vector<Region>{{0, 0, 1, 1}}, {});
  EXPECT_EQ(matcher.pair_count(), 0u);
}

}  // namespace
}  // namespace rink::im
