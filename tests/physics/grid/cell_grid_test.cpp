// The cell grid: nobody within reach is ever missed, however crowded the cells are and however
// often bodies move.
#include "game/physics/grid/cell_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "tests/physics/scenes.h"

namespace rink::physics {
namespace {

struct Crowd {
  CellGrid grid;
  std::vector<double> x, y;

  Crowd(std::mt19937_64& random, std::uint32_t count, double length, double width, double reach)
      : Crowd(random, count, {0.0, 0.0, length, width}, reach, 0.0) {}
  /// Bodies lie up to `beyond` outside the ground.
  Crowd(std::mt19937_64& random, std::uint32_t count, const CellGrid::Ground& ground, double reach,
        double beyond) {
    grid.rebuild(ground, reach, count, 0.0);
    grid.resize(count);
    const auto& [low_x, low_y, length, width] = ground;
    for (std::uint32_t body = 0; body < count; ++body) {
      x.push_back(test::uniform(random, low_x - beyond, low_x + length + beyond));
      y.push_back(test::uniform(random, low_y - beyond, low_y + width + beyond));
      grid.insert(body, x[body], y[body]);
    }
  }
  std::vector<std::uint32_t> near(std::uint32_t body) const {
    std::vector<std::uint32_t> list(grid.collected_max());
    list.resize(grid.collect(body, list.data()));
    std::sort(list.begin(), list.end());
    return list;
  }
};

void expect_all_within(const Crowd& crowd, double reach) {
  const auto count = static_cast<std::uint32_t>(crowd.x.size());
  for (std::uint32_t body = 0; body < count; ++body) {
    const std::vector<std::uint32_t> near = crowd.near(body);
    EXPECT_EQ(std::adjacent_find(near.begin(), near.end()), near.end());
    for (std::uint32_t other = 0; other < count; ++other) {
      if (std::max(std::abs(crowd.x[other] - crowd.x[body]),
                   std::abs(crowd.y[other] - crowd.y[body])) > reach)
        continue;
      EXPECT_TRUE(std::binary_search(near.begin(), near.end(), other))
          << body << " and " << other << ", reach " << reach;
    }
  }
}

TEST(CellGrid, ListsOnceEverybodyWithinReach) {
  std::mt19937_64 random(1);
  for (const double reach : {0.01, 0.08, 0.7, 5.0})
    expect_all_within({random, 400, 3.0, 1.0, reach}, reach);
}

TEST(CellGrid, ListsThemBeyondItsGroundAndWhereThatIsLeft) {
  std::mt19937_64 random(4);
  for (const double reach : {0.01, 0.08, 0.7}) {
    const Crowd crowd(random, 400, {50.0, 20.0, 3.0, 1.0}, reach, 0.5);
    expect_all_within(crowd, reach);
    for (std::uint32_t body = 0; body < 400; ++body) {
      const CellGrid::Place place = crowd.grid.place(body);
      EXPECT_LE(crowd.grid.column_edge(place.column, false), crowd.x[body]);
      EXPECT_GE(crowd.grid.column_edge(place.column, true), crowd.x[body]);
      EXPECT_LE(crowd.grid.row_edge(place.row, false), crowd.y[body]);
      EXPECT_GE(crowd.grid.row_edge(place.row, true), crowd.y[body]);
    }
  }
}

TEST(CellGrid, SeesAheadExactlyThoseWhoCameIntoSightByACrossing) {
  std::mt19937_64 random(2);
  Crowd crowd(random, 2'000, 1.0, 1.0, 0.05);
  const std::uint32_t columns = crowd.grid.column(1.0) + 1, rows = crowd.grid.row(1.0) + 1;
  int seen = 0;
  for (int step = 0; step < 20'000; ++step) {
    const auto body = static_cast<std::uint32_t>(random() % 2'000);
    const auto direction = static_cast<CellGrid::Direction>(random() % 4);
    const std::uint32_t column = crowd.grid.place(body).column, row = crowd.grid.place(body).row;
    const bool is_rim[]{column == 0, column + 1 == columns, row == 0, row + 1 == rows};
    if (is_rim[direction]) continue;
    const std::vector<std::uint32_t> before = crowd.near(body);
    crowd.grid.move(body, direction);
    std::vector<std::uint32_t> ahead(crowd.grid.collected_max()), came;
    ahead.resize(crowd.grid.collect_ahead(body, direction, ahead.data()));
    std::sort(ahead.begin(), ahead.end());
    const std::vector<std::uint32_t> after = crowd.near(body);
    std::set_difference(after.begin(), after.end(), before.begin(), before.end(),
                        std::back_inserter(came));
    ASSERT_EQ(ahead, came) << "step " << step;
    seen += static_cast<int>(came.size());
  }
  EXPECT_GT(seen, 10'000);
}

TEST(CellGrid, VisitsEachPairInSightOnce) {
  std::mt19937_64 random(3);
  for (const std::uint32_t count : {1u, 30u, 400u}) {
    const Crowd crowd(random, count, 3.0, 1.0, 0.1);
    std::vector<std::vector<std::uint32_t>> seen(count);
    for (std::uint32_t body = 0; body < count; ++body) seen[body].push_back(body);
    std::vector<std::uint32_t> room(crowd.grid.collected_max());
    crowd.grid.visit_pairs(room.data(),
                           [&](const std::uint32_t* list, std::uint32_t own, std::uint32_t all) {
                             for (std::uint32_t i = 0; i < own; ++i)
                               for (std::uint32_t k = i + 1; k < all; ++k)
                                 seen[list[i]].push_back(list[k]), seen[list[k]].push_back(list[i]);
                           });
    for (std::uint32_t body = 0; body < count; ++body) {
      std::sort(seen[body].begin(), seen[body].end());
      EXPECT_EQ(seen[body], crowd.near(body)) << body << " of " << count;
    }
  }
}

TEST(CellGrid, HoldsAnyNumberInOneCell) {
  CellGrid grid;
  grid.rebuild(1.0, 1.0, 0.9, 1, 0.0);
  grid.resize(1000);
  for (std::uint32_t body = 0; body < 1000; ++body) grid.insert(body, 0.5, 0.5);
  for (std::uint32_t body = 0; body < 1000; body += 2) grid.remove(body);
  std::vector<std::uint32_t> list(grid.collected_max());
  list.resize(grid.collect(1, list.data()));
  std::sort(list.begin(), list.end());
  ASSERT_EQ(list.size(), 500u);
  for (std::uint32_t k = 0; k < 500; ++k) EXPECT_EQ(list[k], 2 * k + 1);
}

}  // namespace
}  // namespace rink::physics
