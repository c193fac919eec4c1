// The exact matching engine that the rectangle-like schemes share.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "im/cell_index.h"
#include "im/filter.h"
#include "im/region_history.h"

namespace rink::im {

/// Interest is overlap of closed rectangles. A scheme that maps what it is given to other rectangles (`grid`: to cells) derives from it and overrides
/// the two setters. Keeps no pairs: a change is a pair whose overlap before and now differ, so only pairs near an edge of something that moved are tested.
class OverlapFilter : public Filter {
 public:
  /// `world` is where most entities are, in the derived scheme's coordinates.
  explicit OverlapFilter(const Region& world) : everyone_(world), movers_(world) {}

  void set_update_region(Entity entity, const Region& region) override;
  void remove_entity(Entity entity) override;
  void set_subscription_region(Subscriber subscriber, const Region& region) override;
  void remove_subscriber(Subscriber subscriber) override;
  std::span<const Change> match() override;
  const FilterCounters& counters() const override { return counters_; }

 private:
  void index_everyone();
  void match_subscriber(Subscriber subscriber, CellIndex& index);
  void match_moved_subscribers(std::span<const std::uint32_t> subscribers);
  void match_every_subscriber(std::span<const std::uint32_t> moved_entities, bool some_subscribers_moved);

  RegionHistory entities_, subscribers_;
  CellIndex everyone_;  // all entities: for subscribers that moved
  CellIndex movers_;    // those that moved: for subscribers that did not
  bool everyone_is_current_ = false;
  std::vector<std::uint32_t> present_;  // entities in `everyone_`
  std::vector<std::uint32_t> changed_;  // entities of one subscriber
  std::vector<Change> changes_;
  FilterCounters counters_;
};

}  // namespace rink::im
