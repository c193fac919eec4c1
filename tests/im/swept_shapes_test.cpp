// The stage `swept` behind every scheme: whoever is with whom anywhere on the way is let through,
// whatever the shape.
#include <gtest/gtest.h>

#include <iostream>
#include <string>
#include <tuple>

#include "im/stages/flight.h"
#include "tests/im/long_play.h"

namespace rink::im {
namespace {

/// One that flies, or rests: where it is at any time is a closed form.
struct Flyer {
  Flight flight;
  HalfExtent half;
  Region at(double time, double drag) const {
    const Flight now = at_time(flight, time, drag);
    return {now.x - half.x, now.y - half.y, now.x + half.x, now.y + half.y};
  }
};

Flyer draw_flyer(Random& random, double half_low, double half_high, bool flies) {
  Flyer flyer;
  flyer.flight.x = between(random, 0.0, side), flyer.flight.y = between(random, 0.0, side);
  const double u = between(random, -8.0, 8.0), v = between(random, -8.0, 8.0);
  if (flies) flyer.flight.velocity_x = u, flyer.flight.velocity_y = v;
  flyer.half.x = between(random, half_low, half_high),
  flyer.half.y = between(random, half_low, half_high);
  return flyer;
}

/// A hair smaller, so that the rounding of a touch decides nothing.
Region shrunk(const Region& region) {
  constexpr double hair = 1e-9;
  return {region.low_x + hair, region.low_y + hair, region.high_x - hair, region.high_y - hair};
}

enum class Who { entities, subscribers, both };

/// Plays `expression` behind which `swept` stands, and holds it to `rule` at every time between two
/// matches. Returns how often somebody was with somebody.
int play_flights(const std::string& expression, const Relevant& rule,
                 const FilterSettings& settings, Who flies, std::uint64_t seed, int matches) {
  constexpr double tick = 0.1;
  constexpr Entity entity_count = 25;
  constexpr Subscriber subscriber_count = 6;
  Random random(seed);
  const auto filter = make_filter(expression, settings);
  if (filter == nullptr) return ADD_FAILURE() << expression << " is no filter", 0;
  std::map<Entity, Flyer> entities;
  std::map<Subscriber, std::pair<Flyer, Heading>> subscribers;
  Pairs known;
  int together = 0;
  for (int match = 0; match < matches; ++match) {
    const double now = tick * match;
    filter->set_time(now);
    for (Entity id = 0; id < entity_count; ++id) {
      if (match > 0 && between(random, 0.0, 1.0) < 0.9) continue;
      Flyer flyer = draw_flyer(random, 0.05, 0.8,
                               flies != Who::subscribers && between(random, 0.0, 1.0) < 0.8);
      flyer.flight.time = now;
      filter->set_update_region(id, flyer.at(now, settings.drag));
      filter->set_flight(id, flyer.flight);
      entities[id] = flyer;
    }
    for (Subscriber id = 0; id < subscriber_count; ++id) {
      if (match > 0 && between(random, 0.0, 1.0) < 0.9) continue;
      Flyer flyer =
          draw_flyer(random, 0.8, 4.0, flies != Who::entities && between(random, 0.0, 1.0) < 0.8);
      flyer.flight.time = now;
      const Heading heading{between(random, -1.0, 1.0), between(random, -1.0, 1.0)};
      filter->set_subscription_region(id, flyer.at(now, settings.drag));
      filter->set_heading(id, heading);
      filter->set_subscriber_flight(id, flyer.flight);
      subscribers[id] = {flyer, heading};
    }
    for (const Change& change : filter->match()) {
      if (change.transition == Transition::entered)
        known.insert({change.subscriber, change.entity});
      if (change.transition == Transition::left) known.erase({change.subscriber, change.entity});
    }
    // A decision holds until half of the horizon is over, whether there is a match before then or
    // not.
    for (const double ahead : {0.0, 0.02, 0.05, 0.08, 0.1, 0.15, 0.2})
      for (const auto& [subscriber, view] : subscribers)
        for (const auto& [entity, flyer] : entities) {
          Observer observer;
          static_cast<Region&>(observer) = shrunk(view.first.at(now + ahead, settings.drag));
          observer.heading = view.second;
          Body body;
          static_cast<Region&>(body) = shrunk(flyer.at(now + ahead, settings.drag));
          if (!rule(observer, body)) continue;
          ++together;
          if (!known.contains({subscriber, entity}))
            return ADD_FAILURE() << expression << ": seed " << seed << ", match " << match << ", "
                                 << ahead << " s after it subscriber " << subscriber
                                 << " is with entity " << entity << ", which was not let through",
                   together;
        }
  }
  return together;
}

bool looks_at_places(const std::string& scheme) {
  return scheme != "always" && scheme != "owner" && scheme != "team";
}

void play_all(const std::string& scheme, std::uint64_t seed, int matches) {
  FilterSettings settings = settings_for(seed);
  settings.drag = seed % 3 == 0 ? 0.0 : 0.7;
  for (const char* stages :
       {" with swept(horizon=0.4)", " with dwell(matches=2) with swept(horizon=0.4)",
        " with hysteresis(margin=0.3) with swept(horizon=0.4)",
        " with swept(horizon=0.4) with hysteresis(margin=0.3)",
        " with swept(horizon=0.4) with dwell(matches=2)",
        " with swept(horizon=0.4) with tiers(at=0.5) with priority"})
    for (const Who flies : {Who::entities, Who::subscribers, Who::both})
      EXPECT_GT(
          play_flights(scheme + stages, rule_of(scheme, settings), settings, flies, seed, matches),
          0)
          << scheme << stages;
}

class SweptBehind : public testing::TestWithParam<std::string> {};
class SweptBehindLong : public testing::TestWithParam<std::tuple<std::string, std::uint64_t>> {};

std::vector<std::string> schemes_of_places() {
  std::vector<std::string> names = schemes_of_pairs();
  std::erase_if(names, [](const std::string& name) { return !looks_at_places(name); });
  return names;
}

/// What is behind the last stage must not be changed by flights either, so roles are left out only
/// because they do not look at places.
TEST_P(SweptBehind, LetsThroughWhoeverIsWithWhomOnTheWay) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) play_all(GetParam(), seed, 6);
}

