// Shows from how many regions, and movers where few move, waking a second core pays: the same
// matches alone and shared, however few they are, one after the other, by the wall.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "im/matching/batch_matcher.h"
#include "im/schemes/overlap_filter.h"
#include "rti/second_core.h"

namespace rink::bench::im_second_core_bench {
namespace {

using namespace rink;
using Regions = std::vector<im::Region>;

constexpr double side = 1000.0;
constexpr im::Region world{0.0, 0.0, side, side};

template <class Work>
double wall_us(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start)
      .count();
}

double quantile(std::vector<double>& values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

/// Half of them updates, half subscriptions; all squares of one size, one pair per region.
class Field {
 public:
  explicit Field(std::size_t regions)
      : updates(regions / 2),
        subscriptions(regions / 2),
        width_(side / std::sqrt(static_cast<double>(regions))) {
    for (Regions* all : {&updates, &subscriptions})
      for (im::Region& region : *all) {
        const double x = between(0.0, side), y = between(0.0, side);
        region = {x, y, x + width_, y + width_};
      }
  }
  /// Moves so many of each half, others each time, by up to a tenth of their side.
  void step(std::size_t movers) {
    moved.clear();
    for (std::size_t i = 0; i < movers; ++i)
      moved.push_back(static_cast<std::uint32_t>((first_ + i) % updates.size()));
    first_ = (first_ + movers) % updates.size();
    for (Regions* all : {&updates, &subscriptions})
      for (const std::uint32_t id : moved) {
        const double dx = between(-0.1, 0.1) * width_, dy = between(-0.1, 0.1) * width_;
        im::Region& region = (*all)[id];
        region = {region.low_x + dx, region.low_y + dy, region.high_x + dx, region.high_y + dy};
      }
  }
  void tell(im::Filter& filter) const {
    for (const std::uint32_t id : moved)
      filter.set_update_region(id, updates[id]),
          filter.set_subscription_region(id, subscriptions[id]);
  }

  Regions updates, subscriptions;
  std::vector<std::uint32_t> moved;

 private:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  double width_;
  std::size_t first_ = 0;
  std::mt19937_64 random_{42};
};

/// The worker is asked however little there is to do.
struct EagerCore {
  EagerCore() { core.worth_sharing = {0, 0}; }
  rti::SecondCore core;
};

void report(benchmark::State& state, std::vector<double>& alone, std::vector<double>& shared,
            std::size_t mismatches) {
  state.counters["alone_us"] = quantile(alone, 0.5);
  state.counters["shared_us"] = quantile(shared, 0.5);
  state.counters["shared_p90_us"] = quantile(shared, 0.9);
  state.counters["gain"] = quantile(alone, 0.5) / quantile(shared, 0.5);
  state.counters["mismatches"] = static_cast<double>(mismatches);
}

void match_static(benchmark::State& state, std::size_t regions) {
  Field field(regions);
  EagerCore second;
  im::BatchMatcher alone, shared;
  alone.set_world(world), shared.set_world(world);
  shared.share_with(&second.core);
  std::vector<double> alone_us, shared_us;
  for (auto _ : state) {
    alone_us.push_back(wall_us([&] { alone.match(field.updates, field.subscriptions); }));
    shared_us.push_back(wall_us([&] { shared.match(field.updates, field.subscriptions); }));
    state.SetIterationTime(1e-6 * shared_us.back());
  }
  report(state, alone_us, shared_us, alone.pair_count() == shared.pair_count() ? 0 : 1);
}

/// `movers` of each half move; all of them if it is half of the regions.
void match_dynamic(benchmark::State& state, std::size_t regions, std::size_t movers) {
  Field field(regions);
  EagerCore second;
  im::OverlapFilter alone(world), shared(world);
  shared.share_with(&second.core);
  std::vector<double> alone_us, shared_us;
  std::size_t mismatches = 0;
  std::span<const im::Change> changes, others;
  const auto pass = [&](std::size_t count) {
    field.step(count);
    field.tell(alone), field.tell(shared);
    alone_us.push_back(wall_us([&] { changes = alone.match(); }));
    shared_us.push_back(wall_us([&] { others = shared.match(); }));
    mismatches +=
        std::equal(changes.begin(), changes.end(), others.begin(), others.end()) ? 0u : 1u;
  };
  pass(regions / 2), pass(movers);
  alone_us.clear(), shared_us.clear();
  for (auto _ : state) {
    pass(movers);
    state.SetIterationTime(1e-6 * shared_us.back());
  }
  report(state, alone_us, shared_us, mismatches);
}

const bool is_registered = [] {
  const auto add = [](const std::string& name, auto run) {
    benchmark::RegisterBenchmark(name.c_str(), run)
        ->UseManualTime()
        ->Unit(benchmark::kMicrosecond)
        ->Iterations(300);
  };
  for (const std::size_t regions : {2'048u, 8'192u, 16'384u, 32'768u, 65'536u, 131'072u}) {
    add("im/second_core/static/n:" + std::to_string(regions),
        [=](benchmark::State& state) { match_static(state, regions); });
    add("im/second_core/all_move/n:" + std::to_string(regions),
        [=](benchmark::State& state) { match_dynamic(state, regions, regions / 2); });
  }
  for (const std::size_t movers : {512u, 2'048u, 4'096u, 8'192u, 16'384u})
    add("im/second_core/few_move/n:131072/movers:" + std::to_string(movers),
        [=](benchmark::State& state) { match_dynamic(state, 131'072, movers); });
  return true;
}();

}  // namespace
}  // namespace rink::bench::im_second_core_bench
