// The loop of a tile: what may be played here, and what is put off.
#include "game/physics/slabs/tile.h"

#include <algorithm>
#include <cassert>
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
  put_off_.clear(), awakened_.clear();
  impact_.begin_window();
  clock_ = latest_ = {};
  at_once_max_ = 0;
}

void Tile::play(const CellRange& range, std::span<const std::uint32_t> bodies, bool can_be_late) {
  if (bodies.empty()) return;
  can_be_late_ = can_be_late, is_whole_ = false;
  latest_ = clock();
  clock_ = {};  // of another place: it begins anew
  open(range);
  fetch(bodies);
  const EventOrder* entries = events_.windows()->entries();
  bins_.open(shared_.begin, shared_.end, bodies.size());
  for (const std::uint32_t body : bodies) bins_.add(body, entries[body]);
  for (std::uint32_t body = bins_.first(entries); body != EventBins::none;
       body = bins_.first(entries)) {
    const Encounter encounter = encounter_of(body, entries[body].time);
    if (may_play(encounter) && play_event(encounter)) continue;
    bins_.drop_first();
    put_off(encounter);
  }
}

bool Tile::play_first_of_all(std::uint32_t body) {
  can_be_late_ = is_whole_ = true;
  return play_event(encounter_of(body, events_.time(body)));
}

/// Closes the cells next to which another tile plays, and to impacts those next to which it may
/// have put one off.
void Tile::open(const CellRange& range) {
  range_ = range;
  blocked_.assign(std::size_t{range.columns()} * range.rows(), Blocked::for_nobody);
  close_edges(1, Blocked::for_all);
  close_edges(shared_.block_radius, Blocked::for_impacts);
}

/// Closes `width` cells along each edge that is not the field's.
void Tile::close_edges(int width, Blocked blocked) {
  const CellRange& range = range_;
  const CellGrid& grid = places_.grid();
  const int columns = static_cast<int>(grid.columns()), rows = static_cast<int>(grid.rows());
  if (range.first_column > 0)
    block({range.first_column, range.first_row, range.first_column + width, range.end_row},
          blocked);
  if (range.end_column < columns)
    block({range.end_column - width, range.first_row, range.end_column, range.end_row}, blocked);
  if (range.first_row > 0)
    block({range.first_column, range.first_row, range.end_column, range.first_row + width},
          blocked);
  if (range.end_row < rows)
    block({range.first_column, range.end_row - width, range.end_column, range.end_row}, blocked);
}

