// The pairs whose boxes overlap, with the last decision about each: an exact test looks at them
// again when one of the two moves.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

#include "im/basics/checked.h"
#include "im/filter.h"
#include "im/matching/buffer.h"

namespace rink::im {

/// Memory: 12 bytes per pair and half as much in reserve. Lists keep theirs when pairs go.
class CandidatePairs {
  /// An entity and, in the lowest bit, whether it is relevant.
  struct Entry {
    std::uint32_t key;
    float rests_until;
  };

 public:
  /// Forget the pairs of an id.
  void remove_entity(Entity entity);
  void remove_subscriber(Subscriber subscriber);

  /// Has `review` look at the pairs of `subscriber`, or at those of all whose box overlaps that of
  /// `entity`.
  void touch(Subscriber subscriber);
  void touch_near(Entity entity);
  /// Forgets until when the pairs of `subscriber` may rest.
  void wake(Subscriber subscriber);

  /// Applies the ordered changes of the boxes, and calls `decide(subscriber, entity, is_relevant,
  /// rests_until)` for each touched pair. The third argument is its last decision; the fourth, if
  /// it takes one, is a number that it may keep, below all numbers at first. Appends the changes to
  /// `changes`, ordered.
  template <class Decide>
  void review(std::span<const Change> box_changes, const Decide& decide, Buffer<Change>& changes);

  /// The pairs of one subscriber, by ascending entity. Valid until the next `visit_touched`.
  class List {
   public:
    std::size_t size() const { return entries_->size(); }
    Entity entity(std::size_t i) const { return entity_of((*entries_)[i]); }
    bool is_relevant(std::size_t i) const { return CandidatePairs::is_relevant((*entries_)[i]); }
    float rests_until(std::size_t i) const { return (*entries_)[i].rests_until; }

   private:
    friend class CandidatePairs;
    explicit List(const Buffer<Entry>& entries) : entries_(&entries) {}
    const Buffer<Entry>* entries_;
  };

  /// For those who decide about many pairs at once: applies the ordered changes of the boxes and
  /// calls `visit(subscriber, list)` for each touched subscriber in ascending order, then or later
  /// to be followed by calls of `decide`, and at last by `report`.
  template <class Visit>
  void visit_touched(std::span<const Change> box_changes, const Visit& visit);
  /// Keeps the decision about the i-th pair in the list of `subscriber`; pairs come in order.
  void decide(Subscriber subscriber, std::size_t i, bool is_relevant, float rests_until);
  /// Appends all changes since the last report to `changes`, ordered.
  void report(Buffer<Change>& changes);

  std::size_t bytes() const;
  /// Asserts that lists are in order and that both directions hold the same pairs.
  void check() const;

 private:
  static Entity entity_of(Entry entry) { return entry.key >> 1; }
  static bool is_relevant(Entry entry) { return (entry.key & 1u) != 0; }

  void add(Subscriber subscriber, Entity entity);
  void forget(Subscriber subscriber, Entity entity);
  template <class Decide>
  std::size_t merge(Subscriber subscriber, std::span<const Change> box_changes,
                    const Decide& decide, Buffer<Change>& changes);

  std::vector<Buffer<Entry>> entries_;           // by subscriber, ascending
  std::vector<Buffer<Subscriber>> subscribers_;  // by entity, in no order
  Buffer<Entry> merged_;
  Buffer<Change> left_, decided_;
  Buffer<Subscriber> touched_;
  std::vector<bool> is_touched_;
};

template <class Decide>
void CandidatePairs::review(std::span<const Change> box_changes, const Decide& decide,
                            Buffer<Change>& changes) {
  for (const Change& change : box_changes) touch(change.subscriber);
  std::sort(touched_.data(), touched_.data() + touched_.size());
  for (const Subscriber subscriber : touched_.span()) {
    box_changes = box_changes.subspan(merge(subscriber, box_changes, decide, changes));
    is_touched_[subscriber] = false;
  }
  assert(box_changes.empty());  // they were ordered, and each was of somebody touched
  touched_.clear();
  if constexpr (checks_whole_structures) check();
}

template <class Visit>
void CandidatePairs::visit_touched(std::span<const Change> box_changes, const Visit& visit) {
  for (const Change& change : box_changes) touch(change.subscriber);
  std::sort(touched_.data(), touched_.data() + touched_.size());
  const auto keep = [](Subscriber, Entity, bool was) { return was; };
  for (const Subscriber subscriber : touched_.span()) {
    box_changes = box_changes.subspan(merge(subscriber, box_changes, keep, left_));
    is_touched_[subscriber] = false;
    visit(subscriber, List(entries_[subscriber]));
  }
  assert(box_changes.empty());  // they were ordered, and each was of somebody touched
  touched_.clear();
  if constexpr (checks_whole_structures) check();
}

/// Returns how many of `box_changes`, the first, were of `subscriber`.
template <class Decide>
std::size_t CandidatePairs::merge(Subscriber subscriber, std::span<const Change> box_changes,
                                  const Decide& decide, Buffer<Change>& changes) {
  Buffer<Entry>& entries = entries_[subscriber];
  std::size_t next = 0;
  const auto has_change = [&] {
    return next < box_changes.size() && box_changes[next].subscriber == subscriber;
  };
  const auto looked_at = [&](Entry entry) -> Entry {
    const Entity entity = entity_of(entry);
    const bool was = is_relevant(entry);
    bool is = was;
    if constexpr (std::is_invocable_v<const Decide&, Subscriber, Entity, bool, float&>)
      is = decide(subscriber, entity, was, entry.rests_until);
    else is = decide(subscriber, entity, was);
    if (is != was)
      changes.push_back({subscriber, entity, is ? Transition::entered : Transition::left});
    return {entity << 1 | (is ? 1u : 0u), entry.rests_until};
  };
  if (!has_change()) {
    for (std::size_t i = 0; i < entries.size(); ++i) entries[i] = looked_at(entries[i]);
    return 0;
  }
  const auto enter_below = [&](std::uint64_t end) {
    for (; has_change() && box_changes[next].entity < end; ++next) {
      assert(box_changes[next].transition == Transition::entered);
      add(subscriber, box_changes[next].entity);
      merged_.push_back(
          looked_at({box_changes[next].entity << 1, -std::numeric_limits<float>::infinity()}));
    }
  };
  merged_.clear();
  merged_.reserve(entries.size() + box_changes.size());
  for (const Entry entry : entries.span()) {
    const Entity entity = entity_of(entry);
    enter_below(entity);
    if (!has_change() || box_changes[next].entity != entity) {
      merged_.push_back(looked_at(entry));
      continue;
    }
    assert(box_changes[next].transition == Transition::left);
    if (is_relevant(entry)) changes.push_back(box_changes[next]);
    forget(subscriber, entity);
    ++next;
  }
  enter_below(std::uint64_t{1} << 32);
  assert(!has_change());
  entries.resize(merged_.size());
  std::copy(merged_.span().begin(), merged_.span().end(), entries.data());
  return next;
}

}  // namespace rink::im
