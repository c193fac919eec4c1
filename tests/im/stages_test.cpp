// Every stage behind schemes and combinations, against what the plain scheme says: hysteresis,
// dwell and tiers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tests/im/cases.h"
#include "tests/im/long_play.h"
#include "tests/im/stage_counts.h"

namespace rink::im {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const char* const behind[] = {"region",
                              "aura",
                              "grid",
                              "cone",
                              "sight",
                              "aura and not sight",
                              "(region or team) and not hex",
                              "not region"};

/// The rule of `text`, which is one of those above.
Relevant rule(const std::string& text, const FilterSettings& settings) {
  const auto of = [&](const char* name) { return rule_of(name, settings); };
  if (text == "aura and not sight")
    return [a = of("aura"), s = of("sight")](const Observer& o, const Body& b) {
      return a(o, b) && !s(o, b);
    };
  if (text == "(region or team) and not hex")
    return [r = of("region"), t = of("team"), h = of("hex")](const Observer& o, const Body& b) {
      return (r(o, b) || t(o, b)) && !h(o, b);
    };
  if (text == "not region")
    return [r = of("region")](const Observer& o, const Body& b) { return !r(o, b); };
  return rule_of(text, settings);
}

Observer grown(const Observer& observer, double margin) {
  constexpr double largest = std::numeric_limits<double>::max();
  const auto bounded = [&](double coordinate) { return std::clamp(coordinate, -largest, largest); };
  Observer result = observer;
  static_cast<Region&>(result) = {
      bounded(observer.low_x - margin), bounded(observer.low_y - margin),
      bounded(observer.high_x + margin), bounded(observer.high_y + margin)};
  return result;
}

void play_hysteresis(const std::string& scheme, std::uint64_t seed, int matches) {
  SCOPED_TRACE(scheme);
  const FilterSettings settings = settings_for(seed);
  const Relevant enters = rule(scheme, settings);
  play(seed, matches, [&] {
    return Judged(make_filter(scheme + " with hysteresis(margin=0.75)", settings), enters,
                  [enters](const Observer& s, const Body& u) { return enters(grown(s, 0.75), u); });
  });
}

TEST(Hysteresis, KeepsWhoIsInUntilHeIsOutOfTheLargerRegion) {
  for (const std::string scheme : behind)
    for (std::uint64_t seed = 1; seed <= 4 && !HasFatalFailure(); ++seed)
      play_hysteresis(scheme, seed, 12);
}

TEST(HysteresisLong, KeepsWhoIsInUntilHeIsOutOfTheLargerRegionOverThousandsOfSeeds) {
  for (std::uint64_t seed = 1; seed <= 2000 && !HasFatalFailure(); ++seed)
    play_hysteresis(behind[seed % std::size(behind)], seed, 12);
}

TEST(Hysteresis, EndsFlappingAtAnEdgeAndCountsIt) {
  const auto plain = make_filter("region", hundred),
             steady = make_filter("region with hysteresis(margin=1)", hundred);
  for (Filter* filter : {plain.get(), steady.get()}) {
    filter->set_subscription_region(0, {0.0, 0.0, 10.0, 10.0});
    for (int i = 0; i < 20; ++i) {
      const double x = i % 2 == 0 ? 9.75 : 10.25;
      filter->set_update_region(0, {x, 5.0, x, 5.0});
      filter->match();
    }
    filter->set_update_region(0, {11.0, 5.0, 11.0, 5.0});
    EXPECT_THAT(filter->match(), IsEmpty());
  }
  EXPECT_EQ(plain->counters().changes, 20u);
  EXPECT_EQ(steady->counters().changes, 1u);
  EXPECT_EQ(count(*steady, "pairs that stayed beyond the region"), 10u);
}

/// What `dwell` makes of the changes of what it stands behind, pair by pair.
class DwellTruth {
 public:
  explicit DwellTruth(int matches) : matches_(matches) {}

