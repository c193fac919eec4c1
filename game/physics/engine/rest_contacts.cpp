// Which bodies rest against each other, and the forces between them.
#include "game/physics/engine/rest_contacts.h"

#include <algorithm>
#include <cassert>

#include "game/physics/bodies/journal.h"
#include "game/physics/bodies/tolerances.h"
#include "game/physics/flight/exponential.h"

namespace rink::physics::inline RINK_PRECISION {

namespace {

/// A contact this near to the end of a face, and moving towards it, does not come to rest [m].
constexpr double face_margin = 1e-9;
/// Sides that would accelerate apart by more than this let go [m/s^2].
constexpr double pull_min = 1e-9;

}  // namespace

RestContacts::RestContacts(const WorldSpec& spec, Bodies& bodies, Jams& jams, EventRecord& record,
                           const Observers& observers)
    : bodies_(bodies),
      friction_(spec, bodies),
      jams_(jams),
      record_(record),
      observers_(observers),
      tolerance_(offset_tolerance(spec)),
      contact_time_(spec.contact_time) {}

bool RestContacts::are_joined(std::uint32_t a, std::uint32_t b) const {
  return std::any_of(rest_contacts_.begin(), rest_contacts_.end(), [&](const RestContact& rest) {
    return (rest.low == a && rest.high == b) || (rest.low == b && rest.high == a);
  });
}

std::vector<std::uint32_t> RestContacts::group(std::uint32_t body, std::uint8_t axes) const {
  assert(body < bodies_.count() && axes != 0 && (axes & ~Body::held) == 0);
  std::vector<std::uint32_t> found{body};
  const auto include = [&](Partner p) {
    if (!bodies_.is_fixed(p) && std::find(found.begin(), found.end(), p) == found.end())
      found.push_back(p);
  };
  for (std::size_t i = 0; i < found.size(); ++i)
    for (const RestContact& rest : rest_contacts_) {
      if ((axes & Body::held_along(rest.axis)) == 0) continue;
      if (rest.low == found[i]) include(rest.high);
      else if (rest.high == found[i]) include(rest.low);
    }
  return found;
}

void RestContacts::rebase_group(std::uint32_t body, Real time) {
  bodies_.rebase(body, time);
  if (!bodies_[body].is(Body::held)) return;
  for (const std::uint32_t group_member : group(body, Body::held))
    bodies_.rebase(group_member, time);
}

void RestContacts::free(std::uint32_t body, Real time) {
  if (bodies_.is_fixed(body)) return dissolve_around(body, time);
  jams_.wake(body, time);
  for (int axis = 0; axis < 2; ++axis) dissolve(body, axis, time);
  bodies_.rebase(body, time);
}

bool RestContacts::would_push_twice(const Contact& c) const {
  if (!bodies_.is_slowed() || bodies_.is_fixed(c.partner)) return false;
  std::vector<std::uint32_t> members = group(c.body, Body::held_along(c.gap.face));
  const std::vector<std::uint32_t> others = group(c.partner, Body::held_along(c.gap.face));
  members.insert(members.end(), others.begin(), others.end());
  return is_pushed_twice(c.gap.face, members);
}

/// The axis along which the body is in rest contact with what can move, and with nothing fixed.
std::optional<int> RestContacts::pushed_axis(std::uint32_t body) const {
  for (int axis = 0; axis < 2; ++axis)
    if ((bodies_[body].flags & Body::held_along(axis)) != 0 &&
        !is_group_fixed(axis, group(body, Body::held_along(axis))))
      return axis;
  return std::nullopt;
}

/// Whether the group is free to move and has a puck that is also pushed along the other axis: its
/// friction would bind two groups to each other.
bool RestContacts::is_pushed_twice(int axis, const std::vector<std::uint32_t>& members) const {
  if (!bodies_.is_slowed() || is_group_fixed(axis, members)) return false;
  return std::any_of(members.begin(), members.end(), [&](std::uint32_t member) {
    return bodies_.is_slowed(member) && (bodies_[member].flags & Body::held_along(1 - axis)) != 0 &&
           !is_group_fixed(1 - axis, group(member, Body::held_along(1 - axis)));
  });
}

bool RestContacts::can_join(const Contact& c) const {
  assert(c.gap.face >= -1 && c.gap.face <= 1);
  if (c.gap.face < 0 || would_push_twice(c)) return false;
  if (!is_body(c.partner)) return true;
  const int along = 1 - c.gap.face;
  const Real extent = shape_of(bodies_, c.body, c.partner).half_extent[along];
  const Motion here = bodies_.motion(c.body), there = bodies_.motion(c.partner);
  const Real offset = here.position[along] - there.position[along],
             speed = here.velocity[along] - there.velocity[along];
  // Two discs have no face: in line they rest on each other only while nothing moves them sideways.
  if (extent == 0.0)
    return speed == 0.0 &&
           acceleration_of(bodies_, c.body)[along] == acceleration_of(bodies_, c.partner)[along];
  return std::abs(offset) < extent - face_margin ||
         (std::abs(offset) <= extent && offset * speed < 0.0);
}

void RestContacts::join(const Contact& c, Real time) {
  assert(c.gap.face >= 0 && c.gap.normal[1 - c.gap.face] == 0.0);
  record_.note(EventKind::rest, time, c.body, c.partner);
  const int axis = c.gap.face;
  const bool is_body_high = c.gap.normal[axis] > 0.0;
  rest_contacts_.push_back(
      {is_body_high ? c.partner : c.body, is_body_high ? c.body : c.partner, axis, infinity, 0.0,
       infinity, observers_.journal ? observers_.journal->next_age() : RestContactAge{}});
  for (const Partner p : {c.body, c.partner})
    if (!bodies_.is_fixed(p)) bodies_.set_flags(p, Body::held_along(axis));
  const std::vector<std::uint32_t> members = group(c.body, Body::held_along(axis));
  Real mass = 0.0, momentum = 0.0;
  for (const std::uint32_t member : members) {
    rebase_group(member, time);
    mass += bodies_.build(member).mass;
    momentum += bodies_.build(member).mass * bodies_.velocity(member)[axis];
  }
  const Real speed = is_group_fixed(axis, members) ? 0.0 : momentum / mass;
  for (const std::uint32_t member : members) bodies_.set_velocity(member, axis, speed);
  share(axis, members, time);
}

bool RestContacts::is_in_group(const RestContact& rest, int axis,
                               const std::vector<std::uint32_t>& members) const {
  if (rest.axis != axis) return false;
  const Partner inside = bodies_.is_fixed(rest.low) ? rest.high : rest.low;
  return std::find(members.begin(), members.end(), inside) != members.end();
}

bool RestContacts::is_group_fixed(int axis, const std::vector<std::uint32_t>& members) const {
  return std::any_of(rest_contacts_.begin(), rest_contacts_.end(), [&](const RestContact& rest) {
    return is_in_group(rest, axis, members) &&
           (bodies_.is_fixed(rest.low) || bodies_.is_fixed(rest.high));
  });
}

/// The accelerations of `members` at common speed `speed` along `axis`, and the force in every
/// hold: Gauss-Seidel on the forces, which push only if `only_push`. Groups are small (a bat and
/// the pucks before it), and the sweep order is the order of the holds, so the bits are
/// reproducible.
void RestContacts::solve_forces(int axis, const std::vector<std::uint32_t>& members, Real speed,
                                bool only_push) {
  accelerations_.resize(bodies_.count());
  Real scale = 1.0;
  for (const std::uint32_t member : members) {
    accelerations_[member] = friction_.own_push(member, axis) - bodies_.own_drag(member) * speed;
    scale = std::max(scale, std::abs(accelerations_[member]));
  }
  for (RestContact& rest : rest_contacts_)
    if (is_in_group(rest, axis, members)) rest.force = 0.0;
  const bool may_stick =
      bodies_.is_slowed() && only_push && speed == 0.0 && !is_group_fixed(axis, members);
  for (int sweep = 0; sweep < 2000; ++sweep) {
    const Real resisted = may_stick ? friction_.resist(axis, members, accelerations_) : Real(0.0);
    const Real change = std::max(resisted, sweep_forces(axis, members, only_push));
    if (change <= 1e-13 * fineness * scale) break;
  }
}

/// One sweep over the holds; answers its largest change of an acceleration.
Real RestContacts::sweep_forces(int axis, const std::vector<std::uint32_t>& members,
                                bool only_push) {
  Real change = 0.0;
  for (RestContact& rest : rest_contacts_) {
    if (!is_in_group(rest, axis, members)) continue;
    const Real low = bodies_.is_fixed(rest.low) ? Real(0.0) : accelerations_[rest.low],
               high = bodies_.is_fixed(rest.high) ? Real(0.0) : accelerations_[rest.high];
    const Real yielding = bodies_.inverse_mass(rest.low) + bodies_.inverse_mass(rest.high);
    assert(yielding > 0.0);  // what is fixed presses nothing that is fixed
    Real force = rest.force + (low - high) / yielding;
    if (only_push) force = std::max<Real>(0.0, force);
    const Real step = force - rest.force;
    rest.force = force;
    if (!bodies_.is_fixed(rest.low))
      accelerations_[rest.low] -= step * bodies_.inverse_mass(rest.low);
    if (!bodies_.is_fixed(rest.high))
      accelerations_[rest.high] += step * bodies_.inverse_mass(rest.high);
    change = std::max(change, std::abs(step) * yielding);
  }
  return change;
}

/// Lets go what is pulled apart, then gives each remaining part of the group one acceleration and
/// one drag, bitwise equal for all its members.
void RestContacts::share(int axis, const std::vector<std::uint32_t>& members, Real time) {
  let_go_what_is_pulled(axis, members, time);
  std::vector<std::uint32_t> done;
  for (const std::uint32_t member : members) {
    if (std::find(done.begin(), done.end(), member) != done.end()) continue;
    const std::vector<std::uint32_t> part = group(member, Body::held_along(axis));
    const auto is_in_part = [&](const RestContact& rest) { return is_in_group(rest, axis, part); };
    if (part.size() > 1 && is_pushed_twice(axis, part)) {
      for (const RestContact& rest : rest_contacts_)
        if (is_in_part(rest)) note_release(rest, time);
      std::erase_if(rest_contacts_, is_in_part);
      for (const std::uint32_t alone : part) share_part(axis, {alone}, time);
    } else {
      const Real turn_time = bodies_.is_slowed() && !is_group_fixed(axis, part)
                                 ? friction_.aim(axis, part, time)
                                 : Real(infinity);
      share_part(axis, part, time);
      for (RestContact& rest : rest_contacts_)
        if (is_in_part(rest)) rest.turn_time = turn_time;
    }
    done.insert(done.end(), part.begin(), part.end());
  }
}

void RestContacts::let_go_what_is_pulled(int axis, const std::vector<std::uint32_t>& members,
                                         Real time) {
  assert(!members.empty());  // their common velocity is that of the first
  // Who is pulled is judged by the friction of this instant, as the next impact is, and not by that
  // of an arc.
  if (bodies_.is_slowed()) friction_.reset_friction(axis, members), friction_.face(members);
  solve_forces(axis, members, bodies_.velocity(members.front())[axis], true);
  const auto is_pulled = [&](const RestContact& rest) {
    if (!is_in_group(rest, axis, members) || rest.force > 0.0) return false;
    const Real low = bodies_.is_fixed(rest.low) ? Real(0.0) : accelerations_[rest.low],
               high = bodies_.is_fixed(rest.high) ? Real(0.0) : accelerations_[rest.high];
    return high - low > pull_min;
  };
  for (const RestContact& rest : rest_contacts_)
    if (is_pulled(rest)) note_release(rest, time);
  std::erase_if(rest_contacts_, is_pulled);
}

void RestContacts::push_again() {
  std::vector<std::uint32_t> done;
  for (std::size_t i = 0; i < bodies_.touched().size(); ++i) {
    const std::uint32_t body = bodies_.touched()[i];
    if (!bodies_[body].is(Body::held) || !bodies_.is_slowed(body) ||
        std::find(done.begin(), done.end(), body) != done.end())
      continue;
    const std::optional<int> axis = pushed_axis(body);
    if (!axis) continue;
    const std::vector<std::uint32_t> members = group(body, Body::held_along(*axis));
    done.insert(done.end(), members.begin(), members.end());
    share(*axis, members, bodies_[body].time);
  }
  for (const std::uint32_t body : bodies_.touched())
    if (bodies_.is_slowed(body)) friction_.slide(body, pushed_axis(body));
}

void RestContacts::share_part(int axis, const std::vector<std::uint32_t>& part, Real time) {
  const bool is_fixed_part = is_group_fixed(axis, part);
  const bool is_alone = part.size() == 1 && !is_fixed_part;
  Real mass = 0.0, thrust = 0.0, drag = 0.0;
  for (const std::uint32_t member : part) {
    mass += bodies_.build(member).mass;
    thrust += bodies_.build(member).mass * friction_.own_push(member, axis);
    drag += bodies_.build(member).mass * bodies_.own_drag(member);
  }
  const bool stands = !is_alone && !is_fixed_part && bodies_.velocity(part.front())[axis] == 0.0 &&
                      std::any_of(part.begin(), part.end(), [&](std::uint32_t member) {
                        return friction_.bears_more(member, axis);
                      });
  for (const std::uint32_t member : part) {
    is_alone ? bodies_.clear_flags(member, Body::held_along(axis))
             : bodies_.set_flags(member, Body::held_along(axis));
    if (is_fixed_part || stands) bodies_.set_law(member, axis, 0.0, bodies_.own_drag(member));
    else if (is_alone)
      bodies_.set_law(member, axis, bodies_.build(member).thrust[axis], bodies_.own_drag(member));
    else bodies_.set_law(member, axis, thrust / mass, drag / mass);
  }
  const bool is_still = is_fixed_part || stands;
  if (!is_alone)
    set_pull_times(axis, part, is_still || drag == 0.0 ? 0.0 : thrust / drag,
                   is_still ? 0.0 : drag / mass, time);
}

/// Contact forces are linear in the common speed, which tends to `terminal_speed` at rate `drag`:
/// one that would be negative there vanishes on the way.
void RestContacts::set_pull_times(int axis, const std::vector<std::uint32_t>& part,
                                  Real terminal_speed, Real drag, Real time) {
  assert(!part.empty() && !(drag < 0.0));
  for (RestContact& rest : rest_contacts_)
    if (is_in_group(rest, axis, part)) rest.pull_time = infinity;
  if (drag == 0.0) return;
  const Real speed = bodies_.velocity(part.front())[axis];
  solve_forces(axis, part, speed, false);
  std::vector<Real> forces;
  for (const RestContact& rest : rest_contacts_)
    if (is_in_group(rest, axis, part)) forces.push_back(std::max<Real>(0.0, rest.force));
  solve_forces(axis, part, terminal_speed, false);
  std::size_t i = 0;
  for (RestContact& rest : rest_contacts_) {
    if (!is_in_group(rest, axis, part)) continue;
    assert(i < forces.size());  // as many as were counted at the speed of now
    const Real now = forces[i++], finally = rest.force;
    Real scale = 0.0;
    for (const std::uint32_t member : part)
      scale += bodies_.build(member).mass * (std::abs(bodies_.build(member).thrust[axis]) +
                                             bodies_.own_drag(member) * std::abs(speed));
    if (finally >= -1e-12 * scale) continue;
    rest.pull_time = time - log1p_of(-now / (now - finally)) / drag;
    // An arc's friction is not quite that of its beginning: a contact that is pressed now and
    // pulled along the arc would come and go at one instant.
    if (bodies_.is_slowed() && friction_.has_sliders(axis, part))
      rest.pull_time = std::max(rest.pull_time, time + contact_time_);
  }
}

void RestContacts::dissolve(std::uint32_t body, int axis, Real time) {
  assert(axis == 0 || axis == 1);
  if (!bodies_[body].is(Body::held_along(axis))) return;
  const std::vector<std::uint32_t> members = group(body, Body::held_along(axis));
  for (const std::uint32_t member : members) rebase_group(member, time);
  std::erase_if(rest_contacts_,
                [&](const RestContact& rest) { return is_in_group(rest, axis, members); });
  for (const std::uint32_t member : members) share_part(axis, {member}, time);
}

/// A post is in no group, but those are who lean on it. It has no motion to rebase, and yet is not
/// what it was to whoever is due to hit it.
void RestContacts::dissolve_around(std::uint32_t post, Real time) {
  const auto is_leant_on = [&](const RestContact& rest) {
    return rest.low == post || rest.high == post;
  };
  for (auto rest = std::find_if(rest_contacts_.begin(), rest_contacts_.end(), is_leant_on);
       rest != rest_contacts_.end();
       rest = std::find_if(rest_contacts_.begin(), rest_contacts_.end(), is_leant_on)) {
    const Partner inside = rest->low == post ? rest->high : rest->low;
    assert(bodies_[inside].is(Body::held_along(rest->axis)));
    dissolve(inside, rest->axis, time);
  }
  bodies_.touch(post);
}

/// When the contact reaches the end of its face [s]; infinite if it never does. Judged from the two
/// last-event states, like any event.
Real RestContacts::slide_time(const RestContact& rest) const {
  if (!is_body(rest.low) || !is_body(rest.high)) return infinity;
  const int along = 1 - rest.axis;
  const Real extent = shape_of(bodies_, rest.low, rest.high).half_extent[along];
  const Motion low = bodies_.motion(rest.low), high = bodies_.motion(rest.high);
  const Real start = std::max(low.time, high.time);
  if (extent == 0.0) {
    const bool is_still =
        bodies_.velocity(rest.low)[along] == bodies_.velocity(rest.high)[along] &&
        acceleration_of(bodies_, rest.low)[along] == acceleration_of(bodies_, rest.high)[along];
    return is_still ? infinity : start;
  }
  Real earliest = infinity;
  for (const Real side : {-1.0, 1.0}) {
    RealVector normal(0.0, 0.0);
    normal[along] = side;
    const auto time = first_contact(RelativeMotion{low, high}, HalfPlane{normal, -extent}, start,
                                    earliest, tolerance_);
    if (time) earliest = *time;
  }
  return earliest;
}

void RestContacts::release(std::uint32_t body, Real time) {
  for (std::size_t i = 0; i < rest_contacts_.size(); ++i) {
    const RestContact rest = rest_contacts_[i];
    if (rest.low != body && rest.high != body) continue;
    const bool ends = std::min(rest.pull_time, slide_time(rest)) <= time;
    if (!ends && rest.turn_time > time) continue;
    if (ends) note_release(rest, time);
    else record_.note(EventKind::turn, time, body);
    const Partner inside = bodies_.is_fixed(rest.low) ? rest.high : rest.low;
    const std::vector<std::uint32_t> members = group(inside, Body::held_along(rest.axis));
    for (const std::uint32_t member : members) rebase_group(member, time);
    if (ends) rest_contacts_.erase(rest_contacts_.begin() + static_cast<std::ptrdiff_t>(i));
    return share(rest.axis, members, time);
  }
}

void RestContacts::note_release(const RestContact& rest, Real time) {
  bodies_.is_fixed(rest.low) ? record_.note(EventKind::release, time, rest.high, rest.low)
                             : record_.note(EventKind::release, time, rest.low, rest.high);
}

}  // namespace rink::physics::inline RINK_PRECISION
