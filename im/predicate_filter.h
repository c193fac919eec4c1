// The short path to a scheme: makes a whole filter of a predicate that says whether one entity matters to one subscriber.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>

#include "im/candidate_pairs.h"
#include "im/overlap_filter.h"

namespace rink::im {

/// One of the two that a predicate is asked about: an entity with its update region, or a subscriber with its subscription region.
struct Party {
  std::uint32_t id;
  const Region& region;
};

/// An entity matters to a subscriber while their closed rectangles overlap and `relevant(subscriber, entity)`, a pure function of two `Party`s, is true. The
/// engine behind `OverlapFilter` finds the pairs whose rectangles overlap; the predicate is asked about those of which one has moved, and about no other.
/// Who wants to be found from farther than his rectangle reaches derives from it and hands in a wider one, as schemes do that map regions to cells.
template <class Relevant>
class PredicateFilter : public OverlapFilter {
 public:
  explicit PredicateFilter(const Region& world, Relevant relevant = {}) : OverlapFilter(world), relevant_(std::move(relevant)) {}

  void remove_entity(Entity entity) override {
    OverlapFilter::remove_entity(entity);
    pairs_.remove_entity(entity);
  }
  void remove_subscriber(Subscriber subscriber) override {
    OverlapFilter::remove_subscriber(subscriber);
    pairs_.remove_subscriber(subscriber);
  }
  std::span<const Change> match() override {
    const std::span<const Change> box_changes = find();
    for (const Entity entity : entities_.moved()) pairs_.touch_near(entity);
    for (const Subscriber subscriber : subscribers_.moved()) pairs_.touch(subscriber);
    changes_.clear();
    pairs_.review(box_changes, [this](Subscriber subscriber, Entity entity, bool was) { return decide(subscriber, entity, was); }, changes_);
    settle(changes_.span());
    return changes_.span();
  }

  /// Memory held.
  std::size_t bytes() const { return OverlapFilter::bytes() + pairs_.bytes() + sizeof(Change) * changes_.capacity(); }

 private:
  bool decide(Subscriber subscriber, Entity entity, bool was) {
    if (!entities_.has_moved(entity) && !subscribers_.has_moved(subscriber)) return was;
    ++counters_.pairs_tested;
    return relevant_(Party{subscriber, subscribers_[subscriber].now}, Party{entity, entities_[entity].now});
  }

  Relevant relevant_;
  CandidatePairs pairs_;
  Buffer<Change> changes_;
};

template <class Relevant>
std::unique_ptr<Filter> make_predicate_filter(const FilterSettings& settings, Relevant relevant) {
  return std::make_unique<PredicateFilter<Relevant>>(settings.world, std::move(relevant));
}

}  // namespace rink::im