TEST_P(SweptBehindLong, LetsThroughWhoeverIsWithWhomOnTheWay) {
  const auto& [scheme, part] = GetParam();
  const std::uint64_t first = 100 + 75 * part;
  for (std::uint64_t seed = first; seed < first + 75 && !HasFailure(); ++seed)
    play_all(scheme, seed, 20);
}

const auto name_of_scheme = [](const auto& scheme) { return scheme.param; };
INSTANTIATE_TEST_SUITE_P(Each, SweptBehind, testing::ValuesIn(schemes_of_places()), name_of_scheme);
INSTANTIATE_TEST_SUITE_P(Each, SweptBehindLong,
                         testing::Combine(testing::ValuesIn(schemes_of_places()),
                                          testing::Range<std::uint64_t>(0, 4)),
                         [](const auto& part) {
                           return std::get<0>(part.param) + "_" +
                                  std::to_string(std::get<1>(part.param));
                         });

TEST(SweptShapes, OfAlternativesAndConjunctionsAreLetThroughToo) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    FilterSettings settings = settings_for(seed);
    settings.drag = 0.3;
    const Relevant aura = rule_of("aura", settings), cone = rule_of("cone", settings),
                   sight = rule_of("sight", settings);
    const Relevant either = [=](const Observer&s,
                                const Body&u) { return aura(s, u) || cone(s, u); },
                   both = [=](const Observer&s, const Body&u) { return aura(s, u) && sight(s, u); };
    for (const Who flies : {Who::entities, Who::subscribers, Who::both}) {
      EXPECT_GT(
          play_flights("(aura or cone) with swept(horizon=0.4)", either, settings, flies, seed, 8),
          0);
      EXPECT_GT(
          play_flights("(aura and sight) with swept(horizon=0.4)", both, settings, flies, seed, 8),
          0);
    }
  }
}

