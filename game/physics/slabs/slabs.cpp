// Passes over tiles, what becomes of a window, and the way back.
#include "game/physics/slabs/slabs.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <utility>

#include "game/physics/bodies/impact_history.h"
#include "game/physics/bodies/jams.h"
#include "game/physics/engine/rest_contacts.h"
#include "game/physics/slabs/event_merge.h"
#include "game/physics/slabs/window_check.h"

namespace rink::physics::inline RINK_PRECISION {

namespace {
/// Half of Clock::endless_events: fewer in a tile, and no instant of the field comes to that many
/// but by chance.
constexpr std::uint64_t at_once_max = Clock::endless_events / 2;
/// The shortest window, in units of that in which a third of the pending events come.
constexpr double least_window = 1.0 / 8.0;
/// Where a window had to be undone, so many after it block a cell more around what is put off.
/// Where one of these has to be undone, windows get shorter by that, and else longer; not below
/// that part of what the plan says.
constexpr std::uint32_t wider_windows = 256;
constexpr double shorter = 0.8, longer = 1.01, least_share = 0.125;
}  // namespace

Slabs::Slabs(Engine& engine, const SlabPlan& plan)
    : engine_(engine), parts_(engine.parts()), plan_(plan), books_(parts_.ledger) {
  assert(plan.tile_cells >= 4 && plan.block_radius >= 0 && plan.window > 0.0);
}

std::optional<Goal> Slabs::advance(Real until, EventBudget* budget) {
  budget_ = budget;
  const std::optional<Goal> goal = play(until);
  budget_ = nullptr;
  return goal;
}

std::optional<Goal> Slabs::play(Real until) {
  if (may_divide() && parts_.events.windows() == nullptr) {
    parts_.events.keep_by(QueuePolicy::windows);
    engine_.rebuild_from_state();
  }
  while (parts_.clock.now < until) {
    engine_.predict_pending();  // first: cells made anew may make bodies wide
    if (!may_divide()) break;
    const Real end = next_end(until);
    if (!is_worth_dividing(end)) break;
    // There are hardly more events in a window than bodies that wait for one.
    const bool is_free = has_room(end, parts_.events.windows()->listed().size());
    if (in_order_ == 0 && is_free && play_window(end)) continue;
    if (in_order_ > 0) --in_order_;
    if (auto goal = play_in_order(end)) return goal;
    if (budget_ != nullptr && budget_->is_exceeded()) return std::nullopt;
  }
  return play_in_order(until);
}

std::optional<Goal> Slabs::play_in_order(Real until) { return engine_.advance(until, budget_); }

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
             longest = third * Real(plan_.window * share_), left = until - now;
  return left > longest ? now + left / std::ceil(left / longest) : until;
}

/// Each window looks at all that have an event.
bool Slabs::is_worth_dividing(Real end) const {
  const WindowQueue& queue = *parts_.events.windows();
  const Real now = parts_.clock.now, third = queue.next_end(now) - now;
  return end > now && end - now >= third * Real(least_window) &&
         2 * queue.listed().size() >= plan_.bodies_min;
}

/// False, with nothing done, if it must be played in order.
bool Slabs::play_window(Real end) {
  begin_window(end);
  play_passes();
  const bool was_right = is_right() && has_room(end, events_played());
  be_patient(was_right && was_worth_it());
  adapt(was_right);
  was_right ? accept() : undo();
  return was_right;
}

bool Slabs::was_worth_it() const {
  std::uint64_t events = last_pass_->played();
  for (const auto& tile : tiles_) {
    const Counters& part = tile->record().counters();
    events += part.disc_impacts + part.crossings + part.stale_events;
  }
  return static_cast<double>(last_pass_->played()) <=
         plan_.last_pass_max * static_cast<double>(events);
}

/// To few windows that have to be undone, and few events put off.
void Slabs::adapt(bool was_right) {
  if (was_right) {
    share_ = std::min(1.0, share_ * longer);
    wider_ -= std::min(wider_, 1u);
  } else if (wider_ == 0) {
    wider_ = wider_windows;
  } else {
    share_ = std::max(least_share, share_ * shorter);
  }
}

