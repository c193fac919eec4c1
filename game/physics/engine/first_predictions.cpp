// The next events of all bodies at once: of two that are near each other, one is asked for both.
#include <algorithm>

#include "game/physics/engine/prediction.h"
#include "game/physics/flight/straight_flight.h"

namespace rink::physics::inline RINK_PRECISION {

/// At rest by itself: it has no event before somebody else's.
bool Prediction::is_left_alone(std::uint32_t body) const {
  return is_still(bodies_, body) && !bodies_[body].is(Body::held);
}

/// Whether nothing but the two states decides when two meet: all small and in straight flight.
bool Prediction::may_ask_pairs_once() const {
  return bodies_.curved_count() == 0 && puck_drag_ == 0.0 && grid_.wide().count() == 0 &&
         visits_meetings();
}

/// Counted twice, as if both had asked. The order of the offers is of no consequence.
void Prediction::ask_pairs_once() {
  grid_.visit_pairs(room_for_candidates(),
                    [&](std::uint32_t* list, std::uint32_t own, std::uint32_t all) {
                      for (; own > 0; --own) {
                        const std::uint32_t body = *list++;
                        counters_.predictions += 2 * std::uint64_t{--all};
                        visit_meetings(bodies_.table().bodies.data(), body, list, all,
                                       [&](std::uint32_t other, Real time) {
                                         offer(body, time, other);
                                         offer(other, time, body);
                                       });
                      }
                    });
}

void Prediction::predict_all(std::span<const std::uint32_t> bodies) {
  const auto moves = [&](std::uint32_t body) {
    return !bodies_[body].is(Body::gone) && !is_left_alone(body);
  };
  const auto mover_count = static_cast<std::size_t>(std::ranges::count_if(bodies, moves));
  events_.expect(mover_count);
  const bool asks_once = 2 * mover_count >= bodies.size() && may_ask_pairs_once();
  if (asks_once) {
    for (const std::uint32_t body : bodies)
      if (moves(body)) begin_alone(body);
    ask_pairs_once();
  }
  for (const std::uint32_t body : bodies) {
    if (bodies_[body].is(Body::gone)) continue;
    if (is_left_alone(body)) events_.drop(body);
    else if (asks_once) events_.schedule(body);
    else predict(body);
  }
}

}  // namespace rink::physics::inline RINK_PRECISION