TEST(SweptShapes, OfWhatIsNegatedAreLetThroughToo) {
  std::map<std::string, int> together;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    FilterSettings settings = settings_for(seed);
    settings.drag = seed % 2 == 0 ? 0.0 : 0.3;
    const Relevant region = rule_of("region", settings), aura = rule_of("aura", settings),
                   cone = rule_of("cone", settings), sight = rule_of("sight", settings),
                   grid = rule_of("grid", settings);
    const std::pair<const char*, Relevant> negations[] = {
        {"not region", [=](const Observer& s, const Body& u) { return !region(s, u); }},
        {"not not aura", aura},
        {"aura and not sight",
         [=](const Observer& s, const Body& u) { return aura(s, u) && !sight(s, u); }},
        {"region and not (cone or grid)",
         [=](const Observer& s, const Body& u) {
           return region(s, u) && !cone(s, u) && !grid(s, u);
         }},
        {"not (aura and not cone) and region", [=](const Observer& s, const Body& u) {
           return !(aura(s, u) && !cone(s, u)) && region(s, u);
         }}};
    for (const auto& [scheme, rule] : negations)
      for (const char* stages :
           {" with swept(horizon=0.4)", " with swept(horizon=0.4) with tiers(at=0.5)"})
        for (const Who flies : {Who::entities, Who::subscribers, Who::both})
          together[scheme] += play_flights("(" + std::string(scheme) + ")" + stages, rule, settings,
                                           flies, seed, 8);
  }
  for (const auto& [scheme, count] : together) EXPECT_GT(count, 20) << scheme;
}

/// Roles stay as they are on any way, so their negation loses nobody and lets nobody else in.
TEST(SweptShapes, NegateRolesAsEver) {
  for (const bool flies : {false, true}) {
    const auto filter = make_filter("(aura and not team) with swept(horizon=1)",
                                    {.world = {0.0, 0.0, 100.0, 100.0}});
    filter->set_subscription_region(0, around(50.0, 50.0, 10.0));
    filter->set_subscriber_role(0, {.team = 1});
    for (Entity id = 0; id < 2; ++id) {
      filter->set_update_region(id, around(52.0, 50.0, 0.1));
      filter->set_entity_role(id, {.team = static_cast<std::uint8_t>(1 + id)});
      if (flies) filter->set_flight(id, {.x = 52.0, .y = 50.0, .velocity_x = 1.0});
    }
    std::vector<Entity> seen;
    for (const Change& change : filter->match()) seen.push_back(change.entity);
    EXPECT_EQ(seen, std::vector<Entity>{1}) << (flies ? "in flight" : "at rest");
  }
}

