// Disc impacts per second of processor time: the engine by windows and slabs, its plain loop, and
// the least program that can do it, side by side.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "bench/gas.h"
#include "bench/reference/hard_discs.h"
#include "game/physics/world.h"

namespace rink::bench::physics_events_bench {
namespace {

using namespace gas_scene;
using rink::physics::Event;
using rink::physics::QueuePolicy;
using rink::physics::World;
using rink::physics::WorldSpec;

/// All events in one order, by a calendar.
WorldSpec plain_loop() {
  WorldSpec spec;
  spec.slabs.reset();
  return spec;
}

/// By windows, which are divided among tiles where there are many discs; a calendar is a tenth
/// quicker for a thousand.
WorldSpec quickest(int count) {
  WorldSpec spec;
  if (count < 5'000) return spec;
  spec.queue = QueuePolicy::windows;
  spec.slabs.emplace();
  return spec;
}

HardDiscs reference(int count, double packing) {
  std::vector<HardDiscs::Disc> discs;
  for (const auto& puck : gas_pucks(count, packing))
    discs.push_back(
        {puck.position.x(), puck.position.y(), puck.velocity.x(), puck.velocity.y(), 0.0});
  return HardDiscs(side_of(count, packing), radius, discs);
}

constexpr int compared_max = 10'000;  // discs: more of them would say no more

/// How many of the first collisions, half of one per disc or so, are others than the plain loop's.
double mismatches_of_reference(int count, double packing) {
  World world = gas_at_start(count, packing, plain_loop());
  world.record_events(true);
  world.advance(1.0 / collision_rate(packing));
  std::vector<std::pair<std::uint32_t, std::uint32_t>> expected, found;
  for (const Event& event : world.events())
    if (event.kind == rink::physics::EventKind::puck_puck && event.other)
      expected.push_back(std::minmax(event.body.index, event.other->index));
  reference(count, packing).advance(world.now(), [&](const HardDiscs::Collision& collision) {
    found.emplace_back(collision.low, collision.high);
  });
  const std::size_t both = std::min(expected.size(), found.size());
  std::size_t others = std::max(expected.size(), found.size()) - both;
  for (std::size_t k = 0; k < both; ++k) others += expected[k] != found[k];
  return static_cast<double>(others);
}

/// 1 if the bits are others than the plain loop's after four collisions of each puck.
double mismatches_of_engine(int count, double packing, WorldSpec spec) {
  if (spec.slabs) spec.slabs->bodies_min = 0;
  return gas(count, packing, spec).hash() == gas(count, packing, plain_loop()).hash() ? 0.0 : 1.0;
}

/// Items are disc impacts.
void engine_events(benchmark::State& state, int count, double packing, const WorldSpec& spec) {
  World& world = kept<std::tuple<int, double, QueuePolicy>, World>(
      {count, packing, spec.queue}, [&] { return gas(count, packing, spec); });
  const double energy = world.kinetic_energy(), step = step_of(count, packing);
  const std::uint64_t before = world.counters().disc_impacts;
  for (auto _ : state) world.advance(world.now() + step);
  state.SetItemsProcessed(static_cast<std::int64_t>(world.counters().disc_impacts - before));
  state.counters["energy_error"] = world.kinetic_energy() / energy - 1.0;
  state.counters["undone"] = static_cast<double>(world.counters().slabs.undone);
  state.counters["max_overlap"] = world.max_overlap();
  state.counters["mismatches"] = mismatches_of_engine(std::min(count, compared_max), packing, spec);
}

void reference_events(benchmark::State& state, int count, double packing) {
  HardDiscs& discs = kept<std::pair<int, double>, HardDiscs>({count, packing}, [&] {
    HardDiscs gas = reference(count, packing);
    gas.advance(4.0 / collision_rate(packing));
    return gas;
  });
  const double energy = discs.kinetic_energy(), step = step_of(count, packing);
  const std::uint64_t before = discs.collisions();
  for (auto _ : state) discs.advance(discs.now() + step);
  state.SetItemsProcessed(static_cast<std::int64_t>(discs.collisions() - before));
  state.counters["energy_error"] = discs.kinetic_energy() / energy - 1.0;
  state.counters["max_overlap"] = discs.max_overlap();
  state.counters["mismatches"] = mismatches_of_reference(std::min(count, compared_max), packing);
}

/// By the processor's time, as a machine that is shared would otherwise measure its other users.
void add(const char* who, int count, double packing, void (*play)(benchmark::State&, int, double)) {
  char name[96];
  std::snprintf(name, sizeof name, "physics/events/%s/n:%d/packing:%g", who, count, packing);
  benchmark::RegisterBenchmark(name, [=](benchmark::State& state) {
    play(state, count, packing);
  })->MeasureProcessCPUTime();
}

const bool registered = [] {
  for (const int count : {1'000, 10'000, 100'000, 1'000'000})
    for (const double packing : {0.05, 0.2, 0.5, 0.7}) {
      add("rink", count, packing, [](benchmark::State& state, int n, double at) {
        engine_events(state, n, at, quickest(n));
      });
      add("plain", count, packing, [](benchmark::State& state, int n, double at) {
        engine_events(state, n, at, plain_loop());
      });
      add("reference", count, packing, reference_events);
    }
  return true;
}();

}  // namespace
}  // namespace rink::bench::physics_events_bench
