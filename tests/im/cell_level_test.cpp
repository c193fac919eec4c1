// The cells of a level are numbered without a gap or a number too many, however long and thin a
// world is.
#include <gtest/gtest.h>

#include <array>

#include "im/matching/index/cell_level.h"

namespace rink::im {
namespace {

/// Single precision tells no whole numbers beyond 2^24 apart, and the last column is one of them.
TEST(CellLevel, HasNoBoxBeyondItsLastColumn) {
  constexpr Region world{0.0, 0.0, 1e6, 1.0};
  constexpr std::array boxes{FloatBox{10.0f, 0.0f, 10.1f, 0.1f},
                             FloatBox{20.0f, 0.0f, 20.1f, 0.1f}};
  for (std::uint32_t box_count = 8'388'609; box_count < 8'388'613; ++box_count) {
    SizeLevels sizes;
    for (std::uint32_t i = 0; i < box_count; ++i) sizes.count(0.1f);
    CellLevels levels;
    levels.choose(sizes, boxes, world, {32.0, 6.0, 2.0});
    const CellLevel& level = levels[0];
    ASSERT_EQ(level.y.last, 0);
    ASSERT_GT(level.x.last, 1 << 20);
    ASSERT_LT(level.cell(3e6f, 0.5f), level.cell_count()) << box_count << " boxes";
    ASSERT_EQ(level.x.cell(3e6f), level.x.last);
  }
}

}  // namespace
}  // namespace rink::im
