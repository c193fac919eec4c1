// One part of the field that plays a window of time by itself.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "game/physics/bodies/bodies.h"
#include "game/physics/bodies/clock.h"
#include "game/physics/bodies/event_record.h"
#include "game/physics/bodies/observers.h"
#include "game/physics/engine/engine.h"
#include "game/physics/engine/prediction.h"
#include "game/physics/events/event_bins.h"
#include "game/physics/events/window_queue.h"
#include "game/physics/grid/cell_grid.h"
#include "game/physics/grid/cell_lists.h"
#include "game/physics/real.h"
#include "game/physics/slabs/blocked_cells.h"
#include "game/physics/slabs/courses.h"
#include "game/physics/slabs/tile_impact.h"
#include "game/physics/slabs/tiling.h"

namespace rink::physics::inline RINK_PRECISION {

/// What all workers share. Different tiles never write the same body's, nor the same cell's.
struct SharedWindow {
  std::vector<Courses::Latest> latest;  ///< by body
  std::vector<Real> played;             ///< by cell: the latest event there
  std::uint32_t number = 0;
  Real begin = 0.0, end = 0.0;  ///< s, the end included
  int block_radius = 2;         ///< cells
  bool is_charged = false;      ///< a budget asks who had the events
  Observers observers;          ///< are told of the window when it is over

  Real& played_at(int column, int row, int columns) {
    return played[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                  static_cast<std::size_t>(column)];
  }
};

/// Of two clocks that have counted apart; where both have seen the same instant, whoever has
/// counted more.
inline bool is_later(const Clock& a, const Clock& b) {
  return a.instant_begin != b.instant_begin ? a.instant_begin > b.instant_begin
                                            : a.events_at_once > b.events_at_once;
}

/// A worker's tile: it plays one after the other. It plays free flight, and impacts of pucks, with
/// each other, walls, bats or posts, that concern no third body; it puts off all else.
class Tile {
 public:
  Tile(const Engine::Parts& engine, SharedWindow& shared, std::uint32_t number,
       std::uint32_t count);
  Tile(const Tile&) = delete;
  Tile& operator=(const Tile&) = delete;

  /// Nothing has been played of the window.
  void begin_window();
  /// The small ones of those who have an event in some cells, and the wide ones who stand there.
  struct Listed {
    std::span<const std::uint32_t> small, wide;
  };
  /// Plays the events of the small ones, all in `range`, and what they bring about. Who was put off
  /// in an earlier pass `can_be_late`.
  void play(const CellRange& range, const Listed& listed, bool can_be_late);
  /// Plays the event of `body`, which is the first of all that are left in the whole field, and
  /// tells the schedule; false, with nothing done, if that is not for a tile.
  bool play_first_of_all(std::uint32_t body);
  /// Notes that the event of `body` and, if it is one, `partner` is late, if it is, before it is
  /// processed by somebody else; and after that how they go on.
  bool mark(std::uint32_t body, Partner partner, Real time);
  void note_late(std::uint32_t body, Real time);
  /// Lists it where it is at `time`, before a crossing that came too early. False, with nothing
  /// done, if that cannot be done here.
  bool put_back(std::uint32_t body, Real time);
  /// Of the flight that a body has begun; who accelerates may be faster when the window ends.
  void note_speed(std::uint32_t body);
  /// Its next event, as if nothing were known, and tells the schedule.
  void predict(std::uint32_t body) {
    clock_.now = shared_.begin;  // before which nobody on a curve leaves a cell
    prediction_.predict(body);
  }

  /// Since begin_window().
  std::vector<std::uint32_t>& put_off() { return put_off_; }
  std::span<const std::uint32_t> wide_put_off() const { return wide_put_off_; }
  std::span<const std::uint32_t> awakened() const { return awakened_; }
  Courses& courses() { return courses_; }
  /// At the latest event since then.
  const Clock& clock() const { return is_later(clock_, latest_) ? clock_ : latest_; }
  EventRecord& record() { return record_; }
  const EventRecord& record() const { return record_; }
  /// With its books and charges, to which the last pass adds those of the engine's events.
  TileImpact& impact() { return impact_; }
  std::uint64_t at_once_max() const { return at_once_max_; }

 private:
  using Place = CellGrid::Place;

  /// An event of a body, its cell, and the other cell that the event concerns.
  struct Encounter {
    std::uint32_t body;
    Partner partner;
    Real time;
    bool crosses;
    Place from, to;
    bool is_with_wide = false;  // a partner that is
  };

  void fetch(std::span<const std::uint32_t> bodies);
  void fetch_all();
  void fetch(std::uint32_t body) const;
  Encounter encounter_of(std::uint32_t body, Real time) const;
  bool play_event(const Encounter& encounter);
  bool leaves_by(CellGrid::Direction direction, Real time, std::uint32_t body) const;
  bool cross(std::uint32_t body);
  void return_to(const Place& before, std::uint32_t body);
  bool collide(std::uint32_t body, std::uint32_t other, Real time);
  bool rebound(std::uint32_t body, Partner wall, Real time);
  bool settle_pair(std::uint32_t body, std::uint32_t other, Real time);
  void enter_impact(std::uint32_t body, const Flight& before, Real time);
  void publish(std::uint32_t body);
  /// And not wide.
  bool is_in_one_cell(const Place& place) const { return place.column < places_.grid().columns(); }
  bool is_impact(const Encounter& encounter) const;
  bool may_play(const Encounter& encounter) const;
  void put_off(const Encounter& encounter);
  void close_around_wide(const Encounter& encounter);
  bool play_wide(const Encounter& encounter);
  bool cross_wide(std::uint32_t body, Real time);
  bool play_near_wide(const Encounter& encounter);
  bool play_with_wide(const Encounter& encounter, std::uint32_t wide, std::uint32_t puck);
  bool strike(std::uint32_t body, std::uint32_t other, Real time);
  bool is_late(const CellBlock& cells, Real time);
  bool is_late(const Place& place, Real time) {
    return is_late({place.column, place.row, place.column, place.row}, time);
  }
  void mark_cell(const Place& place, Real time) {
    Real& played =
        shared_.played_at(place.column, place.row, static_cast<int>(places_.grid().columns()));
    played = std::max(played, time);
  }
  void mark_cells(const CellBlock& cells, Real time);

  SharedWindow& shared_;
  Bodies& bodies_;
  Places& places_;
  NextEvents& events_;
  Clock clock_, latest_;  // of this tile, and of the one that came furthest before
  EventRecord record_;
  std::uint64_t at_once_max_ = 0;
  Prediction prediction_;
  Courses courses_;
  TileImpact impact_;
  EventBins bins_;
  BlockedCells cells_;
  bool can_be_late_ = false, is_whole_ = false;
  std::vector<std::uint32_t> put_off_, wide_put_off_, awakened_, near_;
};

}  // namespace rink::physics::inline RINK_PRECISION
