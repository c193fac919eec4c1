// The stage `swept` behind every scheme: whoever is with whom anywhere on the way is let through, whatever the shape.
#include <gtest/gtest.h>

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
  flyer.half.x = between(random, half_low, half_high), flyer.half.y = between(random, half_low, half_high);
  return flyer;
}

/// A hair smaller, so that the rounding of a touch decides nothing.
Region shrunk(const Region& region) {
  constexpr double hair = 1e-9;
  return {region.low_x + hair, region.low_y + hair, region.high_x - hair, region.high_y - hair};
}

enum class Who { entities, subscribers, both };

/// Plays `expression` behind which `swept` stands, and holds it to `rule` at every time between two matches. Returns how often somebody was with somebody.
int play_flights(const std::string& expression, const Relevant& rule, const FilterSettings& settings, Who flies, std::uint64_t seed, int matches) {
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
      Flyer flyer = draw_flyer(random, 0.05, 0.8, flies != Who::subscribers && between(random, 0.0, 1.0) < 0.8);
      flyer.flight.time = now;
      filter->set_update_region(id, flyer.at(now, settings.drag));
      filter->set_flight(id, flyer.flight);
      entities[id] = flyer;
    }
    for (Subscriber id = 0; id < subscriber_count; ++id) {
      if (match > 0 && between(random, 0.0, 1.0) < 0.9) continue;
      Flyer flyer = draw_flyer(random, 0.8, 4.0, flies != Who::entities && between(random, 0.0, 1.0) < 0.8);
      flyer.flight.time = now;
      const Heading heading{between(random, -1.0, 1.0), between(random, -1.0, 1.0)};
      filter->set_subscription_region(id, flyer.at(now, settings.drag));
      filter->set_heading(id, heading);
      filter->set_subscriber_flight(id, flyer.flight);
      subscribers[id] = {flyer, heading};
    }
    for (const Change& change : filter->match()) {
      if (change.transition == Transition::entered) known.insert({change.subscriber, change.entity});
      if (change.transition == Transition::left) known.erase({change.subscriber, change.entity});
    }
    for (const double ahead : {0.0, 0.02, 0.05, 0.08, 0.1})
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
            return ADD_FAILURE() << expression << ": seed " << seed
                                  << ", match " << match << ", " << ahead
                                  << " s after it subscriber " << subscriber << " is with entity " << entity << ", which was not let through", together;
        }
  }
  return together;
}

bool looks_at_places(const std::string& scheme) { return scheme != "always" && scheme != "owner" && scheme != "team"; }

void play_all(const std::string& scheme, std::uint64_t seed, int matches) {
  FilterSettings settings = settings_for(seed);
  settings.drag = seed % 3 == 0 ? 0.0 : 0.7;
  for (const char* stages : {" with swept(horizon=0.4)", " with dwell(matches=2) with swept(horizon=0.4)", " with hysteresis(margin=0.3) with swept(horizon=0.4)",
                             " with swept(horizon=0.4) with hysteresis(margin=0.3)", " with swept(horizon=0.4) with dwell(matches=2)",
                             " with swept(horizon=0.4) with tiers(at=0.5) with priority"})
    for (const Who flies : {Who::entities, Who::subscribers, Who::both})
      EXPECT_GT(play_flights(scheme + stages, rule_of(scheme, settings), settings, flies, seed, matches), 0) << scheme << stages;
}

class SweptBehind : public testing::TestWithParam<std::string> {};
class SweptBehindLong : public testing::TestWithParam<std::string> {};

std::vector<std::string> schemes_of_places() {
  std::vector<std::string> names = filter_names();
  std::erase_if(names, [](const std::string& name) { return !looks_at_places(name); });
  return names;
}

/// What is behind the last stage must not be changed by flights either, so roles are left out only because they do not look at places.
TEST_P(SweptBehind, LetsThroughWhoeverIsWithWhomOnTheWay) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) play_all(GetParam(), seed, 6);
}

TEST_P(SweptBehindLong, LetsThroughWhoeverIsWithWhomOnTheWay) {
  for (std::uint64_t seed = 100; seed < 400 && !HasFailure(); ++seed) play_all(GetParam(), seed, 20);
}

const auto name_of_scheme = [](const auto& scheme) { return scheme.param; };
INSTANTIATE_TEST_SUITE_P(Each, SweptBehind, testing::ValuesIn(schemes_of_places()), name_of_scheme);
INSTANTIATE_TEST_SUITE_P(Each, SweptBehindLong, testing::ValuesIn(schemes_of_places()), name_of_scheme);

TEST(SweptShapes, OfAlternativesAndConjunctionsAreLetThroughToo) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    FilterSettings settings = settings_for(seed);
    settings.drag = 0.3;
    const Relevant aura = rule_of("aura", settings), cone = rule_of("cone", settings), sight = rule_of("sight", settings);
    const Relevant either = [=](const Observer& s, const Body& u) { return aura(s, u) || cone(s, u); }, both = [=](const Observer& s, const Body& u) { return aura(s, u) && sight(s, u); };
    for (const Who flies : {Who::entities, Who::subscribers, Who::both}) {
      EXPECT_GT(play_flights("(aura or cone) with swept(horizon=0.4)", either, settings, flies, seed, 8), 0);
      EXPECT_GT(play_flights("(aura and sight) with swept(horizon=0.4)", both, settings, flies, seed, 8), 0);
    }
  }
}

TEST(SweptShapes, LeaveTheDiscOfOneWhoRestsExact) {
  const auto filter = make_filter("aura with swept(horizon=1)", {.world = {0.0, 0.0, 100.0, 100.0}});
  filter->set_subscription_region(0, around(50.0, 50.0, 10.0));
  filter->set_update_region(0, around(58.0, 58.0, 0.1));  // in the square's corner, outside of the disc
  filter->set_update_region(1, around(56.0, 56.0, 0.1));
  std::vector<Entity> seen;
  for (const Change& change : filter->match()) seen.push_back(change.entity);
  EXPECT_EQ(seen, std::vector<Entity>{1});
}

}  // namespace
}  // namespace rink::im
