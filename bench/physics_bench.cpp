// Impacts per second of the exact rink among bats, posts and goals, and among bodies at rest; each
// with the error it makes.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "bench/gas.h"
#include "game/physics/world.h"

namespace rink::bench::physics_bench {
namespace {

using rink::physics::BatSpec;
using rink::physics::BodyId;
using rink::physics::Counters;
using rink::physics::PostSpec;
using rink::physics::PuckSpec;
using rink::physics::Vector2;
using rink::physics::World;
using rink::physics::WorldSpec;
using namespace gas_scene;

/// The same gas with one bat and one post per hundred pucks, and two goals; no drag and no thrust,
/// so that energy is kept. Pucks that score come back where there is room.
class Match {
 public:
  Match(int count, double packing) : world_(spec_of(count, packing)) {
    const double side = world_.spec().field.length;
    for (int i = 0; i < count / 100;) {
      BatSpec bat;
      bat.half_extent = {0.04, 0.1};
      bat.mass = 3.0;
      bat.position = anywhere(side);
      bat.velocity = 0.5 * seeded_.velocity();
      if (world_.is_free(bat.position, 1.5 * bat.half_extent)) world_.add(bat), ++i;
    }
    for (int i = 0; i < count / 100;) {
      PostSpec post;
      post.radius = 0.05;
      post.position = anywhere(side);
      if (world_.is_free(post.position, 1.5 * post.radius)) world_.add(post), ++i;
    }
    const int columns = static_cast<int>(std::ceil(std::sqrt(1.2 * count)));
    for (int cell = 0, placed = 0; cell < columns * columns && placed < count; ++cell) {
      PuckSpec puck;
      puck.position = Vector2(cell % columns + 0.5, cell / columns + 0.5) * (side / columns);
      puck.velocity = seeded_.velocity();
      if (world_.is_free(puck.position, radius)) world_.add(puck), ++placed;
    }
    advance(4.0 / collision_rate(packing));
  }

  World& world() { return world_; }
  void advance(double duration) {
    const double until = world_.now() + duration;
    while (const auto goal = world_.advance(until)) out_.push_back(goal->puck);
    for (int tries = place_tries; tries > 0 && !out_.empty(); --tries) {
      const Vector2 place = anywhere(world_.spec().field.length);
      if (!world_.is_free(place, radius)) continue;
      const double speed = world_.velocity(out_.back()).norm(),
                   angle = seeded_.uniform(0.0, 2.0 * std::numbers::pi);
      world_.place(out_.back(), place, Vector2(std::cos(angle), std::sin(angle)) * speed);
      out_.pop_back();
    }
  }
  /// Of the pucks that wait outside as well.
  double energy() const {
    double sum = world_.kinetic_energy();
    for (const BodyId puck : out_)
      sum += 0.5 * world_.mass(puck) * world_.velocity(puck).squaredNorm();
    return sum;
  }

 private:
  /// Enough at every packing that hardly anybody waits outside: fewer pucks would be another scene.
  static constexpr int place_tries = 100;

  static WorldSpec spec_of(int count, double packing) {
    WorldSpec spec;
    spec.field.length = spec.field.width = side_of(count, packing);
    spec.field.goal_width = 0.5;
    return spec;
  }
  Vector2 anywhere(double side) {
    return {seeded_.uniform(0.15, side - 0.15), seeded_.uniform(0.15, side - 0.15)};
  }

