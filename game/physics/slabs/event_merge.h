// Lists that several tiles have written, as one list in the order of times and bodies.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "game/physics/event.h"
#include "game/physics/event_budget.h"
#include "game/physics/events/event_order.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// An event and its place in the order of time and bodies.
struct OrderedEvent {
  EventOrder order;
  Event event;
};

/// The events in the order in which one loop would have written them; those of one place stay as
/// they are given.
std::vector<Event> in_order(std::vector<OrderedEvent> events);

/// Leaves the last EventBudget::recent_max of the events, in that order.
void keep_latest(std::vector<ChargedEvent>& events);

/// Sorts entries by their `order`; those of one place stay as they are given. Keeps its room.
template <class Entry>
class InOrder {
 public:
  void clear() { entries_.clear(), sorted_.clear(); }
  void add(const Entry& entry) { entries_.push_back(entry); }
  void add(std::span<const Entry> entries) {
    entries_.insert(entries_.end(), entries.begin(), entries.end());
  }
  /// All that was added since clear().
  std::span<const Entry> sort();
  /// As it was sorted last.
  std::span<const Entry> sorted() const { return sorted_; }

 private:
  static bool comes_before(const Entry& a, const Entry& b) { return precedes(a.order, b.order); }
  void sort_by_slots();
  void sort_slot(std::uint32_t begin, std::uint32_t end);

  std::vector<Entry> entries_, sorted_;
  std::vector<std::uint32_t> ends_;  // of the slots in `sorted_`
};

/// Events come about evenly in time, so that few are in one slot: five times as fast as to compare
/// all.
template <class Entry>
void InOrder<Entry>::sort_by_slots() {
  const auto [first, last] = std::minmax_element(
      entries_.begin(), entries_.end(),
      [](const Entry& a, const Entry& b) { return a.order.time < b.order.time; });
  const Real begin = first->order.time, span = last->order.time - begin;
  const std::size_t count = entries_.size();
  const auto slot = [&](const Entry& entry) {
    const Real part = span > 0.0 ? (entry.order.time - begin) / span : Real(0.0);
    return static_cast<std::size_t>(static_cast<double>(part) * static_cast<double>(count - 1));
  };
  ends_.assign(count + 1, 0);
  for (const Entry& entry : entries_) ++ends_[slot(entry) + 1];
  for (std::size_t k = 0; k < count; ++k) ends_[k + 1] += ends_[k];
  sorted_.resize(count);
  for (const Entry& entry : entries_) sorted_[ends_[slot(entry)]++] = entry;
}

template <class Entry>
std::span<const Entry> InOrder<Entry>::sort() {
  if (entries_.empty()) return {};
  sort_by_slots();
  std::uint32_t begin = 0;
  for (std::size_t k = 0; k + 1 < ends_.size(); begin = ends_[k++]) sort_slot(begin, ends_[k]);
  assert(std::is_sorted(sorted_.begin(), sorted_.end(), comes_before));
  return sorted_;
}

/// By insertion, unless very many events come at one instant.
template <class Entry>
void InOrder<Entry>::sort_slot(std::uint32_t begin, std::uint32_t end) {
  constexpr std::uint32_t few = 32;
  if (end - begin > few)
    return std::stable_sort(sorted_.begin() + begin, sorted_.begin() + end, comes_before);
  for (std::uint32_t k = begin + 1; k < end; ++k) {
    const Entry entry = sorted_[k];
    std::uint32_t place = k;
    for (; place > begin && comes_before(entry, sorted_[place - 1]); --place)
      sorted_[place] = sorted_[place - 1];
    sorted_[place] = entry;
  }
}

}  // namespace rink::physics::inline RINK_PRECISION
