// Bodies coming and going, the grid, and the event loop.
#include "game/physics/engine/engine.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "game/physics/bodies/change_entries.h"

namespace rink::physics::inline RINK_PRECISION {

Engine::Engine(const WorldSpec& spec)
    : spec_(spec),
      ledger_(spec.accounts_energy),
      bodies_(spec, record_.counters(), ledger_, observers_),
      history_(spec, bodies_, observers_),
      jams_(bodies_, history_, observers_),
      places_(spec),
      rests_(spec, bodies_, jams_, record_, observers_),
      detection_(spec_, bodies_, places_.grid()),
      events_(spec.queue),
      prediction_(spec_, {.clock = clock_,
                          .bodies = bodies_,
                          .grid = places_.grid(),
                          .history = history_,
                          .rests = rests_,
                          .events = events_,
                          .counters = record_.counters()}),
      impact_(spec_, {.clock = clock_,
                      .bodies = bodies_,
                      .detection = detection_,
                      .history = history_,
                      .jams = jams_,
                      .rests = rests_,
                      .record = record_,
                      .observers = observers_}),
      free_impact_(spec_, {.bodies = bodies_,
                           .detection = detection_,
                           .events = events_,
                           .prediction = prediction_,
                           .record = record_,
                           .observers = observers_}),
      look_ahead_(bodies_, places_.grid(), events_) {
  assert(spec.field.length > 0.0 && spec.field.width > 0.0 && spec.field.goal_width >= 0.0 &&
         spec.field.goal_width <= spec.field.width);
  assert(spec.puck_drag >= 0.0 && spec.bat_drag >= 0.0 && spec.contact_time > 0.0 &&
         spec.field.wall < spec.restitution.material_count());
  assert(
      spec.puck_friction >= 0.0 &&
      (!spec.surface_friction ||
       (spec.surface_friction->coefficient.material_count() == spec.restitution.material_count() &&
        spec.surface_friction->tangential_restitution.material_count() ==
            spec.restitution.material_count())));
}

namespace {

/// What holds all bodies in play, and a little more, so that it has some area; the whole field if
/// there are none.
CellGrid::Ground ground_of(const Bodies& bodies, const Field& field, Real now) {
  double low_x = field.length, low_y = field.width, high_x = 0.0, high_y = 0.0;
  for (std::uint32_t body = 0; body < bodies.count(); ++body) {
    if (bodies[body].is(Body::gone)) continue;
    const RealVector place = position_at(bodies, body, now);
    const auto x = static_cast<double>(place.x()), y = static_cast<double>(place.y());
    low_x = std::min(low_x, x), high_x = std::max(high_x, x);
    low_y = std::min(low_y, y), high_y = std::max(high_y, y);
  }
  if (low_x > high_x || low_y > high_y) return {0.0, 0.0, field.length, field.width};
  const double more = std::max(field.length, field.width) / 64.0;
  low_x = std::max(low_x - more, 0.0), high_x = std::min(high_x + more, field.length);
  low_y = std::max(low_y - more, 0.0), high_y = std::min(high_y + more, field.width);
  return {low_x, low_y, high_x - low_x, high_y - low_y};
}

}  // namespace

/// In a grid made anew if this one has no room for one of its size.
void Engine::list(std::uint32_t body, const RealVector& position) {
  const RealVector extent = extent_of(bodies_, body);
  if (places_.fits(bodies_.count(), extent.maxCoeff()))
    return places_.insert(body, position, extent);
  places_.fit(bodies_.count(), extent.maxCoeff());
  rebuild_grid();
}

BodyId Engine::add(BodyState state) {
  const RealVector position(state.flight.x, state.flight.y);
  assert(position.allFinite() && std::isfinite(state.flight.vx) && std::isfinite(state.flight.vy) &&
         state.mass > 0.0 && state.material < spec_.restitution.material_count());
  assert(spec_.allow_overlap ||
         is_free(present(), position, {state.half_extent, state.flight.radius}));
  const std::uint32_t body = bodies_.count();
  state.flight.time = clock_.now;
  state.inverse_mass = state.kind == BodyKind::post ? 0.0 : 1.0 / state.mass;
  bodies_.add(state);
  history_.add();
  jams_.add();
  events_.add();
  rests_.add(body);
  if (observers_.journal != nullptr) observers_.journal->rooms_of.push_back(0);
  ledger_.introduce(energy_of(bodies_, body));
  enter_mouth_if_inside(body);
  places_.resize(body + 1);
  require_prediction(body);
  list(body, position);
  return {body};
}

WorldState Engine::state() const {
  WorldState state{
      spec_,         clock_,  record_.counters(),    bodies_.table(), history_.impact_counts(),
      jams_.table(), ledger_, rests_.rest_contacts()};
  for (Body& b : state.bodies.bodies) b.flags = static_cast<std::uint8_t>(b.flags & ~Body::pending);
  return state;
}

void Engine::restore(WorldState state) {
  assert(bodies_.count() == 0);
  clock_ = state.clock, record_.counters() = state.counters, ledger_ = state.ledger;
  bodies_.restore(std::move(state.bodies));
  history_.restore(std::move(state.impact_counts));
  jams_.restore(std::move(state.jams));
  rests_.restore(std::move(state.rest_contacts));
  rebuild_from_state();
}

/// Predictions, grid and queue follow from the last-event states, whenever they are made. A goal
/// that has not been told was undone.
void Engine::rebuild_from_state() {
  goal_.reset();
  places_.resize(bodies_.count());
  events_.restart(bodies_.count());
  look_ahead_.restart();
  places_.fit(bodies_.count(), 0.0);
  rebuild_grid();
}

void Engine::rebuild_grid() {
  // A subdomain has bodies in a part of the field.
  if (observers_.journal != nullptr) places_.cover(ground_of(bodies_, spec_.field, clock_.now));
  SizeClasses sizes;
  for (std::uint32_t body = 0; body < bodies_.count(); ++body)
    if (!bodies_[body].is(Body::removed))
      sizes.add(static_cast<double>(extent_of(bodies_, body).maxCoeff()));
  places_.rebuild(bodies_.count(), sizes);
  for (std::uint32_t body = 0; body < bodies_.count(); ++body) {
    if (bodies_[body].is(Body::gone)) continue;
    places_.insert(body, position_at(bodies_, body, clock_.now), extent_of(bodies_, body));
    require_prediction(body);
  }
  is_everything_pending_ = true;
}

void Engine::enter_mouth_if_inside(std::uint32_t body) {
  const Body& b = bodies_[body];
  bodies_.set_mouth(body, Body::no_mouth);
  if (b.kind != BodyKind::puck || spec_.field.goal_width == 0.0) return;
  if (b.x < b.radius) bodies_.set_mouth(body, Body::left_mouth);
  if (b.x > spec_.field.length - b.radius) bodies_.set_mouth(body, Body::right_mouth);
}

void Engine::require_prediction(std::uint32_t body) {
  if (bodies_[body].is(Body::pending)) return;
  bodies_.set_flags(body, Body::pending);
  pending_.push_back(body);
}

void Engine::predict_pending() {
  if (2 * pending_.size() > bodies_.count()) rebuild_grid();
  for (const std::uint32_t body : pending_) bodies_.clear_flags(body, Body::pending);
  if (is_everything_pending_) {
    prediction_.predict_all(pending_);
  } else {
    for (const std::uint32_t body : pending_)
      if (!bodies_[body].is(Body::gone)) prediction_.predict(body);
  }
  pending_.clear();
  is_everything_pending_ = false;
}

void Engine::remove(std::uint32_t body) {
  if (bodies_[body].is(Body::removed)) return;
  bodies_.keep(body);
  if (!bodies_[body].is(Body::out_of_play)) {
    if (bodies_.is_fixed(body)) impact_.leave(body, clock_.now);
    rests_.free(body, clock_.now);
    ledger_.introduce(-energy_of(bodies_, body));
    places_.remove(body);
    events_.drop(body);
  }
  bodies_.set_flags(body, Body::removed);
  bodies_.changes().note(body);
  settle();
}

void Engine::place(std::uint32_t puck, const RealVector& position, const RealVector& velocity) {
  const Body& b = bodies_[puck];
  assert(b.kind == BodyKind::puck && !b.is(Body::removed) && position.allFinite() &&
         velocity.allFinite());
  assert(is_free(present(), position, {RealVector(0.0, 0.0), b.radius}));
  bodies_.keep(puck);
  if (!b.is(Body::gone)) {
    rests_.free(puck, clock_.now);
    ledger_.introduce(-energy_of(bodies_, puck));
    bodies_.set_flags(puck, Body::out_of_play);
    places_.remove(puck);
    events_.drop(puck);
    settle();
  }
  bodies_.put(puck, position, velocity, clock_.now);
  bodies_.clear_flags(puck, Body::out_of_play);
  enter_mouth_if_inside(puck);
  if (spec_.surface_friction) bodies_.set_spin(puck, 0.0);
  ledger_.introduce(energy_of(bodies_, puck));
  list(puck, position);
  bodies_.touch(puck);
  settle();
}

void Engine::move(std::uint32_t body, const Moved& moved) {
  assert(!bodies_[body].is(Body::lasting) && bodies_[body].kind != BodyKind::post &&
         moved.position.allFinite() && moved.velocity.allFinite());
  if (observers_.journal != nullptr) observers_.journal->time = clock_.now;
  bodies_.rebase(body, clock_.now);
  bodies_.put(body, moved.position, moved.velocity, clock_.now);
  if (spec_.surface_friction) bodies_.set_spin(body, moved.spin);
  places_.remove(body);
  list(body, moved.position);
  settle();
}

void Engine::set_thrust(std::uint32_t bat, const RealVector& acceleration) {
  assert(bodies_[bat].kind == BodyKind::bat && acceleration.allFinite());
  if (bodies_.build(bat).thrust == acceleration) return;
  bodies_.keep(bat);
  if (Journal* const journal = observers_.journal; journal != nullptr) {
    journal->time = clock_.now;
    journal->thrusts.push_back({clock_.now, journal->number_of(bat), acceleration});
  }
  if (bodies_[bat].is(Body::gone)) {
    bodies_.set_thrust(bat, acceleration);
    return;
  }
  record_.note(EventKind::thrust, clock_.now, bat);
  rests_.rouse(bat, clock_.now);
  bodies_.set_thrust(bat, acceleration);
  for (int axis = 0; axis < 2; ++axis) {
    if ((bodies_[bat].flags & Body::held_along(axis)) != 0) rests_.share(bat, axis, clock_.now);
    else bodies_.set_law(bat, axis, acceleration[axis], bodies_.own_drag(bat));
  }
  settle();
}

std::optional<Goal> Engine::advance(Real until, EventBudget* budget) {
  assert(until >= clock_.now && until < infinity);
  assert(budget == nullptr || !budget->is_exceeded());
  // Or else a stop between two keys of one instant would let the first one's impacts come before
  // the second one.
  if (clock_.is_played && until == clock_.now) return std::nullopt;
  if (observers_.journal != nullptr && clock_.is_played) observers_.journal->played = clock_.now;
  predict_pending();
  clock_.is_played = false;
  const bool looks_ahead = look_ahead_.is_worthwhile();
  for (std::uint32_t body = events_.first(until); body != NextEvents::none;
       body = events_.first(until)) {
    if (looks_ahead && look_ahead_.is_due()) look_ahead_.fetch();
    if (budget == nullptr) process(body, events_.time(body));
    else process(body, *budget);
    if (goal_) return std::exchange(goal_, std::nullopt);
    if (budget != nullptr && budget->is_exceeded()) return std::nullopt;
  }
  clock_.arrive(until);
  return std::nullopt;
}

void Engine::process(std::uint32_t body, EventBudget& budget) {
  const Counters& counters = record_.counters();
  const Partner partner = events_[body].partner;
  const std::uint64_t before = counters.recordable(), hops = counters.hops;
  process(body, events_.time(body));
  if (const std::uint64_t count = counters.recordable() - before; count > 0)
    budget.charge({clock_.now, body, partner, count, counters.hops > hops});
}

void Engine::process(std::uint32_t body, Real time) {
  clock_.reach(time);
  const NextEvent& slot = events_[body];
  if (slot.crossing_time < slot.impact_time) return cross_cell(body);
  const Partner p = slot.partner;
  if (is_body(p) && bodies_[p].version != slot.partner_version) {
    ++record_.counters().stale_events;
    return prediction_.predict(body);
  }
  if (observers_.journal != nullptr)
    observers_.journal->begin_event(time, std::min(body, p), std::max(body, p));
  count_event(time);
  if (p == partner::goal_line) score(body, time);
  else if (p == partner::release)
    bodies_[body].is(Body::frozen) ? impact_.go_on(body, time) : rests_.release(body, time);
  else if (p == partner::stop) stop(body, time);
  else if (p == partner::mouth_in || p == partner::mouth_out) {
    rests_.rebase_group(body, time);
    bodies_.set_mouth(body, p == partner::mouth_out                      ? Body::no_mouth
                            : bodies_[body].x < 0.5 * spec_.field.length ? Body::left_mouth
                                                                         : Body::right_mouth);
  } else {
    const bool is_crowded = clock_.is_endless() || events_.is_followed_at_once(body, p);
    if (!free_impact_.collide(body, p, time, is_crowded))
      impact_.collide(body, p, time, is_crowded);
  }
  settle();
}

void Engine::count_event(Real time) {
  clock_.count_event(time);
  record_.counters().events_at_once_max =
      std::max(record_.counters().events_at_once_max, clock_.events_at_once);
  if (observers_.journal != nullptr) observers_.journal->count_event(time, clock_.events_at_once);
}

void Engine::settle() {
  if (ledger_.is_kept()) bodies_.close_books();
  if (bodies_.is_slowed()) rests_.push_again();
  if (observers_.journal != nullptr)
    enter_changes(*observers_.journal, bodies_, free_impact_.is_wanted());
  for (const std::uint32_t body : bodies_.touched())
    if (!bodies_[body].is(Body::gone | Body::pending)) prediction_.predict(body);
  bodies_.forget_touched();
}

void Engine::cross_cell(std::uint32_t body) {
  ++record_.counters().crossings;
  const CellGrid::Direction direction = events_[body].direction;
  places_.move(body, direction);
  prediction_.predict_beyond(body, direction);
}

void Engine::stop(std::uint32_t body, Real time) {
  record_.note(EventKind::stop, time, body);
  rests_.rouse(body, time);
  bodies_.set_velocity(body, RealVector(0.0, 0.0));  // one too slow to move before the next instant
                                                     // that a clock can show was not evaluated
}

void Engine::score(std::uint32_t body, Real time) {
  record_.note(EventKind::goal, time, body);
  rests_.free(body, time);
  ledger_.introduce(-energy_of(bodies_, body));
  bodies_.set_flags(body, Body::out_of_play);
  bodies_.set_mouth(body, Body::no_mouth);
  places_.remove(body);
  events_.drop(body);
  goal_ = Goal{time, {body}, bodies_[body].x < 0.5 * spec_.field.length ? End::left : End::right};
}

}  // namespace rink::physics::inline RINK_PRECISION
