// One step per bucket of the schedule and distance.
#include "game/physics/engine/look_ahead.h"

#include <algorithm>

#include "game/physics/prefetch.h"

namespace rink::physics::inline RINK_PRECISION {

namespace {
/// With fewer bodies all is near at hand, and to look ahead costs a fifth.
constexpr std::uint32_t look_ahead_min = 30'000;
}  // namespace

bool LookAhead::is_worthwhile() const {
  return bodies_.count() >= look_ahead_min && events_.upcoming().knows_upcoming();
}

void LookAhead::fetch_body(std::uint32_t body) const {
  prefetch(&bodies_[body]);
  prefetch(&events_[body]);
  grid_.prefetch_place(body);
  events_.upcoming().prefetch(body);
}

void LookAhead::fetch_collected(std::uint32_t count) const {
  for (std::uint32_t k = 0; k < count; ++k) prefetch(&bodies_[candidates_[k]]);
}

bool LookAhead::meets(std::uint32_t body) const {
  return events_[body].impact_time <= events_[body].crossing_time;
}

bool LookAhead::meets_listed(std::uint32_t body) const {
  return meets(body) && is_body(events_[body].partner) &&
         grid_.is_in_one_cell(events_[body].partner);
}

template <class Visit>
void LookAhead::step(std::size_t number, Visit&& visit) {
  const EventSchedule& schedule = events_.upcoming();
  const std::int64_t distance = static_cast<std::int64_t>(seen_.size() - number),
                     current = schedule.current();
  std::int64_t& last = seen_[number];
  if (last > current + distance) last = current;  // the buckets were numbered anew
  for (last = std::max(last, current); last < current + distance;)
    schedule.upcoming(++last - current, visit);
}

void LookAhead::fetch() {
  candidates_.resize(grid_.collected_max());
  step(0, [&](std::uint32_t body) { fetch_body(body); });
  step(1, [&](std::uint32_t body) {
    if (!grid_.is_in_one_cell(body)) return;  // it is wide, or has left, but its note has not
    if (!meets(body)) return grid_.prefetch_cells_ahead(body, events_[body].direction);
    grid_.prefetch_cells(body);
    if (is_body(events_[body].partner)) fetch_body(events_[body].partner);
  });
  step(2, [&](std::uint32_t body) {
    if (!grid_.is_in_one_cell(body)) return;
    fetch_collected(meets(body) ? grid_.collect(body, candidates_.data())
                                : grid_.collect_ahead_of_move(body, events_[body].direction,
                                                              candidates_.data()));
    if (meets_listed(body)) grid_.prefetch_cells(events_[body].partner);
  });
  step(3, [&](std::uint32_t body) {
    if (meets_listed(body))
      fetch_collected(grid_.collect(events_[body].partner, candidates_.data()));
  });
}

}  // namespace rink::physics::inline RINK_PRECISION
