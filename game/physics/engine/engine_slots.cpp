// What a subdomain of a world asks of its engine: bodies put into their slots and taken from them,
// and the way back to an earlier instant.
#include <algorithm>
#include <cassert>
#include <utility>

#include "game/physics/engine/engine.h"

namespace rink::physics::inline RINK_PRECISION {

BodyState Engine::body_state(std::uint32_t body) const {
  return state_of(body, bodies_, history_, jams_);
}

/// All of the body's state, but not where it is listed.
void Engine::write(std::uint32_t body, const BodyState& state) {
  bodies_.write(body, state);
  history_.write(body, state);
  jams_.write(body, state);
}

void Engine::put(std::uint32_t body, const BodyState& state) {
  assert(body < bodies_.count());
  write(body, state);
  places_.remove(body);
  events_.drop(body);
  if (bodies_[body].is(Body::gone)) return;
  list(body, position_at(bodies_, body, clock_.now));
  if (!bodies_.is_fixed(body)) return require_prediction(body);
  // Posts look at nobody: those who are there must look at it.
  for (std::uint32_t other = 0; other < bodies_.count(); ++other)
    if (!bodies_.is_fixed(other) && !bodies_[other].is(Body::gone)) require_prediction(other);
}

void Engine::drop(std::uint32_t body) {
  assert(body < bodies_.count());
  BodyState blank;
  blank.inverse_mass = 0.0, blank.flags = Body::removed,
  blank.drag = RealVector::Constant(spec_.puck_drag);
  write(body, blank);
  places_.remove(body);
  events_.drop(body);
}

/// When a contact ends follows from both sides' states and from itself, and no version tells of
/// that: whoever has a new one, or one with a body that was put, is predicted anew.
void Engine::set_rest_contacts(std::vector<RestContact> rest_contacts) {
  std::stable_sort(rest_contacts.begin(), rest_contacts.end(),
                   [](const RestContact& a, const RestContact& b) { return a.age < b.age; });
  const auto is_pending = [&](Partner p) {
    return p < bodies_.count() && (bodies_[p].flags & Body::pending) != 0;
  };
  const auto are_same = [](const RestContact& a, const RestContact& b) {
    return a.low == b.low && a.high == b.high && a.axis == b.axis && a.pull_time == b.pull_time &&
           a.turn_time == b.turn_time;
  };
  const auto is_in = [&](const std::vector<RestContact>& list, const RestContact& rest) {
    return std::any_of(list.begin(), list.end(),
                       [&](const RestContact& other) { return are_same(rest, other); });
  };
  std::vector<Partner> concerned;
  const auto concern = [&](const RestContact& rest) {
    concerned.insert(concerned.end(), {rest.low, rest.high});
  };
  for (const RestContact& rest : rest_contacts)
    if (is_pending(rest.low) || is_pending(rest.high) || !is_in(rests_.rest_contacts(), rest))
      concern(rest);
  for (const RestContact& rest : rests_.rest_contacts())
    if (!is_in(rest_contacts, rest)) concern(rest);
  for (const Partner p : concerned)
    if (p < bodies_.count() && !bodies_[p].is(Body::removed)) require_prediction(p);
  rests_.restore(std::move(rest_contacts));
}

void Engine::drop_blank_contacts() {
  const auto is_blank = [&](Partner p) {
    return p < bodies_.count() && bodies_[p].is(Body::removed);
  };
  std::vector<RestContact> left = rests_.rest_contacts();
  const auto blank = std::stable_partition(left.begin(), left.end(), [&](const RestContact& rest) {
    return !is_blank(rest.low) && !is_blank(rest.high);
  });
  for (auto rest = blank; rest != left.end(); ++rest)
    for (const Partner p : {rest->low, rest->high})
      if (p < bodies_.count() && !is_blank(p)) require_prediction(p);
  left.erase(blank, left.end());
  rests_.restore(std::move(left));
}

std::vector<std::uint32_t> Engine::group_of(std::uint32_t body) const {
  if ((bodies_[body].flags & (Body::held | Body::frozen)) == 0) return {body};
  std::vector<std::uint32_t> group = rests_.group(body, Body::held);
  jams_.for_each_other(body, [&](std::uint32_t other) { group.push_back(other); });
  return group;
}

WorldMark Engine::mark() const {
  return {rests_.rest_contacts(), jams_.table().frozen, clock_, jams_.table().count,
          record_.counters()};
}

void Engine::undo(const WorldMark& mark, const BeforeImages& before) {
  for (const BeforeImages::KeptState& kept : before.states()) {
    BodyState state = kept.state;
    state.flight = bodies_[kept.body];
    write(kept.body, state);
  }
  for (const BeforeImages::KeptFlight& kept : before.flights()) {
    const Flight& f = kept.flight;
    bodies_.put(kept.body, {f.x, f.y}, {f.vx, f.vy}, f.time);
  }
  rests_.restore(mark.rest_contacts);
  jams_.restore(mark.frozen, mark.jam_count);
  clock_ = mark.clock;
  record_.counters() = mark.counters;
  for (const std::uint32_t body : pending_) bodies_.clear_flags(body, Body::pending);
  pending_.clear();
  bodies_.forget_touched();
  for (std::uint32_t body = 0; body < bodies_.count(); ++body) bodies_.changes().note(body);
  rebuild_from_state();
}

}  // namespace rink::physics::inline RINK_PRECISION
