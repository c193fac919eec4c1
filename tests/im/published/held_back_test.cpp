// The stages `vfc` and `dyconits` by brute force: what was held back, recounted for each pair from
// all that ever happened to its entity.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/im/cases.h"
#include "tests/im/long_play.h"
#include "tests/im/stage_counts.h"

namespace rink::im {
namespace {

constexpr double none = std::numeric_limits<double>::infinity();

/// Where an entity was at each match from the one at which it came, and whether it was updated.
struct History {
  std::size_t first = 0;
  std::vector<Region> regions;
  std::vector<bool> updated;
  const Region& at(std::size_t match) const { return regions[match - first]; }
};

long double middle_x(const Region& region) { return (region.low_x + 0.0L + region.high_x) / 2.0L; }
long double middle_y(const Region& region) { return (region.low_y + 0.0L + region.high_y) / 2.0L; }
long double way(const Region& from, const Region& to) {
  return std::hypot(middle_x(to) - middle_x(from), middle_y(to) - middle_y(from));
}

/// What the pair lacks at `now`, if it was told at match `told`.
struct Lack {
  std::uint64_t updates = 0, age = 0;
  long double path = 0.0L, distance = 0.0L;
};
Lack lack_of(const History& history, std::size_t told, std::size_t now) {
  Lack lack;
  for (std::size_t match = told + 1; match <= now; ++match) {
    if (history.updated[match - history.first] && lack.updates++ == 0) {
      lack.age = now - match + 1;
      lack.distance = way(history.at(match - 1), history.at(now));
    }
    if (lack.updates > 0) lack.path += way(history.at(match - 1), history.at(match));
  }
  return lack;
}

struct Crowd {
  std::map<Entity, History> entities;
  std::map<Subscriber, Region> subscribers;
  std::size_t now = 0;
};
using ToldAt = std::map<std::pair<Subscriber, Entity>, std::size_t>;

/// Plays a crowd that moves in bursts, comes and goes, and compares who is due at each match with
/// `judge(crowd, told)`, by which every pair in scope that lacks something is told or not.
template <class Judge>
void play_held(const std::string& text, std::uint64_t seed, const Judge& judge) {
  SCOPED_TRACE(text + " with seed " + std::to_string(seed));
  const FilterSettings settings = settings_for(seed);
  const auto filter = make_filter(text, settings), inner = make_filter("region", settings);
  ASSERT_TRUE(filter);
  Random random(seed);
  Crowd crowd;
  ToldAt told;
  std::size_t told_count = 0;
  const auto set = [&](Entity entity, const Region& region) {
    filter->set_update_region(entity, region), inner->set_update_region(entity, region);
  };
  std::map<Entity, Region> present;
  for (crowd.now = 1; crowd.now <= 100; ++crowd.now) {
    const double share = crowd.now % 7 == 0 ? 0.0 : crowd.now % 3 == 0 ? 0.7 : 0.2;
    for (Entity entity = 0; entity < 50; ++entity) {
      const bool is_there = present.contains(entity);
      if (is_there && between(random, 0.0, 1.0) < 0.02) {
        filter->remove_entity(entity), inner->remove_entity(entity);
        present.erase(entity), crowd.entities.erase(entity);
        std::erase_if(told, [&](const auto& each) { return each.first.second == entity; });
        continue;
      }
      if (is_there && between(random, 0.0, 1.0) >= share) continue;
      Region region = draw_random(random, 0.5);
      if (is_there && between(random, 0.0, 1.0) < 0.8) {
        const double x = between(random, -0.3, 0.3), y = between(random, -0.3, 0.3);
        const Region& was = present[entity];
        region = {was.low_x + x, was.low_y + y, was.high_x + x, was.high_y + y};
      }
      present[entity] = region;
      set(entity, region);
      if (!is_there) crowd.entities[entity] = {crowd.now, {}, {}};
    }
    for (Subscriber subscriber = 0; subscriber < 6; ++subscriber) {
      if (crowd.now > 1 && between(random, 0.0, 1.0) >= share) continue;
      const Region region = draw_random(random, 5.0);
      crowd.subscribers[subscriber] = region;
      filter->set_subscription_region(subscriber, region);
      inner->set_subscription_region(subscriber, region);
    }
    for (auto& [entity, history] : crowd.entities) {
      history.regions.push_back(present[entity]);
      history.updated.push_back(between(random, 0.0, 1.0) < 0.8 * share);
      if (history.updated.back()) filter->note_update(entity);
    }

    std::vector<Change> expected;
    for (const Change& change : inner->match()) {
      expected.push_back(change);
      const std::pair pair{change.subscriber, change.entity};
      if (change.transition == Transition::left) told.erase(pair);
      else told[pair] = crowd.now;
    }
    for (const auto& pair : judge(crowd, told)) {
      expected.push_back({pair.first, pair.second, Transition::due});
      told[pair] = crowd.now;
      ++told_count;
    }
    std::sort(expected.begin(), expected.end());
    ASSERT_EQ(match(*filter), expected) << "at match " << crowd.now;
  }
  EXPECT_GT(told_count, 5u);
  EXPECT_EQ(count(*filter, "told"), told_count);
}

struct Bounds {
  double at, matches, updates, distance;
};

void play_vfc(const std::string& stage, const std::vector<Bounds>& zones) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed)
    play_held("region with " + stage, seed, [&](const Crowd& crowd, const ToldAt& told) {
      std::set<std::pair<Subscriber, Entity>> due;
      for (const auto& [pair, when] : told) {
        const History& history = crowd.entities.at(pair.second);
        const Region& own = crowd.subscribers.at(pair.first);
        const Lack lack = lack_of(history, when, crowd.now);
        if (lack.updates == 0) continue;
        const long double reach = std::min(own.high_x - own.low_x, own.high_y - own.low_y) / 2.0L,
                          distance = way(own, history.at(crowd.now));
        Bounds zone{0.0, 0.0, 0.0, 0.0};
        for (const Bounds& each : zones)
          if (distance > each.at * reach) zone = each;
        if (static_cast<double>(lack.age) > zone.matches ||
            static_cast<double>(lack.updates) > zone.updates || lack.distance > zone.distance)
          due.insert(pair);
      }
      return due;
    });
}

