// The stage `von` by brute force from the definition of Voronoi regions, in numbers without
// rounding, and by Euler's formula.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "tests/im/cases.h"
#include "tests/im/published/whole_play.h"
#include "tests/im/stage_counts.h"

namespace rink::im {
namespace {

using Whole = boost::multiprecision::cpp_int;

/// A multiple of 2^-260 of at most 2^200, as all are that the stage compares.
Whole whole_of(double number) {
  if (number == 0.0) return 0;
  int exponent = 0;
  const double fraction = std::frexp(number, &exponent);
  return Whole(static_cast<long long>(std::ldexp(fraction, 53))) << (exponent - 53 + 260);
}

/// Differences of quarters, of which four multiplied fit into 64 bits.
bool is_quarter(double number) {
  return std::abs(number) < 0x1p12 && number * 4.0 == std::round(number * 4.0);
}

/// An interval of places on the bisector of subscriber and entity. `above` and `below` bound it by
/// fractions of positive denominators; one of 0 is no bound.
template <class Real>
class Bisector {
 public:
  Bisector(Real x, Real y) : x_(x), y_(y) {}
  /// Keeps what is not nearer to the site (x, y): t with 2 t cross(own, site) <= site (site - own).
  void cut(Real x, Real y) {
    const Real cross = x_ * y - y_ * x, excess = x * (x - x_) + y * (y - y_);
    if (cross == 0) is_empty_ |= excess < 0;
    else if (cross > 0 && (above_below_ == 0 || excess * above_below_ < above_ * cross))
      above_ = excess, above_below_ = cross;
    else if (cross < 0 && (below_below_ == 0 || -excess * below_below_ > below_ * -cross))
      below_ = -excess, below_below_ = -cross;
  }
  bool is_empty() const {
    return is_empty_ || (above_below_ != 0 && below_below_ != 0 &&
                         below_ * above_below_ > above_ * below_below_);
  }

