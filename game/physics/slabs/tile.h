// One part of the field that plays a window of time by itself.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "game/physics/bodies/bodies.h"
#include "game/physics/bodies/clock.h"
#include "game/physics/bodies/event_record.h"
#include "game/physics/engine/engine.h"
#include "game/physics/engine/prediction.h"
#include "game/physics/events/event_bins.h"
#include "game/physics/events/window_queue.h"
#include "game/physics/grid/cell_grid.h"
#include "game/physics/real.h"
#include "game/physics/slabs/courses.h"
#include "game/physics/slabs/pair_impact.h"

namespace rink::physics::inline RINK_PRECISION {

/// Columns and rows of cells, the end excluded.
struct CellRange {
  int first_column, first_row, end_column, end_row;

  std::uint32_t columns() const { return static_cast<std::uint32_t>(end_column - first_column); }
  std::uint32_t rows() const { return static_cast<std::uint32_t>(end_row - first_row); }
};

/// What all workers share. Different tiles never write the same body's, nor the same cell's.
struct SharedWindow {
  std::vector<Courses::Latest> latest;  ///< by body
  std::vector<Real> played;             ///< by cell: the latest event there
  std::uint32_t number = 0;
  Real begin = 0.0, end = 0.0;  ///< s, the end included
  int block_radius = 2;         ///< cells

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

/// A worker's tile: it plays one after the other. It plays free flight, and impacts of two pucks
/// that concern no third body; it puts off all else.
class Tile {
 public:
  Tile(const Engine::Parts& engine, SharedWindow& shared, std::uint32_t number,
       std::uint32_t count);
  Tile(const Tile&) = delete;
  Tile& operator=(const Tile&) = delete;

  /// Nothing has been played of the window.
  void begin_window();
  /// Plays the events of `bodies`, all in `range`, and what they bring about. Who was put off in an
  /// earlier pass `can_be_late`.
  void play(const CellRange& range, std::span<const std::uint32_t> bodies, bool can_be_late);
  /// Plays the event of `body`, which is the first of all that are left in the whole field, and
  /// tells the schedule; false, with nothing done, if that is not for a tile.
  bool play_first_of_all(std::uint32_t body);
  /// Notes that the event of `body` and, if it is one, `partner` is late, if it is, before it is
  /// processed by somebody else; and after that how they go on.
  bool mark(std::uint32_t body, Partner partner, Real time);
  void note_late(std::uint32_t body, Real time);
  bool put_back(std::uint32_t body, Real time);
  /// Its next event, as if nothing were known, and tells the schedule.
  void predict(std::uint32_t body) { prediction_.predict(body); }

  /// Since begin_window().
  std::vector<std::uint32_t>& put_off() { return put_off_; }
  std::span<const std::uint32_t> awakened() const { return awakened_; }
  Courses& courses() { return courses_; }
  /// At the latest event since then.
  const Clock& clock() const { return is_later(clock_, latest_) ? clock_ : latest_; }
  EventRecord& record() { return record_; }
  const EventRecord& record() const { return record_; }
  /// With its books, where the last pass adds what the engine's events took.
  PairImpact& impact() { return impact_; }
  std::uint64_t at_once_max() const { return at_once_max_; }

 private:
  using Place = CellGrid::Place;

  enum class Blocked : std::uint8_t { for_nobody, for_impacts, for_all };
  /// An event of a body, its cell, and the other cell that the event concerns.
  struct Encounter {
    std::uint32_t body;
    Partner partner;
    Real time;
    bool crosses;
    Place from, to;
  };

  void open(const CellRange& range);
  void close_edges(int width, Blocked blocked);
  void fetch(std::span<const std::uint32_t> bodies);
  void fetch_all();
  void fetch(std::uint32_t body) const;
  Encounter encounter_of(std::uint32_t body, Real time) const;
  bool play_event(const Encounter& encounter);
  bool cross(std::uint32_t body);
  bool collide(std::uint32_t body, std::uint32_t other, Real time);
  void publish(std::uint32_t body);
  Blocked blocked(const Place& place) const;
  bool is_impact(const Encounter& encounter) const;
  bool may_play(const Encounter& encounter) const;
  void put_off(const Encounter& encounter);
  void block(const CellRange& cells, Blocked whom);
  bool is_late(const Place& place, Real time);
  void mark_cell(const Place& place, Real time);

  SharedWindow& shared_;
  Bodies& bodies_;
  Places& places_;
  NextEvents& events_;
  Clock clock_, latest_;  // of this tile, and of the one that came furthest before
  EventRecord record_;
  std::uint64_t at_once_max_ = 0;
  Prediction prediction_;
  Courses courses_;
  PairImpact impact_;
  EventBins bins_;
  CellRange range_{};
  bool can_be_late_ = false, is_whole_ = false;
  std::vector<Blocked> blocked_;  // by cell of the range
  std::vector<std::uint32_t> put_off_, awakened_, near_;
};

}  // namespace rink::physics::inline RINK_PRECISION
