// Pressed clusters that stand still: who stands with whom, until when, and as what they go on.
#include "game/physics/bodies/jams.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "game/physics/bodies/before_images.h"
#include "tests/physics/bodies/loose_bodies.h"

namespace rink::physics::test {
namespace {

std::vector<std::uint32_t> others_of(const Jams& jams, std::uint32_t body) {
  std::vector<std::uint32_t> others;
  jams.for_each_other(body, [&](std::uint32_t other) { others.push_back(other); });
  std::sort(others.begin(), others.end());
  return others;
}

using Members = std::vector<std::uint32_t>;

/// A row of bats 1 m apart, each driven towards the right at `thrust` and moving at 1 m/s.
LooseBodies& add_row(LooseBodies& loose, std::uint32_t count, double thrust) {
  for (std::uint32_t body = 0; body < count; ++body) {
    loose.add_bat({1.0 + body, 2.0}, {1.0, 0.0});
    loose.thrust(body, {thrust, 0.0});
  }
  return loose;
}

TEST(Jams, StandWhereTheyAreWhateverDrivesThem) {
  LooseBodies loose(rink_of(10, 4));
  add_row(loose, 3, 6.0);
  loose.jams.stop(Members{2, 0, 1});
  for (std::uint32_t body = 0; body < 3; ++body) {
    const Motion later = motion_at(loose.bodies, body, 7.0);
    EXPECT_EQ(later.position, Vector2(1.0 + body, 2.0));
    EXPECT_EQ(later.velocity, Vector2(0.0, 0.0));
  }
}

/// From the instant on at which one of them is woken, and from rest: x = a t^2/2 in free fall, and
/// a (t - (1 - exp(-g t))/g)/g under drag.
TEST(Jams, YieldToTheirThrustAgainOnceOneOfThemIsWoken) {
  for (const double drag : {0.0, 1.5}) {
    LooseBodies loose(rink_of(10, 4, 1.0, 0.0, drag));
    add_row(loose, 3, 6.0);
    loose.jams.stop(Members{0, 1, 2});
    loose.jams.wake(1, 2.0);
    const double t = 0.5, away = drag == 0.0
                                     ? 6.0 * t * t / 2.0
                                     : 6.0 * (t - (1.0 - std::exp(-drag * t)) / drag) / drag;
    for (std::uint32_t body = 0; body < 3; ++body)
      EXPECT_NEAR(motion_at(loose.bodies, body, 2.5).position.x(), 1.0 + body + away, 1e-14);
    EXPECT_TRUE(loose.jams.table().frozen.empty());
  }
}

/// And keep their hops, for the glide was one of them.
TEST(Jams, GlideAsTheyAreToldUntilOneOfThemIsWoken) {
  LooseBodies loose(rink_of(10, 4));
  add_row(loose, 3, 6.0);
  const Members members{2, 0, 1};
  loose.history.note_hop(members, 0.0);
  const std::vector<RealVector> accelerations{{0.0, 2.0}, {0.0, 0.0}, {0.0, 1.0}};
  loose.jams.glide(members, accelerations, 0.75);
  for (const std::uint32_t body : members) {
    const Motion later = motion_at(loose.bodies, body, 0.5);
    const double across = body == 2 ? 2.0 : body == 1 ? 1.0 : 0.0;
    EXPECT_EQ(later.position, Vector2(1.5 + body, 2.0 + 0.125 * across));
    EXPECT_EQ(later.velocity, Vector2(1.0, 0.5 * across));
    EXPECT_EQ(loose.history.last_hop(body), 0.75);
  }
  loose.jams.wake(0, 0.5);
  for (const std::uint32_t body : members) {
    EXPECT_EQ(loose.bodies.law(body).acceleration, Vector2(6.0, 0.0));
    EXPECT_EQ(loose.history.last_hop(body), 0.5);
    EXPECT_EQ(loose.history.hops(body), 1u);
  }
}

TEST(Jams, WakeAloneAndLeaveOtherJamsStanding) {
  LooseBodies loose(rink_of(10, 4));
  add_row(loose, 6, 6.0);
  loose.jams.stop(Members{0, 4}), loose.jams.stop(Members{5, 1, 2});
  EXPECT_EQ(others_of(loose.jams, 1), (Members{2, 5}));
  loose.jams.wake(4, 1.0);
  EXPECT_EQ(others_of(loose.jams, 0), Members{});
  EXPECT_EQ(others_of(loose.jams, 5), (Members{1, 2}));
  EXPECT_EQ(loose.jams.table().count, 2u);
  loose.jams.wake(3, 1.0);  // is in none
  EXPECT_EQ(loose.bodies[3].time, 0.0);
}

/// Who was stopped by hops begins a new series after it is woken.
TEST(Jams, ForgetTheHopsThatMadeThem) {
  LooseBodies loose(rink_of(10, 4));
  add_row(loose, 2, 6.0);
  loose.history.note_hop(Members{0, 1}, 0.0);
  loose.jams.stop(Members{0, 1});
  loose.jams.wake(0, 1e-6);
  EXPECT_EQ(loose.history.hops(0), 0u);
  EXPECT_EQ(loose.history.hops(1), 0u);
}

/// Handed to another world, a jam is the same one there; and a body that is handed on twice, or
/// awake, is listed once, or not at all.
TEST(Jams, AreTheSameInAnotherWorld) {
  LooseBodies here(rink_of(10, 4)), there(rink_of(10, 4));
  add_row(here, 4, 6.0), add_row(there, 4, 6.0);
  here.jams.stop(Members{3, 1}), here.jams.stop(Members{0, 2});
  const auto hand_over = [&](std::uint32_t body) {
    const BodyState state = state_of(body, here.bodies, here.history, here.jams);
    there.bodies.write(body, state);
    there.jams.write(body, state);
  };
  for (const std::uint32_t body : {2, 1, 0, 3, 1, 2}) hand_over(body);
  EXPECT_EQ(others_of(there.jams, 1), Members{3});
  EXPECT_EQ(others_of(there.jams, 2), Members{0});
  EXPECT_EQ(there.jams.table().frozen.size(), 4u);
  here.jams.wake(1, 1.0);
  hand_over(1), hand_over(3);
  EXPECT_EQ(others_of(there.jams, 3), Members{});
  EXPECT_EQ(there.jams.table().frozen.size(), 2u);
}

/// Against a list of who stands with whom.
TEST(Jams, KeepWhoStandsWithWhomThroughRandomStopsAndWakes) {
  constexpr std::uint64_t seed = 11;
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  constexpr std::uint32_t count = 40;
  std::mt19937_64 random(seed);
  LooseBodies loose(rink_of(100, 4));
  add_row(loose, count, 6.0);
  std::vector<Members> jams;
  const auto jam_of = [&](std::uint32_t body) {
    return std::find_if(jams.begin(), jams.end(), [&](const Members& jam) {
      return std::find(jam.begin(), jam.end(), body) != jam.end();
    });
  };
  for (int step = 0; step < 500; ++step) {
    const auto body = static_cast<std::uint32_t>(random() % count);
    if (const auto jam = jam_of(body); jam != jams.end()) {
      loose.jams.wake(body, step);
      jams.erase(jam);
    } else {
      Members members;
      for (std::uint32_t each = 0; each < count; ++each)
        if (jam_of(each) == jams.end() && (each == body || random() % 8 == 0))
          members.push_back(each);
      std::shuffle(members.begin(), members.end(), random);
      loose.jams.stop(members);
      jams.push_back(members);
    }
    for (std::uint32_t each = 0; each < count; ++each) {
      Members expected;
      if (const auto jam = jam_of(each); jam != jams.end()) expected = *jam;
      EXPECT_EQ(loose.bodies[each].is(Body::frozen), !expected.empty());
      std::erase(expected, each);
      std::sort(expected.begin(), expected.end());
      ASSERT_EQ(others_of(loose.jams, each), expected) << "step " << step << ", body " << each;
    }
  }
}

}  // namespace
}  // namespace rink::physics::test
