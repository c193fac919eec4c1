// Cells as partitions: each body has one, and a region's cells hold every body within it.
#include "loadgen/dds/partition_grid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "game/model/random_stream.h"

namespace rink::loadgen {
namespace {

constexpr im::Region field{-10.0, -5.0, 10.0, 5.0};

TEST(PartitionGrid, HoldsEveryBodyOfARegionInTheCellsOfTheRegion) {
  game::RandomStream random(5, 1);
  const auto within = [&](double low, double high) {
    return low + (high - low) * random.uniform();
  };
  for (const double size : {0.3, 1.0, 2.5, 7.0, 100.0}) {
    const PartitionGrid grid(field, size);
    for (int trial = 0; trial < 2000; ++trial) {
      const double x = within(-12.0, 12.0), y = within(-7.0, 7.0);
      const im::Region region{x, y, x + within(0.0, 5.0), y + within(0.0, 5.0)};
      const physics::Vector2 place(within(region.low_x, region.high_x),
                                   within(region.low_y, region.high_y));
      const auto cells = grid.cells_of(region);
      ASSERT_TRUE(std::ranges::binary_search(cells, grid.cell_at(place)))
          << "cells of " << size << " m, trial " << trial;
      ASSERT_LT(cells.back(), grid.size());
    }
  }
}

TEST(PartitionGrid, CoversTheFieldByCellsOfTheSizeAndNamesEachOnce) {
  const PartitionGrid grid(field, 2.5);
  EXPECT_EQ(grid.size(), 8u * 4u);
  EXPECT_EQ(grid.cell_at({-10.0, -5.0}), 0u);
  EXPECT_EQ(grid.cell_at({-7.4, -5.0}), 1u);
  EXPECT_EQ(grid.cell_at({10.0, 5.0}), 31u) << "its edge belongs to the last cell";
  std::set<std::string> names;
  for (std::uint32_t cell = 0; cell < grid.size(); ++cell) names.insert(grid.name_of(cell));
  EXPECT_EQ(names.size(), grid.size());
  EXPECT_EQ(names.count(""), 0u);
}

TEST(PartitionGrid, WithoutASizeIsOneCellInTheDefaultPartition) {
  const PartitionGrid grid(field, 0.0);
  EXPECT_EQ(grid.size(), 1u);
  EXPECT_EQ(grid.name_of(0), "");
  EXPECT_THAT(grid.cells_of({-1.0, -1.0, 1.0, 1.0}), testing::ElementsAre(0u));
}

}  // namespace
}  // namespace rink::loadgen
