// Times the RTI's data distribution alone: regions move, a match follows; the pairs in scope are
// recounted by brute force.
#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "rti/distribution/interest.h"

namespace rink::bench::rti_distribution_bench {
namespace {

using namespace rink;
using namespace rink::rti;

constexpr const char* model_xml =
    R"(<objectModel><objects><objectClass><name>Root</name><objectClass><name>Entity</name>
<attribute><name>position</name><dataType>HLAfloat64LE</dataType></attribute></objectClass></objectClass></objects>
<dimensions><dimension><name>X</name></dimension><dimension><name>Y</name></dimension><dimension><name>Altitude</name></dimension><dimension><name>Channel</name></dimension></dimensions>
</objectModel>)";
constexpr std::uint16_t entity = 1;
constexpr AttributeSet position{1u};

/// Federate 0 owns all entities, each with `regions_each` regions; the others subscribe with one
/// each, 5 % of a square of 100 m. Regions are over the first `dimensions` of X, Y, Altitude,
/// Channel; in the last two, entities and subscriptions lie on one of four levels.
class Field {
 public:
  static constexpr double side = 100.0, seen = 11.2;
  Field(std::uint32_t entities, std::uint32_t subscribers, std::uint32_t dimensions,
        std::uint32_t regions_each)
      : dimension_count_(dimensions),
        regions_each_(regions_each),
        subscribers_(subscribers),
        distribution_(fom_, objects_, ownership_,
                      im::make_filter("region", {{0.0, 0.0, side, side}, 0.0})) {
    const DimensionSet set((std::uint64_t{1} << dimensions) - 1);
    for (std::uint32_t federate = 0; federate <= subscribers; ++federate)
      distribution_.add_federate(federate);
    for (std::uint32_t i = 0; i < entities; ++i) {
      slots_.push_back(objects_.insert({i}, 0, entity, ""));
      distribution_.object_registered(slots_.back());
      for (std::uint32_t k = 0; k < regions_each; ++k) {
        const RegionHandle region{i * regions_each + k};
        distribution_.create_region(0, region, set);
        if (regions_each == 1) distribution_.associate(0, slots_.back(), region);
        else distribution_.associate(0, slots_.back(), region, position);
        updates_.push_back(ranges(region.value, 0.0, 0.0));
        distribution_.modify_region(0, region, updates_.back());
      }
    }
    for (std::uint32_t federate = 1; federate <= subscribers; ++federate) {
      distribution_.create_region(federate, {0}, set);
      distribution_.subscribe(federate, entity, {position, position}, {0});
      views_.push_back(ranges(7919 * federate, 0.0, seen));
      distribution_.modify_region(federate, {0}, views_.back());
    }
  }

  /// Every `stride`-th region of either kind drifts; returns how many.
  std::uint32_t move(std::uint32_t stride, double at) {
    std::uint32_t moved = 0;
    for (std::uint32_t i = 0; i < updates_.size(); i += stride, ++moved)
      distribution_.modify_region(0, {i}, updates_[i] = ranges(i, at, 0.0));
    for (std::uint32_t i = 0; i < views_.size(); i += stride, ++moved)
      distribution_.modify_region(i + 1, {0}, views_[i] = ranges(7919 * (i + 1), at, seen));
    return moved;
  }
  void match() { distribution_.match(); }
  /// Ends what a flush would end.
  void flush() {
    for (std::uint32_t federate = 1; federate <= subscribers_; ++federate) {
      FederateInterest& told = distribution_.of(federate);
      told.events.clear();
      if (told.needs_any_full_state) told.needs_full_state.clear();
      told.needs_any_full_state = false;
    }
  }
  /// Pairs in scope by what the distribution says, and by every range against every other.
  bool is_right() const {
    for (std::uint32_t view = 0; view < views_.size(); ++view)
      for (std::uint32_t i = 0; i < slots_.size(); ++i) {
        bool is_due = false;
        for (std::uint32_t k = 0; k < regions_each_; ++k)
          is_due |= overlap(updates_[i * regions_each_ + k], views_[view]);
        if (distribution_.of(view + 1).in_scope.contains(slots_[i]) != is_due) return false;
      }
    return true;
  }
  const DistributionCounters& counters() const { return distribution_.counters(); }

 private:
  std::vector<Range> ranges(std::uint32_t number, double at, double half) const {
    const double x = side * (0.5 + 0.5 * std::sin(0.61803 * number + 0.05 * at)),
                 y = side * (0.5 + 0.5 * std::cos(1.41421 * number + 0.05 * at));
    const double level = std::floor(4.0 * (0.5 + 0.499 * std::sin(2.71828 * number + 0.02 * at)));
    std::vector<Range> all{
        {x - half, x + half}, {y - half, y + half}, {level, level}, {3.0 - level, 3.0 - level}};
    all.resize(dimension_count_);
    return all;
  }
  static bool overlap(const std::vector<Range>& a, const std::vector<Range>& b) {
    bool all = true;
    for (std::size_t i = 0; i < a.size(); ++i) all = all && a[i].overlaps(b[i]);
    return all;
  }

  Fom fom_ = Fom::parse(model_xml, "bench");
  ObjectTable objects_{fom_};
  Ownership ownership_{fom_, objects_};
  std::uint32_t dimension_count_, regions_each_, subscribers_;
  Interest distribution_;
  std::vector<ObjectSlot> slots_;
  std::vector<std::vector<Range>> updates_, views_;
};

/// Arguments: dimensions of each region, regions of each entity, and of how many regions one moves.
void distribution_match(benchmark::State& state) {
  const auto dimensions = static_cast<std::uint32_t>(state.range(0)),
             regions_each = static_cast<std::uint32_t>(state.range(1)),
             stride = static_cast<std::uint32_t>(state.range(2));
  Field field(5500 / regions_each, 500, dimensions, regions_each);
  field.match();
  field.flush();
  double now = 0.0;
  std::uint64_t moved = 0;
  const DistributionCounters before = field.counters();
  for (auto _ : state) {
    moved += field.move(stride, now += 1.0 / 30.0);
    field.match();
    state.PauseTiming();
    field.flush();
    state.ResumeTiming();
  }
  if (!field.is_right()) state.SkipWithError("the pairs in scope are not those of brute force");
  const DistributionCounters& after = field.counters();
  const auto per_move = [&](std::uint64_t count) {
    return static_cast<double>(count) / static_cast<double>(moved);
  };
  state.counters["ns_per_moved_region"] = benchmark::Counter(
      static_cast<double>(moved) * 1e-9, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["changes"] = per_move(after.entries - before.entries + after.exits - before.exits);
  state.counters["reconsidered"] = per_move(after.pairs_reconsidered - before.pairs_reconsidered);
  state.counters["ranges_tested"] = per_move(after.ranges_tested - before.ranges_tested);
}

BENCHMARK(distribution_match)
    ->Name("rti/distribution/match")
    ->ArgNames({"dimensions", "regions_each", "one_moves_of"})
    ->Args({2, 1, 1})
    ->Args({2, 1, 100})
    ->Args({4, 1, 1})
    ->Args({4, 1, 100})
    ->Args({2, 4, 1})
    ->Args({4, 4, 1})
    ->UseRealTime()
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace rink::bench::rti_distribution_bench
