// Flights: exact times of meeting and parting against bisection in long double, and swept regions
// that hold every place of a flight.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "im/stages/flight.h"
#include "tests/im/long_play.h"

namespace rink::im {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr double never = -std::numeric_limits<double>::infinity();

struct Place {
  long double x, y;
};
Place place(const Flight& flight, long double time, long double drag) {
  const long double passed = time - flight.time,
                    warped = drag > 0.0L ? -std::expm1(-drag * passed) / drag : passed;
  return {flight.x + flight.velocity_x * warped, flight.y + flight.velocity_y * warped};
}

/// Above 0 apart, in metres: the greater gap along an axis, or that to the disc.
long double box_gap(const Place& a, const HalfExtent& a_half, const Place& b,
                    const HalfExtent& b_half) {
  return std::max(std::abs(a.x - b.x) - a_half.x - b_half.x,
                  std::abs(a.y - b.y) - a_half.y - b_half.y);
}
long double disc_gap(const Place& a, const HalfExtent& a_half, const Place& b, long double radius) {
  const long double x = std::max(std::abs(a.x - b.x) - a_half.x, 0.0L),
                    y = std::max(std::abs(a.y - b.y) - a_half.y, 0.0L);
  return std::hypot(x, y) - radius;
}

/// The times between `from` and `until` at which `gap` changes its sign: gaps of lines to convex
/// sets fall once and rise once.
template <class Gap>
std::pair<long double, long double> bisected(const Gap& gap, long double from, long double until) {
  // The least gap first, by golden section.
  long double low = from, high = until;
  for (int i = 0; i < 400; ++i) {
    const long double a = low + 0.382L * (high - low), b = low + 0.618L * (high - low);
    if (gap(a) <= gap(b)) high = b;
    else low = a;
  }
  const long double best = (low + high) / 2.0L;
  if (gap(best) > 0.0L) return {1.0L, 0.0L};
  const auto root = [&gap](long double inside, long double outside) {
    if (gap(outside) <= 0.0L) return outside;
    for (int i = 0; i < 200; ++i) {
      const long double middle = (inside + outside) / 2.0L;
      (gap(middle) <= 0.0L ? inside : outside) = middle;
    }
    return inside;
  };
  return {root(best, from), root(best, until)};
}

Flight draw_flight(Random& random) {
  Flight flight;
  flight.x = between(random, -10.0, 10.0), flight.y = between(random, -10.0, 10.0);
  flight.velocity_x = between(random, -5.0, 5.0), flight.velocity_y = between(random, -5.0, 5.0);
  flight.time = between(random, 0.0, 3.0);
  return flight;
}

/// A grazing meeting has no sharp time: there the error of a time is that of the gap's square root.
template <class Gap>
void expect_same(const TimeSpan& span, const Gap& gap, long double from, std::uint64_t seed) {
  const long double until = from + 20.0L;
  const auto [enters, leaves] = bisected(gap, from, until);
  if (enters > leaves) {
    const bool is_grazing =
        span.enters > span.leaves || span.enters >= until || std::abs(gap(span.enters)) < 1e-9L;
    EXPECT_TRUE(is_grazing) << "seed " << seed;
    return;
  }
  ASSERT_LE(span.enters, span.leaves) << "seed " << seed;
  const bool is_short = std::abs(leaves - enters) < 1e-3L;
  const auto agree = [&](double found, long double truth) {
    const double tolerance = 1e-11 + 1e-9 * (is_short ? 1e3 : 0.0);
    const bool goes_on = truth >= until;
    EXPECT_NEAR(goes_on ? std::min(found, static_cast<double>(until)) : found,
                static_cast<double>(truth), tolerance)
        << "seed " << seed;
  };
  agree(span.enters, enters);
  agree(span.leaves, leaves);
}

TEST(Flight, MeetsAndPartsWhenBisectionSaysSo) {
  int meetings = 0;
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    Random random(seed);
    const double drag = seed % 3 == 0 ? 0.0 : seed % 3 == 1 ? 0.25 : 2.0;
    const Flight a = draw_flight(random), b = draw_flight(random);
    const double x = between(random, 0.0, 1.0), y = between(random, 0.0, 1.0),
                 u = between(random, 0.0, 4.0), v = between(random, 0.0, 4.0);
    const HalfExtent a_half{seed % 7 == 0 ? 0.0 : x, y}, b_half{u, v};
    const double start = std::max(a.time, b.time);
    const auto boxes = [&](long double t) {
      return box_gap(place(a, t, drag), a_half, place(b, t, drag), b_half);
    };
    const auto disc = [&](long double t) {
      return disc_gap(place(a, t, drag), a_half, place(b, t, drag), u);
    };
    const TimeSpan met = touching_boxes(a, a_half, b, b_half, drag);
    meetings += met.enters <= met.leaves ? 1 : 0;
    expect_same(met, boxes, start, seed);
    expect_same(touching_disc(a, a_half, b, u, drag), disc, start, seed);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(meetings, 300);
}

TEST(Flight, KnowsTouchingRestAndComingToRestShortOfIt) {
  const HalfExtent half{0.5, 0.5}, none;
  const Flight still{.x = 5.0, .y = 0.0};
  EXPECT_EQ(touching_boxes({.velocity_x = 1.0}, half, still, half, 0.0).enters, 4.0);
  EXPECT_EQ(touching_boxes({.velocity_x = 1.0}, half, still, half, 0.0).leaves, 6.0);
  EXPECT_EQ(touching_boxes({.y = 1.0, .velocity_x = 1.0}, half, still, half, 0.0).enters, 4.0)
      << "along an edge is touching";
  EXPECT_EQ(touching_boxes({.y = 1.0 + 1e-15, .velocity_x = 1.0}, half, still, half, 0.0).leaves,
            never);
  EXPECT_EQ(touching_boxes({.x = 4.5}, half, still, half, 0.0).leaves, -never) << "both rest";
  EXPECT_EQ(touching_boxes({.x = 1.0}, half, still, half, 0.0).leaves, never);
  EXPECT_EQ(touching_boxes({.velocity_x = 1.0}, half, still, half, 0.25).leaves, never)
      << "it comes to rest at 4 m, and is never quite there";
  EXPECT_NEAR(touching_boxes({.velocity_x = 2.0}, half, still, half, 0.25).enters,
              -std::log(1.0 - 0.25 * 2.0) / 0.25, 1e-12);
  EXPECT_NEAR(touching_disc({.velocity_x = 1.0}, none, still, 2.0, 0.0).enters, 3.0, 1e-15);
  EXPECT_NEAR(touching_disc({.y = 2.0, .velocity_x = 1.0}, none, still, 2.0, 0.0).enters, 5.0,
              1e-15)
      << "grazing";
  EXPECT_EQ(touching_disc({.velocity_x = -1.0}, none, still, 2.0, 0.0).leaves, never);
}

TEST(Swept, HoldsEveryPlaceOfAFlightUntilItsHorizonAndTellsTheTimes) {
  for (std::uint64_t seed = 1; seed <= 40 && !testing::Test::HasFatalFailure(); ++seed) {
    Random random(seed);
    const double drag = seed % 2 == 0 ? 0.0 : 0.5, horizon = 0.4;
    const auto filter = make_filter("region with swept(horizon=0.4)",
                                    {.world = {0.0, 0.0, side, side}, .drag = drag});
    std::map<Entity, Flight> flights;
    const Region view{5.0, 5.0, 9.0, 9.0};
    Pairs known;
    std::map<Entity, TimeSpan> stays;
    filter->set_subscription_region(0, view);
    for (int tick = 0; tick < 30; ++tick) {
      const double now = 0.1 * tick;
      filter->set_time(now);
      for (Entity id = 0; id < 30; ++id) {
        if (tick > 0 && between(random, 0.0, 1.0) < 0.9) continue;
        Flight flight = draw_flight(random);
        flight.x += 7.0, flight.y += 7.0, flight.time = now;
        if (tick == 0) filter->set_update_region(id, around(flight.x, flight.y, 0.25));
        filter->set_flight(id, flights[id] = flight);
      }
      for (const Change& change : filter->match())
        change.transition == Transition::entered ? void(known.insert({0, change.entity}))
                                                 : void(known.erase({0, change.entity}));
      for (const RelevanceInterval& stay : filter->relevance_intervals())
        stays[stay.entity] = {stay.enters, stay.leaves};
      for (const auto& [id, flight] : flights)
        for (double ahead = 0.0; ahead <= 0.1; ahead += 0.02) {
          const Flight at = at_time(flight, now + ahead, drag);
          const bool is_with = std::abs(at.x - 7.0) <= 2.25 && std::abs(at.y - 7.0) <= 2.25;
          ASSERT_LE(is_with, known.contains({0, id}))
              << "seed " << seed << ", entity " << id << " comes in between two matches";
          if (!known.contains({0, id}) || std::abs(now + ahead - stays[id].enters) < 1e-9 ||
              std::abs(now + ahead - stays[id].leaves) < 1e-9)
            continue;
          ASSERT_EQ(is_with, stays[id].enters <= now + ahead && now + ahead <= stays[id].leaves)
              << "seed " << seed << ", entity " << id;
        }
    }
    std::vector<StageCount> counts;
    filter->list_counts(counts);
    ASSERT_EQ(counts.size(), 3u);
    EXPECT_GT(counts[0].count, 80u);
    EXPECT_LT(counts[1].count, 30u * 30u * 2u / 3u)
        << "half of " << horizon << " s are two matches";
    EXPECT_GT(counts[2].count, 0u);
  }
}

TEST(Swept, TellsTheTimesAnewWhereEitherOfTwoTakesAnotherWay) {
  for (const bool turns_the_subscriber : {true, false}) {
    const auto filter =
        make_filter("region with swept(horizon=1)", {.world = {0.0, 0.0, 100.0, 100.0}});
    filter->set_update_region(0, around(50.0, 50.0, 0.0));
    filter->set_subscription_region(0, around(50.0, 50.0, 10.0));
    filter->set_flight(0, {.x = 50.0, .y = 50.0, .velocity_x = 2.0});
    filter->set_subscriber_flight(0, {.x = 50.0, .y = 50.0, .velocity_x = -3.0});
    filter->match();
    ASSERT_EQ(filter->relevance_intervals().size(), 1u);
    EXPECT_NEAR(filter->relevance_intervals()[0].leaves, 2.0, 1e-12) << "10 m at 5 m/s";
    filter->set_time(1.0);
    if (turns_the_subscriber)
      filter->set_subscriber_flight(0, {.x = 47.0, .y = 50.0, .velocity_x = 1.0, .time = 1.0});
    else filter->set_flight(0, {.x = 52.0, .y = 50.0, .velocity_x = -2.0, .time = 1.0});
    EXPECT_THAT(filter->match(), IsEmpty());
    ASSERT_EQ(filter->relevance_intervals().size(), 1u);
    EXPECT_NEAR(filter->relevance_intervals()[0].leaves, 6.0, 1e-12) << "5 m at 1 m/s either way";
  }
}

TEST(Swept, CostsNothingForWhoRests) {
  const auto filter =
      make_filter("aura with swept(horizon=1 disc=1)", {.world = {0.0, 0.0, 100.0, 100.0}});
  for (Entity id = 0; id < 100; ++id) filter->set_update_region(id, around(id, 50.0, 0.5));
  filter->set_subscription_region(0, around(50.0, 50.0, 10.0));
  for (Entity id = 0; id < 100; ++id)
    filter->set_flight(id, {.x = static_cast<double>(id), .y = 50.0});
  filter->match();
  EXPECT_EQ(filter->relevance_intervals().size(), 21u);
  const FilterCounters before = filter->counters();
  for (int tick = 1; tick < 10; ++tick) {
    filter->set_time(tick);
    for (Entity id = 0; id < 100; ++id)
      filter->set_flight(id, {.x = static_cast<double>(id), .y = 50.0});
    EXPECT_THAT(filter->match(), IsEmpty());
    EXPECT_THAT(filter->relevance_intervals(), IsEmpty());
  }
  EXPECT_EQ(filter->counters().pairs_tested, before.pairs_tested);
  EXPECT_EQ(filter->counters().regions_moved, before.regions_moved);
  filter->set_flight(30, {.x = 30.0, .y = 50.0, .velocity_x = 5.0, .time = 9.0});
  filter->match();
  EXPECT_THAT(filter->relevance_intervals(), IsEmpty())
      << "until its swept region reaches the disc";
  filter->set_time(10.5);
  EXPECT_THAT(filter->match(), ElementsAre(Change{0, 30, Transition::entered}));
  ASSERT_EQ(filter->relevance_intervals().size(), 1u);
  EXPECT_NEAR(filter->relevance_intervals()[0].enters, 10.9, 1e-12);
  EXPECT_NEAR(filter->relevance_intervals()[0].leaves, 15.1, 1e-12);
}

TEST(Swept, LetsTiersMeasureWhereThoseWhoFlyAre) {
  const auto filter = make_filter("region with swept(horizon=4) with tiers(at=0.5)",
                                  {.world = {0.0, 0.0, 100.0, 100.0}});
  filter->set_subscription_region(0, around(50.0, 50.0, 10.0));
  filter->set_update_region(0, around(42.0, 50.0, 0.0));
  filter->set_flight(0, {.x = 42.0, .y = 50.0, .velocity_x = 1.0});
  EXPECT_THAT(filter->match(), ElementsAre(Change{0, 0, Transition::entered, 1}));
  filter->set_time(2.9);
  EXPECT_THAT(filter->match(), IsEmpty());
  filter->set_time(3.0);
  EXPECT_THAT(filter->match(), ElementsAre(Change{0, 0, Transition::tier_changed, 0}))
      << "at 45, 5 from the middle";
}

/// Of who does not fly.
TEST(Swept, LetsConditionsSeeTheTimePass) {
  const auto filter =
      make_filter("when \"age < 1\" with swept(horizon=0.5)", {.world = {0.0, 0.0, 100.0, 100.0}});
  filter->set_subscription_region(0, around(50.0, 50.0, 10.0));
  filter->set_update_region(0, around(52.0, 50.0, 0.0));
  filter->set_time(2.0);
  filter->set_entity_facts(0, {.kind = EntityKind::puck, .changed_at = 2.0});
  EXPECT_THAT(filter->match(), ElementsAre(Change{0, 0, Transition::entered}));
  filter->set_time(2.9);
  EXPECT_THAT(filter->match(), IsEmpty());
  filter->set_time(3.1);
  EXPECT_THAT(filter->match(), ElementsAre(Change{0, 0, Transition::left}));
}

TEST(Swept, TakesARegionForTheEndOfAFlight) {
  const auto filter =
      make_filter("region with swept(horizon=10)", {.world = {0.0, 0.0, 100.0, 100.0}});
  filter->set_subscription_region(0, {50.0, 0.0, 60.0, 10.0});
  filter->set_flight(0, {.velocity_x = 1.0});  // nobody yet
  filter->set_update_region(0, {0.0, 5.0, 1.0, 6.0});
  filter->set_flight(0, {.x = 0.5, .y = 5.5, .velocity_x = 6.0});
  EXPECT_THAT(filter->match(), ElementsAre(Change{0, 0, Transition::entered}));
  filter->set_update_region(0, {0.0, 5.0, 1.0, 6.0});
  EXPECT_THAT(filter->match(), ElementsAre(Change{0, 0, Transition::left}));
  EXPECT_THAT(filter->relevance_intervals(), IsEmpty());
}

}  // namespace
}  // namespace rink::im
