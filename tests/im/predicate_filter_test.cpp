// The short path to a scheme: predicates of a few lines, each a whole filter that agrees with brute
// force and with closed forms.
#include "im/schemes/predicate_filter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/im/cases.h"
#include "tests/im/long_play.h"

namespace rink::im {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// Who is in the right half of my region matters to me.
bool is_in_my_right_half(const Party& me, const Party& entity) {
  const double middle = 0.5 * me.region.low_x + 0.5 * me.region.high_x;
  return entity.region.low_x >= middle;
}

std::unique_ptr<Filter> make_right_half_filter(const FilterSettings& settings) {
  return make_predicate_filter(settings, &is_in_my_right_half);
}

bool overlaps_right_half(const Region& s, const Region& u) {
  const bool is_apart =
      u.high_x < s.low_x || s.high_x < u.low_x || u.high_y < s.low_y || s.high_y < u.low_y;
  return !is_apart && !(u.low_x < 0.5 * s.low_x + 0.5 * s.high_x);
}

TEST(PredicateFilter, MakesASchemeOfThreeLinesThatReplaysToTheRecount) {
  for (std::uint64_t seed = 1; seed <= 40 && !testing::Test::HasFatalFailure(); ++seed)
    play(seed, 24,
         [&] { return Judged(make_right_half_filter(settings_for(seed)), overlaps_right_half); });
}

TEST(PredicateFilter, SeesChangesWhileTheBoxesGoOnOverlapping) {
  const auto filter = make_right_half_filter({.world = {0.0, 0.0, 10.0, 10.0}});
  const auto put = [&](double x) { filter->set_update_region(3, {x, 5.0, x, 5.0}); };
  const auto match = [&] {
    const auto changes = filter->match();
    return std::vector<Change>(changes.begin(), changes.end());
  };
  filter->set_subscription_region(0, {2.0, 2.0, 8.0, 8.0});
  put(4.0);
  EXPECT_THAT(match(), IsEmpty());
  put(5.0);
  EXPECT_THAT(match(), ElementsAre(Change{0, 3, Transition::entered}));
  put(4.0), put(6.0);
  EXPECT_THAT(match(), IsEmpty()) << "net";
  filter->set_subscription_region(0, {4.0, 2.0, 10.0, 8.0});
  EXPECT_THAT(match(), ElementsAre(Change{0, 3, Transition::left})) << "the other one moved";
  EXPECT_EQ(filter->counters().changes, 2u);
}

TEST(PredicateFilter, AsksAboutNobodyWhoRests) {
  std::uint64_t asked = 0;
  const auto filter =
      make_predicate_filter({.world = {0.0, 0.0, 100.0, 100.0}},
                            [&asked](const Party&, const Party&) { return ++asked > 0; });
  for (std::uint32_t id = 0; id < 100; ++id) {
    filter->set_subscription_region(id, {0.0, 0.0, 50.0, 50.0});
    filter->set_update_region(id, {0.5 * id, 1.0, 0.5 * id, 1.0});
  }
  EXPECT_EQ(filter->match().size(), 10'000u);
  asked = 0;
  const std::uint64_t tested = filter->counters().pairs_tested;
  EXPECT_TRUE(filter->match().empty());
  EXPECT_EQ(filter->counters().pairs_tested, tested);
  filter->set_update_region(7, {7.0, 2.0, 7.0, 2.0});
  filter->match();
  EXPECT_EQ(asked, 100u) << "its own pairs";
}

/// Where all move a little, most pairs are clear of where their answer changes, and are not asked
/// again until they could be there.
TEST(PredicateFilter, AsksOnlyAboutThoseWhoCouldHaveChangedTheirAnswer) {
  const auto asked_per_tick = [](const std::string& scheme) {
    const auto filter = make_filter(scheme, {.world = {0.0, 0.0, 100.0, 100.0},
                                             .cell_size = 3.0,
                                             .posts = {{30.0, 30.0, 2.0}, {70.0, 60.0, 2.0}}});
    Random random(4);
    std::vector<Region> entities;
    for (Entity i = 0; i < 2'000; ++i) {
      const double x = between(random, 0.0, 100.0);
      entities.push_back(around(x, between(random, 0.0, 100.0), 0.1));
    }
    std::uint64_t before = 0;
    constexpr int ticks = 20;
    for (int tick = 0; tick <= ticks; ++tick) {
      const double step = 0.01 * tick;
      for (Entity i = 0; i < entities.size(); ++i)
        filter->set_update_region(i, {entities[i].low_x + step, entities[i].low_y - step,
                                      entities[i].high_x + step, entities[i].high_y - step});
      for (Subscriber i = 0; i < 50; ++i)
        filter->set_subscription_region(i, around(20.0 + 1.2 * i - step, 50.0 + step, 15.0));
      filter->match();
      if (tick == 0) before = filter->counters().pairs_tested;
    }
    return static_cast<double>(filter->counters().pairs_tested - before) / ticks;
  };
  // 50 squares of 900 square metres hold 9,000 of these points.
  const double engine = asked_per_tick("region");
  for (const char* scheme : {"hybrid", "hex", "diamond", "nimbus", "cone", "sight", "pvs", "tiles"})
    EXPECT_LT(asked_per_tick(scheme) - engine, 1'800.0) << scheme;
}

TEST(PredicateFilter, KnowsWhoIsAsking) {
  const auto filter = make_predicate_filter({}, [](const Party& subscriber, const Party& entity) {
    return subscriber.id % 2 == entity.id % 2;
  });
  for (std::uint32_t id = 0; id < 2; ++id)
    filter->set_subscription_region(id, {}), filter->set_update_region(id, {});
  const auto changes = filter->match();
  EXPECT_THAT(std::vector<Change>(changes.begin(), changes.end()),
              ElementsAre(Change{0, 0, Transition::entered}, Change{1, 1, Transition::entered}));
}

/// Uniform points and squares of half side `reach` away from the borders: told to a filter, and
/// what it let through counted.
class UniformPoints {
 public:
  static constexpr double reach = 10.0;

  UniformPoints() {
    Random random(11);
    for (Place& place : entities_)
      place = {between(random, 0.0, 100.0), 0.0}, place.y = between(random, 0.0, 100.0);
    for (Place& place : subscribers_)
      place = {between(random, 25.0, 75.0), 0.0}, place.y = between(random, 25.0, 75.0);
  }

  std::span<const Change> match(Filter& filter) const {
    for (Entity i = 0; i < entities_.size(); ++i)
      filter.set_update_region(i, around(entities_[i].x, entities_[i].y, 0.0));
    for (Subscriber i = 0; i < subscribers_.size(); ++i)
      filter.set_subscription_region(i, around(subscribers_[i].x, subscribers_[i].y, reach));
    return filter.match();
  }
  /// The share of what was let through that is within reach of its subscriber.
  double precision(Filter& filter) const {
    double sent = 0.0, wanted = 0.0;
    for (const Change& change : match(filter)) {
      const Place &s = subscribers_[change.subscriber], &e = entities_[change.entity];
      ++sent;
      wanted += std::hypot(e.x - s.x, e.y - s.y) <= reach ? 1.0 : 0.0;
    }
    return wanted / sent;
  }

 private:
  struct Place {
    double x, y;
  };
  std::vector<Place> entities_{20'000}, subscribers_{400};
};

TEST(AuraScheme, HasAQuarterOfPiOfWhatTheSquareAroundItHas) {
  const UniformPoints points;
  const auto aura = make_filter("aura", hundred), region = make_filter("region", hundred);
  const double in_disc = static_cast<double>(points.match(*aura).size()),
               in_square = static_cast<double>(points.match(*region).size());
  EXPECT_NEAR(in_disc / in_square / (std::numbers::pi / 4.0), 1.0, 0.01);
  EXPECT_EQ(points.precision(*make_filter("aura", hundred)), 1.0);
}

TEST(AuraScheme, IsClosedToTheLastBitAndMeasuresFromTheNearestPoint) {
  const auto filter = make_filter("aura", hundred);
  filter->set_subscription_region(0, {0.0, 0.0, 10.0, 10.0});
  filter->set_update_region(0, {8.0, 9.0, 8.0, 9.0});  // 3, 4, 5
  filter->set_update_region(1, {8.0, std::nextafter(9.0, 10.0), 8.0, 10.0});
  filter->set_update_region(2, {10.0, 5.0, 12.0, 5.0});
  filter->set_update_region(3, {std::nextafter(10.0, 11.0), 5.0, 12.0, 5.0});
  filter->set_update_region(4, {8.0, 9.0, 20.0, 20.0});
  filter->set_update_region(5, {9.0, 9.0, 10.0, 10.0});  // in the corner of the square
  const auto changes = filter->match();
  std::vector<Entity> entered;
  for (const Change& change : changes) entered.push_back(change.entity);
  EXPECT_THAT(entered, ElementsAre(0, 2, 4));
}

/// A sample of the longer path: maps entities to their cells first, so that a move within a cell is
/// none.
class CellsInDisc final : public PredicateFilter<bool (*)(const Party&, const Party&)> {
 public:
  explicit CellsInDisc(double cell)
      : PredicateFilter(
            hundred.world,
            [](const Party& s, const Party& e) { return disc_touches(s.region, e.region); }),
        cell_(cell) {}
  void set_update_region(Entity entity, const Region& region) override {
    const double x = std::floor(region.low_x / cell_) * cell_,
                 y = std::floor(region.low_y / cell_) * cell_;
    PredicateFilter::set_update_region(entity, {x, y, x + cell_, y + cell_});
  }

 private:
  double cell_;
};

TEST(Precision, OfCellsThatACircleTouchesFollowsTheirSide) {
  const UniformPoints points;
  for (const double k : {0.25, 0.5, 1.0}) {
    CellsInDisc filter(k * UniformPoints::reach);
    EXPECT_NEAR(
        points.precision(filter) / (std::numbers::pi / (std::numbers::pi + 4.0 * k + k * k)), 1.0,
        0.03)
        << "cells of " << k << " R";
  }
}

}  // namespace
}  // namespace rink::im