/// Asks the processor for what the events will look at: all that is in the tile, or around `bodies`
/// where these are few.
void Tile::fetch(std::span<const std::uint32_t> bodies) {
  if (32 * bodies.size() >= blocked_.size()) return fetch_all();
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

void Tile::fetch_all() {
  places_.grid().within({static_cast<std::uint32_t>(range_.first_column),
                         static_cast<std::uint32_t>(range_.first_row),
                         static_cast<std::uint32_t>(range_.end_column - 1),
                         static_cast<std::uint32_t>(range_.end_row - 1)},
                        [&](std::uint32_t body) { fetch(body); });
  constexpr int line = 64 / sizeof(Real);
  for (int row = range_.first_row; row < range_.end_row; ++row)
    for (int column = range_.first_column; column < range_.end_column; column += line)
      prefetch(&shared_.played_at(column, row, static_cast<int>(places_.grid().columns())));
}

void Tile::fetch(std::uint32_t body) const {
  prefetch(&bodies_[body]);
  prefetch(&events_[body]);
  prefetch(events_.windows()->entries() + body);
  places_.grid().prefetch_place(body);
}

/// The next event of `body`.
Tile::Encounter Tile::encounter_of(std::uint32_t body, Real time) const {
  const NextEvent& slot = events_[body];
  Encounter encounter{body,
                      slot.partner,
                      time,
                      slot.crossing_time < slot.impact_time,
                      places_.grid().place(body),
                      places_.grid().place(body)};
  if (encounter.crosses) {
    encounter.to = encounter.from.towards(slot.direction);
  } else if (is_body(slot.partner)) {
    // A post may be wider than a cell; it has no courses.
    const Place to = places_.grid().place_meanwhile(slot.partner);
    if (to.column < places_.grid().columns()) encounter.to = to;
  }
  return encounter;
}

/// For what `place` is blocked; for all where it is not in the tile.
Tile::Blocked Tile::blocked(const Place& place) const {
  const auto column = static_cast<std::uint32_t>(place.column - range_.first_column),
             row = static_cast<std::uint32_t>(place.row - range_.first_row);
  return column < range_.columns() && row < range_.rows()
             ? blocked_[row * range_.columns() + column]
             : Blocked::for_all;
}

bool Tile::may_play(const Encounter& encounter) const {
  const Blocked most = std::max(blocked(encounter.from), blocked(encounter.to));
  return most == Blocked::for_nobody || (most == Blocked::for_impacts && !is_impact(encounter));
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
  const int radius = shared_.block_radius;
  for (const Place& place : {encounter.from, encounter.to}) {
    block({place.column - radius, place.row - radius, place.column + radius + 1,
           place.row + radius + 1},
          Blocked::for_impacts);
    block({place.column, place.row, place.column + 1, place.row + 1}, Blocked::for_all);
  }
}

/// As far as they are in the tile.
void Tile::block(const CellRange& cells, Blocked whom) {
  const int first_column = std::max(range_.first_column, cells.first_column),
            end_column = std::min(range_.end_column, cells.end_column),
            end_row = std::min(range_.end_row, cells.end_row);
  for (int row = std::max(range_.first_row, cells.first_row); row < end_row; ++row)
    for (int column = first_column; column < end_column; ++column) {
      Blocked& cell =
          blocked_[static_cast<std::uint32_t>(row - range_.first_row) * range_.columns() +
                   static_cast<std::uint32_t>(column - range_.first_column)];
      cell = std::max(cell, whom);
    }
}

bool Tile::play_event(const Encounter& encounter) {
  const auto& [body, p, time, crosses, from, target] = encounter;
  if ((!crosses && !is_body(p)) || bodies_[body].is(Body::curved)) return false;
  const bool is_stale = !crosses && !is_impact(encounter);
  const bool is_late_now = can_be_late_ && (is_late(from, time) || is_late(target, time));
  if (is_stale) {
    ++record_.counters().stale_events;
    prediction_.look(body);
    publish(body);
  } else if (!(crosses ? cross(body) : collide(body, p, time))) {
    return false;
  }
  mark_cell(from, time);
  if (!is_stale) mark_cell(target, time);
  if (!is_late_now) return true;
  if (!is_stale && !crosses) mark_cell(places_.grid().place(p), time);
  note_late(body, time);
  if (!crosses && !is_stale) note_late(p, time);
  return true;
}

bool Tile::cross(std::uint32_t body) {
  const CellGrid::Direction direction = events_[body].direction;
  if (!places_.grid().has_room_beyond(body, direction)) return false;
  ++record_.counters().crossings;
  courses_.note_speed(bodies_[body]);
  places_.move(body, direction);
  prediction_.look_beyond(body, direction);
  publish(body);
  return true;
}

/// Somebody who has been taken to another cell by a later event than this is put back to where it
/// is at `time`. False if that cannot be done here.
bool Tile::put_back(std::uint32_t body, Real time) {
  const Body& b = bodies_[body];
  const CellGrid& grid = places_.grid();
  if (b.is(Body::curved) || !grid.is_listed(body)) return true;
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
  for (auto back = direction(grid.place(body)); back; back = direction(grid.place(body))) {
    const bool is_ours = is_whole_ || blocked(grid.place(body).towards(*back)) != Blocked::for_all;
    if (!is_ours || !grid.has_room_beyond(body, *back)) return false;
    places_.move(body, *back);
  }
  return true;
}

/// Where a third one touches neither.
bool Tile::collide(std::uint32_t body, std::uint32_t other, Real time) {
  const std::uint32_t low = std::min(body, other), high = std::max(body, other);
  const Body &a = bodies_[low], &b = bodies_[high];
  if (can_be_late_ && !put_back(other, time)) return false;
  if (events_[low].is_tied || events_[high].is_tied || !impact_.bounce(low, high, time))
    return false;
  const NextEvent slot_a = events_[low], slot_b = events_[high];
  const std::uint64_t predictions = record_.counters().predictions;
  if (!(impact_.was_near() && prediction_.predict_counting(low) == 2 &&
        prediction_.predict_counting(high) == 2)) {
    impact_.take_back();
    events_.slot(low) = slot_a, events_.slot(high) = slot_b;
    record_.counters().predictions = predictions;
    return false;
  }
  impact_.settle(time);
  const Flight &before_a = impact_.low_before(), &before_b = impact_.high_before();
  courses_.replace(low, before_a, a.version - 1, time, shared_.latest[low]);
  courses_.replace(high, before_b, b.version - 1, time, shared_.latest[high]);
  courses_.note_speed(a), courses_.note_speed(b);
  record_.note(EventKind::puck_puck, time, low, high);
  record_.counters().evaluations += (before_a.time < time) + (before_b.time < time);
  record_.counters().bodies_touched += 2;
  clock_.count_event(time);
  at_once_max_ = std::max(at_once_max_, clock_.events_at_once);
  publish(low), publish(high);
  return true;
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

/// Whether somebody next to the cell has been played further.
bool Tile::is_late(const Place& place, Real time) {
  const int columns = static_cast<int>(places_.grid().columns()),
            rows = static_cast<int>(places_.grid().rows());
  for (int row = std::max(0, place.row - 1); row < std::min(rows, place.row + 2); ++row)
    for (int column = std::max(0, place.column - 1); column < std::min(columns, place.column + 2);
         ++column)
      if (shared_.played_at(column, row, columns) > time) return true;
  return false;
}

void Tile::mark_cell(const Place& place, Real time) {
  Real& played =
      shared_.played_at(place.column, place.row, static_cast<int>(places_.grid().columns()));
  played = std::max(played, time);
}

bool Tile::mark(std::uint32_t body, Partner partner, Real time) {
  const Place from = places_.grid().place(body),
              to = is_body(partner) && places_.grid().is_in_one_cell(partner)
                       ? places_.grid().place(partner)
                       : from;
  const bool is_late_now = is_late(from, time) || is_late(to, time);
  mark_cell(from, time), mark_cell(to, time);
  return is_late_now;
}

void Tile::note_late(std::uint32_t body, Real time) {
  courses_.note_late({bodies_[body], time, events_.time(body), body, places_.grid().place(body)});
}

}  // namespace rink::physics::inline RINK_PRECISION
