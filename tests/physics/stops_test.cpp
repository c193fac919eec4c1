// Throngs of bats that press each other, pucks, walls and posts under keys: not a digit depends on
// where advance() stops, not even between two keys of one instant.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <utility>

#include "tests/physics/scenes.h"

namespace rink::physics::test {
namespace {

/// A field half full of bats, with pucks and posts between them; scene `number` of many.
class Throng {
 public:
  explicit Throng(std::uint64_t number) : number_(number) {
    static const double restitutions[] = {0.2, 0.0, 0.5, 0.95, 1.0};
    spec_ = rink_of(4.0, 2.0, restitutions[number % 5], number % 2 == 0 ? 0.25 : 0.0,
                    number % 3 == 2 ? 0.0 : 3.0);
    if (number % 4 == 3) spec_.puck_friction = 0.6;
    if (number % 8 == 4)
      spec_.surface_friction = SurfaceFriction{PairTable(1, 0.2), RestitutionTable(1, 0.3)};
  }

  World world() const {
    World world(spec_);
    std::mt19937_64 random(number_);
    scatter_posts(world, random, 3);
    const double mass_min = number_ % 2 == 0 ? 5.0 : 0.1;
    for (int tries = 0; tries < 400; ++tries) {
      BatSpec bat;
      const double x = uniform(random, 0.2, 3.8), y = uniform(random, 0.2, 1.8),
                   along = uniform(random, 0.05, 0.2), across = uniform(random, 0.05, 0.2);
      bat.position = {x, y}, bat.half_extent = {along, across};
      bat.mass = mass_min * std::pow(5.0 / mass_min, uniform(random, 0.0, 1.0));
      if (world.body_count() < 43 && world.is_free(bat.position, bat.half_extent)) world.add(bat);
    }
    scatter_pucks(world, random, 20, 0.1, 0.1);
    return world;
  }

  struct Bunch {
    double time;
    std::vector<std::pair<BodyId, Vector2>> keys;  // of one instant, in order
  };
  /// Neighbours' keys together, for they are in one another's way.
  std::vector<Bunch> keys(const World& world, double duration) const {
    std::vector<BodyId> bats;
    for (BodyId body; body.index < world.body_count(); ++body.index)
      if (world.kind(body) == BodyKind::bat) bats.push_back(body);
    std::sort(bats.begin(), bats.end(), [&](BodyId a, BodyId b) {
      return world.position(a).sum() < world.position(b).sum();
    });
    std::mt19937_64 random(number_ + 1'000'000);
    std::vector<Bunch> bunches;
    for (double time = 0.0; time < duration; time += uniform(random, 0.0, 0.04)) {
      Bunch bunch{time, {}};
      const std::size_t first = random() % bats.size(), count = 1 + random() % 8;
      for (std::size_t k = 0; k < count; ++k) {
        const double x = static_cast<double>(random() % 3) - 1.0,
                     y = static_cast<double>(random() % 3) - 1.0;
        bunch.keys.emplace_back(bats[(first + random() % 5) % bats.size()], 4.9 * Vector2(x, y));
      }
      bunches.push_back(std::move(bunch));
    }
    return bunches;
  }

 private:
  std::uint64_t number_;
  WorldSpec spec_;
};

/// Every double that World tells of a body.
std::vector<double> states(const World& world) {
  std::vector<double> all;
  for (BodyId body; body.index < world.body_count(); ++body.index) {
    const Motion m = world.motion(body);
    for (const Vector2& pair : {m.position, m.velocity, m.acceleration, m.drag})
      all.insert(all.end(), {pair.x(), pair.y()});
    all.insert(all.end(), {m.time, world.spin(body), world.is_held(body) ? 1.0 : 0.0});
  }
  return all;
}

struct Tally {
  Counters events;
  std::uint64_t stops = 0, stops_between_keys = 0, restored = 0;
};

/// Stops at random, at keys and between those of one instant; asks about everything there; now and
/// then goes on as another world.
void advance_with_stops(World& world, double until, std::mt19937_64& stops, Tally& tally) {
  while (world.now() < until && stops() % 3 != 0) {
    world.advance(std::min(until, world.now() + uniform(stops, 0.0, 0.02)));
    ++tally.stops;
    if (stops() % 4 == 0) {
      EXPECT_GE(world.kinetic_energy() + world.momentum().norm() + world.max_overlap(), 0.0);
    }
    if (stops() % 16 != 0) continue;
    std::optional<World> restored = World::restore(world.save());
    ASSERT_TRUE(restored);
    world = std::move(*restored);
    ++tally.restored;
  }
  world.advance(until);
}

void expect_same_with_stops(std::uint64_t number, double duration, Tally& tally) {
  SCOPED_TRACE(testing::Message() << "throng " << number);
  const Throng throng(number);
  World once = throng.world(), often = throng.world();
  std::mt19937_64 stops(number + 7);
  for (const Throng::Bunch& bunch : throng.keys(once, duration)) {
    once.advance(bunch.time);
    advance_with_stops(often, bunch.time, stops, tally);
    for (const auto& [bat, thrust] : bunch.keys) {
      once.set_thrust(bat, thrust);
      often.set_thrust(bat, thrust);
      if (stops() % 2 == 0) continue;
      often.advance(bunch.time);
      ++tally.stops_between_keys;
    }
  }
  once.advance(duration);
  advance_with_stops(often, duration, stops, tally);
  EXPECT_EQ(states(once), states(often));
  EXPECT_EQ(once.hash(), often.hash());
  for (const auto counter : counter_of_kind) tally.events.*counter += once.counters().*counter;
  tally.events.joint_impacts += once.counters().joint_impacts;
}

void expect_same_with_stops(std::uint64_t first, std::uint64_t last, double duration) {
  Tally tally;
  for (std::uint64_t number = first; number < last && !testing::Test::HasFailure(); ++number)
    ASSERT_NO_FATAL_FAILURE(expect_same_with_stops(number, duration, tally));
  const Counters& c = tally.events;
  std::cout << tally.stops << " stops, " << tally.stops_between_keys
            << " between keys of one instant, " << tally.restored << " restored; " << c.events()
            << " events, " << c.rests << " rests, " << c.releases << " releases, " << c.hops
            << " hops, " << c.freezes << " freezes, " << c.turns << " turns of friction, "
            << c.bat_bat_impacts << " impacts of bats\n";
  for (const std::uint64_t count : {tally.stops, tally.stops_between_keys, tally.restored, c.rests,
                                    c.releases, c.hops, c.freezes, c.turns, c.bat_bat_impacts})
    EXPECT_GT(count, 10u);
}

TEST(Stops, ChangeNothingInThirtyThrongs) { expect_same_with_stops(0, 30, 2.0); }

/// A thousand throngs in ten parts.
class StopsLong : public testing::TestWithParam<std::uint64_t> {};

TEST_P(StopsLong, ChangeNothingInHundredThrongs) {
  const std::uint64_t first = 1000 + 100 * GetParam();
  expect_same_with_stops(first, first + 100, 6.0);
}

INSTANTIATE_TEST_SUITE_P(Part, StopsLong, testing::Range<std::uint64_t>(0, 10));

}  // namespace
}  // namespace rink::physics::test
