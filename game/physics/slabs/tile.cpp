// The loop of a tile: what may be played here, and what is put off.
#include "game/physics/slabs/tile.h"

#include <algorithm>
#include <cassert>

#include "game/physics/bodies/tolerances.h"
#include "game/physics/engine/free_impact.h"

namespace rink::physics::inline RINK_PRECISION {

Tile::Tile(const Engine::Parts& engine, SharedWindow& shared, std::uint32_t number,
           std::uint32_t count)
    : shared_(shared),
      bodies_(engine.bodies),
      places_(engine.places),
      events_(engine.events),
      restitution_(engine.spec.restitution),
      rest_speed_(rest_speed(engine.spec)),
      prediction_(engine.spec, {clock_, engine.bodies, engine.places.grid(), engine.rests,
                                engine.events, record_.counters()}),
      courses_(number, count) {}

void Tile::begin_window() {
  courses_.begin(shared_.number);
  record_.counters() = {};
  record_.forget();
  put_off_.clear(), awakened_.clear();
  clock_ = latest_ = {};
  at_once_max_ = 0;
}

std::uint8_t& Tile::blocked_at(int column, int row) {
  const int width = range_.end_column - range_.first_column;
  return blocked_[static_cast<std::size_t>(row - range_.first_row) *
                      static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(column - range_.first_column)];
}

void Tile::play(const CellRange& range, std::span<const std::uint32_t> bodies, bool can_be_late) {
  if (bodies.empty()) return;
  range_ = range, can_be_late_ = can_be_late, is_whole_ = false;
  latest_ = clock();
  clock_ = {};  // of another place: it begins anew
  blocked_.assign(static_cast<std::size_t>((range.end_column - range.first_column) *
                                           (range.end_row - range.first_row)),
                  0);
  const EventOrder* entries = events_.windows()->entries();
  bins_.open(shared_.begin, shared_.end, bodies.size());
  for (const std::uint32_t body : bodies) bins_.add(body, entries[body]);
  for (std::uint32_t body = bins_.first(entries); body != EventBins::none;
       body = bins_.first(entries)) {
    const Place from = places_.grid().place(body), to = target_of(body);
    if (may_play(from) && may_play(to) && play_event(body, entries[body].time)) continue;
    bins_.drop_first();
    put_off(body, from, to);
  }
}

bool Tile::play_first_of_all(std::uint32_t body) {
  can_be_late_ = is_whole_ = true;
  return play_event(body, events_.time(body));
}

/// The other cell that the event concerns.
Tile::Place Tile::target_of(std::uint32_t body) const {
  const NextEvent& slot = events_[body];
  Place place = places_.grid().place(body);
  if (slot.crossing_time < slot.impact_time) {
    const int step = (slot.direction & 1) != 0 ? 1 : -1;
    std::uint16_t& index = slot.direction <= CellGrid::right ? place.column : place.row;
    index = static_cast<std::uint16_t>(index + step);
    return place;
  }
  return is_body(slot.partner) ? places_.grid().place(slot.partner) : place;
}

/// Not at an edge, beyond which another tile plays, and not blocked.
bool Tile::may_play(const Place& place) const {
  const CellGrid& grid = places_.grid();
  const int margin = std::max(1, shared_.block_radius);
  const auto is_inside = [margin](int index, int first, int end, std::uint32_t count) {
    return index >= first + (first > 0 ? margin : 0) &&
           index < end - (end < static_cast<int>(count) ? margin : 0);
  };
  return is_inside(place.column, range_.first_column, range_.end_column, grid.columns()) &&
         is_inside(place.row, range_.first_row, range_.end_row, grid.rows()) &&
         const_cast<Tile*>(this)->blocked_at(place.column, place.row) == 0;
}

void Tile::put_off(std::uint32_t body, const Place& from, const Place& to) {
  put_off_.push_back(body);
  block(from), block(to);
}

void Tile::block(const Place& place) {
  const int radius = shared_.block_radius;
  for (int row = std::max(range_.first_row, place.row - radius);
       row < std::min(range_.end_row, place.row + radius + 1); ++row)
    for (int column = std::max(range_.first_column, place.column - radius);
         column < std::min(range_.end_column, place.column + radius + 1); ++column)
      blocked_at(column, row) = 1;
}

bool Tile::play_event(std::uint32_t body, Real time) {
  const NextEvent& slot = events_[body];
  const Partner p = slot.partner;
  const bool crosses = slot.crossing_time < slot.impact_time;
  if (!crosses && !is_body(p)) return false;
  const bool is_stale = !crosses && bodies_[p].version != slot.partner_version;
  const bool is_late_now =
      can_be_late_ && (is_late(places_.grid().place(body), time) || is_late(target_of(body), time));
  const Place from = places_.grid().place(body), to = is_stale ? from : target_of(body);
  if (is_stale) {
    ++record_.counters().stale_events;
    prediction_.look(body);
    publish(body);
  } else if (!(crosses ? cross(body) : collide(body, p, time))) {
    return false;
  }
  mark_cell(from, time), mark_cell(to, time);
  if (!is_late_now) return true;
  note_late(body, time);
  if (!crosses && !is_stale) note_late(p, time);
  return true;
}

bool Tile::cross(std::uint32_t body) {
  const CellGrid::Direction direction = events_[body].direction;
  if (!places_.grid().has_room_beyond(body, direction)) return false;
  ++record_.counters().crossings;
  places_.move(body, direction);
  prediction_.look_beyond(body, direction);
  publish(body);
  return true;
}

/// As FreeImpact, where a third one touches neither.
bool Tile::collide(std::uint32_t body, std::uint32_t other, Real time) {
  const std::uint32_t low = std::min(body, other), high = std::max(body, other);
  const Body &a = bodies_[low], &b = bodies_[high];
  if (events_[low].is_tied || events_[high].is_tied || (a.flags | b.flags) != 0 ||
      a.kind != BodyKind::puck || b.kind != BodyKind::puck ||
      restitution_(a.material, b.material) != 1.0)
    return false;
  const Flight before_a = a, before_b = b;
  const NextEvent slot_a = events_[low], slot_b = events_[high];
  const auto square = bounce_freely(bodies_, low, high, time, rest_speed_);
  if (!square) return false;
  const Real touching = a.radius + b.radius + Real(0.5 * clear_of_touching);
  const std::uint64_t predictions = record_.counters().predictions;
  if (!(*square <= touching * touching && prediction_.predict_counting(low) == 2 &&
        prediction_.predict_counting(high) == 2)) {
    bodies_.take_back(low, before_a, a.version - 1);
    bodies_.take_back(high, before_b, b.version - 1);
    events_.slot(low) = slot_a, events_.slot(high) = slot_b;
    record_.counters().predictions = predictions;
    return false;
  }
  courses_.replace(low, before_a, a.version - 1, time, shared_.latest[low]);
  courses_.replace(high, before_b, b.version - 1, time, shared_.latest[high]);
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
  queue.entries()[body] = order;
  if (order.time <= shared_.end) bins_.add(body, order);
  if (order.time < infinity && !queue.is_listed(body)) awakened_.push_back(body);
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
              to = is_body(partner) && places_.grid().is_listed(partner)
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
