// The scheme `zones` by brute force: the world cut anew from all middles at every match.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/im/cases.h"
#include "tests/im/long_play.h"
#include "tests/im/published/whole_play.h"
#include "tests/im/stage_counts.h"

namespace rink::im {
namespace {

using Point = std::pair<double, double>;

struct CutZone {
  Region bounds;
  bool is_left, is_low, is_right, is_high;  ///< on the world's rim
};

/// The zone of the point `of` among `all`, from the whole world downwards.
CutZone zone_of(const Point& of, std::vector<Point> all, CutZone zone, std::size_t capacity,
                int cuts) {
  if (all.size() <= capacity || cuts == 20) return zone;
  const double x = middle(zone.bounds.low_x, zone.bounds.high_x),
               y = middle(zone.bounds.low_y, zone.bounds.high_y);
  std::erase_if(all, [&](const Point& each) {
    return (each.first < x) != (of.first < x) || (each.second < y) != (of.second < y);
  });
  if (of.first < x) zone.bounds.high_x = x, zone.is_right = false;
  else zone.bounds.low_x = x, zone.is_left = false;
  if (of.second < y) zone.bounds.high_y = y, zone.is_high = false;
  else zone.bounds.low_y = y, zone.is_low = false;
  return zone_of(of, std::move(all), zone, capacity, cuts + 1);
}

bool touches(const Region& s, const CutZone& zone) {
  return (zone.is_right || s.low_x <= zone.bounds.high_x) &&
         (zone.is_left || s.high_x >= zone.bounds.low_x) &&
         (zone.is_high || s.low_y <= zone.bounds.high_y) &&
         (zone.is_low || s.high_y >= zone.bounds.low_y);
}

void play_zones(std::size_t capacity, const Span& seeds) {
  play_whole(
      "zones(capacity=" + std::to_string(capacity) + ")", seeds,
      [capacity](const FilterSettings& settings) {
        return
            [=, whole = settings.world](const Judged& judged, const Observer& me, const Body& its) {
              std::vector<Point> all;
              for (const auto& [entity, body] : judged.entities())
                all.push_back({middle(body.low_x, body.high_x), middle(body.low_y, body.high_y)});
              const Point own{middle(its.low_x, its.high_x), middle(its.low_y, its.high_y)};
              return touches(me, zone_of(own, all, {whole, true, true, true, true}, capacity, 0));
            };
      });
}

TEST(Zones, AreCutWhereItIsCrowdedAndSeenWhereASubscriptionTouchesThem) {
  for (const std::size_t capacity : {std::size_t{1}, std::size_t{3}, std::size_t{16}})
    play_zones(capacity, {.first = 1, .count = 3, .matches = 12});
}

TEST(Zones, AreJoinedAgainWhenTheCrowdHasGone) {
  const auto filter = make_filter("zones(capacity=2)", hundred);
  const auto zones = [&] {
    filter->match();
    return count(*filter, "zones at the end");
  };
  EXPECT_EQ(zones(), 1u);
  for (Entity entity = 0; entity < 3; ++entity)
    filter->set_update_region(entity, point(10.0 + 30.0 * entity, 10.0));
  EXPECT_EQ(zones(), 4u);
  filter->remove_entity(1);
  EXPECT_EQ(zones(), 1u);
  for (Entity entity = 10; entity < 13; ++entity)
    filter->set_update_region(entity, point(7.0, 7.0));
  EXPECT_EQ(zones(), 1u + 3u * 20u) << "all in one point, so that no cut helps";
  for (Entity entity = 10; entity < 13; ++entity) filter->remove_entity(entity);
  EXPECT_EQ(zones(), 1u);
}

TEST(Zones, ShowWhoWaitsWithoutAMoveWhenTheirZoneIsCutOrJoined) {
  const auto filter = make_filter("zones(capacity=1)", hundred);
  filter->set_subscription_region(0, {60.0, 60.0, 70.0, 70.0});
  filter->set_update_region(0, point(10.0, 10.0));
  EXPECT_EQ(match(*filter), (std::vector{Change{0, 0, Transition::entered}}));
  filter->set_update_region(1, point(90.0, 90.0));
  EXPECT_EQ(match(*filter),
            (std::vector{Change{0, 0, Transition::left}, Change{0, 1, Transition::entered}}));
  filter->remove_entity(1);
  EXPECT_EQ(match(*filter), (std::vector{Change{0, 0, Transition::entered}}));
}

TEST(Zones, TestNoPairWhereNobodyChangesZones) {
  const auto filter = make_filter("zones(capacity=4)", hundred);
  for (Entity entity = 0; entity < 60; ++entity)
    filter->set_update_region(entity, point(1.6 * entity + 0.3, (37 * entity) % 100 + 0.3));
  filter->set_subscription_region(0, {20.0, 20.0, 50.0, 50.0});
  filter->match();
  const FilterCounters before = filter->counters();
  for (Entity entity = 0; entity < 60; ++entity)
    filter->set_update_region(entity, point(1.6 * entity + 0.31, (37 * entity) % 100 + 0.31));
  EXPECT_TRUE(match(*filter).empty());
  EXPECT_EQ(filter->counters().pairs_tested, before.pairs_tested);
  EXPECT_EQ(filter->counters().regions_moved, before.regions_moved);
}

TEST(Zones, AreRefusedByNameBeforeSwept) {
  EXPECT_EQ(complaint_about("(zones or team) with swept(horizon=1)", hundred).value_or(""),
            "swept cannot follow zones: which zones there will be on the way is not known");
  EXPECT_EQ(complaint_about("zones(capacity=0)", hundred).value_or(""),
            "zones: capacity = 0 is not a whole number from 1 to 1000000");
}

}  // namespace
}  // namespace rink::im
