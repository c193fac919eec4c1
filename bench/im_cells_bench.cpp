// Times the cell filter alone: every object moves, and what is compared is its cell against the
// cells that subscribers touch.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <iterator>
#include <random>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "im/filter.h"

namespace rink::bench::im_cells_bench {
namespace {

using namespace rink;

constexpr double objects_per_square_metre = 5.0, cell = 1.0, view = 3.1622776601683795,
                 rate_hz = 60.0;

/// The crowd at large: five objects of 8 cm to the square metre that fly at 1 m/s and turn at the
/// walls, a subscriber to every ten that sees 10 m^2, ticks of 1/60 s, cells of 1 m.
class Field {
 public:
  explicit Field(std::uint32_t count) : side_(std::sqrt(count / objects_per_square_metre)) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> place(0.0, side_), angle(0.0, 6.283185307179586);
    for (std::uint32_t i = 0; i < count; ++i) {
      const double x = place(random), y = place(random), direction = angle(random);
      objects.push_back({x, y, std::cos(direction) / rate_hz, std::sin(direction) / rate_hz});
    }
    for (std::uint32_t i = 0; i < count / 10; ++i) {
      const double x = place(random), y = place(random);
      subscriptions.push_back({x - 0.5 * view, y - 0.5 * view, x + 0.5 * view, y + 0.5 * view});
    }
    regions.resize(count);
    step();
  }

  void step() {
    for (std::size_t i = 0; i < objects.size(); ++i) {
      Object& object = objects[i];
      object.x += object.dx, object.y += object.dy;
      if (object.x < 0.0 || object.x > side_) object.dx = -object.dx;
      if (object.y < 0.0 || object.y > side_) object.dy = -object.dy;
      regions[i] = {object.x - 0.04, object.y - 0.04, object.x + 0.04, object.y + 0.04};
    }
  }
  im::Region world() const { return {0.0, 0.0, side_, side_}; }

  struct Object {
    double x, y, dx, dy;
  };
  std::vector<Object> objects;
  std::vector<im::Region> regions, subscriptions;

 private:
  double side_;
};

/// Who sees whom, as a number of pairs and a sum over them that no two sets are likely to share.
struct Standing {
  std::uint64_t pairs = 0, sum = 0;

  static std::uint64_t mixed(std::uint64_t subscriber, std::uint64_t entity) {
    std::uint64_t value = subscriber << 32 | entity;
    value = (value ^ value >> 31) * 0x9E3779B97F4A7C15u;
    return (value ^ value >> 29) * 0xBF58476D1CE4E5B9u;
  }
  void replay(std::span<const im::Change> changes) {
    for (const im::Change& change : changes) {
      const std::uint64_t own = mixed(change.subscriber, change.entity);
      if (change.transition == im::Transition::entered) ++pairs, sum += own;
      else --pairs, sum -= own;
    }
  }
};

/// By the rule itself: each subscriber asks every cell that it touches who is in it. Not through
/// anything of the filter.
Standing recount(const Field& field) {
  const auto key = [](double column, double row) {
    return (static_cast<std::int64_t>(column) + 1000000) * 4000000 +
           static_cast<std::int64_t>(row) + 1000000;
  };
  std::unordered_map<std::int64_t, std::vector<std::uint32_t>> cells;
  for (std::uint32_t i = 0; i < field.regions.size(); ++i) {
    const im::Region& r = field.regions[i];
    cells[key(std::floor((0.5 * r.low_x + 0.5 * r.high_x) / cell),
              std::floor((0.5 * r.low_y + 0.5 * r.high_y) / cell))]
        .push_back(i);
  }
  Standing standing;
  for (std::uint32_t s = 0; s < field.subscriptions.size(); ++s) {
    const im::Region& r = field.subscriptions[s];
    for (double row = std::floor(r.low_y / cell); row <= std::floor(r.high_y / cell); ++row)
      for (double column = std::floor(r.low_x / cell); column <= std::floor(r.high_x / cell);
           ++column)
        if (const auto found = cells.find(key(column, row)); found != cells.end())
          for (const std::uint32_t entity : found->second)
            ++standing.pairs, standing.sum += Standing::mixed(s, entity);
  }
  return standing;
}

/// One iteration hands in the region of every object and takes the changes, all of them written.
void run(benchmark::State& state, std::uint32_t count) {
  Field field(count);
  const auto filter = im::make_filter("grid", {.world = field.world(), .cell_size = cell});
  for (std::uint32_t i = 0; i < field.subscriptions.size(); ++i)
    filter->set_subscription_region(i, field.subscriptions[i]);
  Standing standing;
  const auto tell = [&] {
    for (std::uint32_t i = 0; i < count; ++i) filter->set_update_region(i, field.regions[i]);
    return filter->match();
  };
  for (int tick = 0; tick < 2; ++tick)
    standing.replay(tell()), field.step();  // what is built once is part of no tick
  const im::FilterCounters before = filter->counters();
  for (auto _ : state) {
    const std::span<const im::Change> changes = tell();
    state.PauseTiming();
    standing.replay(changes);
    field.step();
    state.ResumeTiming();
  }
  standing.replay(tell());
  const Standing truth = recount(field);
  using benchmark::Counter;
  const double pairs_apart =
      std::abs(static_cast<double>(truth.pairs) - static_cast<double>(standing.pairs));
  state.counters["mismatches"] = pairs_apart + (truth.sum == standing.sum ? 0.0 : 1.0);
  // Seconds per iteration and object, which the reporter prints with its unit.
  state.counters["per_object"] =
      Counter(static_cast<double>(count), Counter::kIsIterationInvariantRate | Counter::kInvert);
  const double objects = static_cast<double>(state.iterations() + 1) * count;
  state.counters["crossed"] =
      static_cast<double>(filter->counters().regions_moved - before.regions_moved) / objects;
  state.counters["changes"] =
      static_cast<double>(filter->counters().changes - before.changes) / objects;
  state.counters["standing"] = static_cast<double>(standing.pairs);
}

const bool is_registered = [] {
  for (const std::uint32_t count : {10'000u, 100'000u, 1'000'000u})
    benchmark::RegisterBenchmark(("im/cells/rink/n:" + std::to_string(count)).c_str(), run, count)
        ->Unit(benchmark::kMicrosecond);
  return true;
}();

}  // namespace
}  // namespace rink::bench::im_cells_bench
