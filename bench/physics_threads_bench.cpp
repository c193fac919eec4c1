// What a second thread gains over one in a gas by tiles, by the wall, beside what it gains in bare
// arithmetic in the same minute, with the states of both compared to the bit.
#include <benchmark/benchmark.h>

#include <chrono>
#include <cstdint>
#include <cstdio>

#include "bench/clock.h"
#include "bench/gas.h"
#include "game/physics/workers.h"
#include "game/process/thread_team.h"

namespace rink::bench::physics_threads_bench {
namespace {

using namespace gas_scene;
using rink::game::ThreadTeam;
using rink::physics::QueuePolicy;
using rink::physics::World;
using rink::physics::WorldSpec;

constexpr int count = 100'000, rounds = 12;
constexpr std::uint32_t threads = 2;
constexpr std::uint64_t loop_length = 40'000'000;  // some 40 ms

/// Sums over the rounds.
struct Spent {
  double real_s = 0.0, processor_s = 0.0;
};

template <class Work>
void spend(Spent& spent, const Work& work) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  const double processor_begin = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
  work();
  spent.processor_s += seconds_of(CLOCK_PROCESS_CPUTIME_ID) - processor_begin;
  spent.real_s += std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Arithmetic that looks at no memory, `length` steps of it.
void loop(std::uint64_t length) {
  std::uint64_t x = 1;
  for (std::uint64_t k = 0; k < length; ++k) x = x * 6364136223846793005u + 1442695040888963407u;
  benchmark::DoNotOptimize(x);
}

WorldSpec by_tiles(rink::physics::Workers* workers) {
  WorldSpec spec;
  spec.queue = QueuePolicy::windows;
  spec.slabs.emplace();
  spec.slabs->workers = workers;
  return spec;
}

/// In turns, that a load which comes and goes meets all alike. One iteration, for the two worlds
/// must be of one state.
void share(benchmark::State& state, double packing) {
  for (auto _ : state) {
    ThreadTeam team(threads);
    World alone = gas(count, packing, by_tiles(nullptr)),
          shared = gas(count, packing, by_tiles(&team));
    const std::uint64_t before = alone.counters().disc_impacts;
    Spent alone_spent, shared_spent, loop_alone, loop_shared;
    const double step = 1.0 / collision_rate(packing);
    auto part = [](std::uint32_t) { loop(loop_length / threads); };
    for (int round = 0; round < rounds; ++round) {
      spend(loop_alone, [] { loop(loop_length); });
      spend(loop_shared, [&] { rink::physics::run_on(team, part); });
      spend(alone_spent, [&] { alone.advance(alone.now() + step); });
      spend(shared_spent, [&] { shared.advance(shared.now() + step); });
    }
    if (alone.hash() != shared.hash())
      return state.SkipWithError("two threads come to another state than one");
    const auto impacts = static_cast<double>(alone.counters().disc_impacts - before);
    state.SetIterationTime(shared_spent.real_s);
    state.SetItemsProcessed(static_cast<std::int64_t>(impacts));
    state.counters["speed_up"] = alone_spent.real_s / shared_spent.real_s;
    state.counters["loop_speed_up"] = loop_alone.real_s / loop_shared.real_s;
    state.counters["alone_processor_ns"] = 1e9 * alone_spent.processor_s / impacts;
    state.counters["shared_processor_ns"] = 1e9 * shared_spent.processor_s / impacts;
  }
}

const bool registered = [] {
  for (const double packing : {0.05, 0.2, 0.5, 0.7}) {
    char name[64];
    std::snprintf(name, sizeof name, "physics/threads/%u/n:%d/packing:%g", threads, count, packing);
    benchmark::RegisterBenchmark(name, [=](benchmark::State& state) { share(state, packing); })
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond)
        ->Iterations(1);
  }
  return true;
}();

}  // namespace
}  // namespace rink::bench::physics_threads_bench