/// Those who have landed, or were told that they rest, are decided as if nobody had ever flown.
TEST(SweptShapes, LeaveNothingBehindWhenAllHaveLanded) {
  std::size_t count = 0;
  for (const std::string scheme :
       {"region", "aura", "cone", "sight", "pvs", "tiles", "diamond", "nimbus", "grid", "hex",
        "hierarchical", "hybrid", "strips", "aura and not cone", "not region",
        "region and not (cone or aura)"})
    for (const bool by_flights : {false, true}) {
      SCOPED_TRACE(scheme + (by_flights ? ", told that they rest" : ", by their regions"));
      const FilterSettings settings = settings_for(5);
      const auto filter = make_filter("(" + scheme + ") with swept(horizon=0.4)", settings),
                 plain = make_filter(scheme, settings);
      Random random(17);
      std::vector<Flyer> entities, subscribers;
      const auto fly = [&](int round) {
        const double now = 0.1 * round;
        filter->set_time(now);
        entities.clear(), subscribers.clear();
        for (Entity id = 0; id < 40; ++id) {
          entities.push_back(draw_flyer(random, 0.05, 0.8, round == 0));
          entities.back().flight.time = now;
          filter->set_update_region(id, entities.back().at(now, settings.drag));
          if (round == 0 || by_flights) filter->set_flight(id, entities.back().flight);
        }
        for (Subscriber id = 0; id < 6; ++id) {
          subscribers.push_back(draw_flyer(random, 0.8, 4.0, round == 0));
          subscribers.back().flight.time = now;
          filter->set_subscription_region(id, subscribers.back().at(now, settings.drag));
          filter->set_heading(id, {1.0, 0.5 * id});
          if (round == 0 || by_flights)
            filter->set_subscriber_flight(id, subscribers.back().flight);
        }
      };
      Pairs known, exact;
      const auto take = [](Filter& from, Pairs& pairs) {
        for (const Change& change : from.match()) {
          if (change.transition == Transition::entered)
            pairs.insert({change.subscriber, change.entity});
          else pairs.erase({change.subscriber, change.entity});
        }
      };
      fly(0);
      take(*filter, known);
      fly(1);
      take(*filter, known);
      for (Entity id = 0; id < entities.size(); ++id)
        plain->set_update_region(id, entities[id].at(0.1, settings.drag));
      for (Subscriber id = 0; id < subscribers.size(); ++id)
        plain->set_subscription_region(id, subscribers[id].at(0.1, settings.drag)),
            plain->set_heading(id, {1.0, 0.5 * id});
      take(*plain, exact);
      EXPECT_EQ(known, exact);
      count += exact.size();
    }
  EXPECT_GT(count, 300u);
}

/// Of one who was told no heading: it looks where it flew.
TEST(SweptShapes, LetAConeLookAheadAfterALanding) {
  const auto filter =
      make_filter("cone(half_angle=60) with swept(horizon=1)", {.world = {0.0, 0.0, 100.0, 100.0}});
  filter->set_update_region(0, around(38.0, 50.0, 0.1));
  filter->set_update_region(1, around(49.0, 50.0, 0.1));
  filter->set_subscription_region(0, around(40.0, 50.0, 10.0));
  filter->set_subscriber_flight(0, {.x = 40.0, .y = 50.0, .velocity_x = 8.0});
  for (int tick = 0; tick <= 2; ++tick) filter->set_time(0.1 * tick), filter->match();
  for (int tick = 3; tick <= 5; ++tick) {
    filter->set_time(0.1 * tick);
    filter->set_subscription_region(0, around(42.0, 50.0, 10.0));
    for (const Change& change : filter->match())
      EXPECT_EQ(std::pair(change.entity, change.transition), std::pair(Entity{0}, Transition::left))
          << "what it has flown by";
  }
  filter->set_subscription_region(0, around(41.0, 50.0, 10.0));
  std::vector<Entity> entered;
  for (const Change& change : filter->match())
    if (change.transition == Transition::entered) entered.push_back(change.entity);
  EXPECT_EQ(entered, std::vector<Entity>{0}) << "it went back";
}

