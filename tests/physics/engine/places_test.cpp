// Whoever may touch a body is found near its place, against all pairs.
#include "game/physics/engine/places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "tests/physics/scenes.h"

namespace rink::physics::test {
namespace {

std::vector<std::uint32_t> listed_near(const Places& places, std::uint32_t body) {
  std::vector<std::uint32_t> found(places.grid().collected_max());
  found.resize(places.grid().collect(body, found.data()));
  std::sort(found.begin(), found.end());
  return found;
}

TEST(Places, FitOnceTheyWereMadeForSoManyOfThatSize) {
  Places places(rink_of(4, 2));
  EXPECT_FALSE(places.fits(1, 0.04));
  places.fit(10, 0.04);
  EXPECT_TRUE(places.fits(10, 0.04));
  EXPECT_FALSE(places.fits(10, 0.041));
  places.fit(1000, 0.02);  // the widest is still the same
  EXPECT_EQ(places.reach(), 0.04);
  EXPECT_TRUE(places.fits(1000, 0.04));
  EXPECT_FALSE(places.fits(1'000'000, 0.04));
}

/// Two touch at the sum of their reaches at most, so cells are at least as wide as two of them.
TEST(Places, HaveCellsThatNoTouchReachesBeyond) {
  for (const double reach : {0.01, 0.1, 0.5})
    for (const double cell_size : {0.0, 0.7}) {
      WorldSpec spec = rink_of(4, 2);
      spec.cell_size = cell_size;
      Places places(spec);
      places.fit(5000, reach);
      places.rebuild(5000);
      EXPECT_GE(places.grid().side(), 2.0 * reach);
      EXPECT_GE(places.grid().side(), cell_size);
    }
}

/// Bodies stray by single cells, as crossings have them do, or are put elsewhere.
TEST(Places, ListEverybodyWhoMayTouchThroughRandomMoves) {
  constexpr std::uint64_t seed = 8;
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  constexpr std::uint32_t count = 120;
  std::mt19937_64 random(seed);
  const WorldSpec spec = rink_of(4, 2);
  Places places(spec);
  places.resize(count);
  places.fit(count, 0.1);
  places.rebuild(count);
  std::vector<Vector2> at(count);
  std::vector<bool> is_there(count, false);
  for (int step = 0; step < 2000; ++step) {
    const auto body = static_cast<std::uint32_t>(random() % count);
    if (!is_there[body]) {
      at[body] = {uniform(random, 0.0, 4.0), uniform(random, 0.0, 2.0)};
      places.insert(body, at[body]);
      is_there[body] = true;
    } else if (random() % 3 == 0) {
      places.remove(body);
      is_there[body] = false;
    } else {
      const auto way = static_cast<CellGrid::Direction>(random() % 4);
      Vector2 to = at[body];
      to[way / 2] += (way % 2 == 0 ? -1.0 : 1.0) * places.grid().side();
      if (to.minCoeff() < 0.0 || to.x() > 4.0 || to.y() > 2.0) continue;
      // The last cells are wider: there it may stay in its own.
      const CellGrid& grid = places.grid();
      if (grid.column(to.x()) == grid.place(body).column &&
          grid.row(to.y()) == grid.place(body).row)
        continue;
      at[body] = to;
      places.move(body, way);
    }
    if (step % 50 != 0) continue;
    for (std::uint32_t one = 0; one < count; ++one) {
      EXPECT_EQ(places.grid().is_listed(one), is_there[one]);
      if (!is_there[one]) continue;
      const std::vector<std::uint32_t> found = listed_near(places, one);
      EXPECT_EQ(std::adjacent_find(found.begin(), found.end()), found.end());
      for (std::uint32_t other = 0; other < count; ++other) {
        const bool is_found = std::binary_search(found.begin(), found.end(), other);
        if (!is_there[other]) {
          EXPECT_FALSE(is_found);
        } else if ((at[one] - at[other]).lpNorm<Eigen::Infinity>() <= 2.0 * places.reach()) {
          EXPECT_TRUE(is_found) << one << " misses " << other << " after step " << step;
        }
      }
    }
  }
}

TEST(Places, HoldNobodyAfterTheyAreMadeAnew) {
  Places places(rink_of(4, 2));
  places.resize(2);
  places.fit(2, 0.1);
  places.rebuild(2);
  places.insert(0, {1.0, 1.0}), places.insert(1, {1.1, 1.0});
  EXPECT_EQ(listed_near(places, 0), (std::vector<std::uint32_t>{0, 1}));
  places.rebuild(2);
  EXPECT_FALSE(places.grid().is_listed(0));
  places.insert(1, {1.1, 1.0});
  EXPECT_EQ(listed_near(places, 1), (std::vector<std::uint32_t>{1}));
}

}  // namespace
}  // namespace rink::physics::test
