// Bodies put into their slots and taken from them, and windows undone.
#include "game/physics/portion.h"

#include <algorithm>
#include <limits>
#include <utility>

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
    : world_(spec), before_(engine().images(body_count)), is_there_(body_count, 0) {
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
  engine().observe({&before_, &journal_});
}

Portion::~Portion() { engine().observe({}); }

BodyState Portion::state_in(const World& world, std::uint32_t body) {
  return world.engine_->body_state(body);
}

Motion Portion::motion_before(std::uint32_t body) const {
  return before_.has_changed(body) ? state_before(body).motion() : engine().bodies().motion(body);
}

const Flight& Portion::flight(std::uint32_t body) const { return engine().bodies()[body]; }

std::optional<Flight> Portion::free_flight(std::uint32_t body) const {
  const Body& b = engine().bodies()[body];
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

void Portion::put(std::uint32_t body, const BodyState& state) {
  is_there_[body] = 1;
  engine().put(body, state);
}

void Portion::drop(std::uint32_t body) {
  if (!is_there(body)) return;
  engine().drop(body);
  is_there_[body] = 0;
}

const std::vector<Hold>& Portion::holds() const { return engine().holds(); }

void Portion::set_holds(std::vector<Hold> holds) { engine().set_holds(std::move(holds)); }

std::vector<std::uint32_t> Portion::group_of(std::uint32_t body) const {
  return engine().group_of(body);
}

void Portion::begin_window() {
  before_.begin();
  journal_.changes.clear(), journal_.motions.clear(), journal_.looked_at.clear();
  journal_.event = 0, journal_.quiet_events = 0, journal_.stirred = 0, journal_.at_once_max = 0,
  journal_.times.clear(), journal_.was_hopeless = false;
  mark_ = engine().mark();
}

void Portion::undo() {
  engine().undo(mark_, before_);
  begin_window();
}

void Portion::advance(double until) {
  while (world_.advance(until)) {
  }
}

}  // namespace rink::physics::inline RINK_PRECISION
