// Bodies coming and going, the grid, and the event loop.
#include "game/physics/engine/engine.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <limits>
#include <utility>

namespace rink::physics::inline RINK_PRECISION {

namespace {
/// With fewer bodies all is near at hand, and to look ahead costs a fifth.
constexpr std::size_t look_ahead_min = 30'000;
}  // namespace

Engine::Engine(const WorldSpec& spec)
    : spec_(spec),
      puck_drag_(spec.puck_drag),
      contact_time_(spec.contact_time),
      rest_speed_(20.0 * contact_time_),
      queue_(spec.queue),
      ledger_(spec.accounts_energy) {
  assert(spec.field.length > 0.0 && spec.field.width > 0.0 && spec.field.goal_width >= 0.0 &&
         spec.field.goal_width <= spec.field.width);
  assert(spec.puck_drag >= 0.0 && spec.bat_drag >= 0.0 && spec.contact_time > 0.0 &&
         spec.field.wall < spec.restitution.material_count());
  assert(spec.puck_friction >= 0.0 &&
         (!is_rough() || (spec.surface_friction->coefficient.material_count() ==
                              spec.restitution.material_count() &&
                          spec.surface_friction->tangential_restitution.material_count() ==
                              spec.restitution.material_count())));
  tolerance_ = 0x1p-52 * fineness * (spec.field.length + spec.field.width);
  has_free_impacts_ = spec.puck_drag == 0.0 && !is_slowed() && !is_rough() &&
                      !spec.accounts_energy && !spec.allow_overlap;
  grid_.rebuild(spec.field.length, spec.field.width, 0.0, 1, spec.cell_size);
}

Motion Engine::motion(std::uint32_t body) const {
  const Body& b = bodies_[body];
  return {b.time,           {b.x, b.y},
          {b.vx, b.vy},     laws_[body].acceleration,
          laws_[body].drag, is_slowed() ? rest_times_[body] : infinity};
}

Real Engine::reach_of(std::uint32_t body) const {
  return bodies_[body].radius + builds_[body].half_extent.maxCoeff();
}

RoundedBox Engine::shape_of(std::uint32_t a, std::uint32_t b) const {
  return {builds_[a].half_extent + builds_[b].half_extent, bodies_[a].radius + bodies_[b].radius};
}

BodyId Engine::add(BodyKind kind, const RealVector& position, const RealVector& velocity,
                   Real radius, const RealVector& half_extent, Real mass, MaterialId material,
                   Half half, Real spin) {
  assert(position.allFinite() && velocity.allFinite() && mass > 0.0 &&
         material < spec_.restitution.material_count());
  assert(spec_.allow_overlap || is_free(position, {half_extent, radius}));
  const auto body = static_cast<std::uint32_t>(bodies_.size());
  const Real inverse_mass = kind == BodyKind::post ? 0.0 : 1.0 / mass;
  bodies_.push_back({{position.x(), position.y(), velocity.x(), velocity.y(), clock_.now, radius},
                     inverse_mass,
                     0,
                     kind,
                     material,
                     0,
                     no_mouth});
  changes_.add(body);
  builds_.push_back({mass, inverse_mass, half_extent, RealVector(0.0, 0.0), half});
  slots_.push_back(no_event);
  laws_.push_back({RealVector(0.0, 0.0), RealVector::Constant(own_drag(body))});
  rhythms_.emplace_back();
  jams_.push_back(0);
  write_law(body);
  if (is_rough()) spins_.push_back(spin);
  if (is_slowed()) rest_times_.push_back(infinity), slowing_.emplace_back(0.0, 0.0), slide(body);
  ledger_.introduce(energy_of(body));
  enter_mouth_if_inside(body);
  const std::uint32_t count = body + 1;
  grid_.resize(count);
  queue_.resize(count);
  require_prediction(body);
  if (count > grid_capacity_ || reach_of(body) > reach_) {
    reach_ = std::max(reach_, reach_of(body));
    grid_capacity_ = std::max(64u, 2 * count);
    rebuild_grid();
  } else {
    grid_.insert(body, static_cast<double>(position.x()), static_cast<double>(position.y()));
  }
  return {body};
}

void Engine::rebuild_grid() {
  grid_.rebuild(spec_.field.length, spec_.field.width, static_cast<double>(2.0 * reach_),
                static_cast<std::uint32_t>(bodies_.size()), spec_.cell_size);
  for (std::uint32_t body = 0; body < bodies_.size(); ++body) {
    if (is_gone(body)) continue;
    const RealVector position = at(body, clock_.now).position;
    grid_.insert(body, static_cast<double>(position.x()), static_cast<double>(position.y()));
    require_prediction(body);
  }
  is_everything_pending_ = true;
}

void Engine::enter_mouth_if_inside(std::uint32_t body) {
  Body& b = bodies_[body];
  b.mouth = no_mouth;
  if (b.kind != BodyKind::puck || spec_.field.goal_width == 0.0) return;
  if (b.x < b.radius) b.mouth = left_mouth;
  if (b.x > spec_.field.length - b.radius) b.mouth = right_mouth;
}

void Engine::require_prediction(std::uint32_t body) {
  if ((bodies_[body].flags & pending) != 0) return;
  bodies_[body].flags |= pending;
  pending_.push_back(body);
}

/// Where everything is predicted anew, whoever moves finds those who rest; these need not look for
/// themselves.
void Engine::predict_pending() {
  if (2 * pending_.size() > bodies_.size()) rebuild_grid();
  for (const std::uint32_t body : pending_) {
    bodies_[body].flags = static_cast<std::uint8_t>(bodies_[body].flags & ~pending);
    if (is_gone(body)) continue;
    if (!is_everything_pending_ || !is_left_alone(body)) {
      predict(body);
    } else {
      slots_[body] = no_event;
      queue_.set(body, infinity, body, body);
    }
  }
  pending_.clear();
  is_everything_pending_ = false;
}

/// At rest by itself: it has no event before somebody else's.
bool Engine::is_left_alone(std::uint32_t body) const {
  const Body& b = bodies_[body];
  return b.vx == 0.0 && b.vy == 0.0 && (b.flags & held) == 0 &&
         laws_[body].acceleration == RealVector(0.0, 0.0);
}

void Engine::remove(std::uint32_t body) {
  Body& b = bodies_[body];
  if ((b.flags & removed) != 0) return;
  keep(body);
  if ((b.flags & out_of_play) == 0) {
    wake(body, clock_.now);
    for (int axis = 0; axis < 2; ++axis) dissolve(body, axis, clock_.now);
    rebase(body, clock_.now);
    ledger_.introduce(-energy_of(body));
    grid_.remove(body);
    queue_.set(body, infinity, body, body);
  }
  b.flags |= removed;
  changes_.note(body);
  settle();
}

void Engine::place(std::uint32_t puck, const RealVector& position, const RealVector& velocity) {
  Body& b = bodies_[puck];
  assert(b.kind == BodyKind::puck && (b.flags & gone) == out_of_play && position.allFinite() &&
         velocity.allFinite());
  assert(is_free(position, {RealVector(0.0, 0.0), b.radius}));
  keep(puck);
  b.x = position.x(), b.y = position.y(), b.vx = velocity.x(), b.vy = velocity.y(),
  b.time = clock_.now;
  b.flags = static_cast<std::uint8_t>(b.flags & ~out_of_play);
  enter_mouth_if_inside(puck);
  if (is_rough()) spins_[puck] = 0.0;
  ledger_.introduce(energy_of(puck));
  grid_.insert(puck, static_cast<double>(b.x), static_cast<double>(b.y));
  touch(puck);
  settle();
}

void Engine::set_thrust(std::uint32_t bat, const RealVector& acceleration) {
  assert(bodies_[bat].kind == BodyKind::bat && acceleration.allFinite());
  if (builds_[bat].thrust == acceleration) return;
  keep(bat);
  if (journal_ != nullptr) journal_->time = clock_.now;
  if (is_gone(bat)) {
    builds_[bat].thrust = acceleration;
    return;
  }
  record_.note(EventKind::thrust, clock_.now, bat);
  wake(bat, clock_.now);
  rebase_companions(bat, clock_.now);
  builds_[bat].thrust = acceleration;
  for (int axis = 0; axis < 2; ++axis) {
    if ((bodies_[bat].flags & held_along(axis)) != 0)
      share(axis, companions(bat, held_along(axis)), clock_.now);
    else set_law(bat, axis, acceleration[axis], own_drag(bat));
  }
  settle();
}

std::optional<Goal> Engine::advance(Real until) {
  assert(until >= clock_.now && until < infinity);
  // Or else a stop between two keys of one instant would let the first one's impacts come before
  // the second one.
  if (clock_.is_played && until == clock_.now) return std::nullopt;
  if (journal_ != nullptr && clock_.is_played) journal_->played = clock_.now;
  predict_pending();
  clock_.is_played = false;
  const bool looks_ahead = bodies_.size() >= look_ahead_min && queue_.calendar() != nullptr;
  for (std::uint32_t body = queue_.first(until); body != EventQueue::none;
       body = queue_.first(until)) {
    if (looks_ahead && queue_.calendar()->current() != looked_ahead_.back() - 1) look_ahead();
    process(body, queue_.time(body));
    if (goal_) return std::exchange(goal_, std::nullopt);
  }
  clock_.arrive(until);
  return std::nullopt;
}

/// Fetches what the next events will look into, in steps, as one thing leads to the next: who
/// comes, whom he meets and in which cells, who is there. Changes nothing but speed.
void Engine::look_ahead() {
  const auto& calendar = *queue_.calendar();
  const auto fetch = [&](std::uint32_t body) {
    __builtin_prefetch(&bodies_[body], 1);
    __builtin_prefetch(&slots_[body], 1);
    grid_.prefetch_place(body);
    calendar.prefetch(body);
  };
  const auto meets = [&](std::uint32_t body) {
    return slots_[body].impact_time <= slots_[body].crossing_time;
  };
  const auto meets_listed = [&](std::uint32_t body) {
    return meets(body) && is_body(slots_[body].partner) && grid_.is_listed(slots_[body].partner);
  };
  const auto fetch_collected = [&](std::uint32_t count) {
    for (std::uint32_t k = 0; k < count; ++k) __builtin_prefetch(&bodies_[candidates_[k]]);
  };
  const auto step = [&](std::size_t number, auto&& visit) {
    const std::int64_t distance = static_cast<std::int64_t>(looked_ahead_.size() - number),
                       current = calendar.current();
    std::int64_t& last = looked_ahead_[number];
    if (last > current + distance) last = current;  // the buckets were numbered anew
    for (last = std::max(last, current); last < current + distance;)
      calendar.upcoming(++last - current, visit);
  };
  candidates_.resize(grid_.collected_max());
  step(0, fetch);
  step(1, [&](std::uint32_t body) {
    if (!grid_.is_listed(body)) return;  // it has left, its note has not
    if (!meets(body)) return grid_.prefetch_cells_ahead(body, slots_[body].direction);
    grid_.prefetch_cells(body);
    if (is_body(slots_[body].partner)) fetch(slots_[body].partner);
  });
  step(2, [&](std::uint32_t body) {
    if (!grid_.is_listed(body)) return;
    fetch_collected(meets(body) ? grid_.collect(body, candidates_.data())
                                : grid_.collect_ahead_of_move(body, slots_[body].direction,
                                                              candidates_.data()));
    if (meets_listed(body)) grid_.prefetch_cells(slots_[body].partner);
  });
  step(3, [&](std::uint32_t body) {
    if (meets_listed(body))
      fetch_collected(grid_.collect(slots_[body].partner, candidates_.data()));
  });
}

void Engine::process(std::uint32_t body, Real time) {
  clock_.reach(time);
  const Slot& slot = slots_[body];
  if (slot.crossing_time < slot.impact_time) return cross_cell(body);
  const Partner p = slot.partner;
  if (is_body(p) && bodies_[p].version != slot.partner_version) {
    ++counters_.stale_events;
    return predict(body);
  }
  if (journal_ != nullptr) journal_->begin_event(time, std::min(body, p), std::max(body, p));
  count_event(time);
  if (p == partner::goal_line) score(body, time);
  else if (p == partner::release) release(body, time);
  else if (p == partner::stop) stop(body, time);
  else if (p == partner::mouth_in || p == partner::mouth_out) {
    rebase_companions(body, time);
    bodies_[body].mouth = p == partner::mouth_out                      ? no_mouth
                          : bodies_[body].x < 0.5 * spec_.field.length ? left_mouth
                                                                       : right_mouth;
  } else if (!collide_freely(body, p, time)) collide(body, p, time);
  settle();
}

void Engine::count_event(Real time) {
  clock_.count_event(time);
  counters_.events_at_once_max = std::max(counters_.events_at_once_max, clock_.events_at_once);
  if (journal_ != nullptr)
    journal_->at_once_max = std::max(journal_->at_once_max, clock_.events_at_once),
    journal_->times.push_back(time);
}

void Engine::settle() {
  if (ledger_.is_kept()) {
    for (std::size_t i = 0; i < touched_.size(); ++i)
      if (!is_gone(touched_[i])) ledger_.note_after(i, energy_of(touched_[i]));
    ledger_.close_event();
  }
  if (is_slowed()) slide_touched();
  if (journal_ != nullptr) enter_changes();
  for (std::size_t i = 0; i < touched_.size(); ++i) {
    Body& b = bodies_[touched_[i]];
    b.flags = static_cast<std::uint8_t>(b.flags & ~touched);
    if (!is_gone(touched_[i]) && (b.flags & pending) == 0) predict(touched_[i]);
  }
  touched_.clear();
}

void Engine::cross_cell(std::uint32_t body) {
  ++counters_.crossings;
  const CellGrid::Direction direction = slots_[body].direction;
  grid_.move(body, direction);
  if ((bodies_[body].flags & curved) != 0) return predict(body);
  // Only the three cells that came into sight: the earliest impact in the others is known and stays
  // the earliest.
  predict_flight(body);
  candidates_.resize(grid_.collected_max());
  predict_pairs(body, grid_.collect_ahead(body, direction, candidates_.data()));
  enqueue(body);
}

void Engine::stop(std::uint32_t body, Real time) {
  record_.note(EventKind::stop, time, body);
  wake(body, time);
  rebase_companions(body, time);
  bodies_[body].vx = bodies_[body].vy =
      0.0;  // one too slow to move before the next instant that a clock can show was not evaluated
}

void Engine::score(std::uint32_t body, Real time) {
  record_.note(EventKind::goal, time, body);
  wake(body, time);
  for (int axis = 0; axis < 2; ++axis) dissolve(body, axis, time);
  rebase(body, time);
  ledger_.introduce(-energy_of(body));
  Body& b = bodies_[body];
  b.flags |= out_of_play;
  b.mouth = no_mouth;
  grid_.remove(body);
  queue_.set(body, infinity, body, body);
  goal_ = Goal{time, {body}, b.x < 0.5 * spec_.field.length ? End::left : End::right};
}

}  // namespace rink::physics::inline RINK_PRECISION