  World world_;
  Seeded seeded_{3};
  std::vector<BodyId> out_;
};

/// Pucks of radius 0.04 on a lattice of 0.2 m; `moving` of them in a corner move, fenced in by a
/// row of posts, the rest lie still.
World resting(int count, int moving) {
  const int columns = static_cast<int>(std::ceil(std::sqrt(count))),
            pen = static_cast<int>(std::ceil(std::sqrt(moving)));
  WorldSpec spec;
  spec.field.length = spec.field.width = 0.2 * columns + 0.2;
  spec.cell_size = 0.25;  // the same cells around the pen, however large the field is
  World world(spec);
  Seeded seeded{4};
  const auto place = [&](int index) { return 0.2 * index + (index < pen ? 0.1 : 0.3); };
  for (int k = 0; k < count; ++k) {
    PuckSpec puck;
    puck.position = {place(k % columns), place(k / columns)};
    if (k % columns < pen && k / columns * pen + k % columns < moving)
      puck.velocity = seeded.velocity();
    world.add(puck);
  }
  const double fence = 0.2 * pen + 0.1;
  for (int k = 0; 0.12 * k < fence && moving < count; ++k) {
    PostSpec post;
    post.radius = 0.05;
    post.position = {fence, 0.12 * k + 0.05};
    world.add(post);
    std::swap(post.position.x(), post.position.y());
    if (world.is_free(post.position, post.radius)) world.add(post);
  }
  world.advance(0.0);
  return world;
}

/// Items are impacts of any kind.
void match_events(benchmark::State& state, int count, double packing) {
  const auto match = kept<std::pair<int, double>, std::shared_ptr<Match>>(
      {count, packing}, [&] { return std::make_shared<Match>(count, packing); });
  World& world = match->world();
  const double energy = match->energy(), step = step_of(count, packing);
  const std::uint64_t before = world.counters().impacts();
  for (auto _ : state) match->advance(step);
  state.SetItemsProcessed(static_cast<std::int64_t>(world.counters().impacts() - before));
  state.counters["energy_error"] = match->energy() / energy - 1.0;
  state.counters["max_overlap"] = world.max_overlap();
}

/// One step is 10 ms. The counters are those of the first simulated second: equal for equal movers,
/// whoever else lies on the field.
void at_rest(benchmark::State& state, int count, int moving) {
  World world = resting(count, moving);
  const Counters before = world.counters();
  world.advance(1.0);
  const Counters& after = world.counters();
  state.counters["events"] = static_cast<double>(after.events() - before.events());
  state.counters["predictions"] = static_cast<double>(after.predictions - before.predictions);
  state.counters["bodies_touched"] =
      static_cast<double>(after.bodies_touched - before.bodies_touched);
  for (auto _ : state) world.advance(world.now() + 0.01);
  state.counters["max_overlap"] = world.max_overlap();
}

/// The relative change of energy over ten million collisions.
void energy_drift(benchmark::State& state, int count, double packing) {
  World world = gas(count, packing);
  const double energy = world.kinetic_energy();
  const std::uint64_t before = world.counters().disc_impacts;
  for (auto _ : state)
    while (world.counters().disc_impacts - before < 10'000'000) world.advance(world.now() + 1.0);
  state.SetItemsProcessed(static_cast<std::int64_t>(world.counters().disc_impacts - before));
  state.counters["energy_error"] = world.kinetic_energy() / energy - 1.0;
}

/// A frame of 1/60 s of a match for two: a puck, two bats under keys that change ten times per
/// second, drag, goals.
void two_player_step(benchmark::State& state) {
  WorldSpec spec;
  spec.field.length = 2.0;
  spec.field.width = 1.0;
  spec.field.goal_width = 0.3;
  spec.field.bats_keep_to_half = true;
  spec.puck_drag = 0.2;
  spec.bat_drag = 1.0;
  spec.restitution = rink::physics::RestitutionTable(1, 0.9);
  World world(spec);
  Seeded seeded{5};
  std::vector<BodyId> bats;
  for (const bool is_left : {true, false}) {
    BatSpec bat;
    bat.half_extent = {0.04, 0.1};
    bat.mass = 3.0;
    bat.position = {is_left ? 0.4 : 1.6, 0.5};
    bat.half = is_left ? rink::physics::Half::left : rink::physics::Half::right;
    bats.push_back(world.add(bat));
  }
  PuckSpec puck;
  puck.position = {1.0, 0.5};
  puck.velocity = {1.0, 0.3};
  puck.mass = 0.2;
  const BodyId id = world.add(puck);
  std::uint64_t frame = 0;
  for (auto _ : state) {
    if (frame++ % 6 == 0) {
      const auto axis = [&] { return 6.0 * (static_cast<double>(seeded.next() % 3) - 1.0); };
      const double x = axis(), y = axis();
      world.set_thrust(bats[seeded.next() % 2], {x, y});
    }
    const double until = world.now() + 1.0 / 60.0;
    while (world.advance(until)) {
    }
    if (!world.is_in_play(id) && world.is_free({1.0, 0.5}, puck.radius))
      world.place(id, {1.0, 0.5}, {seeded.uniform(-1.0, 1.0), seeded.uniform(-1.0, 1.0)});
  }
  state.counters["max_overlap"] = world.max_overlap();
}

/// One simulated second of 1,000 pucks and 100 bats on 200 m^2, a key changing ten times per bat
/// and second; cpu_share is the part of a core it takes in real time.
void crowd(benchmark::State& state) {
  WorldSpec spec;
  spec.field.length = 20.0;
  spec.field.width = 10.0;
  spec.puck_drag = 0.2;
  spec.bat_drag = 1.0;
  spec.restitution = rink::physics::RestitutionTable(1, 0.9);
  World world(spec);
  Seeded seeded{2};
  std::vector<BodyId> bats;
  for (int i = 0; i < 100;) {
    BatSpec bat;
    bat.half_extent = {0.04, 0.1};
    bat.mass = 3.0;
    bat.position = {seeded.uniform(0.1, 19.9), seeded.uniform(0.1, 9.9)};
    if (world.is_free(bat.position, bat.half_extent)) bats.push_back(world.add(bat)), ++i;
  }
  for (int i = 0; i < 1000;) {
    PuckSpec puck;
    puck.position = {seeded.uniform(0.04, 19.96), seeded.uniform(0.04, 9.96)};
    puck.velocity = {seeded.uniform(-1.5, 1.5), seeded.uniform(-1.5, 1.5)};
    puck.mass = 0.2;
    if (world.is_free(puck.position, puck.radius)) world.add(puck), ++i;
  }
  const std::uint64_t before = world.counters().disc_impacts;
  for (auto _ : state)
    for (int key = 0; key < 1000; ++key) {
      world.advance(world.now() + 1e-3);
      const auto axis = [&] { return 6.0 * (static_cast<double>(seeded.next() % 3) - 1.0); };
      const double x = axis(), y = axis();
      world.set_thrust(bats[seeded.next() % bats.size()], {x, y});
    }
  state.SetItemsProcessed(static_cast<std::int64_t>(world.counters().disc_impacts - before));
  state.counters["cpu_share"] =
      benchmark::Counter(static_cast<double>(state.iterations()),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["max_overlap"] = world.max_overlap();
}

const bool registered = [] {
  char name[96];
  for (const int count : {1'000, 10'000, 100'000})
    for (const double packing : {0.05, 0.2}) {
      std::snprintf(name, sizeof name, "physics/match_events/rink/n:%d/packing:%g", count, packing);
      benchmark::RegisterBenchmark(name, [=](benchmark::State& state) {
        match_events(state, count, packing);
      })->UseRealTime();
    }
  for (const auto& [count, moving] : {std::pair(1'000, 100), std::pair(1'000'000, 100),
                                      std::pair(100'000, 1'000), std::pair(100'000, 100'000)}) {
    std::snprintf(name, sizeof name, "physics/resting/rink/n:%d/moving:%d", count, moving);
    benchmark::RegisterBenchmark(name,
                                 [count = count, moving = moving](benchmark::State& state) {
                                   at_rest(state, count, moving);
                                 })
        ->UseRealTime()
        ->Unit(benchmark::kMicrosecond);
  }
  benchmark::RegisterBenchmark("physics/energy_drift/rink/n:1000/packing:0.5",
                               [](benchmark::State& state) { energy_drift(state, 1000, 0.5); })
      ->UseRealTime()
      ->Iterations(1)
      ->Unit(benchmark::kSecond);
  benchmark::RegisterBenchmark("physics/two_player_step", two_player_step)->UseRealTime();
  benchmark::RegisterBenchmark("physics/crowd/rink/pucks:1000/bats:100", crowd)
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond);
  return true;
}();

}  // namespace
}  // namespace rink::bench::physics_bench
