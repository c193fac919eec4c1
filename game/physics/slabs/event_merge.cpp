// A stable sort by time and bodies.
#include "game/physics/slabs/event_merge.h"

#include <algorithm>

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

}  // namespace rink::physics::inline RINK_PRECISION
