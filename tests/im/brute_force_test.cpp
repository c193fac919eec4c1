// Every scheme against brute force on long random sequences of moves, arrivals, removals and returns.
#include <gtest/gtest.h>

#include <array>

#include "tests/im/layouts.h"
#include "tests/im/recount.h"

namespace rink::im {
namespace {

/// A round of what may happen between two matches; `activity` is the share of ids that something happens to.
void disturb(Judged& judged, Random& random, const Layout& layout, double activity) {
  constexpr std::uint32_t entity_max = 60, subscriber_max = 15;
  constexpr double entity_half = 0.5, subscriber_half = 3.0;
  const auto happens = [&](double probability) { return between(random, 0.0, 1.0) < probability; };
  for (Entity entity = 0; entity < entity_max; ++entity) {
    if (!happens(activity)) continue;
    if (happens(0.1)) judged.remove_entity(entity);
    const auto found = judged.entities().find(entity);
    if (found != judged.entities().end()) judged.move_entity(entity, moved(random, found->second, layout, entity_half));
    else if (happens(0.5)) judged.move_entity(entity, layout.draw(random, entity_half));
  }
  for (Subscriber subscriber = 0; subscriber < subscriber_max; ++subscriber) {
    if (!happens(activity)) continue;
    if (happens(0.1)) judged.remove_subscriber(subscriber);
    const auto found = judged.subscribers().find(subscriber);
    if (found != judged.subscribers().end()) judged.move_subscriber(subscriber, moved(random, found->second, layout, subscriber_half));
    else if (happens(0.5)) judged.move_subscriber(subscriber, layout.draw(random, subscriber_half));
  }
}

void play(const std::string& scheme, std::uint64_t seed, int matches) {
  for (const Layout& layout : layouts) {
    SCOPED_TRACE(scheme + " on " + layout.name + " with seed " + std::to_string(seed));
    Random random(seed);
    Judged judged(scheme, {.world = {0.0, 0.0, side, side}, .cell_size = seed % 2 == 0 ? 1.0 : 0.7});
    for (int i = 0; i < matches; ++i) {
      constexpr std::array activities{1.0, 0.3, 0.05};
      disturb(judged, random, layout, activities[static_cast<std::size_t>(i) % activities.size()]);
      if (i % 7 == 3) disturb(judged, random, layout, 0.5);  // several moves between two matches
      judged.check_match();
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

class EveryScheme : public testing::TestWithParam<std::string> {};
class EverySchemeLong : public testing::TestWithParam<std::string> {};

TEST_P(EveryScheme, ReplaysToTheRecountOnEveryLayout) {
  for (std::uint64_t seed = 1; seed <= 12 && !HasFatalFailure(); ++seed) play(GetParam(), seed, 24);
}

TEST_P(EverySchemeLong, ReplaysToTheRecountOverAThousandSeeds) {
  for (std::uint64_t seed = 1000; seed < 2000 && !HasFatalFailure(); ++seed) play(GetParam(), seed, 24);
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
