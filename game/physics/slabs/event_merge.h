// Lists of events that several tiles have written, as one list.
#pragma once

#include <vector>

#include "game/physics/event.h"
#include "game/physics/event_budget.h"
#include "game/physics/events/event_order.h"

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

}  // namespace rink::physics::inline RINK_PRECISION