 private:
  Real x_, y_;
  Real above_ = 0, above_below_ = 0, below_ = 0, below_below_ = 0;
  bool is_empty_ = false;
};

/// What the paper says of one pair among all entities that `inner` lets through.
bool is_neighbour(const Judged& judged, const Relevant& inner, double area, const Observer& me,
                  const Body& its) {
  if (!inner(me, its)) return false;
  const auto is_own = [&me](const Body& body) {
    return me.role.owner != Role::none && body.role.owner == me.role.owner;
  };
  const Offset own = offset_of(me, its);
  const double range = area * (std::min(me.high_x - me.low_x, me.high_y - me.low_y) / 2.0);
  if (is_own(its) || own.squared() <= range * range) return true;
  const auto seen = [](const Offset& offset) {
    const auto plain = [](double number) {
      return std::abs(number) < 0x1p-200 ? 0.0 : std::clamp(number, -0x1p200, 0x1p200);
    };
    return Offset{plain(offset.x), plain(offset.y)};
  };
  const auto is_here = [](const Offset& offset) { return offset.x == 0.0 && offset.y == 0.0; };
  const Offset at = seen(own);
  if (is_here(at)) return true;
  std::vector<Offset> others;
  bool are_quarters = is_quarter(at.x) && is_quarter(at.y);
  for (const auto& [_, other] : judged.entities()) {
    const Offset there = seen(offset_of(me, other));
    if (!inner(me, other) || is_own(other) || is_here(there)) continue;
    others.push_back(there);
    are_quarters = are_quarters && is_quarter(there.x) && is_quarter(there.y);
  }
  const auto touches = [&](const auto& as) {
    Bisector bisector(as(at.x), as(at.y));
    for (const Offset& other : others) bisector.cut(as(other.x), as(other.y));
    return !bisector.is_empty();
  };
  if (are_quarters)
    return touches([](double number) { return static_cast<long long>(number * 4.0); });
  return touches(whole_of);
}

void expect_neighbours(const std::string& inner, double area, const Span& seeds) {
  const std::string text = inner + " with von(area=" + std::to_string(area) + ")";
  play_whole(text, seeds, [&](const FilterSettings& settings) {
    return [rule = rule_of(inner, settings), area](const Judged& judged, const Observer& me,
                                                   const Body& its) {
      return is_neighbour(judged, rule, area, me, its);
    };
  });
}

TEST(Von, KeepsTheAreaOfInterestAndTheEnclosingNeighbours) {
  expect_neighbours("none", 0.0, {1, 1, 8});
  expect_neighbours("none", 0.5, {11, 1, 4});
  expect_neighbours("region", 0.25, {21, 3, 12});
  expect_neighbours("aura", 0.5, {31, 2, 12});
}

TEST(VonLong, KeepsThemOverManySeeds) {
  expect_neighbours("none", 0.0, {1000, 4, 18});
  expect_neighbours("region", 0.25, {2000, 25, 18});
}

/// An area of interest of radius 1 around (0, 0), and these at their places.
std::unique_ptr<Filter> around_origin(const std::vector<Heading>& places) {
  auto filter = make_filter("none with von(area=0.5)", hundred);
  filter->set_subscription_region(0, {-2.0, -2.0, 2.0, 2.0});
  for (Entity k = 0; k < places.size(); ++k)
    filter->set_update_region(k, point(places[k].x, places[k].y));
  return filter;
}

TEST(Von, CountsRegionsThatTouchInAPoint) {
  const auto square = around_origin({{4.0, 0.0}, {0.0, 4.0}, {-4.0, 0.0}, {0.0, -4.0}, {4.0, 4.0}});
  EXPECT_EQ(told(*square), (std::set<Entity>{0, 1, 2, 3, 4})) << "all four of a corner are equal";
  EXPECT_EQ(count(*square, "enclosing neighbours beyond the area of interest"), 5u);
  square->set_update_region(4, point(4.0, std::nextafter(4.0, 5.0)));
  EXPECT_EQ(match(*square), (std::vector<Change>{{0, 4, Transition::left}})) << "an ulp beyond";
}

TEST(Von, EndsWhereRegionsHaveNoEnd) {
  EXPECT_EQ(told(*around_origin({{3.0, 0.0}, {5.0, 0.0}, {-4.0, 0.0}, {-7.0, 0.0}})),
            (std::set<Entity>{0, 2}))
      << "in one line, the first on either side";
  EXPECT_EQ(told(*around_origin({{3.0, 3.0}})), std::set<Entity>{0});
  EXPECT_EQ(told(*around_origin({{3.0, 0.0}, {0.0, 3.0}, {3.0, 0.0}, {4.0, 4.0}})),
            (std::set<Entity>{0, 1, 2}))
      << "two at one place are equal, and the hull's corner has neighbours on one side alone";
  EXPECT_TRUE(told(*around_origin({})).empty());
}

TEST(Von, KeepsWhoIsNearOrInTheSamePlaceBehindOthers) {
  EXPECT_EQ(told(*around_origin({{0.25, 0.0}, {0.5, 0.0}, {1.0, 0.0}, {1.5, 0.0}, {0.0, 0.0}})),
            (std::set<Entity>{0, 1, 2, 4}));
}

TEST(Von, LetsNoBodyOfTheSubscribersOwnEnclose) {
  const auto filter = around_origin({{-1.5, 0.0}, {-3.0, 0.0}, {3.0, 0.0}});
  EXPECT_EQ(told(*filter), (std::set<Entity>{0, 2}));
  filter->set_subscriber_role(0, {.owner = 7});
  filter->set_entity_role(0, {.owner = 7});
  EXPECT_EQ(told(*filter), std::set<Entity>{1}) << "its own stays and hides nobody";
}

/// Twice the number of edges of a triangulation of n points of which h are on the hull, 3n - 3 - h.
TEST(Von, HasAsManyNeighboursAsEulerCounts) {
  constexpr std::uint32_t n = 200;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const auto filter = make_filter("none with von(area=0)", hundred);
    std::vector<Heading> places;
    for (std::uint32_t k = 0; k < n; ++k) {
      const double x = between(random, 0.0, 100.0), y = between(random, 0.0, 100.0);
      places.push_back({x, y});
      filter->set_update_region(k, point(x, y));
      filter->set_subscription_region(k, around(x, y, 0.0));
    }
    std::size_t on_hull = 0;
    for (const Heading& a : places)  // some line through it has all on one side
      on_hull += std::any_of(places.begin(), places.end(), [&](const Heading& b) {
        return &a != &b && std::all_of(places.begin(), places.end(), [&](const Heading& c) {
          return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) >= 0.0;
        });
      });
    std::set<std::pair<Subscriber, Entity>> pairs;
    for (const Change& change : match(*filter)) pairs.insert({change.subscriber, change.entity});
    EXPECT_EQ(pairs.size(), n + 2 * (3 * n - 3 - on_hull)) << "and each its own place";
    for (const auto& [one, other] : pairs) EXPECT_TRUE(pairs.contains({other, one}));
  }
}

TEST(Von, TestsNobodyAtRest) {
  const auto filter = around_origin({{3.0, 1.0}, {-3.0, 2.0}, {2.0, -5.0}});
  filter->match();
  const std::uint64_t tested = filter->counters().pairs_tested;
  EXPECT_TRUE(filter->match().empty());
  EXPECT_EQ(filter->counters().pairs_tested, tested);
}

TEST(Von, IsRefusedWithTheFaultNamed) {
  const auto objection = [](const std::string& text) {
    return complaint_about(text, {}).value_or("");
  };
  EXPECT_EQ(objection("none with von"), "");
  EXPECT_EQ(objection("none with von(area=2)"), "von: area = 2 is not a number from 0 to 1");
  EXPECT_EQ(objection("none with von(aoi=1)"), "von has no parameter aoi; it has area");
  EXPECT_EQ(objection("none with von with swept(horizon=1)"),
            "swept cannot follow von: which are first anywhere on the way is not known");
}

}  // namespace
}  // namespace rink::im
