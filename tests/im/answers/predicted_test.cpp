// Answers that a reader of docs/im.md can work out alone: where hexagons lie, how borders round,
// the eye on a rim, and the match of entry in `dwell`. Written from the page, not from the schemes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "im/filter.h"
#include "tests/im/layouts.h"

namespace rink::im {
namespace {

bool is_relevant(const std::string& expression, const FilterSettings& settings,
                 const Region& subscription, const Region& update) {
  const auto filter = make_filter(expression, settings);
  filter->set_subscription_region(0, subscription);
  filter->set_update_region(0, update);
  return !filter->match().empty();
}

/// "One's middle on o; rows lie 3h/4 apart, every other c/2 to the right. A point is in that of the
/// nearest middle: of equals the even row's, then the right one."
bool page_says_hexagon_touches(double c, double o_x, double o_y, const Region& s, double x,
                               double y) {
  const double h = 2.0 * c / std::sqrt(3.0);
  double nearest = std::numeric_limits<double>::infinity(), middle_x = 0.0, middle_y = 0.0;
  for (const int parity : {0, 1})  // even rows first, each from right to left
    for (int row = -40; row <= 40; ++row)
      for (int k = 40; k >= -40; --k) {
        if ((row & 1) != parity) continue;
        const double at_x = o_x + (k + (parity == 1 ? 0.5 : 0.0)) * c, at_y = o_y + row * 0.75 * h;
        const double away = (x - at_x) * (x - at_x) + (y - at_y) * (y - at_y);
        if (away < nearest) nearest = away, middle_x = at_x, middle_y = at_y;
      }
  const auto gap = [](double middle, double low, double high) {
    return std::max(low - middle, middle - high);
  };
  const double across = gap(middle_x, s.low_x, s.high_x), up = gap(middle_y, s.low_y, s.high_y);
  return across <= c / 2.0 && up <= h / 2.0 && across + std::sqrt(3.0) * up <= c;
}

TEST(Predicted, HexagonsLieWhereThePageSays) {
  Random random(3);
  int touching = 0;
  for (int i = 0; i < 1500; ++i) {
    // Every other case lies on quarters along x, where borders are exact.
    const double x = i % 2 == 0 ? between(random, -6.0, 6.0)
                                : std::round(4.0 * between(random, -6.0, 6.0)) / 4.0,
                 y = between(random, -6.0, 6.0);
    const Region s = around(x + between(random, -1.5, 1.5), y + between(random, -1.5, 1.5),
                            between(random, 0.0, 1.0));
    const bool expected = page_says_hexagon_touches(1.0, 0.25, -0.5, s, x, y);
    touching += expected ? 1 : 0;
    ASSERT_EQ(is_relevant("hex(cell_size=1)", {.world = {0.25, -0.5, 8.0, 8.0}}, s, {x, y, x, y}),
              expected)
        << "point " << x << ", " << y << " of case " << i;
  }
  EXPECT_GT(touching, 300);
  EXPECT_LT(touching, 1300);
}

/// "x is in column floor((x - o)/c), in doubles. A subscription touches the columns of its edges
/// and between", so a border belongs to the cell above it where the quotient comes out whole.
TEST(Predicted, BordersRoundAsTheQuotientDoes) {
  const double o = 0.3, c = 0.1;
  int unlike_products = 0;
  for (int k = 0; k < 200; ++k) {
    const double border = o + k * c;
    for (const double x : {std::nextafter(border, 0.0), border, std::nextafter(border, 100.0)}) {
      const double column = std::floor((x - o) / c);
      unlike_products += column != std::floor(k + (x < border ? -0.5 : 0.0)) ? 1 : 0;
      for (const double edge : {border, std::nextafter(border, 0.0)}) {
        const bool expected =
            std::floor((edge - 1.0 - o) / c) <= column && column <= std::floor((edge - o) / c);
        for (const char* scheme : {"grid(cell_size=0.1)", "strips(cell_size=0.1)"})
          ASSERT_EQ(is_relevant(scheme, {.world = {o, o, 30.0, 30.0}}, {edge - 1.0, 1.0, edge, 2.0},
                                {x, 1.5, x, 1.5}),
                    expected)
              << scheme << " at border " << k;
      }
    }
  }
  EXPECT_GT(unlike_products, 10) << "the rounding that the page tells of never mattered";
}

/// "A way that only touches the post is free, so an eye on its rim sees all but what lies behind
/// it; a post that the eye is in hides nothing."
TEST(Predicted, AnEyeOnARimSeesAllButWhatIsBehindThePost) {
  const FilterSettings settings{.world = {-10.0, -10.0, 10.0, 10.0}, .posts = {{0.0, 0.0, 1.0}}};
  const auto sees = [&settings](double eye_x, double x, double y) {
    return is_relevant("sight", settings, around(eye_x, 0.0, 8.0), {x, y, x, y});
  };
  EXPECT_TRUE(sees(1.0, 3.0, 0.0)) << "away from the post";
  EXPECT_TRUE(sees(1.0, 1.0, 5.0)) << "along the tangent";
  EXPECT_FALSE(sees(1.0, 1.0 - 1e-9, 5.0)) << "within the tangent";
  EXPECT_FALSE(sees(1.0, -3.0, 0.0)) << "behind";
  EXPECT_FALSE(sees(1.0, -1.0, 0.0)) << "the far rim";
  EXPECT_FALSE(sees(1.0, 0.0, 0.0)) << "the post's own middle";
  EXPECT_TRUE(sees(1.0, 1.0, 0.0)) << "the eye itself";
  EXPECT_TRUE(sees(1.0 - 1e-9, -3.0, 0.0)) << "from inside";
  EXPECT_FALSE(sees(1.0 + 1e-9, -3.0, 0.0)) << "from outside";
}

/// "A pair that enters at match m leaves at match m + `matches` or later."
TEST(Predicted, DwellCountsFromTheMatchOfEntry) {
  for (int matches = 1; matches <= 5; ++matches)
    for (int away_at = 2; away_at <= 8; ++away_at) {
      const auto filter = make_filter("region with dwell(matches=" + std::to_string(matches) + ")",
                                      {.world = {0.0, 0.0, 10.0, 10.0}});
      filter->set_subscription_region(0, {0.0, 0.0, 1.0, 1.0});
      filter->set_update_region(0, {0.5, 0.5, 0.5, 0.5});
      int left_at = 0;
      for (int match = 1; match <= 16; ++match) {
        if (match == away_at) filter->set_update_region(0, {5.0, 5.0, 5.0, 5.0});
        for (const Change& change : filter->match())
          if (change.transition == Transition::left) left_at = match;
      }
      EXPECT_EQ(left_at, std::max(away_at, 1 + matches)) << matches << ", away at " << away_at;
    }
}

}  // namespace
}  // namespace rink::im