  std::vector<Change> match(std::span<const Change> changes) {
    ++now_;
    for (const Change& change : changes)
      is_in_[{change.subscriber, change.entity}] = change.transition == Transition::entered;
    std::vector<Change> reported;
    for (const auto& [pair, is_in] : is_in_) {
      const auto known = since_.find(pair);
      if (is_in && known == since_.end()) {
        since_[pair] = now_;
        reported.push_back({pair.first, pair.second, Transition::entered});
      } else if (!is_in && known != since_.end() && now_ - known->second >= matches_) {
        since_.erase(known);
        reported.push_back({pair.first, pair.second, Transition::left});
      }
    }
    return reported;
  }
  void remove_entity(Entity entity) {
    const auto is_gone = [entity](const auto& each) { return each.first.second == entity; };
    std::erase_if(is_in_, is_gone), std::erase_if(since_, is_gone);
  }

 private:
  int matches_, now_ = 0;
  std::map<std::pair<Subscriber, Entity>, bool> is_in_;
  std::map<std::pair<Subscriber, Entity>, int> since_;
};

void play_dwell(const std::string& scheme, std::uint64_t seed, int matches) {
  SCOPED_TRACE(scheme + " with seed " + std::to_string(seed));
  const FilterSettings settings = settings_for(seed);
  const auto plain = make_filter(scheme, settings),
             dwelling = make_filter(scheme + " with dwell(matches=" + std::to_string(matches) + ")",
                                    settings);
  DwellTruth truth(matches);
  Random random(seed);
  for (int i = 0; i < 60; ++i) {
    for (std::uint32_t id = 0; id < 30; ++id) {
      if (between(random, 0.0, 1.0) < 0.05) {
        for (Filter* filter : {plain.get(), dwelling.get()}) filter->remove_entity(id);
        truth.remove_entity(id);
      }
      if (between(random, 0.0, 1.0) < 0.3) continue;
      const Region place = draw_gridded(random, 0.5), view = draw_gridded(random, 3.0);
      for (Filter* filter : {plain.get(), dwelling.get()}) {
        filter->set_update_region(id, place);
        if (id < 8 && i % 5 == 0) filter->set_subscription_region(id, view);
      }
    }
    const std::vector<Change> expected = truth.match(plain->match());
    const auto changes = dwelling->match();
    ASSERT_EQ(std::vector<Change>(changes.begin(), changes.end()), expected) << "match " << i;
  }
}

TEST(Dwell, LetsNobodyGoBeforeHisTime) {
  for (const std::string scheme : behind)
    for (const int matches : {1, 2, 7, 40})
      for (std::uint64_t seed = 1; seed <= 5 && !HasFatalFailure(); ++seed)
        play_dwell(scheme, seed, matches);
}

TEST(DwellLong, LetsNobodyGoBeforeHisTimeOverAThousandSeeds) {
  for (std::uint64_t seed = 1; seed <= 1000 && !HasFatalFailure(); ++seed)
    play_dwell(behind[seed % std::size(behind)], seed, static_cast<int>(1 + seed % 12));
}

TEST(Dwell, CountsWhatItPutOffAndCalledOff) {
  const auto filter = make_filter("region with dwell(matches=3)", hundred);
  const auto put = [&](double x) {
    filter->set_update_region(0, {x, 5.0, x, 5.0});
    const auto changes = filter->match();
    return std::vector<Change>(changes.begin(), changes.end());
  };
  filter->set_subscription_region(0, {0.0, 0.0, 10.0, 10.0});
  EXPECT_THAT(put(5.0), ElementsAre(Change{0, 0, Transition::entered}));
  EXPECT_THAT(put(15.0), IsEmpty());
  EXPECT_THAT(put(5.0), IsEmpty());
  EXPECT_THAT(put(15.0), ElementsAre(Change{0, 0, Transition::left}))
      << "three matches after it entered";
  EXPECT_EQ(count(*filter, "departures put off"), 1u);
  EXPECT_EQ(count(*filter, "departures called off"), 1u);
}

TEST(Tiers, SayInWhichRingAnEntityIsAndWhenThatChanges) {
  for (const std::string scheme : behind) {
    SCOPED_TRACE(scheme);
    const FilterSettings settings = settings_for(2);
    const Relevant relevant = rule(scheme, settings);
    play(3, 8, [&] {
      return Judged(make_filter(scheme + " with tiers(at=0.25 at=0.5)", settings), relevant);
    });
  }
}

/// Replays tiers to a recount by hand.
void play_tiers(std::uint64_t first_seed, std::uint64_t last_seed) {
  for (std::uint64_t seed = first_seed; seed <= last_seed; ++seed) {
    Random random(seed);
    const auto filter = make_filter("region with tiers(at=0.25 at=0.5)", settings_for(seed));
    std::map<std::pair<Subscriber, Entity>, int> known;
    for (int i = 0; i < 12; ++i) {
      std::map<Entity, Region> entities;
      std::map<Subscriber, Region> subscribers;
      for (std::uint32_t id = 0; id < 40; ++id)
        filter->set_update_region(id, entities[id] = draw_gridded(random, 0.5));
      for (std::uint32_t id = 0; id < 8; ++id)
        filter->set_subscription_region(id, subscribers[id] = draw_gridded(random, 3.0));
      for (const Change& change : filter->match()) {
        const std::pair pair{change.subscriber, change.entity};
        if (change.transition != Transition::left) known[pair] = change.tier;
        else if (known.erase(pair) != 1) FAIL() << "left without having been there";
      }
      std::map<std::pair<Subscriber, Entity>, int> expected;
      for (const auto& [s, view] : subscribers)
        for (const auto& [e, place] : entities) {
          if (!overlap_closed(view, place)) continue;
          const double x = 0.5 * view.low_x + 0.5 * view.high_x,
                       y = 0.5 * view.low_y + 0.5 * view.high_y,
                       half = 0.5 * (view.high_x - view.low_x);
          expected[{s, e}] = disc_touches(around(x, y, 0.25 * half), place)  ? 0
                             : disc_touches(around(x, y, 0.5 * half), place) ? 1
                                                                             : 2;
        }
      ASSERT_EQ(known, expected) << "seed " << seed;
    }
  }
}

TEST(Tiers, ReplayToTheRecount) { play_tiers(1, 60); }
TEST(TiersLong, ReplayToTheRecountOverThousandsOfSeeds) { play_tiers(100, 3'000); }

TEST(Stages, ComposeInAnyOrderBehindAnyScheme) {
  for (const std::string& scheme : schemes_of_pairs())
    for (const std::string stages : {"with hysteresis(margin=0.5) with dwell(matches=3)",
                                     "with dwell(matches=3) with hysteresis(margin=0.5)",
                                     "with swept(horizon=0.5) with dwell(matches=2)",
                                     "with hysteresis(margin=0.5) with swept(horizon=1) with "
                                     "dwell(matches=2) with tiers(at=0.5) with priority"}) {
      const auto once = make_filter(scheme + " " + stages, settings_for(3)),
                 again = make_filter("(" + scheme + ") " + stages, settings_for(3));
      ASSERT_TRUE(once) << scheme << " " << stages;
      Random random(4);
      Pairs known;
      for (int i = 0; i < 20; ++i) {
        for (std::uint32_t id = 0; id < 30; ++id) {
          const Region place = draw_gridded(random, 0.5), view = draw_gridded(random, 3.0);
          for (Filter* filter : {once.get(), again.get()})
            filter->set_update_region(id, place), filter->set_subscription_region(id % 6, view);
        }
        const auto changes = once->match(), same = again->match();
        ASSERT_TRUE(std::ranges::equal(changes, same));
        ASSERT_TRUE(std::ranges::is_sorted(changes));
        for (const Change& change : changes) {
          const std::pair pair{change.subscriber, change.entity};
          const bool was_in = known.contains(pair);
          ASSERT_EQ(was_in, change.transition != Transition::entered);
          if (change.transition == Transition::entered) known.insert(pair);
          if (change.transition == Transition::left) known.erase(pair);
        }
      }
      // All rests: what was put off comes, then nothing costs anything.
      for (int i = 0; i < 5; ++i) once->match();
      const FilterCounters before = once->counters();
      EXPECT_THAT(once->match(), IsEmpty());
      EXPECT_EQ(once->counters().pairs_tested, before.pairs_tested);
      EXPECT_EQ(once->counters().regions_moved, before.regions_moved);
    }
}

}  // namespace
}  // namespace rink::im
