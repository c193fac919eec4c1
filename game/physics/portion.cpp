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
    : world_(spec), is_there_(body_count, 0) {
  Engine& e = engine();
  e.bodies_.assign(body_count, {{0.0, 0.0, 0.0, 0.0, 0.0, 0.0},
                                0.0,
                                0,
                                BodyKind::puck,
                                0,
                                Engine::removed,
                                Engine::no_mouth});
  e.builds_.assign(body_count, {1.0, 0.0, Vector2(0.0, 0.0), Vector2(0.0, 0.0), Half::both});
  e.laws_.assign(body_count, {Vector2(0.0, 0.0), Vector2::Constant(spec.puck_drag)});
  e.rhythms_.resize(body_count);
  for (std::uint32_t body = 0; body < body_count; ++body) e.changes_.add(body);
  e.jams_.assign(body_count, 0);
  if (e.is_slowed())
    e.rest_times_.assign(body_count, infinity), e.slowing_.assign(body_count, Vector2(0.0, 0.0));
  if (e.is_rough()) e.spins_.assign(body_count, 0.0);
  journal_.marks.resize(body_count);
  journal_.rooms_of.assign(body_count, 0);
  e.rebuild_from_state();
  e.journal_ = &journal_;
}

Portion::~Portion() { engine().journal_ = nullptr; }

BodyState Portion::state_in(const World& world, std::uint32_t body) {
  return world.engine_->state_of(body);
}

BodyState Portion::state_before(std::uint32_t body) const {
  const Journal::Mark& mark = journal_.marks[body];
  BodyState before = mark.number > journal_.mark ? journal_.states[mark.state].state : state(body);
  if (mark.number >= journal_.mark) before.flight = journal_.flights[mark.flight].flight;
  return before;
}

Motion Portion::motion_before(std::uint32_t body) const {
  return journal_.marks[body].number < journal_.mark ? engine().motion(body)
                                                     : state_before(body).motion();
}

const Flight& Portion::flight(std::uint32_t body) const { return engine().bodies_[body]; }

std::optional<Flight> Portion::free_flight(std::uint32_t body) const {
  const Body& b = engine().bodies_[body];
  if ((b.flags & (Engine::curved | Engine::held | Engine::frozen | Engine::gone)) != 0)
    return std::nullopt;
  return b;
}

bool Portion::was_gone(std::uint32_t body) const {
  const Journal::Mark& mark = journal_.marks[body];
  const std::uint8_t flags = mark.number > journal_.mark ? journal_.states[mark.state].state.flags
                                                         : engine().bodies_[body].flags;
  return (flags & Engine::gone) != 0;
}

bool Portion::is_possible(const BodyState& state, std::uint32_t body_count) {
  constexpr std::uint8_t known = Engine::gone | Engine::held | Engine::frozen;
  const bool is_jammed = (state.flags & Engine::frozen) != 0;
  return (state.flags & ~known) == 0 && state.mouth <= Engine::right_mouth &&
         (!is_jammed || state.jam < body_count);
}

bool Portion::is_out_of_play(const BodyState& state) { return (state.flags & Engine::gone) != 0; }

bool Portion::is_held_along(const BodyState& state, int axis) {
  return (state.flags & (axis == 0 ? Engine::held_x : Engine::held_y)) != 0;
}

/// All of the body's state, but not where it is listed.
void Portion::write(std::uint32_t body, const BodyState& s) {
  Engine& e = engine();
  Body& b = e.bodies_[body];
  const auto kept = static_cast<std::uint8_t>(b.flags & (Engine::curved | Engine::pending));
  static_cast<Flight&>(b) = s.flight;
  b.inverse_mass = s.inverse_mass, b.kind = s.kind, b.material = s.material, b.mouth = s.mouth;
  b.flags = static_cast<std::uint8_t>(kept | s.flags);
  ++b.version;
  e.changes_.note(body);
  e.builds_[body] = {s.mass, s.inverse_mass, s.half_extent, s.thrust, s.half};
  e.laws_[body] = {s.acceleration, s.drag};
  Rhythm& rhythm = e.rhythms_[body];
  rhythm.window_start = s.impacts_begin, rhythm.last_hop = s.last_hop, rhythm.impacts = s.impacts,
  rhythm.hops = s.hops;
  rhythm.repeats = {s.repeats_instant, s.repeats};
  rhythm.meetings = {};  // counted anew: they matter from thousands on, when the count of events at
                         // one instant has long had its say
  if (e.is_slowed()) e.rest_times_[body] = s.rest_time, e.slowing_[body] = s.slowing;
  if (e.is_rough()) e.spins_[body] = s.spin;
  e.jams_[body] = s.jam;
  e.write_law(body);
}

