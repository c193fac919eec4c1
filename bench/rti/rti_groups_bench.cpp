// What group communication costs: a message to a group of 500, by one outside and by a member, and
// 1,000 federates that come and go.
#include <benchmark/benchmark.h>

#include "rti/groups/member_lists.h"

namespace rink::bench::rti_groups_bench {
namespace {

using namespace rink::rti;

/// `sender` below the group's size: a member.
void reach(benchmark::State& state, std::uint32_t sender) {
  constexpr std::uint32_t size = 500;
  MemberLists groups;
  for (std::uint32_t federate = 0; federate < size; ++federate) groups.join(3, federate);
  std::uint64_t reached = 0;
  for (auto _ : state) {
    const auto receivers = groups.receivers(3, sender);
    reached += receivers.size();
    benchmark::DoNotOptimize(receivers.back());
  }
  state.counters["reached"] =
      static_cast<double>(reached) / static_cast<double>(state.iterations());
}

void come_and_go(benchmark::State& state) {
  constexpr std::uint32_t federate_count = 1000, group_count = 12;
  std::size_t left = 0;
  for (auto _ : state) {
    MemberLists groups;
    for (std::uint32_t federate = 0; federate < federate_count; ++federate)
      for (std::uint32_t group = 0; group < group_count; group += 4) groups.join(group, federate);
    for (std::uint32_t federate = 0; federate < federate_count; ++federate)
      groups.remove_federate(federate);
    left += groups.receivers(0, federate_count).size();
  }
  state.SetItemsProcessed(state.iterations() * federate_count);
  state.counters["left"] = static_cast<double>(left);
}

BENCHMARK_CAPTURE(reach, from_outside, 500u)->Name("rti/groups/reach/from_outside")->UseRealTime();
BENCHMARK_CAPTURE(reach, from_within, 250u)->Name("rti/groups/reach/from_within")->UseRealTime();
BENCHMARK(come_and_go)->Name("rti/groups/come_and_go/federates:1000")->UseRealTime();

}  // namespace
}  // namespace rink::bench::rti_groups_bench
