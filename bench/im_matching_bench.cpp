// Times the matching engines beside Boost.Geometry's rtree and CGAL's box_intersection_d on the
// same regions, every pair and change written to memory.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "bench/clock.h"
#include "bench/peers/region_peers.h"
#include "im/matching/batch_matcher.h"
#include "im/schemes/overlap_filter.h"
#include "rti/second_core.h"

namespace rink::bench::im_matching_bench {
namespace {

using namespace rink;
using Regions = std::vector<im::Region>;

constexpr double side = 1000.0;
constexpr im::Region world{0.0, 0.0, side, side};

/// `count` updates and as many subscriptions, all squares, whose areas add up to `alpha` times the
/// world's. Hotspot: 90 % of them in 1 % of the world. Mixed: one in a hundred is thirty times as
/// wide as the others.
struct Setting {
  std::uint32_t count;
  double alpha;
  std::string layout;
};

class Field {
 public:
  explicit Field(const Setting& setting) : setting_(setting) {
    for (Regions* regions : {&updates, &subscriptions})
      for (std::uint32_t i = 0; i < setting.count; ++i) regions->push_back(draw());
  }

  /// Moves `share` of all, others each time, along both axes by up to a tenth of their side.
  void step(double share) {
    const auto stride = static_cast<std::size_t>(std::lround(1.0 / share));
    moved.clear();
    for (std::size_t i = tick_++ % stride; i < setting_.count; i += stride)
      moved.push_back(static_cast<std::uint32_t>(i));
    for (Regions* regions : {&updates, &subscriptions})
      for (const std::uint32_t i : moved) shift((*regions)[i]);
  }

  Regions updates, subscriptions;
  std::vector<std::uint32_t> moved;

 private:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  im::Region draw() {
    const bool is_mixed = setting_.layout == "mixed";
    const double mean_area = setting_.alpha * side * side / (2.0 * setting_.count),
                 special = between(0.0, 1.0);
    const double small = std::sqrt(is_mixed ? mean_area / (0.99 + 0.01 * 900.0) : mean_area),
                 width = is_mixed && special < 0.01 ? 30.0 * small : small;
    const double spread = setting_.layout == "hotspot" && special < 0.9 ? 0.1 * side : side;
    const double x = between(0.0, spread), y = between(0.0, spread);
    return {x, y, x + width, y + width};
  }
  void shift(im::Region& region) {
    const double reach = 0.1 * (region.high_x - region.low_x), dx = between(-reach, reach),
                 dy = between(-reach, reach);
    region = {region.low_x + dx, region.low_y + dy, region.high_x + dx, region.high_y + dy};
  }

  Setting setting_;
  std::mt19937_64 random_{42};
  std::size_t tick_ = 0;
};

/// Counts in one direction of a plane sweep.
class Fenwick {
 public:
  explicit Fenwick(std::size_t size) : counts_(size + 1) {}
  void add(std::size_t place) {
    for (++place; place < counts_.size(); place += place & -place) ++counts_[place];
  }
  std::uint64_t below(std::size_t place) const {
    std::uint64_t sum = 0;
    for (; place > 0; place -= place & -place) sum += counts_[place];
    return sum;
  }

