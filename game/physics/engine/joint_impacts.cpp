// Gathering those who touch, and writing the velocities back.
#include "game/physics/engine/joint_impacts.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "game/physics/bodies/journal.h"
#include "game/physics/bodies/tolerances.h"

namespace rink::physics::inline RINK_PRECISION {

namespace {

constexpr std::size_t joint_max = 512;  // bodies
/// Gaps within so many roundings of an offset are none.
constexpr double touch_roundings = 16.0;

}  // namespace

EventKind impact_kind(const Bodies& bodies, std::uint32_t body, Partner p) {
  const auto is = [&](BodyKind kind) {
    return bodies[body].kind == kind || (is_body(p) && bodies[p].kind == kind);
  };
  if (!is_body(p)) return p >= partner::edge_left_low ? EventKind::post : EventKind::wall;
  if (is(BodyKind::post)) return EventKind::post;
  if (!is(BodyKind::bat)) return EventKind::puck_puck;
  return is(BodyKind::puck) ? EventKind::puck_bat : EventKind::bat_bat;
}

JointImpacts::JointImpacts(const WorldSpec& spec, const Uses& uses)
    : clock_(uses.clock),
      bodies_(uses.bodies),
      detection_(uses.detection),
      history_(uses.history),
      rests_(uses.rests),
      record_(uses.record),
      observers_(uses.observers),
      is_rough_(spec.surface_friction.has_value()),
      tolerance_(offset_tolerance(spec)) {}

bool JointImpacts::collide(const Contact& c, Real time) {
  if (!is_wanted()) return false;
  const bool is_joint = gather(c, time) || clock_.is_endless();
  record_dependency();
  if (!is_joint) return false;
  assert(problem_.body_count() == members_.size() && problem_.touches.size() == partners_.size());
  velocities_before_ = problem_.velocities;
  clock_.solver_failed = !solver_.solve(problem_, clock_.is_endless());
  if (clock_.solver_failed && observers_.journal != nullptr)
    observers_.journal->unsolved.push_back(time);
  if (clock_.solver_failed) return false;
  ++record_.counters().joint_impacts;
  apply(c, time);
  return true;
}

void JointImpacts::record_dependencies(const Contact& c, Real time) {
  if (observers_.journal == nullptr || !is_wanted() ||
      !detection_.has_company(c.body, c.partner, time))
    return;
  gather(c, time);
  record_dependency();
}

void JointImpacts::record_dependency() {
  if (observers_.journal == nullptr) return;
  std::vector<std::uint32_t>& looked_at = observers_.journal->sight.looked_at;
  looked_at.insert(looked_at.end(), members_.begin(), members_.end());
}

/// All bodies that touch those of `c`, directly or through others, in an order that depends on ids
/// alone. False if no other contact among them closes now.
bool JointImpacts::gather(const Contact& c, Real time) {
  members_.clear();
  problem_.clear();
  partners_.clear();
  place_of(c.body, time);
  if (!bodies_.is_fixed(c.partner)) place_of(c.partner, time);
  for (std::uint32_t place = 0; place < members_.size(); ++place)
    detection_.visit_partners(members_[place], [&](Partner p) { add_touch(place, p, c, time); });
  return does_another_close(c);
}

bool JointImpacts::does_another_close(const Contact& at_hand) const {
  // Slower than this, the time of an impact is too uncertain to tell whether it belongs to the
  // instant.
  const Real slowest = 2.0 * touch_roundings * tolerance_ / Real(instant);
  for (std::size_t i = 0; i < partners_.size(); ++i) {
    const Touch& touch = problem_.touches[i];
    const bool is_at_hand = touch.body == 0 && partners_[i] == at_hand.partner;
    if (!is_at_hand && -parting(touch, problem_.velocities) > slowest) return true;
  }
  return false;
}

std::uint32_t JointImpacts::place_of(std::uint32_t body, Real time) {
  const auto found = std::find(members_.begin(), members_.end(), body);
  if (found != members_.end()) return static_cast<std::uint32_t>(found - members_.begin());
  members_.push_back(body);
  problem_.add_body(bodies_.build(body).mass, bodies_.build(body).inverse_mass,
                    motion_at(bodies_, body, time).velocity, bodies_.is_slowed(body));
  return static_cast<std::uint32_t>(members_.size() - 1);
}

void JointImpacts::add_touch(std::uint32_t place, Partner p, const Contact& at_hand, Real time) {
  const std::uint32_t body = members_[place];
  const Contact c = detection_.contact(body, p, time);
  const bool is_at_hand = (body == at_hand.body && p == at_hand.partner) ||
                          (p == at_hand.body && body == at_hand.partner);
  const Real rounding =
      tolerance_ + std::numeric_limits<Real>::epsilon() * time * problem_.velocities[place].norm();
  if (!is_at_hand && c.gap.distance > touch_roundings * rounding) return;
  std::uint32_t other = fixed_place;
  if (!bodies_.is_fixed(p)) {
    if (members_.size() >= joint_max &&
        std::find(members_.begin(), members_.end(), p) == members_.end())
      return;
    other = place_of(p, time);
    if (other < place) return;  // known from the other side
  }
  problem_.touches.push_back({place, other, c.gap.normal, detection_.restitution(body, p)});
  partners_.push_back(p);
}

/// Rest contacts of whoever was pushed end as in any impact, and every contact that pushed counts
/// as one.
void JointImpacts::apply(const Contact& at_hand, Real time) {
  for (std::size_t i = 0; i < problem_.touches.size(); ++i) {
    const Touch& touch = problem_.touches[i];
    if (!touch.has_pushed) continue;
    const std::uint32_t body = members_[touch.body];
    if (body != at_hand.body || partners_[i] != at_hand.partner)
      count_further(body, partners_[i], time);
    for (const Partner p : {body, partners_[i]}) {
      if (bodies_.is_fixed(p)) continue;
      rests_.rouse(p, time);
      for (int axis = 0; axis < 2; ++axis)
        if (touch.normal[axis] != 0.0) rests_.dissolve(p, axis, time);
    }
  }
  for (std::size_t place = 0; place < members_.size(); ++place) {
    if (problem_.velocities[place] == velocities_before_[place]) continue;
    const std::uint32_t body = members_[place];
    bodies_.keep(body);
    bodies_.set_velocity(body, problem_.velocities[place]);
    bodies_.touch(body);  // also of one that moves by a rounding without a push: what is predicted
                          // of it must follow from its state
  }
}

/// Another impact than the one at hand.
void JointImpacts::count_further(std::uint32_t body, Partner p, Real time) {
  const bool is_fixed = bodies_.is_fixed(p);
  const std::uint32_t first = is_fixed ? body : std::min(body, p);
  const Partner second = is_fixed ? p : std::max(body, p);
  record_.note(impact_kind(bodies_, first, second), time, first, second);
  history_.note_impact(body, time);
  if (!is_fixed) history_.note_impact(p, time);
}

}  // namespace rink::physics::inline RINK_PRECISION
