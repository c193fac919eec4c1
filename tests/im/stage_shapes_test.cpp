// Stages over views that are no squares and not in the middle: which side counts, and what a tier
// weighs.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>

#include "im/stages/priority_order.h"
#include "tests/im/recount.h"

namespace rink::im {
namespace {

constexpr double x = 50.0, y = 30.0;
/// 20 m wide and 8 m high, so that the disc of the subscription has a radius of 4 m.
constexpr Region wide{x - 10.0, y - 4.0, x + 10.0, y + 4.0};
constexpr Region high{x - 4.0, y - 10.0, x + 4.0, y + 10.0};
constexpr double radius = 4.0;

std::map<Entity, std::uint8_t> tiers_of(Filter& filter) {
  std::map<Entity, std::uint8_t> tiers;
  for (const Change& change : filter.match()) tiers[change.entity] = change.tier;
  return tiers;
}

TEST(StageShapes, RingsOfTiersAreFractionsOfTheShorterSide) {
  for (const Region& view : {wide, high}) {
    const auto filter =
        make_filter("region with tiers(at=0.25 at=0.75)", {.world = {0.0, 0.0, 100.0, 100.0}});
    filter->set_subscription_region(0, view);
    const std::array distances{0.24 * radius, 0.26 * radius, 0.74 * radius, 0.76 * radius};
    const bool is_wide = view == wide;
    for (Entity id = 0; id < distances.size(); ++id) {
      const double across = is_wide ? distances[id] : 0.0, up = is_wide ? 0.0 : distances[id];
      filter->set_update_region(id, {x + across, y + up, x + across, y + up});
    }
    EXPECT_EQ(tiers_of(*filter), (std::map<Entity, std::uint8_t>{{0, 0}, {1, 1}, {2, 1}, {3, 2}}));
  }
}

/// How often each of two entities is sent to when one update fits into every match.
std::array<int, 2> shares(const char* expression, const Region& view, double near, double far,
                          int matches) {
  const auto filter = make_filter(expression, {.world = {0.0, 0.0, 100.0, 100.0}});
  filter->set_subscription_region(0, view);
  filter->set_update_region(0, {x + near, y, x + near, y});
  filter->set_update_region(1, {x + far, y, x + far, y});
  const auto ten_bytes = [](const auto&) { return std::size_t{10}; };
  for (int match = 0; match < 4; ++match)
    filter->match(), filter->priority()->fill(0, 100, ten_bytes);  // both have entered
  std::array<int, 2> sent{};
  for (int match = 0; match < matches; ++match) {
    filter->match();
    for (const auto& item : filter->priority()->fill(0, 10, ten_bytes)) ++sent[item.entity];
  }
  return sent;
}

/// What docs/im.md says of two that are sent to in turns: the urgency of who waits for n matches is
/// n w, with w = 1 / ((1 + d / r) 2^tier).
std::array<int, 2> expected_shares(double near, double far, int far_tier, int matches) {
  const std::array weights{1.0 / (1.0 + near / radius),
                           1.0 / ((1.0 + far / radius) * std::exp2(far_tier))};
  std::array<int, 2> waits{}, sent{};
  for (int match = 0; match < matches; ++match) {
    for (int& wait : waits) ++wait;
    const std::size_t most = waits[1] * weights[1] > waits[0] * weights[0] ? 1 : 0;
    waits[most] = 0;
    ++sent[most];
  }
  return sent;
}

TEST(StageShapes, PriorityWeighsDistanceAgainstTheShorterSideAndHalvesWithEachTier) {
  constexpr int matches = 4'000;
  constexpr double near = 0.3 * radius;
  for (const double far : {1.1 * radius, 1.5 * radius, 1.9 * radius, 2.3 * radius}) {
    const auto share = [&](const char* expression, int far_tier) {
      const std::array<int, 2> sent = shares(expression, wide, near, far, matches),
                               expected = expected_shares(near, far, far_tier, matches);
      EXPECT_EQ(sent[0] + sent[1], matches);
      EXPECT_NEAR(sent[0], expected[0], 4) << expression << ", " << far;
      return static_cast<double>(sent[0]) / sent[1];
    };
    const double plain = share("region with priority", 0),
                 second = share("region with tiers(at=0.5) with priority", 1),
                 third = share("region with tiers(at=0.5 at=0.9) with priority", 2);
    EXPECT_LT(plain, second);
    EXPECT_LT(second, third);
  }
}

}  // namespace
}  // namespace rink::im
