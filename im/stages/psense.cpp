// The stage `psense`: of the relevant entities those within the vision range, and in each of eight
// sectors around it the nearest one beyond, which would notice newcomers (Schmieg et al. 2008).
#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "im/stages/chooser.h"
#include "im/stages/stages.h"

namespace rink::im {
namespace {

constexpr std::size_t sector_count = 8;

/// Sector k reaches from 45 k degrees, its own edge, to the next one's, counter-clockwise from the
/// x axis. Only signs and sides are compared, so what lies on an edge does so to the last bit.
std::size_t sector_of(double x, double y) {
  assert(x != 0.0 || y != 0.0);
  std::size_t quarter = 0;
  for (; !(x > 0.0 && y >= 0.0); ++quarter) x = std::exchange(y, -x);  // a quarter turn back
  assert(quarter < 4);
  return 2 * quarter + (y >= x ? 1 : 0);
}

class PSense final : public Chooser {
 public:
  PSense(std::unique_ptr<Filter> inner, double vision)
      : Chooser(std::move(inner), {}), vision_(vision) {
    assert(vision_ > 0.0 && vision_ <= 1.0);
  }
  void list_counts(std::vector<StageCount>& counts) const override {
    Parts::list_counts(counts);
    counts.push_back({"psense", "sensor nodes chosen", sensors_});
    counts.push_back({"psense", "entities left out", left_out_});
  }

 private:
  struct Sensor {
    std::size_t place;  ///< in the list
    double distance_squared;
  };

  /// The list ascends by id, so of sensors equally near the first found has the smaller id.
  void choose(Subscriber subscriber, const CandidatePairs::List& list) override {
    const rink_party& me = subscribers_.data()[subscriber];
    const double range = vision_ * (0.5 * std::min(me.high_x - me.low_x, me.high_y - me.low_y));
    constexpr Sensor none{std::numeric_limits<std::size_t>::max(), 0.0};
    std::array<Sensor, sector_count> sensors;
    sensors.fill(none);
    for (std::size_t i = 0; i < list.size(); ++i) {
      const rink_party& its = entities_.data()[list.entity(i)];
      const double x = its.x - me.x, y = its.y - me.y, distance_squared = x * x + y * y;
      if (distance_squared <= range * range) {
        is_chosen_[i] = true;
        continue;
      }
      Sensor& sensor = sensors[sector_of(x, y)];
      if (sensor.place == none.place || distance_squared < sensor.distance_squared)
        sensor = {i, distance_squared};
    }
    for (const Sensor& sensor : sensors)
      if (sensor.place != none.place) is_chosen_[sensor.place] = true, ++sensors_;
    pairs_tested_ += list.size();
  }

  double vision_;
  std::uint64_t sensors_ = 0;
};

}  // namespace

std::unique_ptr<Filter> make_psense(std::unique_ptr<Filter> inner, double vision) {
  return std::make_unique<PSense>(std::move(inner), vision);
}

}  // namespace rink::im
