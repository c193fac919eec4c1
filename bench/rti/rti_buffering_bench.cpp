// What buffering costs: an update collected, a destination that stopped reading and comes back.
#include <benchmark/benchmark.h>

#include <array>
#include <vector>

#include "bench/rti/entity_federation.h"
#include "rti/buffering/newest_state.h"

namespace rink::bench::rti_buffering_bench {
namespace {

using namespace rink::rti;

/// 5,500 updates of a tick taken in, sealed and forgotten.
void collect(benchmark::State& state) {
  constexpr ObjectSlot object_count = 5500;
  const Fom& fom = reliable_entities();
  const ObjectClassHandle entity = *fom.object_class("Entity");
  ObjectTable objects(fom);
  for (std::uint32_t i = 0; i < object_count; ++i)
    objects.insert({i}, 0, static_cast<std::uint16_t>(entity.value), "");
  NewestState buffering;
  const std::array<std::byte, 8> value{};
  std::size_t bytes = 0;
  for (auto _ : state) {
    for (ObjectSlot slot = 0; slot < object_count; ++slot)
      buffering.append({.owner = 0,
                        .slot = slot,
                        .object = objects[slot],
                        .attributes = fom.attributes(entity),
                        .stamp = {1.0, 0},
                        .values = value});
    bytes = buffering.seal().front().message.size();
    buffering.clear();
  }
  state.SetItemsProcessed(state.iterations() * object_count);
  state.counters["bytes"] = static_cast<double>(bytes);
}

/// Who is held back, asked for 1,000 destinations of which one in ten doesn't read.
void judge(benchmark::State& state) {
  constexpr std::uint32_t federate_count = 1000;
  NewestState buffering;
  std::size_t held = 0;
  for (auto _ : state)
    for (std::uint32_t federate = 0; federate < federate_count; ++federate)
      held += buffering.holds_back(federate, federate % 10 == 0 ? 1u << 20 : 0) ? 1 : 0;
  state.SetItemsProcessed(state.iterations() * federate_count);
  state.counters["held"] = static_cast<double>(held) / static_cast<double>(state.iterations());
}

BENCHMARK(collect)->Name("rti/buffering/collect")->UseRealTime();
BENCHMARK(judge)->Name("rti/buffering/judge")->UseRealTime();

}  // namespace
}  // namespace rink::bench::rti_buffering_bench
