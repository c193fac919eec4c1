// The engines that step from frame to frame, beside each other and the exact one: fast pucks,
// random keys, recorded events and stops.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "game/physics/simulator_choice.h"
#include "tests/physics/play.h"
#include "tests/physics/scenes.h"

namespace rink::physics {
namespace {

using test::integrators;
using test::play;
using test::rink_of;
using test::uniform;

/// Figure 5 of the paper: a puck that crosses an obstacle within one frame.
class FastPucks : public ::testing::TestWithParam<const char*> {
 protected:
  /// Where a puck of 0.02 m is 0.1 s after it was shot along the middle at an obstacle at x = 2.
  template <class Obstacle>
  double shot_at(const Obstacle& obstacle) {
    const auto simulator =
        make_simulator(rink_of(40.0, 2.0), {.engine = GetParam(), .dt = 1.0 / 60});
    simulator->add(obstacle);
    const BodyId puck = simulator->add(
        PuckSpec{.position = {1.0, 1.0}, .velocity = {45.0, 0.0}, .radius = 0.02, .mass = 1e-3});
    play(*simulator, 0.1);
    return simulator->position(puck).x();
  }
  static bool is_naive() { return std::string(GetParam()) == "naive"; }
};

TEST_P(FastPucks, PassThroughAThinBatOnlyWhereContactsAreTestedAtTheEndsOfFrames) {
  const double x =
      shot_at(BatSpec{.position = {2.0, 1.0}, .half_extent = {0.02, 0.1}, .mass = 1e6});
  if (is_naive()) {
    EXPECT_NEAR(x, 1.0 + 45.0 * 0.1, 1e-9);
  } else {
    EXPECT_LT(x, 2.0);
  }
}

TEST_P(FastPucks, PassThroughAPostOnlyWhereContactsAreTestedAtTheEndsOfFrames) {
  const double x = shot_at(PostSpec{.position = {2.0, 1.0}, .radius = 0.05});
  if (is_naive()) {
    EXPECT_NEAR(x, 1.0 + 45.0 * 0.1, 1e-9);
  } else {
    EXPECT_LT(x, 2.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Engines, FastPucks, ::testing::Values("exact", "paper", "naive"),
                         [](const auto& engine) { return std::string(engine.param); });

TEST(NaiveEngine, BouncesSlowPucksAsTheOthersDoButLate) {
  const auto simulator = make_simulator(rink_of(4.0, 2.0), {.engine = "naive", .dt = 1.0 / 60});
  const BodyId left = simulator->add(PuckSpec{.position = {1.0, 1.0}, .velocity = {0.5, 0.0}}),
               right = simulator->add(PuckSpec{.position = {3.0, 1.0}, .velocity = {-0.5, 0.0}});
  play(*simulator, 3.0);
  EXPECT_EQ(simulator->velocity(left), Vector2(-0.5, 0.0));
  EXPECT_EQ(simulator->velocity(right), Vector2(0.5, 0.0));
  EXPECT_EQ(simulator->counters().disc_impacts, 1u);
  EXPECT_NEAR(simulator->position(left).x(), 2.0 - 0.04 - 0.5 * (3.0 - 1.92), 1.0 / 60);
}

/// 12 pucks, 4 bats and 3 posts in a field with goals and a halfway line.
std::unique_ptr<Simulator> busy_rink(const SimulatorChoice& choice, double restitution,
                                     std::vector<BodyId>& bats, std::uint64_t seed) {
  WorldSpec spec = rink_of(2.0, 1.2, restitution, 0.1, 3.0);
  spec.field.goal_width = 0.4;
  spec.field.bats_keep_to_half = true;
  auto simulator = make_simulator(spec, choice);
  simulator->add(PostSpec{.position = {1.0, 0.2}, .radius = 0.08});
  simulator->add(PostSpec{.position = {1.0, 1.0}, .radius = 0.0});
  simulator->add(PostSpec{.position = {1.0, 0.6}, .radius = 0.03});
  std::mt19937_64 random(seed);
  for (const double x : {0.3, 0.6, 1.4, 1.7})
    bats.push_back(simulator->add(BatSpec{.position = {x, 0.6},
                                          .half_extent = {0.04, 0.09},
                                          .mass = 0.5,
                                          .half = x < 1.0 ? Half::left : Half::right}));
  for (int tries = 0; simulator->body_count() < 19 && tries < 10000; ++tries) {
    const Vector2 place(uniform(random, 0.04, 1.96), uniform(random, 0.04, 1.16));
    if (simulator->is_free(place, 0.04))
      simulator->add(PuckSpec{.position = place,
                              .velocity = {uniform(random, -2.0, 2.0), uniform(random, -2.0, 2.0)},
                              .mass = 0.1});
  }
  return simulator;
}

/// Presses keys at random times and puts scored pucks back; stops `extra_stops` times more often
/// than it must.
void play_keys(Simulator& simulator, const std::vector<BodyId>& bats, double until,
               std::uint64_t seed, int extra_stops) {
  std::mt19937_64 random(seed);
  double next = 0.0;
  std::vector<BodyId> scored;
  const auto go_on = [&](double time) {
    while (const auto goal = simulator.advance(time)) scored.push_back(goal->puck);
  };
  while (next < until) {
    for (int stop = 1; stop <= extra_stops; ++stop)
      go_on(simulator.now() + (next - simulator.now()) * stop / (extra_stops + 1.0));
    go_on(next);
    const double x = static_cast<double>(random() % 3) - 1.0,
                 y = static_cast<double>(random() % 3) - 1.0;
    simulator.set_thrust(bats[random() % bats.size()], {8.0 * x, 8.0 * y});
    for (std::size_t i = 0; i < scored.size();) {
      const Vector2 spot(1.0 + 0.1 * static_cast<double>(i), 0.4);
      if (simulator.is_free(spot, 0.04))
        simulator.place(scored[i], spot, {0.0, 0.0}),
            scored.erase(scored.begin() + static_cast<std::ptrdiff_t>(i));
      else ++i;
    }
    next += uniform(random, 0.0, 0.2);
  }
  go_on(until);
}

TEST(Simulators, RecordEveryEventThatTheyCount) {
  for (const char* engine : {"exact", "paper", "naive"}) {
    std::vector<BodyId> bats;
    const auto simulator = busy_rink({.engine = engine}, 0.5, bats, 4);
    simulator->record_events(true);
    play_keys(*simulator, bats, 20.0, 4, 0);
    Counters seen;
    double time = 0.0;
    for (const Event& event : simulator->events()) {
      ++seen.of(event.kind);
      EXPECT_GE(event.time, time) << engine;
      time = event.time;
    }
    Counters counted = simulator->counters();
    for (std::size_t kind = 0; kind < event_kind_names.size(); ++kind)
      EXPECT_EQ(seen.of(static_cast<EventKind>(kind)), counted.of(static_cast<EventKind>(kind)))
          << engine << ' ' << event_kind_names[kind];
    EXPECT_GT(seen.impacts(), 200u) << engine;
  }
}

TEST(SteppedEngines, GiveTheSameBitsWhereverTheyStop) {
  for (const char* engine : {"paper", "naive"})
    for (const char* integrator : integrators) {
      std::vector<std::uint64_t> hashes;
      for (const int extra_stops : {0, 1, 7}) {
        std::vector<BodyId> bats;
        const auto simulator =
            busy_rink({.engine = engine, .integrator = integrator, .dt = 1.0 / 60}, 0.8, bats, 3);
        play_keys(*simulator, bats, 5.0, 9, extra_stops);
        hashes.push_back(simulator->hash());
      }
      EXPECT_EQ(hashes[0], hashes[1]) << engine << ' ' << integrator;
      EXPECT_EQ(hashes[0], hashes[2]) << engine << ' ' << integrator;
    }
}

TEST(PapersEngine, LetsNothingEscapeOrOverlapUnderRandomKeysWithExplicitEuler) {
  for (const double restitution : {0.0, 0.5, 0.9, 1.0})
    for (const std::uint64_t seed : {1, 2, 3}) {
      std::vector<BodyId> bats;
      const auto simulator =
          busy_rink({.engine = "paper", .dt = 1.0 / 60}, restitution, bats, seed);
      play_keys(*simulator, bats, 10.0, seed + 100, 0);
      EXPECT_EQ(escape_count(*simulator), 0u) << restitution << ", seed " << seed;
      EXPECT_LT(simulator->max_overlap(), 1e-3) << restitution << ", seed " << seed;
      EXPECT_TRUE(std::isfinite(simulator->kinetic_energy()));
    }
}

}  // namespace
}  // namespace rink::physics
