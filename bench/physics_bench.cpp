// Disc impacts per second of the exact rink, alone and in a crowd under keys, each with the error it makes.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "game/physics/world.h"

namespace {

using rink::physics::BatSpec;
using rink::physics::BodyId;
using rink::physics::PuckSpec;
using rink::physics::Vector2;
using rink::physics::World;
using rink::physics::WorldSpec;

/// SplitMix64 (Steele, Lea and Flood 2014): the same scenes everywhere.
struct Seeded {
  std::uint64_t state;
  std::uint64_t bits() {
    std::uint64_t z = state += 0x9e3779b97f4a7c15ULL;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }
  double uniform(double low, double high) { return low + (high - low) * static_cast<double>(bits() >> 11) * 0x1p-53; }
};

/// `count` pucks on a square lattice that fills a square field at `packing`, mean speed 1 m/s.
World gas(int count, double packing) {
  const double pi = 3.141592653589793, radius = 0.04, side = std::sqrt(count * pi * radius * radius / packing);
  WorldSpec spec;
  spec.field.length = spec.field.width = side;
  World world(spec);
  Seeded seeded{1};
  const int columns = static_cast<int>(std::ceil(std::sqrt(count)));
  for (int k = 0; k < count; ++k) {
    PuckSpec puck;
    puck.position = Vector2(k % columns + 0.5, k / columns + 0.5) * (side / columns);
    const double angle = seeded.uniform(0.0, 2.0 * pi), speed = std::sqrt(-std::log1p(-seeded.uniform(0.0, 0.999))) * 2.0 / std::sqrt(pi);
    puck.velocity = Vector2(std::cos(angle), std::sin(angle)) * speed;
    world.add(puck);
  }
  return world;
}

/// Items are disc impacts.
void events(benchmark::State& state, int count, double packing) {
  World world = gas(count, packing);
  world.advance(0.5);
  const double energy = world.kinetic_energy();
  const std::uint64_t before = world.counters().disc_impacts;
  const double step = 0.02;
  for (auto _ : state) world.advance(world.now() + step);
  state.SetItemsProcessed(static_cast<std::int64_t>(world.counters().disc_impacts - before));
  state.counters["energy_error"] = world.kinetic_energy() / energy - 1.0;
}

/// One simulated second of 1,000 pucks and 100 bats on 200 m^2, a key changing ten times per bat and second; cpu_share is the part of a core it takes in real time.
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
      const auto axis = [&] { return 6.0 * (static_cast<double>(seeded.bits() % 3) - 1.0); };
      const double x = axis(), y = axis();
      world.set_thrust(bats[seeded.bits() % bats.size()], {x, y});
    }
  state.SetItemsProcessed(static_cast<std::int64_t>(world.counters().disc_impacts - before));
  state.counters["cpu_share"] = benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["max_overlap"] = world.max_overlap();
}

const bool registered = [] {
  for (const int count : {1000, 10000})
    for (const double packing : {0.05, 0.2, 0.5}) {
      char name[80];
      std::snprintf(name, sizeof name, "physics/events/rink/n:%d/packing:%g", count, packing);
      benchmark::RegisterBenchmark(name, [=](benchmark::State& state) { events(state, count, packing); })->UseRealTime();
    }
  benchmark::RegisterBenchmark("physics/crowd/rink/pucks:1000/bats:100", crowd)->UseRealTime()->Unit(benchmark::kMillisecond);
  return true;
}();

}  // namespace
