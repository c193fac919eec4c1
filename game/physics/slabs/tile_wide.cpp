// What befalls bats and posts that are wider than a cell, and who is near them.
#include <algorithm>
#include <cstdint>

#include "game/physics/engine/joint_impacts.h"
#include "game/physics/grid/wide_bodies.h"
#include "game/physics/slabs/tile.h"

namespace rink::physics::inline RINK_PRECISION {

/// Of a wide one: all that reads and writes nothing beyond the tile.
bool Tile::play_wide(const Encounter& encounter) {
  const auto& [body, partner, time, crosses, from, to, is_with_wide] = encounter;
  if (crosses) return cross_wide(body, time);
  if (!is_body(partner) || is_with_wide || !cells_.has(to)) return false;
  const CellBlock cells = cells_of(places_.grid(), body);
  if (!cells_.are_open(cells)) return false;
  clock_.now = time;
  if (is_impact(encounter)) return play_with_wide(encounter, body, partner);
  ++record_.counters().stale_events;
  const bool is_late_now = can_be_late_ && is_late(cells, time);
  prediction_.look(body);
  publish(body);
  mark_cells(cells, time);
  if (is_late_now) note_late(body, time);
  return true;
}

bool Tile::cross_wide(std::uint32_t body, Real time) {
  const CellGrid& grid = places_.grid();
  const CellGrid::Direction direction = events_[body].direction;
  const CellBlock from = cells_of(grid, body), to = moved(from, direction);
  if (!cells_.are_open(from) || !cells_.are_open(to)) return false;
  const bool is_late_now = can_be_late_ && is_late(from, time);
  if (!places_.move_in_place(body, direction)) return false;
  clock_.now = time;
  ++record_.counters().crossings;
  note_speed(body);
  prediction_.look_beyond(body, direction);
  publish(body);
  mark_cells(from, time), mark_cells(to, time);
  if (is_late_now) note_late(body, time);
  return true;
}

/// Of a small one: an impact with a wide one, or what was one. Who does not stand in its cell may
/// be in another tile, which moves it.
bool Tile::play_near_wide(const Encounter& encounter) {
  bool stands_here = false;
  places_.grid().wide().visit_in(encounter.from.column, encounter.from.row,
                                 [&](const WideBodies::Wide& wide) {
                                   stands_here = stands_here || wide.body == encounter.partner;
                                 });
  if (!stands_here) return false;
  return is_impact(encounter) ? play_with_wide(encounter, encounter.partner, encounter.body)
                              : play_event(encounter);
}

/// An impact of a puck and a bat in the tile, or a post.
bool Tile::play_with_wide(const Encounter& encounter, std::uint32_t wide, std::uint32_t puck) {
  const CellBlock cells = cells_of(places_.grid(), wide);
  const bool is_fixed = bodies_.is_fixed(wide);
  const Real time = encounter.time;
  const Place from = places_.grid().place(puck);
  if (!is_in_one_cell(from) || (!is_fixed && !cells_.are_open(cells)) ||
      cells_.at(from) != Blocked::for_nobody)
    return false;
  const bool is_late_now =
      can_be_late_ && (is_late(from, time) || (!is_fixed && is_late(cells, time)));
  if (!strike(encounter.body, encounter.partner, time)) return false;
  mark_cell(from, time), mark_cell(places_.grid().place(puck), time);
  if (!is_fixed) mark_cells(cells, time);
  if (!is_late_now) return true;
  note_late(puck, time);
  if (!is_fixed) note_late(wide, time);
  return true;
}

bool Tile::strike(std::uint32_t body, std::uint32_t other, Real time) {
  if (events_[body].is_tied || events_[other].is_tied || !impact_.strike(body, other, time))
    return false;
  if (!settle_pair(body, other, time)) return false;
  const std::uint32_t low = impact_.low(), high = impact_.high();
  record_.note(impact_kind(bodies_, low, high), time, low, high);
  enter_impact(low, impact_.low_before(), time);
  if (!bodies_.is_fixed(high)) enter_impact(high, impact_.high_before(), time);
  impact_.count_meeting(clock_.instant_begin);
  for (const std::uint32_t one : {low, high})
    if (!bodies_.is_fixed(one)) publish(one);
  return true;
}

}  // namespace rink::physics::inline RINK_PRECISION
