// The loop of a tile: what may be played here, and what is put off.
#include "game/physics/slabs/tile.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "game/physics/flight/motion.h"
#include "game/physics/prefetch.h"

namespace rink::physics::inline RINK_PRECISION {

Tile::Tile(const Engine::Parts& engine, SharedWindow& shared, std::uint32_t number,
           std::uint32_t count)
    : shared_(shared),
      bodies_(engine.bodies),
      places_(engine.places),
      events_(engine.events),
      prediction_(engine.spec, {clock_, engine.bodies, engine.places.grid(), engine.history,
                                engine.rests, engine.events, record_.counters()}),
      courses_(number, count),
      impact_(engine) {}

void Tile::begin_window() {
  courses_.begin(shared_.number);
  record_.counters() = {};
  record_.forget();
  put_off_.clear(), wide_put_off_.clear(), awakened_.clear();
  impact_.begin_window(shared_.is_charged);
  impact_.journal().begin_window(shared_.observers);
  clock_ = latest_ = {};
  at_once_max_ = 0;
}

void Tile::play(const CellRange& range, const Listed& listed, bool can_be_late) {
  if (listed.small.empty()) return;
  can_be_late_ = can_be_late, is_whole_ = false;
  latest_ = clock();
  clock_ = {};  // of another place: it begins anew
  cells_.open(range, places_.grid(), shared_.block_radius);
  fetch(listed.small);
  const EventOrder* entries = events_.windows()->entries();
  bins_.open(shared_.begin, shared_.end, listed.small.size() + listed.wide.size());
  for (const std::uint32_t body : listed.small) bins_.add(body, entries[body]);
  for (const std::uint32_t body : listed.wide) bins_.add(body, entries[body]);
  for (std::uint32_t body = bins_.first(entries); body != EventBins::none;
       body = bins_.first(entries)) {
    const Encounter encounter = encounter_of(body, entries[body].time);
    bins_.drop_first();
    if (!is_in_one_cell(encounter.from)) {
      if (!play_wide(encounter)) close_around_wide(encounter);
    } else if (!may_play(encounter) ||
               !(encounter.is_with_wide ? play_near_wide(encounter) : play_event(encounter))) {
      put_off(encounter);
    }
  }
}

bool Tile::play_first_of_all(std::uint32_t body) {
  can_be_late_ = is_whole_ = true;
  return play_event(encounter_of(body, events_.time(body)));
}

/// Asks the processor for what the events will look at: all that is in the tile, or around `bodies`
/// where these are few.
void Tile::fetch(std::span<const std::uint32_t> bodies) {
  if (32 * bodies.size() >= cells_.count()) return fetch_all();
  for (const std::uint32_t body : bodies) {
    fetch(body);
    places_.grid().prefetch_cells(body);
  }
  near_.resize(places_.grid().collected_max());
  for (const std::uint32_t body : bodies) {
    const std::uint32_t count = places_.grid().collect(body, near_.data());
    for (std::uint32_t k = 0; k < count; ++k) prefetch(&bodies_[near_[k]]);
    if (is_body(events_[body].partner)) fetch(events_[body].partner);
  }
}

/// Entries and places have just been looked at.
void Tile::fetch_all() {
  const CellRange& range = cells_.range();
  const Body* const bodies = bodies_.table().bodies.data();
  const NextEvent* const slots = &events_[0];
  places_.grid().within(
      {static_cast<std::uint32_t>(range.first_column), static_cast<std::uint32_t>(range.first_row),
       static_cast<std::uint32_t>(range.end_column - 1),
       static_cast<std::uint32_t>(range.end_row - 1)},
      [&](std::uint32_t body) { prefetch(bodies + body), prefetch(slots + body); });
  constexpr int line = 64 / sizeof(Real);
  for (int row = range.first_row; row < range.end_row; ++row)
    for (int column = range.first_column; column < range.end_column; column += line)
      prefetch(&shared_.played_at(column, row, static_cast<int>(places_.grid().columns())));
}

void Tile::fetch(std::uint32_t body) const {
  prefetch(&bodies_[body]);
  prefetch(&events_[body]);
  prefetch(events_.windows()->entries() + body);
  places_.grid().prefetch_place(body);
}

/// The next event of `body`.
[[gnu::always_inline]] inline Tile::Encounter Tile::encounter_of(std::uint32_t body,
                                                                 Real time) const {
  const NextEvent& slot = events_[body];
  const Place place = places_.grid().place(body);
  Encounter encounter{body,  slot.partner, time, slot.crossing_time < slot.impact_time,
                      place, place};
  if (encounter.crosses) {
    encounter.to = encounter.from.towards(slot.direction);
  } else if (is_body(slot.partner)) {
    // A post may be wider than a cell; it has no courses.
    const Place to = places_.grid().place_meanwhile(slot.partner);
    encounter.is_with_wide = !is_in_one_cell(to) && to.column != Place{}.column;
    if (is_in_one_cell(to)) encounter.to = to;
  }
  return encounter;
}

[[gnu::always_inline]] inline bool Tile::may_play(const Encounter& encounter) const {
  const Blocked most = std::max(cells_.at(encounter.from), cells_.at(encounter.to));
  return most == Blocked::for_nobody ||
         (most == Blocked::for_impacts && !encounter.is_with_wide && !is_impact(encounter));
}

bool Tile::is_impact(const Encounter& encounter) const {
  return !encounter.crosses &&
         (!is_body(encounter.partner) ||
          bodies_[encounter.partner].version == events_[encounter.body].partner_version);
}

/// Where its bodies are nothing happens until it is played, so that the events of each keep their
/// order; and no course near them is replaced by another that they might not see.
void Tile::put_off(const Encounter& encounter) {
  put_off_.push_back(encounter.body);
  const Place &from = encounter.from, &to = encounter.to;
  cells_.block_around(from, shared_.block_radius);
  if (from.column != to.column || from.row != to.row) cells_.block_around(to, shared_.block_radius);
}

/// Where a wide one stands, who sees it, no course is replaced from its event on; and whom it
/// meets, if that is here, waits with it.
void Tile::close_around_wide(const Encounter& encounter) {
  wide_put_off_.push_back(encounter.body);
  cells_.block_all(cells_of(places_.grid(), encounter.body), Blocked::for_impacts);
  const Place& to = encounter.to;
  if (!encounter.crosses && cells_.has(to) && is_impact(encounter))
    cells_.block_all({to.column, to.row, to.column, to.row}, Blocked::for_all);
}

bool Tile::play_event(const Encounter& encounter) {
  const auto& [body, p, time, crosses, from, target, is_with_wide] = encounter;
  const bool is_with_field = !crosses && !is_body(p);
  if ((is_with_field && (p < partner::wall_left || p > partner::wall_top)) ||
      bodies_[body].is(Body::curved) || !is_in_one_cell(from))
    return false;
  const bool is_stale = !crosses && !is_impact(encounter);
  const bool is_late_now = can_be_late_ && (is_late(from, time) || is_late(target, time));
  if (is_stale) {
    ++record_.counters().stale_events;
    prediction_.look(body);
    publish(body);
  } else if (!(crosses         ? cross(body)
               : is_with_field ? rebound(body, p, time)
                               : collide(body, p, time))) {
    return false;
  }
  mark_cell(from, time);
  if (!is_stale) mark_cell(target, time);
  if (!is_late_now) return true;
  const bool is_of_two = !is_stale && !crosses && !is_with_field;
  if (is_of_two) mark_cell(places_.grid().place(p), time);
  note_late(body, time);
  if (is_of_two && !bodies_.is_fixed(p)) note_late(p, time);
  return true;
}

/// Whether it is at that edge of its cell: its place and its next crossing belong together. Where a
/// crossing had brought it into sight of an impact before that, it comes back at once.
bool Tile::leaves_by(CellGrid::Direction direction, Real time, std::uint32_t body) const {
  if (time < bodies_[body].time) return true;
  const RealVector position = position_at(bodies_, body, time);
  const CellGrid& grid = places_.grid();
  const CellGrid::Place place = grid.place(body);
  const bool is_high = direction == CellGrid::right || direction == CellGrid::up,
             is_across = direction <= CellGrid::right;
  const Real distance = is_across ? position.x() - grid.column_edge(place.column, is_high)
                                  : position.y() - grid.row_edge(place.row, is_high);
  return std::abs(distance) <= Real(1e-6 * grid.side());
}

bool Tile::cross(std::uint32_t body) {
  const CellGrid::Direction direction = events_[body].direction;
  assert(leaves_by(direction, events_[body].crossing_time, body));
  if (!places_.move_in_place(body, direction)) return false;
  ++record_.counters().crossings;
  courses_.note_speed(bodies_[body]);
  prediction_.look_beyond(body, direction);
  publish(body);
  return true;
}

/// By columns, then by rows; return_to() goes back by rows, then by columns.
bool Tile::put_back(std::uint32_t body, Real time) {
  const Body& b = bodies_[body];
  const CellGrid& grid = places_.grid();
  if (b.is(Body::curved) || !grid.is_in_one_cell(body)) return true;
  const Real elapsed = std::max<Real>(0.0, time - b.time),
             warped = warp_unaccelerated(elapsed, bodies_.own_drag(body)).s,
             x = b.x + b.vx * warped, y = b.y + b.vy * warped, slack = Real(1e-9 * grid.side());
  const auto direction = [&](const Place& place) -> std::optional<CellGrid::Direction> {
    if (x < grid.column_edge(place.column, false) - slack) return CellGrid::left;
    if (x > grid.column_edge(place.column, true) + slack) return CellGrid::right;
    if (y < grid.row_edge(place.row, false) - slack) return CellGrid::down;
    if (y > grid.row_edge(place.row, true) + slack) return CellGrid::up;
    return std::nullopt;
  };
  const Place before = grid.place(body);
  for (auto back = direction(before); back; back = direction(grid.place(body))) {
    const bool is_ours =
        is_whole_ || cells_.at(grid.place(body).towards(*back)) != Blocked::for_all;
    if (!is_ours || !places_.move_in_place(body, *back)) return return_to(before, body), false;
  }
  return true;
}

/// The way that put_back() came, through the cells that it has left: so there is room.
void Tile::return_to(const Place& before, std::uint32_t body) {
  const CellGrid& grid = places_.grid();
  while (grid.place(body).row != before.row)
    places_.move(body, grid.place(body).row < before.row ? CellGrid::up : CellGrid::down);
  while (grid.place(body).column != before.column)
    places_.move(body, grid.place(body).column < before.column ? CellGrid::right : CellGrid::left);
}

/// Where a third one touches neither.
bool Tile::collide(std::uint32_t body, std::uint32_t other, Real time) {
  if (!places_.grid().is_in_one_cell(other)) return false;  // a wide one, in many tiles perhaps
  if (bodies_[other].kind != BodyKind::puck) return strike(body, other, time);
  const std::uint32_t low = std::min(body, other), high = std::max(body, other);
  if (events_[low].is_tied || events_[high].is_tied || !impact_.bounce(low, high, time))
    return false;
  if (!settle_pair(body, other, time)) return false;
  record_.note(EventKind::puck_puck, time, low, high);
  enter_impact(low, impact_.low_before(), time), enter_impact(high, impact_.high_before(), time);
  publish(low), publish(high);
  return true;
}

/// Settles the impact that has just been tried, and predicts what comes next of both. False, with
/// all as it was before, if it concerns somebody else as well.
bool Tile::settle_pair(std::uint32_t body, std::uint32_t other, Real time) {
  const Place place = places_.grid().place(other);
  const NextEvent slot = events_[body], its_slot = events_[other];
  const std::uint64_t predictions = record_.counters().predictions;
  const auto meets_nobody_else = [&](std::uint32_t one) {
    const Body& b = bodies_[one];
    if (b.kind == BodyKind::post) return true;  // it looks at nobody
    return (b.is(Body::curved) ? prediction_.predict_curved_counting(one)
                               : prediction_.predict_counting(one)) == 2;
  };
  if (impact_.was_near() && (!can_be_late_ || put_back(other, time)) && meets_nobody_else(body) &&
      meets_nobody_else(other)) {
    impact_.settle(time);
    clock_.count_event(time);
    at_once_max_ = std::max(at_once_max_, clock_.events_at_once);
    return true;
  }
  impact_.take_back();
  return_to(place, other);
  events_.slot(body) = slot, events_.slot(other) = its_slot;
  record_.counters().predictions = predictions;
  return false;
}

/// Where no other body touches it.
bool Tile::rebound(std::uint32_t body, Partner wall, Real time) {
  if (events_[body].is_tied || !impact_.rebound(body, wall, time)) return false;
  const NextEvent slot = events_[body];
  const std::uint64_t predictions = record_.counters().predictions;
  if (prediction_.predict_counting(body) != 1) {
    impact_.take_back();
    events_.slot(body) = slot;
    record_.counters().predictions = predictions;
    return false;
  }
  impact_.settle(time);
  record_.note(EventKind::wall, time, body, wall);
  enter_impact(body, impact_.low_before(), time);
  clock_.count_event(time);
  at_once_max_ = std::max(at_once_max_, clock_.events_at_once);
  publish(body);
  return true;
}

/// One of those whose flight an impact has replaced.
void Tile::enter_impact(std::uint32_t body, const Flight& before, Real time) {
  const Body& b = bodies_[body];
  courses_.replace(body, before, b.version - 1, time, shared_.latest[body]);
  b.is(Body::curved) ? note_speed(body) : courses_.note_speed(b);
  record_.counters().evaluations += before.time < time;
  ++record_.counters().bodies_touched;
}

void Tile::note_speed(std::uint32_t body) {
  Flight flight = bodies_[body];
  const RealVector gain =
      bodies_.law(body).acceleration * (shared_.end - std::min(flight.time, shared_.begin));
  flight.vx = std::abs(flight.vx) + std::abs(gain.x());
  flight.vy = std::abs(flight.vy) + std::abs(gain.y());
  courses_.note_speed(flight);
}

void Tile::publish(std::uint32_t body) {
  if (is_whole_) return events_.schedule(body);
  WindowQueue& queue = *events_.windows();
  const EventOrder order = events_.order_of(body);
  EventOrder& entry = queue.entries()[body];
  const bool had_none = !(entry.time < infinity);
  entry = order;
  if (order.time <= shared_.end) bins_.add(body, order);
  if (had_none && order.time < infinity && !queue.is_listed(body)) awakened_.push_back(body);
}

/// Whether somebody in the cells, or next to them, has been played further.
bool Tile::is_late(const CellBlock& cells, Real time) {
  const int columns = static_cast<int>(places_.grid().columns()),
            rows = static_cast<int>(places_.grid().rows()),
            first_column = std::max(0, static_cast<int>(cells.column_low) - 1),
            end_column = std::min(columns, static_cast<int>(cells.column_high) + 2),
            end_row = std::min(rows, static_cast<int>(cells.row_high) + 2);
  for (int row = std::max(0, static_cast<int>(cells.row_low) - 1); row < end_row; ++row)
    for (int column = first_column; column < end_column; ++column)
      if (shared_.played_at(column, row, columns) > time) return true;
  return false;
}

bool Tile::mark(std::uint32_t body, Partner partner, Real time) {
  const CellGrid& grid = places_.grid();
  const CellBlock from = cells_of(grid, body),
                  to = is_body(partner) && grid.is_listed(partner) ? cells_of(grid, partner) : from;
  const bool is_late_now = is_late(from, time) || is_late(to, time);
  mark_cells(from, time), mark_cells(to, time);
  return is_late_now;
}

void Tile::mark_cells(const CellBlock& cells, Real time) {
  for (std::uint32_t row = cells.row_low; row <= cells.row_high; ++row)
    for (std::uint32_t column = cells.column_low; column <= cells.column_high; ++column)
      mark_cell({static_cast<std::uint16_t>(column), static_cast<std::uint16_t>(row)}, time);
}

void Tile::note_late(std::uint32_t body, Real time) {
  courses_.note_late({bodies_[body], time, events_.time(body), body, places_.grid().place(body)});
}

}  // namespace rink::physics::inline RINK_PRECISION
