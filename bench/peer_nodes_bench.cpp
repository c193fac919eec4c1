// What windows cost nodes that keep standby copies: how many nodes how much, what two and four gain
// over one engine, and by the model what 64 and 256 would need.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <numeric>
#include <vector>

#include "bench/clock.h"
#include "bench/gas.h"
#include "bench/node_costs.h"
#include "bench/trials/diagram_trials.h"

namespace rink::bench::peer_nodes_bench {
namespace {

namespace model = rink::bench::node_model;
using peer::test::CountedRun;

constexpr std::size_t never = peer::members_max + 1;

/// The hash of what the nodes ended with; 0 unless each body is in one part.
std::uint64_t hash_of(const CountedRun& run, const physics::World& whole) {
  return peer::hash_of_whole(whole.spec(), whole.body_count(), run.ends.front()).value_or(0);
}

/// Processor time without the mail, by node and window.
void window(benchmark::State& state, std::uint32_t nodes, bool is_by_tree) {
  constexpr std::uint64_t windows = 60;
  for (auto _ : state) {
    const model::Sample sample = model::sample_of(nodes, 4.0, windows, is_by_tree ? 2 : never);
    const model::Sums sums = model::sums_of(sample);
    state.SetIterationTime(sums.processor_s / sums.windows);
    state.counters["busiest_us"] = 1e6 * sums.busiest_s;
    state.counters["messages"] = sums.messages / sums.windows;
    state.counters["bytes"] = sums.bytes / sums.windows;
    state.counters["agreement_messages"] = sums.agreement_messages / sums.windows;
    state.counters["agreement_bytes"] = sums.agreement_bytes / sums.windows;
    state.counters["delays"] = model::delays_of(nodes, is_by_tree ? 2 : never);
  }
}

/// By the costs of 4 to 16 nodes, of which some have more room.
void foretell(benchmark::State& state, std::uint32_t nodes) {
  for (auto _ : state) {
    const double begin = seconds_of();
    std::vector<model::Sample> samples;
    for (const auto& [few, area] : {std::pair(4u, 4.0), {9u, 4.0}, {16u, 4.0}, {4u, 16.0}})
      samples.push_back(model::sample_of(few, area, 100, never));
    const model::Costs costs = model::costs_of(samples);
    const model::Arena arena = model::arena_of(nodes, 4.0, 0.0);
    std::vector<physics::Vector2> places;
    for (std::uint32_t body = 0; body < arena.world.body_count(); ++body)
      places.push_back(arena.world.position({body}));
    const physics::Field& field = arena.world.spec().field;
    const std::vector<model::Need> needs =
        model::needs_of(peer::Cuts::by_count(field, places, nodes).division(nodes), field, costs);
    state.SetIterationTime(seconds_of() - begin);
    const auto mean = [&](double model::Need::*part) {
      return std::accumulate(
                 needs.begin(), needs.end(), 0.0,
                 [&](double sum, const model::Need& need) { return sum + need.*part; }) /
             static_cast<double>(nodes);
    };
    const auto busiest = std::ranges::max_element(
        needs, {}, [](const model::Need& need) { return need.link_bytes(); });
    state.counters["window_us"] = 1e6 * mean(&model::Need::processor_s);
    state.counters["messages"] = mean(&model::Need::messages);
    state.counters["bytes"] = mean(&model::Need::bytes);
    state.counters["busiest_link_bytes"] = busiest->link_bytes();
    state.counters["delays"] = model::delays_of(nodes, peer::SessionSettings{}.tree_from);
  }
}

/// The nodes of a gas keep copies of each other; the last states of all are one engine's.
void nodes_of_gas(benchmark::State& state, peer::PeerNumber nodes, std::uint32_t count,
                  double packing) {
  constexpr std::uint64_t warm_up = 10, windows = 30;
  for (auto _ : state) {
    const accuracy::Trial trial = accuracy::gas(count, packing);
    physics::World whole(trial.world);
    accuracy::load(trial, whole);
    const double length = 0.4 / (2.0 * gas_scene::collision_rate(packing));  // s
    const CountedRun run = peer::test::counted_run(
        whole, {.node_count = nodes, .window = length, .warm_up = warm_up, .windows = windows});
    whole.advance(length * warm_up);
    const double begin = seconds_of();
    whole.advance(length * (warm_up + windows));
    const double alone_s = seconds_of() - begin;
    if (hash_of(run, whole) != whole.hash())
      return state.SkipWithError("the nodes' states are not the engine's");
    double busiest_s = 0.0, all_s = 0.0;
    for (const peer::test::NodeCost& node : run.nodes)
      busiest_s = std::max(busiest_s, node.processor_s), all_s += node.processor_s;
    state.SetIterationTime(busiest_s);
    state.counters["alone_ms"] = 1e3 * alone_s;
    state.counters["speed_up_by_processor_time"] = alone_s / busiest_s;
    state.counters["all_nodes_of_one"] = all_s / alone_s;
  }
}

const bool registered = [] {
  const auto add = [](const std::string& name, auto&& run) {
    benchmark::RegisterBenchmark(name.c_str(), run)
        ->UseManualTime()
        ->Unit(benchmark::kMicrosecond)
        ->Iterations(1);
  };
  for (const std::uint32_t nodes : {4u, 8u, 12u, 16u, 24u, 32u, 64u})
    for (const bool is_by_tree : {false, true})
      add("peer/window/nodes:" + std::to_string(nodes) + "/tree:" + (is_by_tree ? "1" : "0"),
          [=](benchmark::State& state) { window(state, nodes, is_by_tree); });
  for (const std::uint32_t nodes : {16u, 64u, 256u})
    add("peer/model/nodes:" + std::to_string(nodes),
        [=](benchmark::State& state) { foretell(state, nodes); });
  for (const peer::PeerNumber nodes : {2u, 4u})
    for (const char* packing : {"0.05", "0.3"})
      add("peer/standby/nodes:" + std::to_string(nodes) + "/n:100000/packing:" + packing,
          [=](benchmark::State& state) {
            nodes_of_gas(state, nodes, 100'000, std::stod(packing));
          });
  return true;
}();

}  // namespace
}  // namespace rink::bench::peer_nodes_bench
