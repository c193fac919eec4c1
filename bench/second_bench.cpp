// What a simulated second costs, 60 frames of it, beside other libraries on the same gas, each with
// the error it makes.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <memory>
#include <string>

#include "bench/peers/peers.h"
#include "bench/trials/contender.h"
#include "bench/trials/diagram_trials.h"

namespace rink::bench::second_bench {
namespace {

using rink::accuracy::at_frame;
using rink::accuracy::frame;

/// Each iteration is the second that follows the first tenth of one, for making a world and finding
/// its first events is not what a second costs.
void second(benchmark::State& state, const std::string& engine, int count, double packing) {
  const rink::accuracy::Trial trial =
      rink::accuracy::gas(static_cast<std::uint32_t>(count), packing);
  double energy_error = 0.0, overlap = 0.0, impacts = 0.0;
  for (auto _ : state) {
    state.PauseTiming();
    auto world = rink::accuracy::make_world(trial, {engine}, frame);
    const double energy = world->kinetic_energy();
    world->advance(at_frame(6));
    const std::uint64_t before = world->counters().impacts();
    state.ResumeTiming();
    for (int k = 7; k <= 66; ++k) world->advance(at_frame(k));
    state.PauseTiming();
    energy_error = world->kinetic_energy() / energy - 1.0;
    overlap = world->max_overlap();
    impacts = static_cast<double>(world->counters().impacts() - before);
    world.reset();
    state.ResumeTiming();
  }
  state.counters["energy_error"] = energy_error;
  state.counters["max_overlap"] = overlap;
  state.counters["impacts"] = impacts;
}

void add(const char* name, const std::string& engine, int count, double packing) {
  char text[96];
  std::snprintf(text, sizeof text, "physics/second/%s/n:%d/packing:%g", name, count, packing);
  benchmark::RegisterBenchmark(
      text, [=](benchmark::State& state) { second(state, engine, count, packing); })
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond);
}

const bool registered = [] {
  for (const int count : {1000, 10000})
    for (const double packing : {0.05, 0.3}) {
      add("rink", "exact", count, packing);
      if (rink::peers::is_built_in("chipmunk")) add("chipmunk", "chipmunk", count, packing);
      if (rink::peers::is_built_in("box2d-bullets")) add("box2d", "box2d-bullets", count, packing);
    }
  return true;
}();

}  // namespace
}  // namespace rink::bench::second_bench