TEST(VectorFieldConsistency, TellsAsSoonAsABoundOfTheZoneIsExceeded) {
  play_vfc("vfc(at=0.3 matches=4)", {{0.3, 4.0, none, none}});
  play_vfc("vfc(at=0.3 at=0.7 updates=2 updates=5)",
           {{0.3, none, 2.0, none}, {0.7, none, 5.0, none}});
  play_vfc("vfc(at=0 at=0.5 distance=0.2 distance=0.6)",
           {{0.0, none, none, 0.2}, {0.5, none, none, 0.6}});
  play_vfc("vfc(at=0.2 at=0.6 matches=3 matches=9 updates=2 updates=6 distance=0.2 distance=1)",
           {{0.2, 3.0, 2.0, 0.2}, {0.6, 9.0, 6.0, 1.0}});
}

void play_dyconits(const std::string& stage, double size, double matches, double error) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Region whole = settings_for(seed).world;
    const auto cell = [&](const Region& region) {
      return std::pair{std::floor((middle_x(region) - whole.low_x) / size),
                       std::floor((middle_y(region) - whole.low_y) / size)};
    };
    play_held("region with " + stage, seed, [&](const Crowd& crowd, const ToldAt& told) {
      using Cell = std::pair<long double, long double>;
      std::map<std::pair<Subscriber, Cell>, std::pair<std::uint64_t, long double>> held;
      std::map<std::pair<Subscriber, Cell>, std::vector<Entity>> members;
      for (const auto& [pair, when] : told) {
        const History& history = crowd.entities.at(pair.second);
        const Lack lack = lack_of(history, when, crowd.now);
        if (lack.updates == 0) continue;
        const std::pair unit{pair.first, cell(history.at(crowd.now))};
        held[unit].first = std::max(held[unit].first, lack.age);
        held[unit].second += lack.path;
        members[unit].push_back(pair.second);
      }
      std::set<std::pair<Subscriber, Entity>> due;
      for (const auto& [unit, lack] : held) {
        const Cell own = cell(crowd.subscribers.at(unit.first));
        const long double steps = std::max(std::abs(unit.second.first - own.first),
                                           std::abs(unit.second.second - own.second));
        const bool is_late = steps == 0.0L ||
                             static_cast<long double>(lack.first) > steps * matches ||
                             lack.second > steps * error;
        for (const Entity entity : members[unit])
          if (is_late) due.insert({unit.first, entity});
      }
      return due;
    });
  }
}

TEST(Dyconits, TellAllOfACellAsSoonAsItsBoundIsExceeded) {
  play_dyconits("dyconits(cell_size=1.5 matches=3)", 1.5, 3.0, none);
  play_dyconits("dyconits(cell_size=1 error=0.3)", 1.0, none, 0.3);
  play_dyconits("dyconits(cell_size=2 matches=6 error=0.4)", 2.0, 6.0, 0.4);
}

