// Windows of time in which parts of the field are played apart, with the bits of one order for all.
//
// Dependence. A course is one flight of one body, from the event at s that set it until the event
// at e that replaces it. An event of A and B reads all courses in the 3 x 3 cells around both, a
// crossing those in three cells ahead. It writes the courses, cells and next events of A and B.
//
// In any order. Whoever comes into sight last, by a new course or a crossing, predicts the meeting
// from the two courses as they are. The result stays with one of the two, or an earlier event does.
// Prediction is a function of the two courses, symmetric to the bit, and knows no present; so two
// courses meet at the same bits whoever asks, and whenever.
//
// Right or wrong. Let each body's own events come in order of time, but for crossings that come
// before an impact of theirs does: where that is processed the body is put back to its cell. Then a
// window is right if no two of its courses meet while both last. Take the first event in which it
// differs from the plain loop; until then all courses are equal. An event that the plain loop lacks
// cannot be, for its two courses are there as well. One that the window lacks is a meeting of two
// courses that both last.
//
// Tiles. They play a window alone, one after the other. They put off what touches a cell at their
// edge or a blocked cell, and all but crossings, stale events and simple impacts: of two pucks in
// free flight, or of one with a wall, a bat or a post, not slow nor following each other closely,
// with no third body or wall within 1e-6 m, and no other impact of theirs within 1e-9 s. So whether
// an impact is alone at its instant, which the plain loop asks its whole queue, does not matter to
// what a tile plays; chains of bodies that touch and goals are left to the last pass. Putting off
// blocks the cells of the event's bodies for all, so that a body's events keep their order, and
// those within the block radius for impacts, which replace courses. Tiles shifted by half their
// size along both axes, then along one and along the other, play what was put off; the last pass
// knows no tiles and all kinds of events.
//
// Wide bodies, as long bats are, stand in many cells. Where a tile holds all of these, and none is
// blocked, it plays their events. Else they are left to the last pass; from the first one on, tiles
// replace no course in the cells where the wide one stands.
//
// Goals. Time stops at one, so a window ends before the first that is to be expected, and is
// undone where another comes.
//
// Threads. Each worker looks at a part of what is pending, plays tiles of its own part of the field
// first, and checks what came late there. Tiles of one pass have no cell in common, and a body's
// record, next event and place are written by the tile in whose cells it is; none comes to another
// tile, for crossings at edges are put off. An event reads cells and bodies next to its own, which
// are the tile's own. Of a partner elsewhere only the place is asked, which says that it is
// elsewhere whether it moves just then or not. So nothing depends on who plays which tile, nor
// when.
//
// Check. Within one tile and pass events come in order, so only what was put off can be late: a
// cell next to its own has seen a later event. Its courses, until their next events, are compared
// with all replaced courses that end after it, and with the present ones, for a crossing may have
// taken somebody out of sight too early. They belong to bodies that are listed within vT
// and a reach of it, v being the greatest speed in the window and T what is left of it. All
// have had a later event, so only cells that have seen one are searched. A crossing marks both its
// cells, so nobody has left the neighbourhood unseen. The block radius changes how much is put off
// and how often the check fails, never the result.
//
// Undo. Where the check fails, or the last pass did what depends on more than the bodies concerned
// (a joint impact, a hop, a rest contact, many events at one instant, an event that another of its
// instant brought about), what bodies were before is put back, and the window is played in order;
// once more by tiles, which block more or make windows shorter, where only the check failed. There,
// or where a goal came, those look anew who had an event or were hit; else all do.
//
// Books. What an event takes from the energy waits in a list, and is added to the sums in the order
// in which one loop would have, once the window is right.
//
// Journal. Who looks at the world (bodies/observers.h) is told nothing meanwhile. Each tile notes
// what its impacts would enter, and the last pass takes it from the engine. A right window enters
// all in order of times and ids, with the clock that one loop would have had, and what bodies were
// before; an undone one leaves no trace. Only the room of a body, which its own events alone end,
// is written at once. One more thing must be right: the plain loop also enters who touched the two
// of an impact and stayed as they were. Whoever is near is asked where it is now, so a late impact
// that somebody played further touched, or nearly, makes the window wrong, and what else it found
// of such is left out. Whether an impact of free pucks may go unentered is asked of their flights
// alone, for which way it takes depends on the whole queue. Pieces of one advance() count as one.
//
// Differences from the plain loop: counters of bookkeeping, and the most events at one instant,
// which is counted by tile.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "game/physics/bodies/before_images.h"
#include "game/physics/bodies/clock.h"
#include "game/physics/bodies/tolerances.h"
#include "game/physics/bodies/world_mark.h"
#include "game/physics/counters.h"
#include "game/physics/engine/engine.h"
#include "game/physics/event.h"
#include "game/physics/event_budget.h"
#include "game/physics/real.h"
#include "game/physics/slab_plan.h"
#include "game/physics/slabs/books.h"
#include "game/physics/slabs/last_pass.h"
#include "game/physics/slabs/pace.h"
#include "game/physics/slabs/tile.h"
#include "game/physics/slabs/tile_lists.h"
#include "game/physics/slabs/tile_shares.h"
#include "game/physics/slabs/tiling.h"
#include "game/physics/slabs/window_journal.h"
#include "game/physics/workers.h"

