// Sorts by time and bodies.
#include "game/physics/slabs/event_merge.h"

#include <algorithm>
#include <cstddef>

namespace rink::physics::inline RINK_PRECISION {

std::vector<Event> in_order(std::vector<OrderedEvent> events) {
  std::stable_sort(events.begin(), events.end(), [](const OrderedEvent& a, const OrderedEvent& b) {
    return precedes(a.order, b.order);
  });
  std::vector<Event> sorted;
  sorted.reserve(events.size());
  for (const OrderedEvent& ordered : events) sorted.push_back(ordered.event);
  return sorted;
}

void keep_latest(std::vector<ChargedEvent>& events) {
  const auto comes_before = [](const ChargedEvent& a, const ChargedEvent& b) {
    return precedes({a.time, a.body, a.partner}, {b.time, b.body, b.partner});
  };
  if (events.size() > EventBudget::recent_max) {
    const auto first = events.end() - static_cast<std::ptrdiff_t>(EventBudget::recent_max);
    std::nth_element(events.begin(), first, events.end(), comes_before);
    events.erase(events.begin(), first);
  }
  std::sort(events.begin(), events.end(), comes_before);
}

}  // namespace rink::physics::inline RINK_PRECISION
