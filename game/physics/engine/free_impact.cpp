// One impulse, two predictions.
#include "game/physics/engine/free_impact.h"

#include "game/physics/bodies/journal.h"
#include "game/physics/bodies/tolerances.h"
#include "game/physics/flight/straight_flight.h"

namespace rink::physics::inline RINK_PRECISION {

FreeImpact::FreeImpact(const WorldSpec& spec, const Uses& uses)
    : restitution_(spec.restitution),
      bodies_(uses.bodies),
      detection_(uses.detection),
      events_(uses.events),
      prediction_(uses.prediction),
      record_(uses.record),
      observers_(uses.observers),
      rest_speed_(rest_speed(spec)),
      is_wanted_(spec.puck_drag == 0.0 && !(spec.puck_friction > 0.0) && !spec.surface_friction &&
                 !spec.accounts_energy && !spec.allow_overlap) {}

void FreeImpact::notify(std::uint32_t low, const Flight& before_low, std::uint32_t high,
                        const Flight& before_high, Real time) {
  record_.note(EventKind::puck_puck, time, low, high);
  bodies_.changes().note(low), bodies_.changes().note(high);
  record_.counters().evaluations += (before_low.time < time) + (before_high.time < time);
  record_.counters().bodies_touched += 2;
  if (observers_.before != nullptr) {
    observers_.before->keep_flight(low, before_low);
    observers_.before->keep_flight(high, before_high);
  }
  if (observers_.journal == nullptr) return;
  const Body &a = bodies_[low], &b = bodies_[high];
  observers_.journal->enter_impact({low, a, a.mouth}, {high, b, b.mouth});
}

bool FreeImpact::collide(std::uint32_t body, Partner p, Real time, bool is_crowded) {
  if (is_crowded || !is_body(p)) return false;
  const std::uint32_t low = std::min(body, p), high = std::max(body, p);
  const Body &a = bodies_[low], &b = bodies_[high];
  if (!may_be_free(a, b)) return false;
  const bool is_watched = observers_.journal != nullptr;
  const bool is_counting = is_watched && bodies_.curved_count() == 0 && counts_touching();
  if (is_watched && !is_counting && detection_.has_company(body, p, time)) return false;
  const Flight before_a = a, before_b = b;
  const auto square = bounce_freely(bodies_, low, high, time, {rest_speed_});
  if (!square) return false;
  const Real touching = a.radius + b.radius + Real(0.5 * clear_of_touching);
  if (is_counting && !(*square <= touching * touching && predict_alone(low, high))) {
    bodies_.take_back(low, before_a, a.version - 1);
    bodies_.take_back(high, before_b, b.version - 1);
    return false;
  }
  notify(low, before_a, high, before_b, time);
  if (is_counting) {
    events_.schedule(low);
    events_.schedule(high);
  } else {
    prediction_.predict(low);
    prediction_.predict(high);
  }
  return true;
}

/// Their next events, but for telling the schedule. False, with nothing predicted, if a third one
/// touches one of them.
bool FreeImpact::predict_alone(std::uint32_t low, std::uint32_t high) {
  const NextEvent slot_low = events_[low], slot_high = events_[high];
  const std::uint64_t predictions = record_.counters().predictions;
  if (prediction_.predict_counting(low) == 2 && prediction_.predict_counting(high) == 2)
    return true;  // each itself and the other
  events_.slot(low) = slot_low, events_.slot(high) = slot_high;
  record_.counters().predictions = predictions;
  return false;
}

}  // namespace rink::physics::inline RINK_PRECISION