/// Where tiles are of no use it should cost little to find out.
void Slabs::be_patient(bool was_good) {
  constexpr std::uint32_t in_order_max = 64;
  in_order_last_ = was_good ? 0 : std::min(in_order_max, 2 * in_order_last_ + 1);
  in_order_ = in_order_last_ / 2;
}

/// Whether pucks fly straight unless something presses them, and impacts may be simple.
bool Slabs::may_divide() const {
  const WorldSpec& spec = parts_.spec;
  return parts_.bodies.count() >= plan_.bodies_min && parts_.observers.before == nullptr &&
         parts_.observers.journal == nullptr && spec.queue != QueuePolicy::heap &&
         counts_touching() && spec.puck_friction == 0.0 && !spec.surface_friction &&
         !spec.allow_overlap && !parts_.places.grid().wide().has([&](std::uint32_t body) {
           return !parts_.bodies.is_fixed(body);
         });
}

void Slabs::begin_window(Real end) {
  const std::uint32_t count = parts_.bodies.count();
  const CellGrid& grid = parts_.places.grid();
  if (shared_.latest.size() != count) {
    shared_.latest.assign(count, {});
    const std::uint32_t workers = plan_.workers != nullptr ? plan_.workers->count() : 1;
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
  shared_.block_radius = plan_.block_radius + (wider_ > 0 ? 1 : 0);
  before_ = engine_.mark();
  books_.begin_window();
  events_before_ = parts_.record.events().size();
  put_off_.clear();
  const bool is_kept = parts_.record.is_kept();
  for (const auto& tile : tiles_) tile->begin_window();
  last_pass_->begin_window();
  for (Tile* tile : all_tiles_) tile->record().keep(is_kept);
}

/// The side that the plan says, changed so that tiles fill the longer side of the field: a narrow
/// last one would be all edge.
int Slabs::tile_side() const {
  const CellGrid& grid = parts_.places.grid();
  const int cells = static_cast<int>(std::max(grid.columns(), grid.rows())),
            count = std::max(1, (cells + plan_.tile_cells / 2) / plan_.tile_cells);
  return std::max(4, (cells + count - 1) / count);
}

void Slabs::play_passes() {
  ++slab_counters().windows;
  play_tiles();
  list_awakened();  // or the queue would go on without them
  parts_.events.windows()->reopen(shared_.begin, shared_.end, put_off_);
  last_pass_->play();
  slab_counters().last_pass += last_pass_->played();
}

void Slabs::play_tiles() {
  const int half = tile_side_ / 2;
  due_.clear();
  WindowQueue& queue = *parts_.events.windows();
  for (const std::uint32_t body : queue.listed())
    if (queue.entries()[body].time <= shared_.end) due_.push_back(body);
  play_pass({0, 0, true}, due_);
  for (const Pass& pass : {Pass{half, half, false}, Pass{half, 0, false}, Pass{0, half, false}}) {
    if (put_off_.empty()) return;
    listed_.swap(put_off_);
    play_pass(pass, listed_);
  }
}

void Slabs::play_pass(const Pass& shifted, std::span<const std::uint32_t> bodies) {
  const CellGrid& grid = parts_.places.grid();
  Pass pass = shifted;
  const auto tiles = [side = tile_side_](std::uint32_t cells, int shift) {
    return (static_cast<int>(cells) + shift + side - 1) / side;
  };
  pass.across = tiles(grid.columns(), pass.shift_columns);
  pass.along = tiles(grid.rows(), pass.shift_rows);
  list_by_tile(pass, bodies);
  const auto count = static_cast<std::uint32_t>(pass.across * pass.along);
  if (tiles_.size() == 1 || bodies.size() < plan_.shared_min) {
    for (std::uint32_t number = 0; number < count; ++number)
      play_listed(pass, *tiles_.front(), number);
  } else {
    std::atomic<std::uint32_t> next = 0;
    auto play = [&](std::uint32_t worker) {
      for (std::uint32_t number = next++; number < count; number = next++)
        play_listed(pass, *tiles_[worker], number);
    };
    run_on(*plan_.workers, play);
  }
  take_put_off();
}

void Slabs::list_by_tile(const Pass& pass, std::span<const std::uint32_t> bodies) {
  const CellGrid& grid = parts_.places.grid();
  const int side = tile_side_;
  lists_.resize(std::max(lists_.size(), static_cast<std::size_t>(pass.across * pass.along)));
  for (auto& list : lists_) list.clear();
  const EventOrder* entries = parts_.events.windows()->entries();
  for (const std::uint32_t body : bodies) {
    if (!(entries[body].time <= shared_.end)) continue;
    assert(grid.is_listed(body));
    const int column = (grid.place(body).column + pass.shift_columns) / side,
              row = (grid.place(body).row + pass.shift_rows) / side;
    lists_[static_cast<std::size_t>(row * pass.across + column)].push_back(body);
  }
}

/// By `tile`, the tile of that number.
void Slabs::play_listed(const Pass& pass, Tile& tile, std::uint32_t number) {
  const CellGrid& grid = parts_.places.grid();
  const int side = tile_side_, columns = static_cast<int>(grid.columns()),
            rows = static_cast<int>(grid.rows());
  const int column = static_cast<int>(number) % pass.across * side - pass.shift_columns,
            row = static_cast<int>(number) / pass.across * side - pass.shift_rows;
  tile.play({std::max(0, column), std::max(0, row), std::min(columns, column + side),
             std::min(rows, row + side)},
            lists_[number], !pass.is_first);
}

void Slabs::take_put_off() {
  put_off_.clear();
  for (const auto& tile : tiles_) {
    put_off_.insert(put_off_.end(), tile->put_off().begin(), tile->put_off().end());
    tile->put_off().clear();
  }
  slab_counters().put_off += put_off_.size();
}

bool Slabs::is_right() const {
  const auto has_too_many = [](const Tile* tile) { return tile->at_once_max() >= at_once_max; };
  return !last_pass_->solver_failed() && parts_.clock.events_at_once < at_once_max &&
         std::ranges::none_of(all_tiles_, has_too_many) &&
         WindowCheck(parts_, shared_, all_tiles_).is_right();
}

void Slabs::accept() {
  for (Tile* tile : all_tiles_) slab_counters().late += tile->courses().late().size();
  if (budget_ != nullptr) budget_->charge_unseen(shared_.end, events_played());
  take_clock();
  note_changes();
  add_counters();
  merge_events();
  enter_books();
  parts_.clock.arrive(shared_.end);
}

/// In order of their ids, whoever awakened them: the queue chooses the next window by its list.
void Slabs::list_awakened() {
  listed_.clear();
  for (Tile* tile : all_tiles_)
    listed_.insert(listed_.end(), tile->awakened().begin(), tile->awakened().end());
  std::sort(listed_.begin(), listed_.end());
  for (const std::uint32_t body : listed_) parts_.events.windows()->list(body);
}

/// Of the latest event of all.
void Slabs::take_clock() {
  Clock& clock = parts_.clock;
  for (Tile* tile : all_tiles_) {
    const Clock& own = tile->clock();
    if (!is_later(own, clock)) continue;
    if (own.instant_begin > clock.instant_begin) clock.solver_failed = false;
    clock.instant_begin = own.instant_begin, clock.events_at_once = own.events_at_once;
  }
}

/// In order of their ids, whoever changed them. Where many changed, to look at all is cheaper than
/// to sort.
void Slabs::note_changes() {
  const std::uint32_t count = parts_.bodies.count();
  std::size_t replaced = 0;
  for (Tile* tile : all_tiles_) replaced += tile->courses().replaced().size();
  if (32 * replaced > count) {
    for (std::uint32_t body = 0; body < count; ++body)
      if (shared_.latest[body].window == shared_.number) parts_.bodies.changes().note(body);
    return;
  }
  listed_.clear();
  for (Tile* tile : all_tiles_)
    for (const Courses::Replaced& r : tile->courses().replaced()) listed_.push_back(r.body);
  std::sort(listed_.begin(), listed_.end());
  for (const std::uint32_t body : listed_) parts_.bodies.changes().note(body);
}

void Slabs::add_counters() {
  Counters& sum = parts_.record.counters();
  for (Tile* tile : all_tiles_) {
    const Counters& part = tile->record().counters();
    sum.disc_impacts += part.disc_impacts, sum.crossings += part.crossings;
    sum.stale_events += part.stale_events, sum.predictions += part.predictions;
    sum.evaluations += part.evaluations, sum.bodies_touched += part.bodies_touched;
    sum.events_at_once_max = std::max(sum.events_at_once_max, tile->at_once_max());
  }
}

/// In the order in which one loop would have written them.
void Slabs::merge_events() {
  if (!parts_.record.is_kept()) return;
  std::vector<OrderedEvent> merged;
  const std::span<const Event> own = parts_.record.events().subspan(events_before_);
  for (std::size_t k = 0; k < own.size(); ++k)
    merged.push_back({last_pass_->orders()[events_before_ + k], own[k]});
  for (Tile* tile : all_tiles_)
    for (const Event& event : tile->record().events())
      merged.push_back({{event.time, event.body.index, event.other->index}, event});
  parts_.record.replace_from(events_before_, in_order(std::move(merged)));
}

void Slabs::enter_books() {
  if (!books_.are_kept()) return;
  for (Tile* tile : all_tiles_) books_.add(tile->impact().book());
  books_.enter();
}

/// Back to where the window began.
void Slabs::undo() {
  books_.undo();
  for (const BeforeImages::KeptState& kept : last_pass_->images().states()) {
    BodyState state = kept.state;
    state.flight = parts_.bodies[kept.body];
    parts_.bodies.write(kept.body, state);
    parts_.history.write(kept.body, state);
    parts_.jams.write(kept.body, state);
  }
  for (Tile* tile : all_tiles_) tile->impact().undo();
  for (Tile* tile : all_tiles_)
    for (const Courses::Replaced& r : tile->courses().replaced())
      if (r.earlier == Courses::none) parts_.bodies.take_back(r.body, r.flight, r.version);
  parts_.rests.restore(before_.rest_contacts);
  parts_.jams.restore(before_.frozen, before_.jam_count);
  parts_.clock = before_.clock;
  const SlabCounters slabs = slab_counters();
  parts_.record.counters() = before_.counters;
  slab_counters() = slabs;
  ++slab_counters().undone;
  parts_.record.replace_from(events_before_, {});
  parts_.bodies.forget_touched();
  const bool is_all_in_flight = parts_.bodies.curved_count() == 0 && !last_pass_->solver_failed();
  is_all_in_flight ? look_anew() : engine_.rebuild_from_state();
}

/// Who had an event or was hit is listed where it was and looks around once more; what all others
/// expect holds again.
void Slabs::look_anew() {
  listed_ = due_;
  for (Tile* tile : all_tiles_)
    for (const Courses::Replaced& r : tile->courses().replaced()) listed_.push_back(r.body);
  std::sort(listed_.begin(), listed_.end());
  listed_.erase(std::unique(listed_.begin(), listed_.end()), listed_.end());
  for (const std::uint32_t body : listed_) {
    parts_.places.remove(body);
    parts_.places.insert(body, position_at(parts_.bodies, body, shared_.begin));
  }
  WindowQueue& queue = *parts_.events.windows();
  queue.reopen(shared_.begin, shared_.end, {});  // or each event would be sorted in at once
  for (const std::uint32_t body : listed_) last_pass_->tile().predict(body);
  queue.reopen(shared_.begin, shared_.end, queue.listed());
}

}  // namespace rink::physics::inline RINK_PRECISION
