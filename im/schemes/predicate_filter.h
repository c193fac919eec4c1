// The short path to a scheme: makes a whole filter of a predicate that decides whether one entity
// matters to one subscriber.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "im/marks.h"
#include "im/schemes/candidate_pairs.h"
#include "im/schemes/judgement.h"
#include "im/schemes/odometer.h"
#include "im/schemes/overlap_filter.h"

namespace rink::im {

/// An argument of a predicate: an entity with its update region, or a subscriber with its
/// subscription region.
struct Party {
  std::uint32_t id;
  const Region& region;
};

/// An entity matters to a subscriber while their closed rectangles overlap and
/// `relevant(subscriber, entity)`, a pure function of two `Party`s, is true. The engine behind
/// `OverlapFilter` finds the pairs whose rectangles overlap; the predicate is called only for pairs
/// of which one has moved. A scheme whose shapes reach beyond the rectangles derives from this
/// class and sets wider ones, as schemes that map regions to cells do.
template <class Relevant>
class PredicateFilter : public OverlapFilter {
 public:
  explicit PredicateFilter(const Region& world, Relevant relevant = {})
      : OverlapFilter(world), relevant_(std::move(relevant)) {}

  void set_update_region(Entity entity, const Region& region) override {
    swept_entities_.unset(entity);
    OverlapFilter::set_update_region(entity, region);
  }
  void set_subscription_region(Subscriber subscriber, const Region& region) override {
    swept_subscribers_.unset(subscriber);
    OverlapFilter::set_subscription_region(subscriber, region);
  }
  /// While one of both is swept the predicate is not called, since it sees one place and may be
  /// true at another. Overlap of the rectangles is enough.
  void set_swept_update_region(Entity entity, const Region& from, const Region& to) override {
    if (from == to) set_update_region(entity, from);
    else sweep_entity(entity, hull_of(from, to));
  }
  void set_swept_subscription_region(Subscriber subscriber, const Region& from,
                                     const Region& to) override {
    set_subscription_region(subscriber, hull_of(from, to));
    if (from != to) swept_subscribers_.set(subscriber);
  }
  void remove_entity(Entity entity) override {
    swept_entities_.unset(entity);
    OverlapFilter::remove_entity(entity);
    pairs_.remove_entity(entity);
  }
  void remove_subscriber(Subscriber subscriber) override {
    swept_subscribers_.unset(subscriber);
    OverlapFilter::remove_subscriber(subscriber);
    pairs_.remove_subscriber(subscriber);
  }
  std::span<const Change> match() override {
    const std::span<const Change> box_changes = find();
    for (const Subscriber subscriber : subscribers_.moved()) pairs_.touch(subscriber);
    for (const Entity entity : entities_.moved()) pairs_.touch_near(entity);
    entity_ways_.follow(entities_), subscriber_ways_.follow(subscribers_);
    changes_.clear();
    pairs_.review(
        box_changes,
        [this](Subscriber subscriber, Entity entity, bool was, float& rests_until) {
          return decide(subscriber, entity, was, rests_until);
        },
        changes_);
    settle(changes_.span());
    return changes_.span();
  }

  /// Memory held.
  std::size_t bytes() const {
    return OverlapFilter::bytes() + pairs_.bytes() + sizeof(Change) * changes_.capacity() +
           entity_ways_.bytes() + subscriber_ways_.bytes();
  }

 protected:
  /// Marks the entity as swept over `hull`.
  void sweep_entity(Entity entity, const Region& hull) {
    OverlapFilter::set_update_region(entity, hull);
    swept_entities_.set(entity);
  }
  /// A change other than of its region affects the pairs of `subscriber`: by no more than a change
  /// of its region by `length` metres would, or without a bound.
  void turned(Subscriber subscriber, double length) { subscriber_ways_.add(subscriber, length); }
  void turned(Subscriber subscriber) { pairs_.wake(subscriber); }
  /// The predicate is another from now on, so the next match asks it about every pair.
  void replace(Relevant relevant) {
    relevant_ = std::move(relevant);
    for (Subscriber subscriber = 0; subscriber < subscribers_.size(); ++subscriber)
      turned(subscriber), subscribers_.touch(subscriber);
  }

 private:
  static Judgement judgement(bool is_relevant) { return {is_relevant, 0.0}; }
  static Judgement judgement(const Judgement& judgement) { return judgement; }
  /// A bound of the rounding error of a few sums and products of the coordinates of `region`, with
  /// a factor of thousands to spare.
  static double rounding(const Region& region) {
    return 1e-12 * std::max(std::max(std::abs(region.low_x), std::abs(region.high_x)),
                            std::max(std::abs(region.low_y), std::abs(region.high_y))) +
           1e-300;
  }

  bool decide(Subscriber subscriber, Entity entity, bool was, float& rests_until) {
    if (swept_entities_.has(entity) || swept_subscribers_.has(subscriber))
      return rests_until = -std::numeric_limits<float>::infinity(), true;
    const double way = entity_ways_[entity] + subscriber_ways_[subscriber];
    if (way < static_cast<double>(rests_until) ||
        (!entities_.has_moved(entity) && !subscribers_.has_moved(subscriber)))
      return was;
    ++counters_.pairs_tested;
    const Region &mine = subscribers_[subscriber].now, &its = entities_[entity].now;
    const Judgement is = judgement(relevant_(Party{subscriber, mine}, Party{entity, its}));
    assert(!(is.slack < 0.0));
    const double slack = is.slack > 0.0 ? is.slack - rounding(mine) - rounding(its) : 0.0;
    // Rounded down; where nothing is known it is always over.
    const auto until = static_cast<float>(std::min(way + slack, 1e30));
    rests_until = slack > 0.0 ? until - until * 0x1p-20f : -std::numeric_limits<float>::infinity();
    return is.is_relevant;
  }

  Relevant relevant_;
  CandidatePairs pairs_;
  Marks swept_entities_, swept_subscribers_;
  Odometer entity_ways_, subscriber_ways_;
  Buffer<Change> changes_;
};

template <class Relevant>
std::unique_ptr<Filter> make_predicate_filter(const FilterSettings& settings, Relevant relevant) {
  return std::make_unique<PredicateFilter<Relevant>>(settings.world, std::move(relevant));
}

}  // namespace rink::im
