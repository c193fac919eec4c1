// The stage `vfc`, vector-field consistency: the farther an entity from its subscriber, the more
// may be held back of it, in time, in updates and in distance (Santos, Veiga & Ferreira 2007).
#include <algorithm>
#include <cassert>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "im/stages/held_updates.h"
#include "im/stages/stages.h"

namespace rink::im {
namespace {

class VectorField final : public HeldUpdates {
 public:
  VectorField(std::unique_ptr<Filter> inner, std::vector<ConsistencyZone> zones)
      : HeldUpdates(std::move(inner), "vfc"), zones_(std::move(zones)) {
    assert(!zones_.empty());
  }

 private:
  void judge(Subscriber subscriber, std::span<Held> held) override {
    const Region& own = subscription(subscriber);
    const Half pivot = middle_of(own);
    const double reach =
        std::min(0.5 * own.high_x - 0.5 * own.low_x, 0.5 * own.high_y - 0.5 * own.low_y);
    for (Held& each : held) {
      const double distance_now = distance(pivot, place(each.entity));
      const ConsistencyZone* zone = nullptr;
      for (const ConsistencyZone& wider : zones_)
        if (distance_now > wider.from * reach) zone = &wider;
      each.is_due = zone == nullptr || static_cast<double>(age(each)) > zone->matches ||
                    static_cast<double>(each.updates) > zone->updates ||
                    drift(each) > zone->distance;
    }
  }

  std::vector<ConsistencyZone> zones_;
};

}  // namespace

std::unique_ptr<Filter> make_vfc(std::unique_ptr<Filter> inner,
                                 std::vector<ConsistencyZone> zones) {
  return std::make_unique<VectorField>(std::move(inner), std::move(zones));
}

}  // namespace rink::im
