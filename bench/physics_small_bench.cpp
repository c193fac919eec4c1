// What an event and an idle tick cost where few bodies play, beside many: nothing is spread over
// many bodies there.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "bench/gas.h"
#include "game/physics/world.h"

namespace rink::bench::physics_small_bench {
namespace {

using rink::physics::BatSpec;
using rink::physics::BodyId;
using rink::physics::Counters;
using rink::physics::PuckSpec;
using rink::physics::Vector2;
using rink::physics::World;
using rink::physics::WorldSpec;
using namespace gas_scene;

constexpr double packing = 0.05, tick = 1.0 / 60.0;

/// A match of `count` bodies, one in ten a bat that a key steers three times per second; drag, and
/// impacts that lose energy.
class Match {
 public:
  explicit Match(int count) : world_(spec_of(count)) {
    const double side = world_.spec().field.length;
    while (static_cast<int>(bats_.size()) < (count + 9) / 10) {
      const BatSpec bat{.position = anywhere(side, 0.1), .half_extent = {0.04, 0.1}, .mass = 3.0};
      if (world_.is_free(bat.position, bat.half_extent)) bats_.push_back(world_.add(bat));
    }
    while (static_cast<int>(world_.body_count()) < count) {
      const PuckSpec puck{.position = anywhere(side, radius), .velocity = seeded_.velocity()};
      if (world_.is_free(puck.position, radius)) world_.add(puck);
    }
  }

  World& world() { return world_; }
  void play_tick() {
    for (const BodyId bat : bats_)
      if (seeded_.next() % 20 == 0)
        world_.set_thrust(bat, {seeded_.uniform(-6.0, 6.0), seeded_.uniform(-6.0, 6.0)});
    world_.advance(world_.now() + tick);
  }

 private:
  static WorldSpec spec_of(int count) {
    WorldSpec spec;
    spec.field.length = spec.field.width = side_of(count, packing);
    spec.puck_drag = 0.2, spec.bat_drag = 1.0;
    spec.restitution = rink::physics::RestitutionTable(1, 0.9);
    return spec;
  }
  Vector2 anywhere(double side, double extent) {
    return {seeded_.uniform(extent, side - extent), seeded_.uniform(extent, side - extent)};
  }

  Seeded seeded_{6};
  World world_;
  std::vector<BodyId> bats_;
};

void report(benchmark::State& state, const World& world, const Counters& before) {
  const Counters& after = world.counters();
  const auto events = static_cast<double>(after.events() - before.events());
  state.SetItemsProcessed(static_cast<std::int64_t>(events));
  if (events == 0.0) return;
  state.counters["predictions"] =
      static_cast<double>(after.predictions - before.predictions) / events;
  state.counters["crossings"] = static_cast<double>(after.crossings - before.crossings) / events;
}

/// Items are events; the counters are of bookkeeping per event.
void gas_events(benchmark::State& state, int count) {
  World world = gas(count, packing);
  const Counters before = world.counters();
  const double step = 400.0 / (count * collision_rate(packing));
  for (auto _ : state) world.advance(world.now() + step);
  report(state, world, before);
}

void match_ticks(benchmark::State& state, int count) {
  Match match(count);
  for (int k = 0; k < 600; ++k) match.play_tick();
  const Counters before = match.world().counters();
  for (auto _ : state) match.play_tick();
  report(state, match.world(), before);
}

/// Ticks in which nothing happens.
void idle_ticks(benchmark::State& state, int count) {
  WorldSpec spec;
  spec.field.length = spec.field.width = side_of(count, packing);
  World world(spec);
  for (PuckSpec puck : gas_pucks(count, packing)) {
    puck.velocity = {0.0, 0.0};
    world.add(puck);
  }
  for (auto _ : state) world.advance(world.now() + tick);
}

const bool registered = [] {
  const auto add = [](const char* what, int count, void (*run)(benchmark::State&, int)) {
    char name[96];
    std::snprintf(name, sizeof name, "physics/small/%s/n:%d", what, count);
    benchmark::RegisterBenchmark(name, [count, run](benchmark::State& state) {
      run(state, count);
    })->Unit(benchmark::kNanosecond);
  };
  for (const int count : {10, 30, 100, 1'000, 10'000}) add("gas_events", count, gas_events);
  for (const int count : {3, 10, 30, 100, 1'000}) add("match_ticks", count, match_ticks);
  for (const int count : {3, 10, 100, 1'000, 10'000}) add("idle_ticks", count, idle_ticks);
  return true;
}();

}  // namespace
}  // namespace rink::bench::physics_small_bench
