// The stage `psense` by brute force from the paper's definition: near nodes in the vision range,
// and the nearest node beyond in each of eight sectors.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "im/expression_fault.h"
#include "tests/im/cases.h"
#include "tests/im/published/whole_play.h"
#include "tests/im/stage_counts.h"

namespace rink::im {
namespace {

bool is_near(const Region& s, const Offset& offset, double vision) {
  const double range = vision * (std::min(s.high_x - s.low_x, s.high_y - s.low_y) / 2.0);
  return offset.squared() <= range * range;
}

/// On or left of the sector's first edge and right of its second.
bool is_in_sector(int sector, const Offset& offset) {
  constexpr std::array<std::array<int, 2>, 8> edges{
      {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
  const auto wide = [](double number) {  // beyond all finite ones where doubles are infinite
    constexpr long double most = std::numeric_limits<double>::max();
    return std::isinf(number) ? std::copysign(2.0L * most, number + 0.0L) : number + 0.0L;
  };
  const auto left_of = [&](const std::array<int, 2>& edge) {
    return static_cast<long double>(edge[0]) * wide(offset.y) -
           static_cast<long double>(edge[1]) * wide(offset.x);
  };
  const auto first = static_cast<std::size_t>(sector);
  return left_of(edges[first]) >= 0.0L && left_of(edges[(first + 1) % 8]) < 0.0L;
}

/// What the paper says of one pair, given all entities that `inner` lets through: each sector's
/// sensor is looked for among all of them.
bool is_near_or_sensor(const Judged& judged, const Relevant& inner, double vision,
                       const Observer& me, const Body& its) {
  if (!inner(me, its)) return false;
  const Offset own = offset_of(me, its);
  if (is_near(me, own, vision)) return true;
  for (int sector = 0; sector < 8; ++sector) {
    if (!is_in_sector(sector, own)) continue;
    for (const auto& [_, other] : judged.entities()) {
      if (&other == &its) {
        // Those after this one have larger ids, and must be nearer to take its place.
        for (auto later = judged.entities().rbegin(); &later->second != &its; ++later) {
          const Offset away = offset_of(me, later->second);
          if (inner(me, later->second) && !is_near(me, away, vision) &&
              is_in_sector(sector, away) && away.squared() < own.squared())
            return false;
        }
        return true;
      }
      const Offset away = offset_of(me, other);
      if (inner(me, other) && !is_near(me, away, vision) && is_in_sector(sector, away) &&
          away.squared() <= own.squared())
        return false;
    }
  }
  ADD_FAILURE() << "in no sector: " << own.x << ", " << own.y;
  return false;
}

void expect_near_and_sensors(const std::string& inner, double vision, const Span& seeds) {
  play_whole(inner + " with psense(vision=" + std::to_string(vision) + ")", seeds,
             [&](const FilterSettings& settings) {
               return [rule = rule_of(inner, settings), vision](
                          const Judged& judged, const Observer& me, const Body& its) {
                 return is_near_or_sensor(judged, rule, vision, me, its);
               };
             });
}

TEST(PSense, KeepsTheNearAndTheSensorNodesOfThePaper) {
  expect_near_and_sensors("none", 1.0, {1, 4, 12});
  expect_near_and_sensors("none", 0.25, {11, 4, 12});
  expect_near_and_sensors("region", 0.5, {21, 8, 12});
  expect_near_and_sensors("aura", 0.75, {31, 4, 12});
  expect_near_and_sensors("sight", 0.5, {41, 2, 12});
}

TEST(PSenseLong, KeepsTheNearAndTheSensorNodesOverManySeeds) {
  expect_near_and_sensors("none", 1.0, {1000, 20, 18});
  expect_near_and_sensors("region", 0.5, {2000, 100, 18});
}

/// A vision range of 2 around (0, 0).
std::unique_ptr<Filter> at_origin() {
  auto filter = make_filter("none with psense", hundred);
  filter->set_subscription_region(0, {-2.0, -2.0, 2.0, 2.0});
  return filter;
}

TEST(PSense, GivesASectorItsFirstEdgeAndTheNextOneItsSecond) {
  // Two on each edge, then one between edges and farther off, which nobody needs.
  constexpr std::array<Heading, 8> edges{{{1.0, 0.0},
                                          {1.0, 1.0},
                                          {0.0, 1.0},
                                          {-1.0, 1.0},
                                          {-1.0, 0.0},
                                          {-1.0, -1.0},
                                          {0.0, -1.0},
                                          {1.0, -1.0}}};
  const auto filter = at_origin();
  for (Entity k = 0; k < 8; ++k) {
    const Heading &edge = edges[k], &next = edges[(k + 1) % 8];
    filter->set_update_region(k, point(4.0 * edge.x, 4.0 * edge.y));
    filter->set_update_region(8 + k, point(3.0 * edge.x, 3.0 * edge.y));
    filter->set_update_region(16 + k, point(2.0 * (edge.x + next.x), 2.0 * (edge.y + next.y)));
  }
  EXPECT_EQ(told(*filter), (std::set<Entity>{8, 9, 10, 11, 12, 13, 14, 15}));
  EXPECT_EQ(count(*filter, "sensor nodes chosen"), 8u);
  EXPECT_EQ(count(*filter, "entities left out"), 16u);
}

TEST(PSense, ClosesTheVisionRangeAndTakesTheSmallerIdOfTwoEquallyNear) {
  const auto filter = at_origin();
  filter->set_update_region(0, point(0.0, 0.0));  // where the subscriber is, and nobody's sensor
  filter->set_update_region(1, point(2.0, 0.0));  // on the rim
  filter->set_update_region(2, point(std::nextafter(2.0, 3.0), 0.0));  // a sensor
  filter->set_update_region(5, point(-4.0, 3.0));
  filter->set_update_region(4, point(-4.0, 3.0));
  filter->set_update_region(6, point(4.0, -3.0));
  filter->set_update_region(7, point(3.0, -4.0));  // in another sector
  EXPECT_EQ(told(*filter), (std::set<Entity>{0, 1, 2, 4, 6, 7}));
}

TEST(PSense, ReplacesASensorThatGoesOrComesNear) {
  const auto filter = at_origin();
  filter->set_update_region(0, point(5.0, 1.0));
  filter->set_update_region(1, point(6.0, 1.0));
  filter->set_update_region(2, point(7.0, 1.0));
  EXPECT_EQ(told(*filter), std::set<Entity>{0});
  filter->set_update_region(0, point(1.0, 1.0));
  EXPECT_EQ(told(*filter), std::set<Entity>{1}) << "0 is near now, and stays";
  filter->remove_entity(1);
  EXPECT_EQ(told(*filter), std::set<Entity>{2});
  filter->set_update_region(1, point(6.5, 1.0));
  EXPECT_EQ(match(*filter),
            (std::vector<Change>{{0, 1, Transition::entered}, {0, 2, Transition::left}}));
}

TEST(PSense, IsQuietWithoutSubscribersOrEntities) {
  const auto filter = make_filter("none with psense", hundred);
  EXPECT_TRUE(filter->match().empty());
  filter->set_update_region(3, point(1.0, 1.0));
  EXPECT_TRUE(filter->match().empty());
  filter->set_subscription_region(7, point(5.0, 5.0));
  EXPECT_EQ(told(*filter), std::set<Entity>{3}) << "a point sees none, and senses one";
  filter->remove_entity(3);
  filter->remove_subscriber(7);
  EXPECT_TRUE(filter->match().empty());
}

TEST(PSense, TestsNobodyAtRestAndOnlyTheListsOfWhoMoved) {
  const auto filter = make_filter("region with psense(vision=0.5)", hundred);
  for (std::uint32_t k = 0; k < 100; ++k) {
    const double x = 10.0 * (k % 10), y = 10.0 * (k / 10);
    filter->set_update_region(k, point(x, y));
    filter->set_subscription_region(k, around(x, y, 11.0));
  }
  filter->match();
  const std::uint64_t tested = filter->counters().pairs_tested;
  EXPECT_TRUE(filter->match().empty());
  EXPECT_EQ(filter->counters().pairs_tested, tested);
  filter->set_update_region(55, point(50.5, 50.0));
  filter->match();
  // Nine subscribers have it in their list, each of nine; the engine tests a few more.
  EXPECT_LE(filter->counters().pairs_tested - tested, 81u + 100u);
}

TEST(PSense, IsRefusedWithTheFaultNamed) {
  const auto objection = [](const std::string& text) {
    return complaint_about(text, {}).value_or("");
  };
  EXPECT_EQ(objection("region with psense"), "");
  EXPECT_EQ(objection("region with hysteresis(margin=1) with psense with tiers(at=0.5)"), "");
  EXPECT_EQ(objection("region with swept(horizon=1) with psense"),
            "psense cannot follow swept: of an entity in flight it would take where the flight "
            "began");
  EXPECT_EQ(objection("region with psense(vision=0)"),
            "psense: vision = 0 is not a number from 0.000001 to 1");
  EXPECT_EQ(objection("region with psense(vision=1.5)"),
            "psense: vision = 1.5 is not a number from 0.000001 to 1");
  EXPECT_EQ(objection("region with psense(vision=0.5 vision=0.5)"),
            "psense: vision is given twice");
  EXPECT_EQ(objection("region with psense(k=3)"), "psense has no parameter k; it has vision");
  EXPECT_EQ(objection("region with psense by 'x'"), "psense takes no score: only top does");
  EXPECT_EQ(objection("region with psense with swept(horizon=1)"),
            "swept cannot follow psense: which are first anywhere on the way is not known");
  EXPECT_FALSE(fault_in_momentary("none with psense")) << "it remembers nothing";
}

}  // namespace
}  // namespace rink::im
