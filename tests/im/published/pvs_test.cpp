// The scheme `pvs`: potentially visible sets of cells against ways drawn at random between them,
// and against what is in sight from places.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/im/cases.h"
#include "tests/im/layouts.h"
#include "tests/im/view_truth.h"

namespace rink::im {
namespace {

/// True if somebody in the middle of the cell (column, row) of 1 m is let through to a subscriber
/// in the middle of the cell at (0, 0), past a post.
bool is_visible(const Disc& post, int column, int row) {
  const auto filter = make_filter("pvs(cell_size=1)", {.world = world, .posts = {post}});
  filter->set_subscription_region(0, around(0.5, 0.5, 50.0));
  filter->set_update_region(0, point(0.5 + column, 0.5 + row));
  return !filter->match().empty();
}

TEST(Pvs, HidesACellOnlyIfAPostCrossesEveryWayToIt) {
  // The outermost ways lie along y = 0 and y = 1.
  EXPECT_FALSE(is_visible({3.0, 0.5, 0.501}, 5, 0));
  EXPECT_TRUE(is_visible({3.0, 0.5, 0.5}, 5, 0)) << "ways along both rims only touch";
  EXPECT_TRUE(is_visible({3.0, 0.75, 0.501}, 5, 0)) << "free below";
  EXPECT_TRUE(is_visible({3.0, 0.5, 0.501}, 5, 1)) << "free above";
  EXPECT_TRUE(is_visible({9.0, 0.5, 2.0}, 5, 0)) << "behind it";
  EXPECT_TRUE(is_visible({0.5, 0.5, 0.6}, 5, 0)) << "the subscriber may stand before the post";
  EXPECT_TRUE(is_visible({0.5, 0.5, 3.0}, 5, 0)) << "who is in a post sees all";
}

/// Of thousands of ways between two cells a free one proves that they see each other, and one is
/// found wherever they do, unless the post reaches into the subscriber's cell.
TEST(Pvs, HoldsWhateverAnybodySeesFromTheCell) {
  int hidden = 0, seen = 0, unproven = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const int column = static_cast<int>(between(random, 2.0, 7.0)),
              row = static_cast<int>(between(random, 0.0, 4.0));
    const double share = between(random, 0.2, 0.8);
    const Disc post{0.5 + share * column + between(random, -0.4, 0.4),
                    0.5 + share * row + between(random, -0.4, 0.4), between(random, 0.4, 1.2)};
    const bool is = is_visible(post, column, row);
    bool is_proven = false;
    for (int i = 0; i < 2'000 && !is_proven; ++i) {
      // Rims see farthest round a post.
      const auto place = [&](double low) {
        const double drawn = between(random, -0.5, 1.5);
        return low + std::min(1.0, std::max(0.0, drawn));
      };
      const double x = place(0.0), y = place(0.0), to_x = place(column), to_y = place(row);
      is_proven = !is_in_shadow(post, point(x, y), to_x, to_y);
    }
    if (is_proven) {
      EXPECT_TRUE(is);
    }
    ++(is ? seen : hidden);
    const bool reaches_in = std::hypot(post.x - std::clamp(post.x, 0.0, 1.0),
                                       post.y - std::clamp(post.y, 0.0, 1.0)) < post.radius;
    unproven += is && !is_proven && !reaches_in ? 1 : 0;
  }
  EXPECT_GT(hidden, 50);
  EXPECT_GT(seen, 100);
  EXPECT_EQ(unproven, 0) << "of " << seen;
}

/// What is in sight from a place is in the set of its cell.
TEST(Pvs, LosesNothingOfSight) {
  Random random(7);
  FilterSettings settings{.world = {0.0, 0.0, side, side}, .cell_size = 0.5};
  for (int i = 0; i < 12; ++i) {
    const double x = between(random, 0.0, side), y = between(random, 0.0, side);
    settings.posts.push_back({x, y, between(random, 0.2, 1.5)});
  }
  const auto both = make_filter("sight and not pvs", settings), pvs = make_filter("pvs", settings),
             region = make_filter("region", settings);
  std::size_t lost = 0, let_through = 0, in_region = 0;
  for (std::uint32_t id = 0; id < 200; ++id) {
    const Region at = draw_random(random, 0.0), view = draw_random(random, 6.0);
    for (const auto* filter : {&both, &pvs, &region}) {
      (*filter)->set_update_region(id, at);
      if (id < 50) (*filter)->set_subscription_region(id, view);
    }
  }
  lost = both->match().size(), let_through = pvs->match().size(),
  in_region = region->match().size();
  EXPECT_EQ(lost, 0u);
  EXPECT_LT(let_through, in_region);
}

TEST(Pvs, IsRefusedWithTheFaultNamed) {
  EXPECT_EQ(complaint_about("pvs(cell_size=0)", {}).value_or(""),
            "pvs: cell_size = 0 is not a number from 0.001 to 1000000");
  EXPECT_TRUE(takes_cell_size("pvs"));
  EXPECT_EQ(make_filter("pvs(cell_size=0.25)", {})->cell_size(), 0.25);
}

}  // namespace
}  // namespace rink::im