TEST(HeldUpdates, LeaveWhatEntersAndLeavesToTheSchemeBefore) {
  const auto filter = make_filter("region with vfc(at=0 matches=2)", hundred);
  filter->set_subscription_region(0, {0.0, 0.0, 20.0, 20.0});
  const auto move = [&](double x) { filter->set_update_region(0, point(x, 5.0)); };
  move(5.0);
  EXPECT_EQ(match(*filter), (std::vector{Change{0, 0, Transition::entered}}));
  move(6.0);
  filter->note_update(0);
  EXPECT_TRUE(match(*filter).empty());
  move(30.0);
  EXPECT_EQ(match(*filter), (std::vector{Change{0, 0, Transition::left}}));
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(match(*filter).empty()) << "out of scope nothing is due";
  move(7.0);
  EXPECT_EQ(match(*filter), (std::vector{Change{0, 0, Transition::entered}}))
      << "told in full, so nothing is held back";
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(match(*filter).empty());
}

/// The age counts from the first update that was held back, not from the last telling.
TEST(HeldUpdates, LetWhoRestedForLongWaitAsLongAsOthers) {
  const auto filter = make_filter("region with vfc(at=0 matches=2)", hundred);
  filter->set_subscription_region(0, {0.0, 0.0, 20.0, 20.0});
  filter->set_update_region(0, point(5.0, 5.0));
  filter->match();
  for (int i = 0; i < 50; ++i) EXPECT_TRUE(match(*filter).empty());
  filter->note_update(0);
  EXPECT_TRUE(match(*filter).empty());
  EXPECT_TRUE(match(*filter).empty());
  EXPECT_EQ(match(*filter), (std::vector{Change{0, 0, Transition::due}}));
}

/// Neither where nothing moves and nothing is held back, nor of subscribers who were told all.
TEST(HeldUpdates, LookAtNoPairWhereNothingIsHeldBack) {
  const auto filter = make_filter("region with vfc(at=0 updates=0)", hundred);
  for (Entity entity = 0; entity < 50; ++entity)
    filter->set_update_region(entity, point(entity, 50.0));
  filter->set_subscription_region(0, world);
  filter->match();
  filter->note_update(7);
  EXPECT_EQ(match(*filter), (std::vector{Change{0, 7, Transition::due}}));
  const std::uint64_t before = filter->counters().pairs_tested;
  for (int i = 0; i < 10; ++i) EXPECT_TRUE(match(*filter).empty());
  EXPECT_EQ(filter->counters().pairs_tested, before);
}

/// Of 2,500 pairs, only those of the one entity that something was updated of.
TEST(HeldUpdates, LookAtThePairsOfWhatWasUpdatedAlone) {
  const auto filter = make_filter("region with vfc(at=0 updates=2)", hundred);
  for (std::uint32_t id = 0; id < 50; ++id) {
    filter->set_update_region(id, point(id, 50.0));
    filter->set_subscription_region(id, world);
  }
  EXPECT_EQ(filter->match().size(), 2'500u);
  const std::uint64_t before = filter->counters().pairs_tested;
  for (int update = 0; update < 2; ++update) {
    filter->note_update(7);
    EXPECT_TRUE(match(*filter).empty());
  }
  EXPECT_EQ(filter->counters().pairs_tested - before, 2u * (50u + 50u));
  filter->remove_subscriber(3), filter->remove_entity(9);
  filter->note_update(7);
  EXPECT_EQ(filter->match().size(), 49u);
}

TEST(HeldUpdates, AreRefusedByNameWhereBoundsAreWrong) {
  const auto complaint = [](const char* text) {
    return complaint_about(text, hundred).value_or("");
  };
  EXPECT_EQ(complaint("aura with vfc(at=0.5 matches=3) with priority(budget=100)"), "");
  EXPECT_EQ(complaint("aura with dyconits(cell_size=1 error=0)"), "");
  EXPECT_EQ(complaint("aura with vfc(matches=3)"), "vfc needs at=NUMBER");
  EXPECT_EQ(complaint("aura with vfc(at=0.5)"), "vfc needs a bound: matches, updates or distance");
  EXPECT_EQ(complaint("aura with vfc(at=0.2 at=0.5 matches=3)"),
            "vfc: 1 of matches for 2 of at: each zone has its own, or none has any");
  EXPECT_EQ(complaint("aura with vfc(at=0.2 at=0.5 matches=3 matches=2)"),
            "vfc: matches must ascend");
  EXPECT_EQ(complaint("aura with dyconits(cell_size=1)"),
            "dyconits needs a bound: matches or error");
  EXPECT_EQ(complaint("aura with dyconits(error=1)"), "dyconits needs cell_size=NUMBER");
  EXPECT_EQ(complaint("aura with vfc(at=0.5 matches=3) with dwell(matches=2)"),
            "after vfc nothing may follow but priority: it decides more than whether a pair is "
            "relevant");
  EXPECT_EQ(complaint("aura with swept(horizon=1) with vfc(at=0.5 matches=3)"),
            "vfc cannot follow swept: how far an entity in flight is from what was told is not "
            "known");
}

}  // namespace
}  // namespace rink::im