 private:
  std::vector<std::uint64_t> counts_;
};

/// Pairs (a, b) with a.x < b.x and a.y < b.y.
struct Corner {
  double x, y;
};
std::uint64_t dominated(std::vector<Corner> a, std::vector<Corner> b) {
  const auto by_x = [](const Corner& p, const Corner& q) { return p.x < q.x; };
  std::sort(a.begin(), a.end(), by_x), std::sort(b.begin(), b.end(), by_x);
  std::vector<double> heights;
  heights.reserve(a.size());
  for (const Corner& corner : a) heights.push_back(corner.y);
  std::sort(heights.begin(), heights.end());
  Fenwick seen(heights.size());
  std::uint64_t count = 0;
  std::size_t next = 0;
  for (const Corner& corner : b) {
    for (; next < a.size() && a[next].x < corner.x; ++next)
      seen.add(static_cast<std::size_t>(
          std::lower_bound(heights.begin(), heights.end(), a[next].y) - heights.begin()));
    count += seen.below(static_cast<std::size_t>(
        std::lower_bound(heights.begin(), heights.end(), corner.y) - heights.begin()));
  }
  return count;
}

/// How many pairs overlap, by inclusion and exclusion of those that are apart along x, along y and
/// along both: no pair is ever looked at, ties are exact.
std::uint64_t independent_count(const Regions& updates, const Regions& subscriptions) {
  const auto corners = [](const Regions& regions, double sign_x, double sign_y, bool is_first) {
    std::vector<Corner> result;
    for (const im::Region& r : regions) {
      // The first of two that are apart in the direction of the signs ends with its far edge, the
      // second begins with its near one.
      const double x = (sign_x > 0.0) == is_first ? r.high_x : r.low_x,
                   y = (sign_y > 0.0) == is_first ? r.high_y : r.low_y;
      result.push_back({sign_x * x, sign_y * y});
    }
    return result;
  };
  const auto along = [](std::vector<Corner> a, std::vector<Corner> b, bool x) {
    for (std::vector<Corner>* corners : {&a, &b})
      for (Corner& corner : *corners) (x ? corner.y : corner.x) = corners == &a ? 0.0 : 1.0;
    return dominated(std::move(a), std::move(b));
  };
  std::uint64_t apart = 0, apart_both = 0;
  for (const double sign : {1.0, -1.0}) {
    apart +=
        along(corners(updates, sign, sign, true), corners(subscriptions, sign, sign, false), true);
    apart +=
        along(corners(updates, sign, sign, true), corners(subscriptions, sign, sign, false), false);
    apart_both +=
        dominated(corners(updates, sign, 1.0, true), corners(subscriptions, sign, 1.0, false));
    apart_both +=
        dominated(corners(updates, sign, -1.0, true), corners(subscriptions, sign, -1.0, false));
  }
  return std::uint64_t{updates.size()} * subscriptions.size() + apart_both - apart;
}

double difference(std::uint64_t a, std::uint64_t b) {
  return static_cast<double>(a > b ? a - b : b - a);
}

/// What iterations took of the thread's processor time (all matchers but `rink_two_cores` use one
/// thread, and the machine may have other work), in all and at best, and by the clock on the wall
/// at best.
struct Clock {
  double seconds = 0.0, least = 1e300, least_on_the_wall = 1e300;

