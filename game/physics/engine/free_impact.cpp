// One impulse, two predictions.
#include "game/physics/engine/free_impact.h"

#include <algorithm>
#include <cmath>

#include "game/physics/bodies/journal.h"
#include "game/physics/bodies/tolerances.h"
#include "game/physics/contact/contact_problem.h"
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
  if (observers_.journal == nullptr) return;
  observers_.before->keep_flight(low, before_low);
  observers_.before->keep_flight(high, before_high);
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
  const Real elapsed_a = a.time < time ? time - a.time : 0.0,
             elapsed_b = b.time < time ? time - b.time : 0.0;
  const Real ax = a.x + a.vx * elapsed_a, ay = a.y + a.vy * elapsed_a, bx = b.x + b.vx * elapsed_b,
             by = b.y + b.vy * elapsed_b;
  const Real x = ax - bx, y = ay - by;
  if (x == 0.0 || y == 0.0)
    return false;  // in line with an axis they might come to rest on each other
  const Real approach = x * (b.vx - a.vx) + y * (b.vy - a.vy),
             length_max = std::abs(x) + std::abs(y), square = x * x + y * y;
  const Real speed_max = std::abs(a.vx) + std::abs(a.vy) + std::abs(b.vx) + std::abs(b.vy);
  if (!(approach >= 1.01 * std::max<Real>(rest_speed_, separation_min * speed_max) * length_max))
    return false;
  const Flight before_a = a, before_b = b;
  const Real impulse = (approach + approach) / ((a.inverse_mass + b.inverse_mass) * square);
  const Real kick_a = impulse * a.inverse_mass, kick_b = impulse * b.inverse_mass;
  bodies_.restart(low, {ax, ay}, {a.vx + kick_a * x, a.vy + kick_a * y}, std::max(a.time, time));
  bodies_.restart(high, {bx, by}, {b.vx - kick_b * x, b.vy - kick_b * y}, std::max(b.time, time));
  const Real touching = a.radius + b.radius + Real(0.5 * clear_of_touching);
  if (is_counting && !(square <= touching * touching && predict_alone(low, high))) {
    bodies_.take_back(low, before_a), bodies_.take_back(high, before_b);
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
