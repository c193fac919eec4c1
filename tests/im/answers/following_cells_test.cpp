// Cells whose size nobody gave follow the subscriptions, by the rule of docs/im.md ("Cells").
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "im/filter.h"
#include "tests/im/layouts.h"
#include "tests/im/recount.h"

namespace rink::im {
namespace {

constexpr const char* with_cells[] = {"grid", "hex", "hierarchical", "hybrid", "strips"};

/// Written from the page: a fifth of the median side when chosen, kept from a seventh to a third.
double size_after(double size, const std::map<Subscriber, Region>& subscriptions) {
  std::vector<double> sides;
  for (const auto& [id, region] : subscriptions)
    if (const double both = region.high_x - region.low_x + region.high_y - region.low_y; both > 0.0)
      sides.push_back(both / 2.0);
  if (sides.empty()) return size;
  std::sort(sides.begin(), sides.end());
  const double median = sides[(sides.size() - 1) / 2];
  return size < median / 7.0 || size > median / 3.0 ? median / 5.0 : size;
}

/// Subscriptions grow and shrink by turns, ids come and go, and what is relevant must be what the
/// rule says of the cells that the page says.
void play_cells(const std::string& scheme, std::uint64_t seed) {
  SCOPED_TRACE(scheme + " with seed " + std::to_string(seed));
  Random random(seed);
  const Region world{0.0, 0.0, side, side};
  const auto filter = make_filter(scheme, {.world = world});
  double size = filter->cell_size();
  EXPECT_EQ(size, side / 32.0) << "before subscriptions are known";
  std::map<Entity, Region> entities;
  std::map<Subscriber, Region> subscriptions;
  Pairs known;
  int changes_of_size = 0;
  for (int i = 0; i < 30; ++i) {
    const double view = 0.3 * std::exp2(between(random, 0.0, 5.0));
    for (std::uint32_t id = 0; id < 40; ++id) {
      const double x = between(random, 0.0, side), y = between(random, 0.0, side);
      if (between(random, 0.0, 1.0) < 0.6)
        filter->set_update_region(id, entities[id] = around(x, y, between(random, 0.0, 0.4)));
      if (id < 9 && between(random, 0.0, 1.0) < 0.7)
        filter->set_subscription_region(
            id, subscriptions[id] = around(y, x, id == 8 ? 0.0 : view * between(random, 0.4, 0.6)));
      if (between(random, 0.0, 1.0) < 0.04) {
        filter->remove_entity(id), entities.erase(id);
        filter->remove_subscriber(id), subscriptions.erase(id);
        std::erase_if(known,
                      [id](const auto& pair) { return pair.first == id || pair.second == id; });
      }
    }
    const double before = size;
    size = size_after(size, subscriptions);
    changes_of_size += size != before ? 1 : 0;
    for (const Change& change : filter->match()) {
      const std::pair pair{change.subscriber, change.entity};
      if (change.transition == Transition::entered) {
        known.insert(pair);
      } else {
        ASSERT_EQ(known.erase(pair), 1u);
      }
    }
    ASSERT_NEAR(filter->cell_size(), size, 1e-12 * size) << "match " << i;
    const Relevant rule = rule_of(scheme, {.world = world, .cell_size = filter->cell_size()});
    Pairs expected;
    for (const auto& [s, subscription] : subscriptions)
      for (const auto& [e, update] : entities)
        if (rule(Observer{subscription, {}, {}}, Body{update, {}})) expected.insert({s, e});
    ASSERT_EQ(known, expected) << "match " << i << ", cells of " << size;
  }
  EXPECT_GT(changes_of_size, 5);
  EXPECT_LT(changes_of_size, 25) << "a size that suits is kept";
}

TEST(FollowingCells, AreAsLargeAsThePageSaysAndDecideAccordingly) {
  for (const char* scheme : with_cells)
    for (std::uint64_t seed = 1; seed <= 8 && !testing::Test::HasFatalFailure(); ++seed)
      play_cells(scheme, seed);
}

TEST(FollowingCells, CostNothingAtRestAndAreNotThoseThatAreGiven) {
  for (const std::string scheme : with_cells) {
    SCOPED_TRACE(scheme);
    const auto following = make_filter(scheme, {.world = {0.0, 0.0, 1000.0, 1000.0}}),
               given =
                   make_filter(scheme + "(cell_size=31.25)", {.world = {0.0, 0.0, 1000.0, 1000.0}});
    for (Filter* filter : {following.get(), given.get()}) {
      for (std::uint32_t id = 0; id < 200; ++id) {
        const double x = 5.0 * id, y = 1000.0 - 4.0 * id;
        filter->set_subscription_region(id, around(x, y, 10.0));
        filter->set_update_region(id, around(x, y, 0.1));
      }
      filter->match();
      const FilterCounters before = filter->counters();
      EXPECT_TRUE(filter->match().empty());
      EXPECT_EQ(filter->counters().pairs_tested, before.pairs_tested);
      EXPECT_EQ(filter->counters().regions_moved, before.regions_moved);
    }
    EXPECT_NEAR(following->cell_size(), 4.0, 1e-9) << "a fifth of 20 m";
    EXPECT_EQ(given->cell_size(), 31.25);
  }
}

/// Views of 20 m in a world of 10 km, a fifth each: (L / (L + c))^2 = 25/36. Cells of 1/32 of the
/// world gave 0.4 %.
TEST(FollowingCells, KeepTheirPrecisionInALargeWorld) {
  Random random(1);
  constexpr double world_side = 10'000.0;
  const auto grid = make_filter("grid", {.world = {0.0, 0.0, world_side, world_side}});
  double wanted = 0.0, let_in = 0.0;
  std::vector<Region> views, bodies;
  for (std::uint32_t id = 0; id < 400; ++id) {
    const double x = between(random, 0.0, world_side), y = between(random, 0.0, world_side);
    views.push_back(around(x, y, 10.0));
    grid->set_subscription_region(id, views.back());
    for (std::uint32_t k = 0; k < 100; ++k) {
      const double to_x = x + between(random, -30.0, 30.0), to_y = y + between(random, -30.0, 30.0);
      bodies.push_back({to_x, to_y, to_x, to_y});
      grid->set_update_region(100 * id + k, bodies.back());
    }
  }
  for (const Change& change : grid->match()) {
    ++let_in;
    wanted += overlap_closed(views[change.subscriber], bodies[change.entity]) ? 1.0 : 0.0;
  }
  EXPECT_NEAR(wanted / let_in, 25.0 / 36.0, 0.02);
}

/// While a region is swept, and its cells change, no pair is lost that is relevant on the way.
TEST(FollowingCells, KeepWhatIsRelevantOnASweptWay) {
  for (const char* scheme : with_cells) {
    SCOPED_TRACE(scheme);
    const auto filter = make_filter(scheme, {.world = {0.0, 0.0, 100.0, 100.0}});
    filter->set_subscription_region(0, around(50.0, 50.0, 5.0));
    filter->set_swept_update_region(0, around(10.0, 50.0, 0.1), around(90.0, 50.0, 0.1));
    EXPECT_EQ(filter->match().size(), 1u);
    filter->set_swept_subscription_region(1, around(10.0, 10.0, 0.5), around(90.0, 10.0, 0.5));
    filter->set_subscription_region(0, around(50.0, 50.0, 0.5));
    filter->set_update_region(1, around(50.0, 10.0, 0.1));
    const auto changes = filter->match();
    const auto is_second = [](const Change& change) {
      return change == Change{1, 1, Transition::entered};
    };
    EXPECT_EQ(std::ranges::count_if(changes, is_second), 1);
    for (const Change& change : changes)
      EXPECT_EQ(change.transition, Transition::entered) << "the first pair stays";
  }
}

}  // namespace
}  // namespace rink::im