  template <class Work>
  auto time(benchmark::State& state, const Work& work) {
    const double start = seconds_of(), start_on_the_wall = seconds_of(CLOCK_MONOTONIC);
    const auto result = work();
    const double taken = seconds_of() - start;
    least_on_the_wall =
        std::min(least_on_the_wall, seconds_of(CLOCK_MONOTONIC) - start_on_the_wall);
    state.SetIterationTime(taken);
    seconds += taken;
    least = std::min(least, taken);
    return result;
  }
};

/// Per iteration: `regions` matched or moved, and `pairs` written.
void report(benchmark::State& state, const Clock& clock, double regions, double pairs,
            double mismatches) {
  const double iterations = static_cast<double>(state.iterations());
  state.counters["ns_per_region"] = clock.seconds / iterations / regions * 1e9;
  state.counters["best_ns_per_region"] = clock.least / regions * 1e9;
  state.counters["best_wall_ns_per_region"] = clock.least_on_the_wall / regions * 1e9;
  state.counters["best_ns_per_pair"] = clock.least / std::max(1.0, pairs) * 1e9;
  state.counters["pairs"] = pairs;
  state.counters["mismatches"] = mismatches;
}

template <class Match>
void run_static(benchmark::State& state, const Setting& setting, const Match& match) {
  const Field field(setting);
  // Whoever matches at every tick keeps his memory; what the first one takes more, pages that were
  // never touched above all, is told apart, of everybody.
  const double start = seconds_of();
  std::uint64_t pairs = match(field.updates, field.subscriptions);
  state.counters["first_ns_per_region"] = (seconds_of() - start) / (2.0 * setting.count) * 1e9;
  Clock clock;
  for (auto _ : state)
    pairs = clock.time(state, [&] { return match(field.updates, field.subscriptions); });
  report(state, clock, 2.0 * setting.count, static_cast<double>(pairs),
         difference(pairs, independent_count(field.updates, field.subscriptions)));
}

void rink_static(benchmark::State& state, const Setting& setting, bool has_second_core) {
  std::optional<rti::SecondCore> second_core;
  im::BatchMatcher matcher;
  if (has_second_core) matcher.share_with(&second_core.emplace());
  matcher.set_world(world);
  run_static(state, setting, [&](const Regions& updates, const Regions& subscriptions) {
    matcher.match(updates, subscriptions);
    return matcher.pair_count();
  });
  state.counters["bytes_per_region"] = static_cast<double>(matcher.bytes()) / (2.0 * setting.count);
  state.SetLabel(matcher.instructions());
}

void peer_static(benchmark::State& state, const Setting& setting, bench::RegionMatch peer) {
  if (peer == nullptr) return state.SkipWithError("not there when this was built");
  std::vector<bench::RegionPair> pairs;
  run_static(state, setting, [&](const Regions& updates, const Regions& subscriptions) {
    pairs.clear();
    peer(updates, subscriptions, pairs);
    return pairs.size();
  });
}

/// One iteration hands in the regions that moved and takes the changes.
template <class Follow>
void run_dynamic(benchmark::State& state, double share, Field& field, const Follow& follow) {
  Clock clock;
  double moves = 0.0, changes = 0.0;
  std::uint64_t standing = independent_count(field.updates, field.subscriptions);
  for (auto _ : state) {
    field.step(share);
    const std::span<const im::Change> news = clock.time(state, [&] { return follow(field); });
    moves += 2.0 * static_cast<double>(field.moved.size());
    changes += static_cast<double>(news.size());
    for (const im::Change& change : news)
      standing += change.transition == im::Transition::entered ? 1u : ~std::uint64_t{0};
  }
  const double iterations = static_cast<double>(state.iterations());
  report(state, clock, moves / iterations, changes / iterations,
         difference(standing, independent_count(field.updates, field.subscriptions)));
}

void rink_dynamic(benchmark::State& state, const Setting& setting, double share,
                  bool has_second_core) {
  Field field(setting);
  std::optional<rti::SecondCore> second_core;
  im::OverlapFilter filter(world);
  if (has_second_core) filter.share_with(&second_core.emplace());
  const auto follow = [&](const Field& now) {
    for (const std::uint32_t i : now.moved) filter.set_update_region(i, now.updates[i]);
    for (const std::uint32_t i : now.moved) filter.set_subscription_region(i, now.subscriptions[i]);
    return filter.match();
  };
  field.moved.resize(setting.count);
  for (std::uint32_t i = 0; i < setting.count; ++i) field.moved[i] = i;
  follow(field);
  // What is built once when the first few move is part of no tick.
  field.step(share);
  follow(field);
  run_dynamic(state, share, field, follow);
  state.counters["bytes_per_region"] = static_cast<double>(filter.bytes()) / (2.0 * setting.count);
}

void rtree_dynamic(benchmark::State& state, const Setting& setting, double share) {
  Field field(setting);
  const auto trees = bench::make_moving_rtrees(field.updates, field.subscriptions);
  if (!trees) return state.SkipWithError("not there when this was built");
  std::vector<im::Change> changes;
  run_dynamic(state, share, field, [&](const Field& now) {
    changes.clear();
    for (const std::uint32_t i : now.moved) trees->move_update(i, now.updates[i], changes);
    for (const std::uint32_t i : now.moved)
      trees->move_subscription(i, now.subscriptions[i], changes);
    return std::span<const im::Change>(changes);
  });
}

std::string name_of(const char* kind, const char* matcher, const Setting& setting,
                    const std::string& rest) {
  const std::string alpha = std::to_string(static_cast<int>(setting.alpha)),
                    layout = setting.layout == "uniform" ? "" : "/layout:" + setting.layout;
  return std::string("im/") + kind + "/" + matcher + "/n:" + std::to_string(setting.count) +
         "/alpha:" + alpha + rest + layout;
}

template <class... Arguments>
void add(const std::string& name, const Setting& setting, Arguments... arguments) {
  auto* const bench = benchmark::RegisterBenchmark(name.c_str(), arguments...);
  // The trees need seconds for what is measured.
  bench->UseManualTime()
      ->Unit(benchmark::kMillisecond)
      ->Iterations(setting.count >= 1'000'000 ? 3
                   : setting.count >= 100'000 ? 8
                                              : 100);
}

void add_static(const Setting& setting) {
  add(name_of("static", "rink", setting, ""), setting, rink_static, setting, false);
  add(name_of("static", "rink_two_cores", setting, ""), setting, rink_static, setting, true);
  add(name_of("static", "boost_rtree", setting, ""), setting, peer_static, setting,
      bench::match_by_rtree);
  add(name_of("static", "cgal", setting, ""), setting, peer_static, setting,
      bench::match_by_box_intersection);
}

void add_dynamic(const Setting& setting, const char* moved) {
  add(name_of("dynamic", "rink", setting, std::string("/moved:") + moved), setting, rink_dynamic,
      setting, std::stod(moved), false);
  add(name_of("dynamic", "rink_two_cores", setting, std::string("/moved:") + moved), setting,
      rink_dynamic, setting, std::stod(moved), true);
  add(name_of("dynamic", "boost_rtree", setting, std::string("/moved:") + moved), setting,
      rtree_dynamic, setting, std::stod(moved));
}

const bool is_registered = [] {
  for (const std::uint32_t count : {10'000u, 100'000u, 1'000'000u}) {
    add_static({count, 1.0, "uniform"});
    for (const char* moved : {"1", "0.1", "0.01"}) add_dynamic({count, 1.0, "uniform"}, moved);
  }
  add_static({100'000, 100.0, "uniform"});
  for (const char* layout : {"hotspot", "mixed"}) {
    add_static({100'000, 1.0, layout});
    for (const char* moved : {"1", "0.01"}) add_dynamic({100'000, 1.0, layout}, moved);
  }
  return true;
}();

}  // namespace
}  // namespace rink::bench::im_matching_bench
