// What subscribers were not told yet of the entities in their lists: the base of stages that hold
// updates back within bounds.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "im/composition/pair_lists.h"
#include "im/composition/parts.h"
#include "im/matching/buffer.h"

namespace rink::im {

/// An update is a match before which `note_update` was called for an entity. Each is held back from
/// each subscriber in whose list the entity is, until the derived stage says that the pair is due.
/// The stage counts on that: whoever hears of `due` tells the newest state.
class HeldUpdates : public Parts {
 public:
  /// `name` is that of the stage, for its counts.
  HeldUpdates(std::unique_ptr<Filter> inner, const char* name);

  void set_update_region(Entity entity, const Region& region) override;
  void set_subscription_region(Subscriber subscriber, const Region& region) override;
  void note_update(Entity entity) override;
  void remove_entity(Entity entity) override;
  void remove_subscriber(Subscriber subscriber) override;
  std::span<const Change> match() override;
  Traits traits() const override;
  void list_counts(std::vector<StageCount>& counts) const override;

 protected:
  /// A middle [m], halved, since the differences of the largest numbers have no double.
  struct Half {
    double x = 0.0, y = 0.0;
  };
  /// A relevant pair of which updates are held back.
  struct Held {
    Entity entity;
    std::uint32_t updates;  ///< at least 1
    std::uint64_t since;    ///< the last match at which what was told was the newest
    Half from;              ///< where it was then
    double way;             ///< the sum of its steps since then [m]
    bool is_due;
  };
  static Half middle_of(const Region& region) {
    return {0.25 * region.low_x + 0.25 * region.high_x, 0.25 * region.low_y + 0.25 * region.high_y};
  }
  /// [m]
  static double distance(const Half& from, const Half& to);

  /// Sets `is_due` of each pair that is told at this match. `held` is not empty: all pairs of
  /// `subscriber` with updates held back.
  virtual void judge(Subscriber subscriber, std::span<Held> held) = 0;

  /// Matches since what was told was the newest; 1 at the first update.
  std::uint64_t age(const Held& held) const { return now_ - held.since; }
  /// How far it is from where it was then [m].
  double drift(const Held& held) const { return distance(held.from, place(held.entity)); }
  const Region& subscription(Subscriber subscriber) const { return subscriptions_[subscriber]; }
  const Half& place(Entity entity) const { return places_[entity].middle; }

 private:
  struct Place {
    Region region;                 ///< now
    Half middle, before;           ///< at the last match, and at the one before
    std::uint64_t matched_at = 0;  ///< by number, when something of it was new
    bool is_new = true, is_listed = false, is_updated = false;
  };

  /// A relevant pair.
  struct Known {
    Entity entity;
  };

  void list(Entity entity);
  void move_places();
  void hold(Entity entity);
  void take(std::span<const Change> changes);
  void forget(Subscriber subscriber, Entity entity);
  void tell(Subscriber subscriber, Buffer<Held>& pairs);
  void check() const;

  const char* name_;
  std::uint64_t now_ = 0;  ///< number of the match
  std::vector<Place> places_;
  std::vector<Region> subscriptions_;
  PairLists<Known> known_;
  std::vector<Buffer<Subscriber>> near_;  ///< by entity: its subscribers, in any order
  PairLists<Held> held_;
  Buffer<Entity> touched_;  ///< moved or updated since the last match
  Buffer<Change> due_;
  std::uint64_t updates_ = 0, told_ = 0;
};

}  // namespace rink::im
