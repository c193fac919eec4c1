// What a gas takes in memory in each of several nodes, beside one engine.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <cstdio>

#include "bench/clock.h"
#include "tests/peer/memory_of_nodes.h"

namespace rink::bench::peer_memory_bench {
namespace {

using peer::PeerNumber;

constexpr std::uint32_t puck_count = 100'000;
constexpr double packing = 0.05, window = 0.04;
constexpr int windows = 5;

/// The time is that of the nodes' windows, all in one thread.
void memory(benchmark::State& state, PeerNumber nodes) {
  const auto gas = [] { return peer::test::mixed_gas(puck_count, packing); };
  for (auto _ : state) {
    const std::uint64_t engine = peer::test::memory_of_engine(gas, window * windows);
    const physics::World whole = gas();
    const double begin = seconds_of();
    const peer::test::NodeMemory node = peer::test::memory_of_nodes(whole, nodes, window, windows);
    state.SetIterationTime(seconds_of() - begin);
    const auto per_body = [](std::uint64_t bytes) {
      return static_cast<double>(bytes) / puck_count;
    };
    state.counters["engine_bytes_per_body"] = per_body(engine);
    state.counters["node_bytes_per_body"] = per_body(node.all());
    state.counters["share_bytes_per_body"] = per_body(node.share);
    state.counters["copies_bytes_per_body"] = per_body(node.copies);
    state.counters["held_share"] = node.held / puck_count;
    state.counters["of_one_engine"] =
        engine > 0 ? static_cast<double>(node.all()) / static_cast<double>(engine) : 0.0;
  }
}

const bool registered = [] {
  for (const PeerNumber nodes : {PeerNumber{1}, PeerNumber{2}, PeerNumber{4}}) {
    char name[64];
    std::snprintf(name, sizeof name, "peer/memory/peers:%u/n:%u", static_cast<unsigned>(nodes),
                  puck_count);
    benchmark::RegisterBenchmark(name, [=](benchmark::State& state) { memory(state, nodes); })
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond)
        ->Iterations(1);
  }
  return true;
}();

}  // namespace
}  // namespace rink::bench::peer_memory_bench
