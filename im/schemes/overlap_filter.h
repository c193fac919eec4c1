// Interest as overlap of closed rectangles, or of discs with rectangles; the base of schemes that
// need no more.
#pragma once

#include <cstdint>
#include <span>

#include "im/filter.h"
#include "im/matching/change_join.h"
#include "im/matching/region_history.h"

namespace rink::im {

/// A scheme that maps regions to other rectangles (`grid`: to cells) derives from it and overrides
/// the two setters. Keeps no pairs.
class OverlapFilter : public Filter {
 public:
  /// `world` is where most entities are, in the derived scheme's coordinates; `shape` is the part
  /// of a subscription that counts.
  explicit OverlapFilter(const Region& world, Instructions instructions = Instructions::best,
                         Shape shape = Shape::rectangle)
      : join_(world, instructions, shape) {}

  void set_update_region(Entity entity, const Region& region) override;
  void remove_entity(Entity entity) override;
  void set_subscription_region(Subscriber subscriber, const Region& region) override;
  void remove_subscriber(Subscriber subscriber) override;
  std::span<const Change> match() override;
  const FilterCounters& counters() const override { return counters_; }
  void share_with(Worker* worker) override { join_.share_with(worker); }

  /// Memory held.
  std::size_t bytes() const;

 protected:
  // The two halves of `match`, for filters that decide more exactly than by rectangles: `find`
  // returns the changes, `settle` accepts the final ones.
  std::span<const Change> find();
  void settle(std::span<const Change> changes);
  /// For schemes whose coordinates get a new scale: where most entities are from now on.
  void expect(const Region& world) { join_.expect(world); }

  RegionHistory entities_, subscribers_;
  FilterCounters counters_;

 private:
  ChangeJoin join_;
};

}  // namespace rink::im
