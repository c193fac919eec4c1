// Discs counted around a place at an instant, four at a time, against a look at each.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "game/physics/flight/discs_near.h"

namespace rink::physics::test {
namespace {

#if defined(__SSE2__)

struct alignas(64) Disc : Flight {};

TEST(DiscsNear, AreAsManyAsALookAtEachFinds) {
  if (!has_fours) GTEST_SKIP() << "this processor takes two at a time at most";
  std::mt19937_64 random(1);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int round = 0; round < 2000; ++round) {
    std::vector<Disc> discs(40);
    for (Disc& disc : discs) {
      disc.x = uniform(0.0, 1.0), disc.y = uniform(0.0, 1.0), disc.vx = uniform(-1.0, 1.0),
      disc.vy = uniform(-1.0, 1.0);
      disc.time = uniform(0.0, 1.2), disc.radius = uniform(0.02, 0.2);
    }
    const auto count = static_cast<std::uint32_t>(random() % 33);
    std::vector<std::uint32_t> near(count + 3);
    for (std::uint32_t k = 0; k < count; ++k)
      near[k] = static_cast<std::uint32_t>(random() % discs.size());
    const std::uint32_t filler = 7;
    const double x = uniform(0.0, 1.0), y = uniform(0.0, 1.0), time = 1.0, least = 0.1;
    const auto is_near = [&](std::uint32_t number) {
      const Disc& disc = discs[number];
      const double ahead =
          std::max(0.0, time - disc.time);  // who has had its event at the instant, roundings
                                            // apart, is where it was then
      return std::hypot(disc.x + disc.vx * ahead - x, disc.y + disc.vy * ahead - y) <=
             disc.radius + least;
    };
    std::uint32_t expected = ((0u - count) & 3u) * (is_near(filler) ? 1u : 0u);
    for (std::uint32_t k = 0; k < count; ++k) expected += is_near(near[k]);
    EXPECT_EQ(count_near_in_fours(discs.data(), near.data(), count, filler, {x, y, time, least}),
              expected)
        << "round " << round;
  }
}

#endif

}  // namespace
}  // namespace rink::physics::test
