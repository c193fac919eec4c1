// The scheme `tiles`: distances in steps round posts against closed forms and against ways that
// are walked at random.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "tests/im/cases.h"
#include "tests/im/layouts.h"

namespace rink::im {
namespace {

/// The fewest steps from the tile of 1 m at (0, 0) to the one at (column, row), up to `most`; more
/// than that if none lead there.
int steps_to(int column, int row, std::vector<Disc> posts, double side = 1.0, int most = 20) {
  for (Disc& post : posts) post = {post.x / side, post.y / side, post.radius / side};
  for (int steps = 0; steps <= most; ++steps) {
    const auto filter = make_filter("tiles(cell_size=1 steps=" + std::to_string(steps) + ")",
                                    {.world = world, .posts = posts});
    filter->set_subscription_region(0, around(0.5, 0.5, 50.0));
    filter->set_update_region(0, point(0.5 + column, 0.5 + row));
    if (!filter->match().empty()) return steps;
  }
  return most + 1;
}

TEST(Tiles, AreAsFarApartAsTheirColumnsAndRowsWhereNoPostIs) {
  for (const int column : {-3, 0, 1, 5})
    for (const int row : {-2, 0, 4}) {
      EXPECT_EQ(steps_to(column, row, {}), std::abs(column) + std::abs(row));
      EXPECT_EQ(steps_to(column, row, {{2.0, 1.0, 0.5}}), std::abs(column) + std::abs(row))
          << "a post no wider than a side covers none";
    }
}

TEST(Tiles, AreLeftOverSidesThatNoPostCoversWhole) {
  // The right side of the first tile reaches from (1, 0) to (1, 1).
  EXPECT_EQ(steps_to(1, 0, {{1.0, 0.5, 0.5}}), 1) << "its ends are on the rim";
  EXPECT_EQ(steps_to(1, 0, {{1.0, 0.5, 0.501}}), 3) << "above or below it";
  EXPECT_EQ(steps_to(1, 0, {{1.0, 0.75, 0.6}}), 1) << "free at its low end";
  EXPECT_EQ(steps_to(1, 0, {{1.0, 0.25, 0.3}, {1.0, 0.75, 0.3}}), 1)
      << "two that cover it together leave it open, as they do for sight";
  EXPECT_EQ(steps_to(1, 0, {{1.0, 0.5, 1.6}}), 21) << "all sides of the first tile are covered";
  EXPECT_EQ(steps_to(0, 0, {{0.5, 0.5, 5.0}}), 0) << "who shares a tile is always near";
  EXPECT_EQ(steps_to(6, 0, {{3.5, 0.5, 1.6}}), 6 + 2 * 2) << "over the second row";
}

/// Corners in doubles may lie closer together than a cell is wide.
TEST(Tiles, AreClosedByAPostWhoseDiameterIsASideIfItHoldsBothCorners) {
  const double low = 0.1, size = 0.7, from = low + 15.0 * size, to = low + 16.0 * size;
  const Disc post{(from + to) / 2.0, low + 7.0 * size, 0.35};
  ASSERT_TRUE(post.x - from < post.radius && to - post.x < post.radius) << "the doubles' luck";
  const auto filter = make_filter(
      "tiles(steps=1)",
      {.world = {low, low, low + 30.0, low + 30.0}, .cell_size = size, .posts = {post}});
  filter->set_subscription_region(0, around(post.x, post.y - 0.3, 5.0));
  filter->set_update_region(0, point(post.x, post.y + 0.3));
  EXPECT_TRUE(filter->match().empty());
}

/// Whoever walks between the posts crosses sides that none covers whole, so that no way is shorter
/// than the distance.
TEST(Tiles, AreNoFartherThanAnyWayBetweenPosts) {
  int shortest = 0, longer = 0, walks = 0;
  for (std::uint64_t seed = 1; seed <= 1500; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    std::vector<Disc> posts;
    for (int i = 0; i < 14; ++i)
      posts.push_back(
          {between(random, -2.5, 3.0), between(random, -2.5, 3.0), between(random, 0.2, 0.7)});
    const auto is_free = [&](double x, double y, double to_x, double to_y) {
      return std::none_of(posts.begin(), posts.end(), [&](const Disc& post) {
        const double way_x = to_x - x, way_y = to_y - y;
        const double part = std::clamp(
            ((post.x - x) * way_x + (post.y - y) * way_y) / (way_x * way_x + way_y * way_y), 0.0,
            1.0);
        return std::hypot(x + part * way_x - post.x, y + part * way_y - post.y) < post.radius;
      });
    };
    constexpr double side = 0.25;
    double x = 0.1, y = 0.1, heading = between(random, 0.0, 6.3);
    if (!is_free(x, y, x + 1e-9, y)) continue;
    int crossed = 0;
    for (int i = 0; i < 400 && crossed < 20; ++i) {
      heading += between(random, -0.4, 0.4);
      const double to_x = x + 0.03 * std::cos(heading), to_y = y + 0.03 * std::sin(heading);
      if (!is_free(x, y, to_x, to_y)) {
        heading += 2.0;
        continue;
      }
      crossed += static_cast<int>(std::abs(std::floor(to_x / side) - std::floor(x / side)) +
                                  std::abs(std::floor(to_y / side) - std::floor(y / side)));
      x = to_x, y = to_y;
    }
    const int column = static_cast<int>(std::floor(x / side)),
              row = static_cast<int>(std::floor(y / side)),
              steps = steps_to(column, row, posts, side, 24);
    EXPECT_LE(steps, crossed);
    ++walks, shortest += steps == crossed,
        longer += steps > std::abs(column) + std::abs(row) ? 1 : 0;
  }
  EXPECT_GT(walks, 100);
  EXPECT_GT(shortest, 5) << "or the distances could be too short";
  EXPECT_GT(longer, 5) << "or no post was in a way";
}

TEST(Tiles, AreRefusedWithTheFaultNamed) {
  EXPECT_EQ(complaint_about("tiles(cell_size=0)", {}).value_or(""),
            "tiles: cell_size = 0 is not a number from 0.001 to 1000000");
  EXPECT_EQ(complaint_about("tiles(steps=1.5)", {}).value_or(""),
            "tiles: steps = 1.5 is not a whole number from 0 to 64");
  EXPECT_EQ(complaint_about("tiles", {.tile_steps = 65}).value_or(""),
            "the steps between tiles are not a number from 0 to 64");
  EXPECT_TRUE(takes_cell_size("tiles"));
  EXPECT_EQ(make_filter("tiles(cell_size=0.25)", {})->cell_size(), 0.25);
}

}  // namespace
}  // namespace rink::im