void Portion::put(std::uint32_t body, const BodyState& s) {
  Engine& e = engine();
  std::erase(e.frozen_, body);
  write(body, s);
  is_there_[body] = 1;
  if ((s.flags & Engine::frozen) != 0) e.frozen_.push_back(body);
  e.grid_.remove(body);
  e.queue_.set(body, infinity, body, body);
  e.slots_[body] = Engine::no_event;
  if (e.is_gone(body)) return;
  if (e.reach_of(body) > e.reach_) {
    e.reach_ = e.reach_of(body);
    return e.rebuild_grid();
  }
  const Vector2 position = e.at(body, e.clock_.now).position;
  e.grid_.insert(body, position.x(), position.y());
  if (!e.is_fixed(body)) return e.require_prediction(body);
  // Posts look at nobody: those who are there must look at it.
  for (std::uint32_t other = 0; other < body_count(); ++other)
    if (is_there(other) && !e.is_fixed(other) && !e.is_gone(other)) e.require_prediction(other);
}

void Portion::drop(std::uint32_t body) {
  if (!is_there(body)) return;
  Engine& e = engine();
  std::erase(e.frozen_, body);
  BodyState blank;
  blank.inverse_mass = 0.0, blank.flags = Engine::removed,
  blank.drag = Vector2::Constant(e.spec_.puck_drag);
  write(body, blank);
  e.grid_.remove(body);
  e.queue_.set(body, infinity, body, body);
  is_there_[body] = 0;
}

const std::vector<Hold>& Portion::holds() const { return engine().holds_; }

void Portion::set_holds(std::vector<Hold> holds) {
  std::stable_sort(holds.begin(), holds.end(),
                   [](const Hold& a, const Hold& b) { return a.age < b.age; });
  Engine& e = engine();
  // When a contact ends follows from both sides' states and from itself, and no version tells of
  // that: whoever has a new one, or one with a body that was put, is predicted anew.
  const auto is_pending = [&](Partner p) {
    return p < body_count() && (e.bodies_[p].flags & Engine::pending) != 0;
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
    if (is_pending(hold.low) || is_pending(hold.high) || !is_in(e.holds_, hold)) concern(hold);
  for (const Hold& hold : e.holds_)
    if (!is_in(holds, hold)) concern(hold);
  for (const Partner p : concerned)
    if (p < body_count() && is_there(p)) e.require_prediction(p);
  e.holds_ = std::move(holds);
}

std::vector<std::uint32_t> Portion::group_of(std::uint32_t body) const {
  const Engine& e = engine();
  if ((e.bodies_[body].flags & (Engine::held | Engine::frozen)) == 0) return {body};
  std::vector<std::uint32_t> group = e.companions(body, Engine::held);
  if ((e.bodies_[body].flags & Engine::frozen) != 0)
    for (const std::uint32_t other : e.frozen_)
      if (other != body && e.jams_[other] == e.jams_[body]) group.push_back(other);
  return group;
}

void Portion::begin_window() {
  const Engine& e = engine();
  journal_.changes.clear(), journal_.motions.clear(), journal_.flights.clear(),
      journal_.states.clear(), journal_.looked_at.clear();
  journal_.mark += 2;
  journal_.event = 0, journal_.quiet_events = 0, journal_.stirred = 0, journal_.at_once_max = 0,
  journal_.times.clear(), journal_.was_hopeless = false;
  holds_before_ = e.holds_, frozen_before_ = e.frozen_;
  clock_before_ = e.clock_, jam_count_before_ = e.jam_count_;
  counters_before_ = e.counters_;
}

void Portion::undo() {
  Engine& e = engine();
  for (const Journal::KeptState& kept : journal_.states) {
    BodyState state = kept.state;
    state.flight = e.bodies_[kept.body];
    write(kept.body, state);
  }
  for (const Journal::KeptFlight& kept : journal_.flights)
    static_cast<Flight&>(e.bodies_[kept.body]) = kept.flight;
  e.holds_ = holds_before_, e.frozen_ = frozen_before_;
  e.clock_ = clock_before_, e.jam_count_ = jam_count_before_;
  e.counters_ = counters_before_;
  for (const std::uint32_t body : e.pending_)
    e.bodies_[body].flags = static_cast<std::uint8_t>(e.bodies_[body].flags & ~Engine::pending);
  e.pending_.clear(), e.touched_.clear();
  e.goal_.reset();
  e.queue_ = EventSchedule(e.spec_.queue);
  e.looked_ahead_ = {};
  e.curved_count_ = 0;
  e.rebuild_from_state();
  begin_window();
}

void Portion::advance(double until) {
  while (world_.advance(until)) {
  }
}

}  // namespace rink::physics::inline RINK_PRECISION