/// As long as a cell, to rounding: its high end lies beyond 64 m, where numbers lie twice as far
/// from each other, so in flight its length is a little less or more.
TEST(SweptShapes, HoldWhoIsExactlyAsLongAsACell) {
  FilterSettings settings{.world = {0.0, 0.0, 100.0, 100.0}, .cell_size = 1.0};
  const Relevant rule = rule_of("hierarchical", settings);
  Random random(3);
  int together = 0;
  for (int play = 0; play < 20'000; ++play) {
    const auto filter = make_filter("hierarchical with swept(horizon=0.4)", settings);
    Flyer flyer{{.x = between(random, 63.6, 63.9),
                 .y = between(random, 46.0, 54.0),
                 .velocity_x = between(random, -0.5, 0.5),
                 .velocity_y = between(random, -8.0, 8.0)},
                {0.5, 0.5}};
    const Region view = around(50.0, 50.0, 12.5);  // ends within the larger cell that begins at 62
                                                   // m, before the smaller one that begins at 63 m
    filter->set_subscription_region(0, view);
    filter->set_update_region(0, flyer.at(0.0, 0.0));
    filter->set_flight(0, flyer.flight);
    const bool is_let_through = !filter->match().empty();
    for (const double ahead : {0.0, 0.05, 0.1, 0.15, 0.2}) {
      Observer observer;
      static_cast<Region&>(observer) = view;
      Body body;
      static_cast<Region&>(body) = flyer.at(ahead, 0.0);
      if (!rule(observer, body)) continue;
      ++together;
      ASSERT_TRUE(is_let_through) << "play " << play << ", " << ahead << " s ahead";
    }
  }
  EXPECT_GT(together, 1'000);
}

/// Over 3,600 pairs of whom all fly at up to 11 m/s, 3.2 m on the way of a horizon at most: pairs
/// let through for each pair who are with each other on the way.
TEST(SweptShapes, LetLittleMoreThroughThanComesTogetherOnTheWay) {
  for (const std::string& scheme : schemes_of_places()) {
    std::size_t let_through = 0, together = 0;
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      const FilterSettings settings = settings_for(seed);
      const auto filter = make_filter(scheme + " with swept(horizon=0.4)", settings);
      const Relevant rule = rule_of(scheme, settings);
      Random random(seed);
      std::vector<Flyer> entities, subscribers;
      for (Entity id = 0; id < 60; ++id) {
        entities.push_back(draw_flyer(random, 0.05, 0.4, true));
        filter->set_update_region(id, entities[id].at(0.0, settings.drag)),
            filter->set_flight(id, entities[id].flight);
      }
      for (Subscriber id = 0; id < 10; ++id) {
        subscribers.push_back(draw_flyer(random, 2.0, 4.0, true));
        filter->set_subscription_region(id, subscribers[id].at(0.0, settings.drag)),
            filter->set_subscriber_flight(id, subscribers[id].flight),
            filter->set_heading(id, {1.0, 0.0});
      }
      let_through += filter->match().size();
      for (const Flyer& subscriber : subscribers)
        for (const Flyer& entity : entities) {
          const auto is_with = [&](int part) {
            Observer observer;
            static_cast<Region&>(observer) = subscriber.at(0.01 * part, settings.drag);
            observer.heading = {1.0, 0.0};
            Body body;
            static_cast<Region&>(body) = entity.at(0.01 * part, settings.drag);
            return rule(observer, body);
          };
          for (int part = 0; part <= 40; ++part)
            if (is_with(part) && ++together) break;
        }
    }
    const double ratio = static_cast<double>(let_through) / static_cast<double>(together);
    std::cout << scheme << ": " << let_through << " pairs let through, " << together
              << " together, " << ratio << '\n';
    EXPECT_GE(ratio, 1.0) << scheme;
    EXPECT_LT(ratio, 4.0) << scheme;
  }
}

TEST(SweptShapes, LeaveTheDiscOfOneWhoRestsExact) {
  const auto filter =
      make_filter("aura with swept(horizon=1)", {.world = {0.0, 0.0, 100.0, 100.0}});
  filter->set_subscription_region(0, around(50.0, 50.0, 10.0));
  filter->set_update_region(
      0, around(58.0, 58.0, 0.1));  // in the square's corner, outside of the disc
  filter->set_update_region(1, around(56.0, 56.0, 0.1));
  std::vector<Entity> seen;
  for (const Change& change : filter->match()) seen.push_back(change.entity);
  EXPECT_EQ(seen, std::vector<Entity>{1});
}

}  // namespace
}  // namespace rink::im
