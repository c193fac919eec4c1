// Discs in straight flight: whom one of them meets first, asked two at a time or one by one.
#include "game/physics/flight/straight_flight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "tests/physics/scenes.h"

namespace rink::physics {
namespace {

using test::uniform;

/// Some overlap, some lie still, some are copies of each other.
std::vector<Flight> crowd_of(std::mt19937_64& random, std::uint32_t count) {
  std::vector<Flight> discs;
  for (std::uint32_t k = 0; k < count; ++k) {
    if (k > 1 && random() % 8 == 0) {
      discs.push_back(discs[1 + random() % (k - 1)]);
      continue;
    }
    const double speed = random() % 8 == 0 ? 0.0 : 1.0;
    discs.push_back({uniform(random, -0.3, 0.3), uniform(random, -0.3, 0.3),
                     speed * uniform(random, -2.0, 2.0), speed * uniform(random, -2.0, 2.0),
                     uniform(random, 0.0, 0.05), uniform(random, 0.01, 0.06)});
  }
  return discs;
}

TEST(FirstMeeting, HasTheSameBitsTwoOrFourAtATimeAsOneByOne) {
  std::mt19937_64 random(5);
  int met = 0, tied = 0;
  for (int round = 0; round < 20'000; ++round) {
    const auto count = static_cast<std::uint32_t>(random() % (flight_max + 1));
    const std::vector<Flight> discs = crowd_of(random, count + 1);
    std::vector<std::uint32_t> near;
    for (std::uint32_t k = 0; k < count; ++k)
      near.push_back(static_cast<std::uint32_t>(random() % discs.size()));
    near.resize(flight_max + 8);
    const double latest =
        round % 3 == 0 ? std::numeric_limits<double>::infinity() : uniform(random, 0.05, 0.4);
    const FirstContact expected =
        first_disc_contact_singly(discs.data(), 0, near.data(), count, latest);
    const FirstContact first = first_disc_contact(discs.data(), 0, near.data(), count, latest);
    ASSERT_EQ(first.time, expected.time) << "round " << round;
    ASSERT_EQ(first.other, expected.other) << "round " << round;
    ASSERT_EQ(first.second_time, expected.second_time) << "round " << round;
#if defined(__SSE2__)
    const FirstContact in_pairs =
        first_disc_contact_in_pairs(discs.data(), 0, near.data(), count, latest);
    ASSERT_EQ(in_pairs.time, expected.time) << "round " << round;
    ASSERT_EQ(in_pairs.second_time, expected.second_time) << "round " << round;
#endif
    met += expected.time < std::numeric_limits<double>::infinity();
    tied += expected.time < std::numeric_limits<double>::infinity() &&
            expected.time == expected.second_time;
  }
  EXPECT_GT(met, 5'000);
  EXPECT_GT(tied, 500);
}

TEST(FirstMeeting, CountsThoseWhoTouchInTheSameBreath) {
  if (!counts_touching()) GTEST_SKIP() << "this processor takes two at a time at most";
  std::mt19937_64 random(9);
  std::uint32_t touched = 0, apart = 0;
  for (int round = 0; round < 20'000; ++round) {
    const auto count = static_cast<std::uint32_t>(random() % (flight_max + 1));
    std::vector<Flight> discs = crowd_of(random, count + 1);
    Flight& own = discs[0];
    own.time = 0.1;  // nobody's event is later, as at an impact
    // Every third is put where it is nearly in touch then.
    for (std::uint32_t k = 1; k <= count; k += 3) {
      Flight& other = discs[k];
      const double angle = uniform(random, 0.0, 6.3),
                   distance = own.radius + other.radius +
                              clear_of_touching * (random() % 2 == 0 ? uniform(random, -0.1, 0.9)
                                                                     : uniform(random, 1.1, 3.0));
      other.x = own.x + distance * std::cos(angle) - other.vx * (0.1 - other.time),
      other.y = own.y + distance * std::sin(angle) - other.vy * (0.1 - other.time);
    }
    std::vector<std::uint32_t> near;
    for (std::uint32_t k = 0; k < count; ++k) near.push_back(k);
    near.resize(flight_max + 8);
    std::uint32_t expected = 0;
    for (std::uint32_t k = 0; k < count; ++k) {
      const Flight& other = discs[k];
      const double distance = std::hypot(other.x + other.vx * (0.1 - other.time) - own.x,
                                         other.y + other.vy * (0.1 - other.time) - own.y);
      expected += k == 0 || distance <= own.radius + other.radius + clear_of_touching;
    }
    const FirstContact plain = first_disc_contact(discs.data(), 0, near.data(), count, 1.0),
                       counting =
                           first_disc_contact_counting(discs.data(), 0, near.data(), count, 1.0);
    ASSERT_EQ(counting.touching, expected) << "round " << round;
    ASSERT_EQ(counting.time, plain.time) << "round " << round;
    ASSERT_EQ(counting.other, plain.other) << "round " << round;
    ASSERT_EQ(counting.second_time, plain.second_time) << "round " << round;
    touched += expected, apart += count - expected;
  }
  EXPECT_GT(touched, 20'000u);
  EXPECT_GT(apart, 20'000u);
}

TEST(FirstMeeting, OfEachOfManyHasTheBitsOfThoseAskedOneByOne) {
  if (!visits_meetings()) GTEST_SKIP() << "this processor takes two at a time at most";
  constexpr double never = std::numeric_limits<double>::infinity();
  std::mt19937_64 random(10);
  std::uint32_t met = 0;
  for (int round = 0; round < 5'000; ++round) {
    const auto count = static_cast<std::uint32_t>(random() % (flight_max + 1));
    const std::vector<Flight> discs = crowd_of(random, count + 1);
    std::vector<std::uint32_t> near;
    for (std::uint32_t k = 1; k <= count; ++k) near.push_back(k);
    near.resize(flight_max + 8);
    std::vector<double> times(count + 1, never);
    visit_meetings(discs.data(), 0, near.data(), count,
                   [&](std::uint32_t other, double time) { times[other] = time; });
    for (std::uint32_t k = 1; k <= count; ++k) {
      ASSERT_EQ(times[k], disc_contact_time(discs[0], discs[k], never).value_or(never));
      ASSERT_EQ(times[k], disc_contact_time(discs[k], discs[0], never).value_or(never));
      met += times[k] < never;
    }
  }
  EXPECT_GT(met, 5'000u);
}

/// Discs that graze each other at a gap of some roundings: what the best event known happens to be
/// decides nothing but whether the meeting comes too late.
TEST(FirstMeeting, OfThoseWhoGrazeDoesNotDependOnHowFarOneLooks) {
  std::mt19937_64 random(8);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  int met = 0, hardly_closing = 0;
  for (int round = 0; round < 200'000; ++round) {
    const double angle = uniform(random, 0.0, 6.3), reach = uniform(random, 0.02, 0.1),
                 distance = reach * (1.0 + 1e-16 * static_cast<double>(random() % 20));
    const double speed = uniform(random, 0.01, 2.0),
                 across = 1e-16 * static_cast<double>(random() % 5),
                 along = random() % 2 == 0 ? speed : -speed;
    const double x = std::cos(angle), y = std::sin(angle);
    const std::vector<Flight> discs{
        {0.5, 0.5, 0.0, 0.0, 0.3, 0.5 * reach},
        {0.5 + distance * x, 0.5 + distance * y, -along * y - across * x, along * x - across * y,
         0.3, 0.5 * reach}};
    std::vector<std::uint32_t> near{1, 0, 0, 0};
    const FirstContact ever = first_disc_contact_singly(discs.data(), 0, near.data(), 1, infinity);
    const double closing =
        (discs[1].x - discs[0].x) * discs[1].vx + (discs[1].y - discs[0].y) * discs[1].vy;
    if (!(ever.time < infinity && ever.time > 0.3 + 1e-12)) continue;
    ++met, hardly_closing += std::abs(closing) < 1e-17;
    const double wait = ever.time - 0.3;
    for (const double share : {0.5, 0.9, 1.1, 2.0, 1e3, 1e9}) {
      const double latest = 0.3 + share * wait,
                   expected = wait <= latest - 0.3 ? ever.time : infinity;
      ASSERT_EQ(first_disc_contact_singly(discs.data(), 0, near.data(), 1, latest).time, expected)
          << "round " << round << ", share " << share;
      ASSERT_EQ(first_disc_contact(discs.data(), 0, near.data(), 1, latest).time, expected)
          << "round " << round << ", share " << share;
#if defined(__SSE2__)
      ASSERT_EQ(first_disc_contact_in_pairs(discs.data(), 0, near.data(), 1, latest).time, expected)
          << "round " << round << ", share " << share;
#endif
    }
  }
  EXPECT_GT(met, 2'000);
  EXPECT_GT(hardly_closing, 300);
}

TEST(FirstMeeting, IsWhereTheDistanceIsTheSumOfTheRadii) {
  std::mt19937_64 random(6);
  for (int round = 0; round < 2'000; ++round) {
    const std::vector<Flight> discs = crowd_of(random, 12);
    std::vector<std::uint32_t> near{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 0, 0, 0};
    const FirstContact first = first_disc_contact(discs.data(), 0, near.data(), 11,
                                                  std::numeric_limits<double>::infinity());
    if (first.other > 11) continue;
    const Flight &a = discs[0], &b = discs[first.other];
    const double distance =
        std::hypot(b.x + b.vx * (first.time - b.time) - a.x - a.vx * (first.time - a.time),
                   b.y + b.vy * (first.time - b.time) - a.y - a.vy * (first.time - a.time));
    EXPECT_LE(distance, (a.radius + b.radius) * (1.0 + 1e-12));
    if (first.time > std::max(a.time, b.time)) {
      EXPECT_NEAR(distance, a.radius + b.radius, 1e-12) << "round " << round;
    }
  }
}

TEST(APuck, MeetsTheSameOthersWhetherOrNotABatIsSomewhere) {
  const auto gas = [](bool has_bat) {
    World world(test::rink_of(4.0, 2.0));
    std::mt19937_64 random(7);
    const std::vector<BodyId> pucks = test::scatter_pucks(world, random, 150);
    BatSpec bat;
    bat.position = {3.9, 1.9};
    bat.half_extent = {0.05, 0.05};
    bat.mass = 1e9;  // stays where it is
    for (const BodyId puck : pucks)
      if ((world.position(puck) - bat.position).norm() < 0.5) world.remove(puck);
    PostSpec fence;
    fence.radius = 0.03;
    for (int k = 0; k < 6; ++k) {
      fence.position = {3.75, 1.97 - 0.06 * k};
      if (world.is_free(fence.position, fence.radius)) world.add(fence);
      fence.position = {3.97 - 0.06 * k, 1.7};
      if (world.is_free(fence.position, fence.radius)) world.add(fence);
    }
    if (has_bat) world.add(bat);
    world.advance(3.0);
    std::vector<double> states;
    for (const BodyId puck : pucks)
      for (const double value : {world.position(puck).x(), world.position(puck).y(),
                                 world.velocity(puck).x(), world.velocity(puck).y()})
        states.push_back(value);
    return states;
  };
  EXPECT_EQ(gas(false), gas(true));
}

}  // namespace
}  // namespace rink::physics
