// The stage `psense`: of the relevant entities those within the vision range, and in each of eight
// sectors around it the nearest one beyond, which would notice newcomers (Schmieg et al. 2008).
#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "im/composition/parts.h"
#include "im/pairs/parties.h"
#include "im/schemes/candidate_pairs.h"
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

/// Chooses among a subscriber's list anew when it, or one of its entities, moved, came or went.
class PSense final : public Parts {
 public:
  PSense(std::vector<std::unique_ptr<Filter>> inner, double vision)
      : Parts(std::move(inner)), vision_(vision), entities_(PairUses{}), subscribers_(PairUses{}) {
    assert(parts_.size() == 1 && vision_ > 0.0 && vision_ <= 1.0);
  }

  void set_update_region(Entity entity, const Region& region) override {
    if (entities_.place(entity, region)) pairs_.touch_near(entity);
    Parts::set_update_region(entity, region);
  }
  void set_subscription_region(Subscriber subscriber, const Region& region) override {
    if (subscribers_.place(subscriber, region)) pairs_.touch(subscriber);
    Parts::set_subscription_region(subscriber, region);
  }
  void remove_entity(Entity entity) override {
    Parts::remove_entity(entity);
    pairs_.touch_near(entity);
    entities_.remove(entity);
    pairs_.remove_entity(entity);
  }
  void remove_subscriber(Subscriber subscriber) override {
    Parts::remove_subscriber(subscriber);
    subscribers_.remove(subscriber);
    pairs_.remove_subscriber(subscriber);
  }
  std::span<const Change> match() override {
    pairs_.visit_touched(parts_.front()->match(),
                         [this](Subscriber subscriber, const CandidatePairs::List& list) {
                           choose(subscriber, list);
                         });
    changes_.clear();
    pairs_.report(changes_);
    return reported(changes_.span());
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
  void choose(Subscriber subscriber, const CandidatePairs::List& list) {
    if (list.size() == 0) return;
    const rink_party& me = subscribers_.data()[subscriber];
    const double range = vision_ * (0.5 * std::min(me.high_x - me.low_x, me.high_y - me.low_y));
    constexpr Sensor none{std::numeric_limits<std::size_t>::max(), 0.0};
    std::array<Sensor, sector_count> sensors;
    sensors.fill(none);
    is_chosen_.assign(list.size(), false);
    std::size_t chosen = 0;
    for (std::size_t i = 0; i < list.size(); ++i) {
      const rink_party& its = entities_.data()[list.entity(i)];
      const double x = its.x - me.x, y = its.y - me.y, distance_squared = x * x + y * y;
      if (distance_squared <= range * range) {
        is_chosen_[i] = true, ++chosen;
        continue;
      }
      Sensor& sensor = sensors[sector_of(x, y)];
      if (sensor.place == none.place || distance_squared < sensor.distance_squared)
        sensor = {i, distance_squared};
    }
    for (const Sensor& sensor : sensors)
      if (sensor.place != none.place) is_chosen_[sensor.place] = true, ++chosen, ++sensors_;
    for (std::size_t i = 0; i < list.size(); ++i) pairs_.decide(subscriber, i, is_chosen_[i], 0.0f);
    pairs_tested_ += list.size(), left_out_ += list.size() - chosen;
  }

  double vision_;
  Parties entities_, subscribers_;
  CandidatePairs pairs_;
  std::vector<bool> is_chosen_;
  std::uint64_t sensors_ = 0, left_out_ = 0;
};

}  // namespace

std::unique_ptr<Filter> make_psense(std::unique_ptr<Filter> inner, double vision) {
  std::vector<std::unique_ptr<Filter>> parts;
  parts.push_back(std::move(inner));
  return std::make_unique<PSense>(std::move(parts), vision);
}

}  // namespace rink::im
