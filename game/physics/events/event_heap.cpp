// Entries rise and sink by (time, lower id, higher id).
#include "game/physics/events/event_heap.h"

#include <cassert>

#include "im/basics/checked.h"

namespace rink::physics::inline RINK_PRECISION {

void EventHeap::raise(std::uint32_t place, const Entry& entry) {
  for (; place > 0 && precedes(entry, heap_[(place - 1) / 2]); place = (place - 1) / 2)
    put(place, heap_[(place - 1) / 2]);
  put(place, entry);
}

void EventHeap::sink(std::uint32_t place, const Entry& entry) {
  const auto size = static_cast<std::uint32_t>(heap_.size());
  for (std::uint32_t child = 2 * place + 1; child < size; child = 2 * place + 1) {
    if (child + 1 < size && precedes(heap_[child + 1], heap_[child])) ++child;
    if (!precedes(heap_[child], entry)) break;
    put(place, heap_[child]);
    place = child;
  }
  put(place, entry);
}

void EventHeap::take_out(std::uint32_t body) {
  const std::uint32_t place = places_[body];
  assert((place == none) == (times_[body] == std::numeric_limits<Real>::infinity()));
  if (place == none) return;
  places_[body] = none;
  const Entry last = heap_.back();
  heap_.pop_back();
  if (place == heap_.size()) return;
  if (place > 0 && precedes(last, heap_[(place - 1) / 2])) raise(place, last);
  else sink(place, last);
}

void EventHeap::set(std::uint32_t body, Real time, std::uint32_t lower, std::uint32_t higher) {
  assert(body < times_.size() && time == time && lower <= higher);
  take_out(body);
  times_[body] = time;
  if (time == std::numeric_limits<Real>::infinity()) return;
  const Entry entry{{time, lower, higher}, body};
  heap_.push_back(entry);
  raise(static_cast<std::uint32_t>(heap_.size() - 1), entry);
  if constexpr (checks_whole_structures) check();
}

void EventHeap::check() const {
  for (std::uint32_t place = 0; place < heap_.size(); ++place) {
    [[maybe_unused]] const Entry& entry = heap_[place];
    assert(place == 0 || !precedes(entry, heap_[(place - 1) / 2]));
    assert(places_[entry.body] == place && times_[entry.body] == entry.time);
  }
  [[maybe_unused]] const auto listed = static_cast<std::size_t>(std::count_if(
      places_.begin(), places_.end(), [](std::uint32_t place) { return place != none; }));
  assert(listed == heap_.size());
}

}  // namespace rink::physics::inline RINK_PRECISION