namespace rink::physics::inline RINK_PRECISION {

/// Plays an engine; what is no free flight by its plain loop.
class Slabs {
 public:
  Slabs(Engine& engine, const SlabPlan& plan);
  Slabs(const Slabs&) = delete;
  Slabs& operator=(const Slabs&) = delete;

  /// As Engine::advance(), with or without a budget. Windows that tiles play are within it.
  std::optional<Goal> advance(Real until, EventBudget* budget = nullptr);

 private:
  SlabCounters& slab_counters() { return parts_.record.counters().slabs; }
  bool may_divide() const;
  Real end_by_tiles(Real until);
  Real next_end(Real until) const;
  bool is_worth_dividing(Real end) const;
  std::optional<Goal> play(Real until);
  Real goal_by(Real end) const;
  std::optional<Goal> play_in_order(Real until);
  bool has_room(Real end, std::uint64_t events) const;
  std::uint64_t events_played() const;
  bool plays_by_tiles(Real end);
  bool play_window(Real end);
  bool was_worth_it() const;
  void begin_window(Real end);
  std::uint32_t tile_side() const;
  Workers* workers_for(std::size_t events) const;
  void play_passes();
  void play_tiles();
  void play_listed(const Tiling& tiling, bool can_be_late);
  void take_put_off();
  bool is_usual() const;
  bool has_missed_nothing() const;
  std::size_t late_count() const;
  void accept();
  void list_awakened();
  void charge();
  void take_clock();
  void note_changes();
  void add_counters();
  void merge_events();
  void enter_books();
  void undo();
  void look_anew();

  Engine& engine_;
  Engine::Parts parts_;
  SlabPlan plan_;
  EventBudget* budget_ = nullptr;  // while time advances, if there is one
  Books books_;
  WindowJournal journal_;
  SharedWindow shared_;
  std::vector<std::unique_ptr<Tile>> tiles_;  // one for each worker
  std::unique_ptr<LastPass> last_pass_;
  std::vector<Tile*> all_tiles_;        // that of the last pass, then the others
  TileLists lists_;                     // of a pass
  TileShares shares_;                   // in it
  std::vector<std::uint32_t> put_off_;  // by the pass before
  std::vector<std::uint32_t> listed_;   // by each step for itself
  std::uint32_t tile_side_ = 0;         // cells
  Pace pace_;                           // of windows
  Real goal_ = infinity;                // that a window has found
  WorldMark before_;                    // the window
  std::size_t events_before_ = 0;
};

}  // namespace rink::physics::inline RINK_PRECISION
