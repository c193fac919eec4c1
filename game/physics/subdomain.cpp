// Bodies put into their slots and taken from them, and windows undone.
#include "game/physics/subdomain.h"

#include <algorithm>
#include <cassert>
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
    assert(first <= k);
    most = std::max(most, k - first + 1);
  }
  return most;
}

Subdomain::Subdomain(const WorldSpec& spec, std::uint32_t body_count)
    : world_(spec), before_(engine().images(body_count)), is_there_(body_count, 0) {
  WorldState blank;
  blank.spec = spec;
  const BodyShape nothing{1.0, 0.0, Vector2(0.0, 0.0), Vector2(0.0, 0.0), Half::both};
  blank.bodies.bodies.assign(
      body_count,
      {{0.0, 0.0, 0.0, 0.0, 0.0, 0.0}, 0.0, 0, BodyKind::puck, 0, Body::removed, Body::no_mouth});
  blank.bodies.shapes.assign(body_count, nothing);
  blank.bodies.laws.assign(body_count, {Vector2(0.0, 0.0), Vector2::Constant(spec.puck_drag)});
  if (spec.puck_friction > 0.0) {
    blank.bodies.rest_times.assign(body_count, infinity);
    blank.bodies.slowing.assign(body_count, Vector2(0.0, 0.0));
  }
  if (spec.surface_friction) blank.bodies.spins.assign(body_count, 0.0);
  blank.impact_counts.resize(body_count);
  blank.jams.numbers.assign(body_count, 0);
  blank.ledger = EnergyLedger(spec.accounts_energy);
  engine().restore(std::move(blank));
  journal_.rooms_of.assign(body_count, 0);
  engine().observe({&before_, &journal_});
}

Subdomain::~Subdomain() { engine().observe({}); }

BodyState Subdomain::state_in(const World& world, std::uint32_t body) {
  assert(body < world.body_count());
  return world.engine_->body_state(body);
}

Motion Subdomain::motion_before(std::uint32_t body) const {
  return before_.has_changed(body) ? state_before(body).motion() : engine().bodies().motion(body);
}

const Flight& Subdomain::flight(std::uint32_t body) const { return engine().bodies()[body]; }

std::optional<Flight> Subdomain::free_flight(std::uint32_t body) const {
  const Body& b = engine().bodies()[body];
  if (b.is(Body::curved | Body::lasting)) return std::nullopt;
  return b;
}

bool Subdomain::was_gone(std::uint32_t body) const {
  return (before_.flags(body) & Body::gone) != 0;
}

bool Subdomain::is_possible(const BodyState& state, std::uint32_t body_count) {
  constexpr std::uint8_t known = Body::lasting;
  return (state.flags & ~known) == 0 && state.mouth <= Body::right_mouth &&
         (!is_frozen(state) || state.jam < body_count);
}

double Subdomain::glide_max(const World& world) {
  return static_cast<double>(physics::glide_max(world.spec()));
}

bool Subdomain::is_out_of_play(const BodyState& state) { return (state.flags & Body::gone) != 0; }

bool Subdomain::is_frozen(const BodyState& state) { return (state.flags & Body::frozen) != 0; }

bool Subdomain::is_held_along(const BodyState& state, int axis) {
  assert(axis == 0 || axis == 1);
  return (state.flags & (axis == 0 ? Body::held_x : Body::held_y)) != 0;
}

void Subdomain::put(std::uint32_t body, const BodyState& state) {
  is_there_[body] = 1;
  engine().put(body, state);
}

void Subdomain::drop(std::uint32_t body) {
  assert(body < body_count());
  if (!is_there(body)) return;
  engine().drop(body);
  is_there_[body] = 0;
}

const std::vector<RestContact>& Subdomain::rest_contacts() const {
  return engine().rest_contacts();
}

void Subdomain::set_rest_contacts(std::vector<RestContact> rest_contacts) {
  engine().set_rest_contacts(std::move(rest_contacts));
}

std::vector<std::uint32_t> Subdomain::group_of(std::uint32_t body) const {
  return engine().group_of(body);
}

void Subdomain::begin_window() {
  before_.begin();
  journal_.changes.clear(), journal_.motions.clear(), journal_.looked_at.clear();
  journal_.event = 0, journal_.quiet_events = 0, journal_.mixed_digest = 0,
  journal_.at_once_max = 0, journal_.times.clear(), journal_.had_solver_failed = false;
  mark_ = engine().mark();
}

void Subdomain::undo() {
  engine().undo(mark_, before_);
  begin_window();
}

void Subdomain::advance(double until) {
  while (world_.advance(until)) {
  }
}

}  // namespace rink::physics::inline RINK_PRECISION
