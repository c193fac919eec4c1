// Where the bytes between nodes go: by message and field, per border body and window, and what
// standby copies add to claims.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <string>

#include "bench/gas.h"
#include "bench/node_costs.h"
#include "tests/peer/many/bytes_by_field.h"

namespace rink::bench::peer_bytes_bench {
namespace {

using peer::test::CountedRun;

/// Of what all nodes sent in the counted windows: of fields, bytes per border body and window.
void show(benchmark::State& state, const CountedRun& run) {
  double border = 0.0, windows = 0.0, own = 0.0, repeats = 0.0, standby = 0.0;
  peer::test::BytesByField sent;
  for (const peer::test::NodeCost& node : run.nodes) {
    const peer::PeerCounters &now = node.after.peer, &then = node.before.peer;
    border += static_cast<double>(now.border_windows - then.border_windows);
    repeats += static_cast<double>(now.repeats - then.repeats);
    windows += static_cast<double>(node.windows());
    own += node.own;
    standby += static_cast<double>(node.after.replica_bytes - node.before.replica_bytes);
    sent += node.fields;
  }
  for (const auto& [field, bytes] : sent.bytes())
    state.counters[field] = static_cast<double>(bytes) / border;
  const auto of = [&](const char* message) { return static_cast<double>(sent.of(message)); };
  state.counters["all/claims_and_handover_per_border_body"] =
      (of("claims/") + of("handover/")) / border;
  state.counters["all/border_bodies_per_node"] = border / windows;
  state.counters["all/own_per_node"] = own / static_cast<double>(run.nodes.size());
  state.counters["all/repeated_share"] = repeats / windows;
  state.counters["all/claims_per_node_and_window"] = of("claims/") / windows;
  state.counters["all/handover_per_node_and_window"] = of("handover/") / windows;
  state.counters["all/verdict_per_node_and_window"] = of("verdict/") / windows;
  state.counters["all/standby_per_node_and_window"] = standby / windows;
}

void gas(benchmark::State& state, peer::PeerNumber nodes, double packing, double collisions) {
  for (auto _ : state) {
    const physics::World whole = gas_scene::gas_at_start(10'000 * static_cast<int>(nodes), packing);
    const double length =
        collisions > 0.0 ? collisions / (2.0 * gas_scene::collision_rate(packing)) : 0.02;  // s
    // Some snapshots.
    const std::uint64_t windows = collisions > 0.0 ? 200 : 800;
    show(state, peer::test::counted_run(whole, {.node_count = nodes,
                                                .window = length,
                                                .warm_up = 20,
                                                .windows = windows,
                                                .keeps_fields = true}));
  }
}

void arena(benchmark::State& state, std::uint32_t nodes) {
  for (auto _ : state)
    show(state, node_model::sample_of(nodes, 4.0, 60, peer::SessionSettings{}.tree_from, true).run);
}

const bool registered = [] {
  const auto add = [](const std::string& name, auto&& run) {
    benchmark::RegisterBenchmark(name.c_str(), run)->Unit(benchmark::kMillisecond)->Iterations(1);
  };
  for (const peer::PeerNumber nodes : {2u, 8u})
    for (const char* packing : {"0.05", "0.3"})
      for (const char* collisions : {"0.4", "0"})
        add("peer/bytes/gas/nodes:" + std::to_string(nodes) + "/packing:" + packing +
                "/collisions:" + collisions,
            [=](benchmark::State& state) {
              gas(state, nodes, std::stod(packing), std::stod(collisions));
            });
  for (const std::uint32_t nodes : {2u, 8u, 32u})
    add("peer/bytes/arena/nodes:" + std::to_string(nodes),
        [=](benchmark::State& state) { arena(state, nodes); });
  return true;
}();

}  // namespace
}  // namespace rink::bench::peer_bytes_bench
