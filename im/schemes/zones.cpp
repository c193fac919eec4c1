// The scheme `zones`: an entity matters to a subscriber while the subscription touches the zone
// that it is in, where crowded zones are cut and empty ones joined (Steed & Abou-Haidar 2003).
#include <algorithm>
#include <cstdint>
#include <vector>

#include "im/schemes/cells.h"
#include "im/schemes/overlap_filter.h"
#include "im/schemes/zone_tree.h"

namespace rink::im {
namespace {

/// Each entity stands for its zone, so that the entities of a zone that is cut or joined move.
class ZonesFilter final : public OverlapFilter {
 public:
  ZonesFilter(const Region& world, std::uint32_t capacity)
      : OverlapFilter(world), world_(world), tree_(world, capacity) {}

  void set_update_region(Entity entity, const Region& region) override {
    const Region centre = centre_of(region);
    tree_.set(entity, centre.low_x, centre.low_y);
  }
  void remove_entity(Entity entity) override {
    tree_.remove(entity);
    OverlapFilter::remove_entity(entity);
  }
  /// Zones on the rim reach outwards without end: what lies outside touches them where it is
  /// nearest.
  void set_subscription_region(Subscriber subscriber, const Region& region) override {
    OverlapFilter::set_subscription_region(
        subscriber, {std::clamp(region.low_x, world_.low_x, world_.high_x),
                     std::clamp(region.low_y, world_.low_y, world_.high_y),
                     std::clamp(region.high_x, world_.low_x, world_.high_x),
                     std::clamp(region.high_y, world_.low_y, world_.high_y)});
  }
  std::span<const Change> match() override {
    moved_.clear();
    tree_.settle(moved_);
    for (const Entity entity : moved_)
      OverlapFilter::set_update_region(entity, tree_.zone_of(entity));
    return OverlapFilter::match();
  }
  Traits traits() const override { return {.depends_on_crowd = true}; }
  void list_counts(std::vector<StageCount>& counts) const override {
    counts.push_back({"zones", "zones at the end", tree_.zone_count()});
  }

 private:
  Region world_;
  ZoneTree tree_;
  std::vector<Entity> moved_;
};

}  // namespace

std::unique_ptr<Filter> make_zones_filter(const FilterSettings& settings);

std::unique_ptr<Filter> make_zones_filter(const FilterSettings& settings) {
  return std::make_unique<ZonesFilter>(settings.world, settings.zone_capacity);
}

}  // namespace rink::im
