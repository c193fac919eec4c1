// Times interest management: whole passes with moving entities and subscriptions, judged by a
// brute-force recount.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "bench/im_crowd.h"
#include "im/filter.h"

namespace rink::bench::im_bench {
namespace {

using namespace rink;
using bench::Crowd, bench::Table, bench::replay;

bool is_relevant(const std::string& scheme, const im::Region& s, const im::Region& u, double cell) {
  if (scheme == "none") return true;
  const bool overlaps =
      s.low_x <= u.high_x && u.low_x <= s.high_x && s.low_y <= u.high_y && u.low_y <= s.high_y;
  if (scheme == "region") return overlaps;
  if (scheme == "aura") {
    const double x = 0.5 * (s.low_x + s.high_x), y = 0.5 * (s.low_y + s.high_y),
                 radius = 0.5 * std::min(s.high_x - s.low_x, s.high_y - s.low_y);
    return std::hypot(std::clamp(x, u.low_x, u.high_x) - x, std::clamp(y, u.low_y, u.high_y) - y) <=
           radius;
  }
  const double column = std::floor(0.5 * (u.low_x + u.high_x) / cell),
               row = std::floor(0.5 * (u.low_y + u.high_y) / cell);
  // All objects are smaller than a cell, so that `hierarchical` has one level here.
  const bool is_in_touched_cell =
      std::floor(s.low_x / cell) <= column && column <= std::floor(s.high_x / cell) &&
      std::floor(s.low_y / cell) <= row && row <= std::floor(s.high_y / cell);
  return is_in_touched_cell && (overlaps || scheme != "hybrid");
}

std::size_t mismatches(const Crowd& crowd, const std::string& scheme, double cell,
                       const Table& table) {
  std::size_t wrong = 0;
  for (std::size_t s = 0; s < crowd.subscribers.size(); ++s)
    for (std::size_t e = 0; e < crowd.objects.size(); ++e)
      wrong += is_relevant(scheme, crowd.subscription(s), crowd.update(e), cell) !=
               (table[s * crowd.objects.size() + e] != 0);
  return wrong;
}

struct Case {
  std::string scheme;
  std::uint32_t subscribers, objects;
  double moved;  ///< part of the objects that move in a tick
  double rate_hz;
};

/// One iteration is one tick as the RTI sees it: every region handed in, moved or not, then the
/// match.
void pass(benchmark::State& state, const Case& of) {
  const auto& [scheme, subscribers, objects, moved, rate_hz] = of;
  Crowd crowd(subscribers, objects, rate_hz);
  const double cell = crowd.side / 32.0;
  const auto filter =
      im::make_filter(scheme, {.world = {0.0, 0.0, crowd.side, crowd.side}, .cell_size = cell});
  Table table(std::size_t{subscribers} * objects);
  crowd.tell(*filter);
  std::size_t wrong = replay(filter->match(), objects, table);
  const im::FilterCounters before = filter->counters();
  for (auto _ : state) {
    state.PauseTiming();
    crowd.step(moved);
    state.ResumeTiming();
    crowd.tell(*filter);
    const auto changes = filter->match();
    state.PauseTiming();
    wrong += replay(changes, objects, table);
    state.ResumeTiming();
  }
  using benchmark::Counter;
  state.counters["mismatches"] =
      static_cast<double>(wrong + mismatches(crowd, scheme, cell, table));
  state.counters["changes"] = Counter(
      static_cast<double>(filter->counters().changes - before.changes), Counter::kAvgIterations);
  state.counters["tests"] =
      Counter(static_cast<double>(filter->counters().pairs_tested - before.pairs_tested),
              Counter::kAvgIterations);
  state.counters["standing"] = static_cast<double>(std::count(table.begin(), table.end(), 1));
}

const bool is_registered = [] {
  const auto add = [](const std::string& scheme, std::uint32_t subscribers, std::uint32_t objects,
                      const char* moved, double rate_hz) {
    const std::string name = "im/pass/" + scheme + "/subscribers:" + std::to_string(subscribers) +
                             "/objects:" + std::to_string(objects) + "/moved:" + moved;
    benchmark::RegisterBenchmark(name.c_str(), pass,
                                 Case{scheme, subscribers, objects, std::stod(moved), rate_hz})
        ->UseRealTime()
        ->Unit(benchmark::kMicrosecond);
  };
  for (const std::string& scheme : im::filter_names()) {
    if (!(std::set<std::string>{"aura", "grid", "hierarchical", "hybrid", "none", "region"})
             .contains(scheme))
      continue;  // judged in tests/im alone
    for (const char* moved : {"1", "0.1", "0.01"}) add(scheme, 1'000, 10'000, moved, 60.0);
    add(scheme, 500, 5'500, "1", 30.0);
  }
  return true;
}();

}  // namespace
}  // namespace rink::bench::im_bench
