// Bodies put into their slots and taken from them, and windows undone.
#include "game/physics/portion.h"

#include <algorithm>
#include <initializer_list>
#include <limits>

#include "game/physics/engine/engine.h"

namespace rink::physics::inline RINK_PRECISION {

std::uint64_t most_at_once(std::span<const double> times) {
  constexpr double roundings =
      32.0;  // twice as long as the engine's instant, for times may be some roundings out of order
  std::size_t most = 0, first = 0;
  for (std::size_t k = 0; k < times.size(); ++k) {
    while (times[first] + roundings * std::numeric_limits<double>::epsilon() * (1.0 + times[k]) <
           times[k])
      ++first;
    most = std::max(most, k - first + 1);
  }
  return most;
}

Portion::Portion(const WorldSpec& spec, std::uint32_t body_count)
    : world_(spec),
      before_(engine().bodies_, engine().history_, engine().jams_, body_count),
      is_there_(body_count, 0) {
  WorldState blank;
  blank.spec = spec;
  const Build nothing{1.0, 0.0, Vector2(0.0, 0.0), Vector2(0.0, 0.0), Half::both};
  blank.bodies.bodies.assign(
      body_count,
      {{0.0, 0.0, 0.0, 0.0, 0.0, 0.0}, 0.0, 0, BodyKind::puck, 0, Body::removed, Body::no_mouth});
  blank.bodies.builds.assign(body_count, nothing);
  blank.bodies.laws.assign(body_count, {Vector2(0.0, 0.0), Vector2::Constant(spec.puck_drag)});
  if (spec.puck_friction > 0.0) {
    blank.bodies.rest_times.assign(body_count, infinity);
    blank.bodies.slowing.assign(body_count, Vector2(0.0, 0.0));
  }
  if (spec.surface_friction) blank.bodies.spins.assign(body_count, 0.0);
  blank.rhythms.resize(body_count);
  blank.jams.numbers.assign(body_count, 0);
  blank.ledger = EnergyLedger(spec.accounts_energy);
  engine().restore(std::move(blank));
  journal_.rooms_of.assign(body_count, 0);
  engine().observers_ = {&before_, &journal_};
}

Portion::~Portion() { engine().observers_ = {}; }

BodyState Portion::state_in(const World& world, std::uint32_t body) {
  const Engine& e = *world.engine_;
  return state_of(body, e.bodies_, e.history_, e.jams_);
}

Motion Portion::motion_before(std::uint32_t body) const {
  return before_.has_changed(body) ? state_before(body).motion() : engine().bodies_.motion(body);
}

const Flight& Portion::flight(std::uint32_t body) const { return engine().bodies_[body]; }

std::optional<Flight> Portion::free_flight(std::uint32_t body) const {
  const Body& b = engine().bodies_[body];
  if (b.is(Body::curved | Body::lasting)) return std::nullopt;
  return b;
}

bool Portion::was_gone(std::uint32_t body) const { return (before_.flags(body) & Body::gone) != 0; }

bool Portion::is_possible(const BodyState& state, std::uint32_t body_count) {
  constexpr std::uint8_t known = Body::lasting;
  const bool is_jammed = (state.flags & Body::frozen) != 0;
  return (state.flags & ~known) == 0 && state.mouth <= Body::right_mouth &&
         (!is_jammed || state.jam < body_count);
}

bool Portion::is_out_of_play(const BodyState& state) { return (state.flags & Body::gone) != 0; }

bool Portion::is_held_along(const BodyState& state, int axis) {
  return (state.flags & (axis == 0 ? Body::held_x : Body::held_y)) != 0;
}

/// All of the body's state, but not where it is listed.
void Portion::write(std::uint32_t body, const BodyState& s) {
  Engine& e = engine();
  e.bodies_.write(body, s);
  e.history_.write(body, s);
  e.jams_.write(body, s);
}

void Portion::put(std::uint32_t body, const BodyState& s) {
  Engine& e = engine();
  write(body, s);
  is_there_[body] = 1;
  e.places_.remove(body);
  e.events_.drop(body);
  if (e.bodies_[body].is(Body::gone)) return;
  if (e.reach_of(body) > e.places_.reach()) {
    e.places_.fit(body_count(), e.reach_of(body));
    return e.rebuild_grid();
  }
  e.places_.insert(body, motion_at(e.bodies_, body, e.clock_.now).position);
  if (!e.bodies_.is_fixed(body)) return e.require_prediction(body);
  // Posts look at nobody: those who are there must look at it.
  for (std::uint32_t other = 0; other < body_count(); ++other)
    if (is_there(other) && !e.bodies_.is_fixed(other) && !e.bodies_[other].is(Body::gone))
      e.require_prediction(other);
}

void Portion::drop(std::uint32_t body) {
  if (!is_there(body)) return;
  Engine& e = engine();
  BodyState blank;
  blank.inverse_mass = 0.0, blank.flags = Body::removed,
  blank.drag = Vector2::Constant(e.spec_.puck_drag);
  write(body, blank);
  e.places_.remove(body);
  e.events_.drop(body);
  is_there_[body] = 0;
}

const std::vector<Hold>& Portion::holds() const { return engine().rests_.holds(); }

void Portion::set_holds(std::vector<Hold> holds) {
  std::stable_sort(holds.begin(), holds.end(),
                   [](const Hold& a, const Hold& b) { return a.age < b.age; });
  Engine& e = engine();
  // When a contact ends follows from both sides' states and from itself, and no version tells of
  // that: whoever has a new one, or one with a body that was put, is predicted anew.
  const auto is_pending = [&](Partner p) {
    return p < body_count() && (e.bodies_[p].flags & Body::pending) != 0;
  };
  const auto are_same = [](const Hold& a, const Hold& b) {
    return a.low == b.low && a.high == b.high && a.axis == b.axis && a.pull_time == b.pull_time &&
           a.turn_time == b.turn_time;
  };
  const auto is_in = [&](const std::vector<Hold>& list, const Hold& hold) {
    return std::any_of(list.begin(), list.end(),
                       [&](const Hold& other) { return are_same(hold, other); });
  };
  std::vector<Partner> concerned;
  const auto concern = [&](const Hold& hold) {
    concerned.insert(concerned.end(), {hold.low, hold.high});
  };
  for (const Hold& hold : holds)
    if (is_pending(hold.low) || is_pending(hold.high) || !is_in(e.rests_.holds(), hold))
      concern(hold);
  for (const Hold& hold : e.rests_.holds())
    if (!is_in(holds, hold)) concern(hold);
  for (const Partner p : concerned)
    if (p < body_count() && is_there(p)) e.require_prediction(p);
  e.rests_.restore(std::move(holds));
}

std::vector<std::uint32_t> Portion::group_of(std::uint32_t body) const {
  const Engine& e = engine();
  if ((e.bodies_[body].flags & (Body::held | Body::frozen)) == 0) return {body};
  std::vector<std::uint32_t> group = e.rests_.group(body, Body::held);
  e.jams_.for_each_other(body, [&](std::uint32_t other) { group.push_back(other); });
  return group;
}

void Portion::begin_window() {
  const Engine& e = engine();
  before_.begin();
  journal_.changes.clear(), journal_.motions.clear(), journal_.looked_at.clear();
  journal_.event = 0, journal_.quiet_events = 0, journal_.stirred = 0, journal_.at_once_max = 0,
  journal_.times.clear(), journal_.was_hopeless = false;
  holds_before_ = e.rests_.holds(), frozen_before_ = e.jams_.table().frozen;
  clock_before_ = e.clock_, jam_count_before_ = e.jams_.table().count;
  counters_before_ = e.record_.counters();
}

void Portion::undo() {
  Engine& e = engine();
  for (const BeforeImages::KeptState& kept : before_.states()) {
    BodyState state = kept.state;
    state.flight = e.bodies_[kept.body];
    write(kept.body, state);
  }
  for (const BeforeImages::KeptFlight& kept : before_.flights()) {
    const Flight& f = kept.flight;
    e.bodies_.put(kept.body, {f.x, f.y}, {f.vx, f.vy}, f.time);
  }
  e.rests_.restore(holds_before_);
  e.jams_.restore(frozen_before_, jam_count_before_);
  e.clock_ = clock_before_;
  e.record_.counters() = counters_before_;
  for (const std::uint32_t body : e.pending_) e.bodies_.clear_flags(body, Body::pending);
  e.pending_.clear();
  e.bodies_.forget_touched();
  for (std::uint32_t body = 0; body < body_count(); ++body) e.bodies_.changes().note(body);
  e.goal_.reset();
  e.rebuild_from_state();
  begin_window();
}

void Portion::advance(double until) {
  while (world_.advance(until)) {
  }
}

}  // namespace rink::physics::inline RINK_PRECISION
