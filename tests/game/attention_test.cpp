// Which pucks a player looks at.
#include "game/players/attention.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace rink::game {
namespace {

std::vector<std::uint32_t> ids_of(const std::vector<SeenEntity>& pucks) {
  std::vector<std::uint32_t> ids;
  for (const SeenEntity& puck : pucks) ids.push_back(puck.id);
  return ids;
}

/// Places on a lattice of 8 x 8 are at equal distance to many.
TEST(NearestOf, AreTheFirstOfAllInOrderOfDistanceThenOfAppearance) {
  std::mt19937 random(5);
  const auto lattice_point = [&] {
    const std::uint32_t cell = static_cast<std::uint32_t>(random()) % 64;
    return Vector2(0.25 * (cell % 8), 0.25 * (cell / 8));  // NOLINT(bugprone-integer-division)
  };
  for (std::uint32_t count = 0; count < 60; ++count) {
    std::vector<SeenEntity> seen;
    for (std::uint32_t k = 0; k < count; ++k)
      seen.push_back({.id = k, .position = lattice_point()});
    const Vector2 from = lattice_point();
    std::vector<SeenEntity> all = seen;
    std::ranges::stable_sort(
        all, {}, [&](const SeenEntity& puck) { return (puck.position - from).squaredNorm(); });
    for (const std::size_t most : {0u, 1u, 3u, 17u, 60u}) {
      std::vector<std::uint32_t> first = ids_of(all);
      first.resize(std::min(most, first.size()));
      EXPECT_EQ(ids_of(nearest_of(seen, from, most)), first) << most << " of " << count;
    }
  }
}

}  // namespace
}  // namespace rink::game
