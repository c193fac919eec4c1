// Every stage behind schemes and combinations, against what the plain scheme says: hysteresis,
// dwell, tiers and priority.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "im/stages/priority_order.h"
#include "tests/im/cases.h"
#include "tests/im/long_play.h"

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

std::uint64_t count(const Filter& filter, const std::string& what) {
  std::vector<StageCount> counts;
  filter.list_counts(counts);
  for (const StageCount& each : counts)
    if (what == each.what) return each.count;
  ADD_FAILURE() << "nothing counts " << what;
  return 0;
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

TEST(Priority, SendsTheStateOfWhoEnteredFirstAndStarvesNobody) {
  const auto filter = make_filter("region with priority", hundred);
  filter->set_subscription_region(0, {0.0, 0.0, 20.0, 20.0});
  for (Entity entity = 0; entity < 20; ++entity)
    filter->set_update_region(entity, {10.0 + 0.5 * entity, 10.0, 10.0 + 0.5 * entity, 10.0});
  filter->match();
  PriorityOrder& order = *filter->priority();
  const auto bytes_of = [](const PriorityOrder::Item& item) {
    return std::size_t{item.is_state ? 40u : 10u};
  };
  const auto first = order.fill(0, 200, bytes_of);
  ASSERT_EQ(first.size(), 5u);
  for (Entity entity = 0; entity < 5; ++entity)
    EXPECT_EQ(first[entity].entity, entity) << "the nearest first";
  std::vector<int> sent(20);
  for (int i = 0; i < 400; ++i) {
    filter->match();
    std::size_t used = 0;
    for (const PriorityOrder::Item& item : order.fill(0, 50, bytes_of))
      ++sent[item.entity], used += bytes_of(item);
    EXPECT_LE(used, 50u);
  }
  EXPECT_GT(*std::min_element(sent.begin(), sent.end()), 60) << "nobody starves";
  EXPECT_NEAR(static_cast<double>(sent[0]) / sent[19], 1.95, 0.25)
      << "1 / (1 + d / r) of the middle against the edge";
  EXPECT_EQ(order.counts().states, 20u);
  EXPECT_EQ(order.counts().state_bytes, 800u);
  EXPECT_EQ(order.counts().update_bytes, 10u * order.counts().updates);
  filter->set_update_region(3, {90.0, 90.0, 90.0, 90.0});
  filter->match();
  for (const PriorityOrder::Item& item : order.order(0)) EXPECT_NE(item.entity, 3u);
  EXPECT_FALSE(make_filter("region", hundred)->priority());
}

/// What fits is what a whole sort would put in front, states and updates in turns, and what does
/// not is all the rest.
TEST(Priority, FillsWithTheMostUrgentAndPutsOffAllOthers) {
  const auto filter = make_filter("region with tiers(at=0.4) with priority", hundred);
  PriorityOrder& order = *filter->priority();
  Random random(8);
  constexpr std::size_t item_bytes = 10;
  for (int match = 1; match <= 60; ++match) {
    filter->set_subscription_region(0, around(50.0, 50.0, 20.0));
    for (Entity entity = 0; entity < 200; ++entity) {
      const double x = between(random, 20.0, 80.0);
      if (match == 1 || between(random, 0.0, 1.0) < 0.1)
        filter->set_update_region(entity, around(x, between(random, 20.0, 80.0), 0.1));
    }
    filter->match();
    std::vector<Entity> states, updates, expected, filled, put_off;
    for (const PriorityOrder::Item& item : order.order(0))
      (item.is_state ? states : updates).push_back(item.entity);
    std::size_t room = 25;
    for (const auto* list :
         {match % 2 == 0 ? &updates : &states, match % 2 == 0 ? &states : &updates})
      for (std::size_t i = 0; i < list->size() && room > 0; ++i, --room)
        expected.push_back((*list)[i]);
    for (const PriorityOrder::Item& item :
         order.fill(0, 25 * item_bytes, [](const auto&) { return item_bytes; }))
      filled.push_back(item.entity);
    for (const PriorityOrder::Item& item : order.put_off()) put_off.push_back(item.entity);
    ASSERT_EQ(filled, expected) << "match " << match;
    std::vector<Entity> all(filled), there(states);
    all.insert(all.end(), put_off.begin(), put_off.end());
    there.insert(there.end(), updates.begin(), updates.end());
    ASSERT_THAT(all, testing::UnorderedElementsAreArray(there)) << "match " << match;
  }
}

/// (Matches since it was last sent) / ((1 + d / r) 2^tier), d in the plane; of a state the matches
/// since it entered, and one more.
TEST(Priority, OrdersByTheMatchesWaitedTheDistanceAndTheTier) {
  const auto filter = make_filter("region with tiers(at=0.4) with priority", hundred);
  PriorityOrder& order = *filter->priority();
  Random random(9);
  constexpr double half = 20.0;
  std::map<Entity, Region> places;
  std::map<Entity, int> since, tier;  // the match at which it was sent last, or entered
  std::map<Entity, bool> is_state;
  filter->set_subscription_region(0, around(50.0, 50.0, half));
  std::size_t compared = 0;
  for (int match = 1; match <= 40; ++match) {
    for (Entity entity = 0; entity < 150; ++entity) {
      const double x = between(random, 25.0, 75.0), y = between(random, 25.0, 75.0);
      if (match == 1 || between(random, 0.0, 1.0) < 0.1)
        filter->set_update_region(entity, places[entity] = around(x, y, 0.1));
    }
    for (const Change& change : filter->match()) {
      if (change.transition == Transition::left) since.erase(change.entity);
      if (change.transition == Transition::entered)
        since[change.entity] = match, is_state[change.entity] = true;
      if (change.transition != Transition::left) tier[change.entity] = change.tier;
    }
    const auto urgency = [&](Entity entity) {
      const Region& place = places[entity];
      const double d = std::hypot(0.5 * (place.low_x + place.high_x) - 50.0,
                                  0.5 * (place.low_y + place.high_y) - 50.0);
      return (match - since[entity] + (is_state[entity] ? 1 : 0)) /
             ((1.0 + d / half) * std::pow(2.0, tier[entity]));
    };
    for (const bool states : {true, false}) {
      double before = std::numeric_limits<double>::infinity();
      for (const PriorityOrder::Item& item : order.order(0)) {
        if (item.is_state != states) continue;
        ASSERT_EQ(item.is_state, is_state[item.entity]);
        ASSERT_LE(urgency(item.entity), before * (1.0 + 1e-5))
            << "match " << match << ", entity " << item.entity;
        before = urgency(item.entity), ++compared;
      }
    }
    for (const PriorityOrder::Item& item :
         order.fill(0, 120, [](const auto&) { return std::size_t{10}; }))
      since[item.entity] = match, is_state[item.entity] = false;
  }
  EXPECT_GT(compared, 1'000u);
}

TEST(Priority, TakesOneThatAloneExceedsTheBudget) {
  const auto filter = make_filter("region with tiers(at=0.5) with priority", hundred);
  filter->set_subscription_region(0, {0.0, 0.0, 20.0, 20.0});
  filter->set_update_region(0, {10.0, 10.0, 10.0, 10.0});
  filter->set_update_region(1, {19.0, 10.0, 19.0, 10.0});
  filter->match();
  const auto huge = [](const PriorityOrder::Item&) { return std::size_t{1000}; };
  EXPECT_EQ(filter->priority()->fill(0, 100, huge).size(), 1u);
  EXPECT_EQ(filter->priority()->fill(0, 100, huge).front().entity, 1u);
  EXPECT_EQ(count(*filter, "put off"), 2u);
}

TEST(Stages, ComposeInAnyOrderBehindAnyScheme) {
  for (const std::string& scheme : filter_names())
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
