// Entries rise and sink by (time, lower id, higher id).
#include "game/physics/events/event_heap.h"

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
  if (place == none) return;
  places_[body] = none;
  const Entry last = heap_.back();
  heap_.pop_back();
  if (place == heap_.size()) return;
  if (place > 0 && precedes(last, heap_[(place - 1) / 2])) raise(place, last);
  else sink(place, last);
}

void EventHeap::set(std::uint32_t body, Real time, std::uint32_t lower, std::uint32_t higher) {
  take_out(body);
  times_[body] = time;
  if (time == std::numeric_limits<Real>::infinity()) return;
  const Entry entry{{time, lower, higher}, body};
  heap_.push_back(entry);
  raise(static_cast<std::uint32_t>(heap_.size() - 1), entry);
}

}  // namespace rink::physics::inline RINK_PRECISION
