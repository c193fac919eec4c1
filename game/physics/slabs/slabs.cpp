// Passes over tiles, what becomes of a window, and the way back.
#include "game/physics/slabs/slabs.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "game/physics/bodies/tolerances.h"
#include "game/physics/slabs/next_goal.h"
#include "game/physics/slabs/window_check.h"

namespace rink::physics::inline RINK_PRECISION {

namespace {
/// Half of Clock::endless_events: fewer in a tile, and no instant of the field comes to that many
/// but by chance.
constexpr std::uint64_t at_once_max = Clock::endless_events / 2;
/// The shortest window, in units of that in which a third of the pending events come.
constexpr double least_window = 1.0 / 8.0;
/// How often an advance() that begins with few events looks whether there are more by now: a look
/// costs next to nothing, and a short advance() is to be as fast as without.
constexpr double looks_max = 16.0;

std::uint32_t worker_count(const SlabPlan& plan) {
  return plan.workers != nullptr ? plan.workers->count() : 1;
}
}  // namespace

Slabs::Slabs(Engine& engine, const SlabPlan& plan)
    : engine_(engine),
      parts_(engine.parts()),
      plan_(plan),
      books_(parts_.ledger),
      journal_(parts_),
      lists_(parts_.places.grid(), parts_.events, worker_count(plan)),
      shares_(worker_count(plan)) {
  assert(plan.tile_cells >= 4 && plan.block_radius >= 0 && plan.window > 0.0);
}

std::optional<Goal> Slabs::advance(Real until, EventBudget* budget) {
  budget_ = budget;
  const std::optional<Goal> goal = play(until);
  budget_ = nullptr;
  return goal;
}

std::optional<Goal> Slabs::play(Real until) {
  if (parts_.clock.now < until) journal_.begin_advance();
  const Real pause = (until - parts_.clock.now) / Real(looks_max);
  while (parts_.clock.now < until) {
    engine_.predict_pending();  // first: cells made anew may make bodies wide
    if (!may_divide()) break;
    const Real now = parts_.clock.now, end = end_by_tiles(until);
    Real end_in_order = now + pause > now ? std::min<Real>(until, now + pause) : until;
    if (end > now) {
      const Real goal = goal_by(end);
      const bool ends_early = goal <= end;
      if (plays_by_tiles(ends_early ? std::nextafter(goal, now) : end)) continue;
      end_in_order = ends_early ? std::min<Real>(until, goal + Real(instant)) : end;
    }
    if (auto scored = play_in_order(end_in_order)) return scored;
    if (budget_ != nullptr && budget_->is_exceeded()) return std::nullopt;
  }
  return play_in_order(until);
}

/// Of the next window, if there are events enough for one; else now.
Real Slabs::end_by_tiles(Real until) {
  if (parts_.spec.queue == QueuePolicy::calendar) parts_.events.choose(plan_.bodies_min / 2);
  if (parts_.events.windows() == nullptr) return parts_.clock.now;
  const Real end = next_end(until);
  return is_worth_dividing(end) ? end : parts_.clock.now;
}

/// When the first goal is to be expected, if it is by `end`.
Real Slabs::goal_by(Real end) const {
  const Real next = next_goal(parts_),
             first = goal_ > parts_.clock.now ? std::min(goal_, next) : next;
  return first <= end ? first : Real(infinity);
}

/// Whether it was possible up to `end`, or something was found that the next window ends before.
bool Slabs::plays_by_tiles(Real end) {
  // There are hardly more events in a window than bodies that wait for one.
  const bool is_free = has_room(end, parts_.events.windows()->listed().size());
  const bool has_played =
      !pace_.is_patient() && is_free && is_worth_dividing(end) && play_window(end);
  if (!has_played) pace_.note_in_order();
  return has_played;
}

/// Of one advance(), however many of these and of windows it takes.
std::optional<Goal> Slabs::play_in_order(Real until) {
  if (parts_.clock.now < until) parts_.clock.is_played = false;
  return engine_.advance(until, budget_);
}

/// Whether the budget, if there is one, has room for so many until `end`.
bool Slabs::has_room(Real end, std::uint64_t events) const {
  return budget_ == nullptr || budget_->has_room(end, events);
}

/// That a budget charges, in the window at hand.
std::uint64_t Slabs::events_played() const {
  std::uint64_t events = parts_.record.counters().recordable() - before_.counters.recordable();
  for (const Tile* tile : all_tiles_) events += tile->record().counters().recordable();
  return events;
}

/// Windows up to `until` are equally long: the plain loop would play what is left of too short a
/// one.
Real Slabs::next_end(Real until) const {
  const Real now = parts_.clock.now, third = parts_.events.windows()->next_end(now) - now,
             longest = third * Real(plan_.window * pace_.share()), left = until - now;
  return left > longest ? now + left / std::ceil(left / longest) : until;
}

/// Each window looks at all that have an event.
bool Slabs::is_worth_dividing(Real end) const {
  const WindowQueue& queue = *parts_.events.windows();
  const Real now = parts_.clock.now, third = queue.next_end(now) - now;
  return end > now && end - now >= third * Real(least_window) &&
         2 * queue.listed().size() >= plan_.bodies_min;
}

/// False, with nothing done, if it must be played in order. Nothing is done either where it has
/// found a goal, which the next one ends before; one that is due already is played in order.
bool Slabs::play_window(Real end) {
  begin_window(end);
  play_passes();
  const bool is_cut = last_pass_->goal() < infinity,
             is_usual = this->is_usual() && journal_.are_usual(all_tiles_),
             was_right = !is_cut && is_usual && has_missed_nothing(),
             is_accepted = was_right && has_room(end, events_played());
  if (is_cut) goal_ = last_pass_->goal();
  else if (was_right && !is_accepted) pace_.note_no_room();
  else pace_.note(was_right, was_right && was_worth_it());
  is_accepted ? accept() : undo();
  // One that has missed something misses less where more is blocked, or if it is shorter.
  const bool is_tried_again = is_cut      ? goal_ > shared_.begin
                              : was_right ? false
                                          : is_usual && !pace_.is_patient();
  return is_accepted || is_tried_again;
}

bool Slabs::was_worth_it() const {
  std::uint64_t events = last_pass_->played();
  for (const auto& tile : tiles_) {
    const Counters& part = tile->record().counters();
    events += part.impacts() + part.crossings + part.stale_events;
  }
  return static_cast<double>(last_pass_->played()) <=
         plan_.last_pass_max * static_cast<double>(events);
}

/// Whether pucks fly straight unless something presses them, and impacts may be simple.
bool Slabs::may_divide() const {
  const WorldSpec& spec = parts_.spec;
  return parts_.bodies.count() >= plan_.bodies_min && spec.queue != QueuePolicy::heap &&
         counts_touching() && spec.puck_friction == 0.0 && !spec.surface_friction &&
         !spec.allow_overlap;
}

void Slabs::begin_window(Real end) {
  const std::uint32_t count = parts_.bodies.count();
  const CellGrid& grid = parts_.places.grid();
  if (shared_.latest.size() != count) {
    shared_.latest.assign(count, {});
    const std::uint32_t workers = worker_count(plan_);
    last_pass_ = std::make_unique<LastPass>(engine_, shared_, workers, workers + 1);
    tiles_.clear();
    all_tiles_ = {&last_pass_->tile()};
    for (std::uint32_t worker = 0; worker < workers; ++worker) {
      tiles_.push_back(std::make_unique<Tile>(parts_, shared_, worker, workers + 1));
      all_tiles_.push_back(tiles_.back().get());
    }
  }
  const std::size_t cells = std::size_t{grid.columns()} * grid.rows();
  if (shared_.played.size() != cells) shared_.played.assign(cells, -1.0);
  tile_side_ = tile_side();
  ++shared_.number;
  shared_.begin = parts_.clock.now, shared_.end = end;
  shared_.block_radius = plan_.block_radius + (pace_.blocks_wider() ? 1 : 0);
  shared_.is_charged = budget_ != nullptr;
  before_ = engine_.mark();
  journal_.begin_window();
  shared_.observers = journal_.observers();
  books_.begin_window();
  events_before_ = parts_.record.events().size();
  const bool is_kept = parts_.record.is_kept();
  for (const auto& tile : tiles_) tile->begin_window();
  last_pass_->begin_window();
  for (Tile* tile : all_tiles_) tile->record().keep(is_kept);
}

/// The side that the plan says, changed so that tiles fill the longer side of the field: a narrow
/// last one would be all edge.
std::uint32_t Slabs::tile_side() const {
  const CellGrid& grid = parts_.places.grid();
  const auto planned = static_cast<std::uint32_t>(plan_.tile_cells);
  const std::uint32_t cells = std::max(grid.columns(), grid.rows()),
                      count = std::max(1u, (cells + planned / 2) / planned);
  return std::max(4u, (cells + count - 1) / count);
}

void Slabs::play_passes() {
  ++slab_counters().windows;
  play_tiles();
  list_awakened();  // or the queue would go on without them
  parts_.events.windows()->reopen(shared_.begin, shared_.end, put_off_);
  last_pass_->play();
  journal_.end_passes();
  slab_counters().last_pass += last_pass_->played();
}

/// Those who play so many events at once; null where one is enough.
Workers* Slabs::workers_for(std::size_t events) const {
  return tiles_.size() > 1 && events >= plan_.shared_min ? plan_.workers : nullptr;
}

void Slabs::play_tiles() {
  using Shift = Tiling::Shift;
  const CellGrid& grid = parts_.places.grid();
  const std::uint32_t half = tile_side_ / 2;
  const Tiling first(grid, tile_side_, {});
  lists_.list_due(first, shared_.end, workers_for(parts_.events.windows()->listed().size()));
  play_listed(first, false);
  for (const Shift shift : {Shift{half, half}, Shift{half, 0}, Shift{0, half}}) {
    if (put_off_.empty()) break;
    const Tiling shifted(grid, tile_side_, shift);
    lists_.list(shifted, put_off_, shared_.end);
    play_listed(shifted, true);
  }
  put_off_.insert(put_off_.end(), lists_.wide().begin(), lists_.wide().end());
}

void Slabs::play_listed(const Tiling& tiling, bool can_be_late) {
  auto play = [&](std::uint32_t worker) {
    while (const auto tile = shares_.next(worker))
      tiles_[worker]->play(tiling.cells_of(*tile),
                           {lists_.in(*tile, worker), lists_.wide_in(*tile)}, can_be_late);
  };
  shares_.begin(tiling.count());
  if (Workers* const workers = workers_for(lists_.count())) run_on(*workers, play);
  else play(0);
  take_put_off();
}

void Slabs::take_put_off() {
  put_off_.clear();
  for (const auto& tile : tiles_) {
    put_off_.insert(put_off_.end(), tile->put_off().begin(), tile->put_off().end());
    tile->put_off().clear();
    if (!tile->wide_put_off().empty()) lists_.add_wide(tile->wide_put_off());
  }
  slab_counters().put_off += put_off_.size();
}

/// Whether nothing came of which only the order of the whole field can tell what it does.
bool Slabs::is_usual() const {
  const auto has_too_many = [](const Tile* tile) { return tile->at_once_max() >= at_once_max; };
  return !last_pass_->solver_failed() && parts_.clock.events_at_once < at_once_max &&
         std::ranges::none_of(all_tiles_, has_too_many);
}

bool Slabs::has_missed_nothing() const {
  return WindowCheck(parts_, shared_, all_tiles_).is_right(workers_for(late_count()));
}

std::size_t Slabs::late_count() const {
  std::size_t sum = 0;
  for (Tile* tile : all_tiles_) sum += tile->courses().late().size();
  return sum;
}

}  // namespace rink::physics::inline RINK_PRECISION
