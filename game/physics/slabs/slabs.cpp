// Passes over tiles, the check, and the way back.
#include "game/physics/slabs/slabs.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "game/physics/bodies/impact_history.h"
#include "game/physics/bodies/jams.h"
#include "game/physics/bodies/tolerances.h"
#include "game/physics/engine/rest_contacts.h"
#include "game/physics/flight/straight_flight.h"

namespace rink::physics::inline RINK_PRECISION {

namespace {
/// Half of Clock::endless_events: fewer in a tile, and no instant of the field comes to that many
/// but by chance.
constexpr std::uint64_t at_once_max = Clock::endless_events / 2;
}  // namespace

Slabs::Slabs(Engine& engine, const SlabPlan& plan)
    : engine_(engine), parts_(engine.parts()), plan_(plan) {
  assert(plan.tile_cells >= 4 && plan.window > 0.0);
}

std::optional<Goal> Slabs::advance(Real until) {
  const Clock& clock = parts_.clock;
  while (clock.now < until && is_in_free_flight()) {
    engine_.predict_pending();
    const Real now = clock.now, third = parts_.events.windows()->next_end(now) - now;
    const Real end = std::min(until, now + third * Real(plan_.window));
    if (!(end > now)) break;
    begin_window(end);
    if (play_window()) {
      accept();
      continue;
    }
    undo();
    if (auto goal = engine_.advance(end)) return goal;
  }
  return engine_.advance(until);
}

bool Slabs::is_in_free_flight() const {
  const WorldSpec& spec = parts_.spec;
  return parts_.bodies.count() >= plan_.bodies_min && parts_.bodies.curved_count() == 0 &&
         parts_.rests.rest_contacts().empty() && parts_.jams.table().frozen.empty() &&
         parts_.observers.before == nullptr && parts_.observers.journal == nullptr &&
         parts_.events.windows() != nullptr && counts_touching() && spec.puck_drag == 0.0 &&
         spec.puck_friction == 0.0 && !spec.surface_friction && !spec.accounts_energy &&
         !spec.allow_overlap && spec.field.goal_width == 0.0;
}

/// Who is put off and who is played on further should not meet before the window is over: where
/// cells are hardly wider than discs, those of two neighbours nearly touch.
int Slabs::block_radius() const {
  return Real(parts_.places.grid().side()) < 1.5 * 2.0 * parts_.places.reach() ? 2 : 1;
}

void Slabs::begin_window(Real end) {
  const std::uint32_t count = parts_.bodies.count();
  const CellGrid& grid = parts_.places.grid();
  if (shared_.latest.size() != count || !last_pass_) {
    shared_.latest.assign(count, {});
    tiles_.clear();
    tiles_.push_back(std::make_unique<Tile>(parts_, shared_, 0, 2));
    last_pass_ = std::make_unique<LastPass>(engine_, shared_, 1, 2);
    all_tiles_ = {&last_pass_->tile(), tiles_.front().get()};
  }
  const std::size_t cells = std::size_t{grid.columns()} * grid.rows();
  if (shared_.played.size() != cells) shared_.played.assign(cells, -1.0);
  ++shared_.number;
  shared_.begin = parts_.clock.now, shared_.end = end;
  shared_.block_radius = plan_.block_radius >= 0 ? plan_.block_radius : block_radius();
  clock_before_ = parts_.clock, counters_before_ = parts_.record.counters();
  events_before_ = parts_.record.events().size();
  jam_count_before_ = parts_.jams.table().count;
  put_off_.clear();
  const bool is_kept = parts_.record.is_kept();
  for (const auto& tile : tiles_) tile->begin_window();
  last_pass_->begin_window();
  for (Tile* tile : all_tiles_) tile->record().keep(is_kept);
}

/// False if it must be played in order.
bool Slabs::play_window() {
  ++slab_counters().windows;
  play_tiles();
  parts_.events.windows()->reopen(shared_.begin, shared_.end, put_off_);
  last_pass_->play();
  slab_counters().last_pass += last_pass_->played();
  return is_right();
}

void Slabs::play_tiles() {
  const int half = plan_.tile_cells / 2;
  std::vector<std::uint32_t> due;
  WindowQueue& queue = *parts_.events.windows();
  for (const std::uint32_t body : queue.listed())
    if (queue.entries()[body].time <= shared_.end) due.push_back(body);
  play_pass(0, 0, due, true);
  for (const auto& [columns, rows] :
       {std::pair(half, half), std::pair(half, 0), std::pair(0, half)}) {
    if (put_off_.empty()) return;
    due.swap(put_off_);
    play_pass(columns, rows, due, false);
  }
}

/// Tiles begin so many cells before the field does.
void Slabs::play_pass(int shift_columns, int shift_rows, std::span<const std::uint32_t> bodies,
                      bool is_first) {
  const CellGrid& grid = parts_.places.grid();
  const int side = plan_.tile_cells, columns = static_cast<int>(grid.columns()),
            rows = static_cast<int>(grid.rows());
  const int across = (columns + shift_columns + side - 1) / side,
            along = (rows + shift_rows + side - 1) / side;
  lists_.resize(std::max(lists_.size(), static_cast<std::size_t>(across * along)));
  for (auto& list : lists_) list.clear();
  const EventOrder* entries = parts_.events.windows()->entries();
  for (const std::uint32_t body : bodies) {
    if (!(entries[body].time <= shared_.end)) continue;
    assert(grid.is_listed(body));
    const int column = (grid.place(body).column + shift_columns) / side,
              row = (grid.place(body).row + shift_rows) / side;
    lists_[static_cast<std::size_t>(row * across + column)].push_back(body);
  }
  for (int row = 0; row < along; ++row)
    for (int column = 0; column < across; ++column) {
      const CellRange range{std::max(0, column * side - shift_columns),
                            std::max(0, row * side - shift_rows),
                            std::min(columns, (column + 1) * side - shift_columns),
                            std::min(rows, (row + 1) * side - shift_rows)};
      tiles_.front()->play(range, lists_[static_cast<std::size_t>(row * across + column)],
                           !is_first);
    }
  take_put_off();
}

void Slabs::take_put_off() {
  put_off_.clear();
  for (const auto& tile : tiles_) {
    put_off_.insert(put_off_.end(), tile->put_off().begin(), tile->put_off().end());
    tile->put_off().clear();
  }
  slab_counters().put_off += put_off_.size();
}

const Courses::Replaced& Slabs::course_at(std::uint32_t at) const {
  const auto workers = static_cast<std::uint32_t>(tiles_.size() + 1);
  const std::uint32_t worker = at % workers;
  Tile& tile = worker + 1 == workers ? last_pass_->tile() : *tiles_[worker];
  return tile.courses().replaced()[at / workers];
}

Real Slabs::greatest_speed() const {
  Real square = 0.0;
  for (Tile* tile : all_tiles_)
    for (const Courses::Replaced& r : tile->courses().replaced())
      square = std::max(square, r.flight.vx * r.flight.vx + r.flight.vy * r.flight.vy);
  return std::sqrt(square);
}

bool Slabs::is_right() const {
  if (last_pass_->solver_failed() || parts_.clock.events_at_once >= at_once_max) return false;
  Real speed = -1.0;
  for (Tile* tile : all_tiles_) {
    if (tile->at_once_max() >= at_once_max) return false;
    for (const Courses::Late& late : tile->courses().late()) {
      if (speed < 0.0) speed = greatest_speed();
      if (meets_replaced(late, speed)) return false;
    }
  }
  return true;
}

/// Whether its course meets one that is over now, while both lasted.
bool Slabs::meets_replaced(const Courses::Late& late, Real speed) const {
  const CellGrid& grid = parts_.places.grid();
  const auto radius = 2 + static_cast<std::uint32_t>(std::ceil(static_cast<double>(
                              speed * (shared_.end - late.from) / Real(grid.side()))));
  const std::uint32_t column = late.place.column, row = late.place.row;
  bool meets = false;
  grid.within({column - std::min(column, radius), row - std::min(row, radius), column + radius,
               row + radius},
              [&](std::uint32_t other) {
                if (meets || other == late.body || shared_.latest[other].window != shared_.number)
                  return;
                for (std::uint32_t at = shared_.latest[other].at; at != Courses::none;) {
                  const Courses::Replaced& r = course_at(at);
                  if (!(r.end > late.from)) return;
                  const Real end = std::min(r.end, late.until);
                  const auto time = disc_contact_time(late.flight, r.flight, end);
                  if (time && *time < end) meets = true;
                  at = r.earlier;
                }
              });
  return meets;
}

void Slabs::accept() {
  WindowQueue& queue = *parts_.events.windows();
  Clock& clock = parts_.clock;
  for (Tile* tile : all_tiles_) {
    for (const std::uint32_t body : tile->awakened()) queue.list(body);
    for (const Courses::Replaced& r : tile->courses().replaced())
      parts_.bodies.changes().note(r.body);
    slab_counters().late += tile->courses().late().size();
    if (tile->clock().instant_begin > clock.instant_begin) {
      clock.instant_begin = tile->clock().instant_begin;
      clock.events_at_once = tile->clock().events_at_once;
      clock.solver_failed = false;
    }
  }
  add_counters();
  merge_events();
  clock.arrive(shared_.end);
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
  struct Ordered {
    EventOrder order;
    Event event;
  };
  std::vector<Ordered> merged;
  const std::span<const Event> own = parts_.record.events().subspan(events_before_);
  for (std::size_t k = 0; k < own.size(); ++k)
    merged.push_back({last_pass_->orders()[events_before_ + k], own[k]});
  for (Tile* tile : all_tiles_)
    for (const Event& event : tile->record().events())
      merged.push_back({{event.time, event.body.index, event.other->index}, event});
  std::stable_sort(merged.begin(), merged.end(),
                   [](const Ordered& a, const Ordered& b) { return precedes(a.order, b.order); });
  std::vector<Event> events;
  events.reserve(merged.size());
  for (const Ordered& ordered : merged) events.push_back(ordered.event);
  parts_.record.replace_from(events_before_, events);
}

/// Back to where the window began.
void Slabs::undo() {
  for (const BeforeImages::KeptState& kept : last_pass_->images().states()) {
    BodyState state = kept.state;
    state.flight = parts_.bodies[kept.body];
    parts_.bodies.write(kept.body, state);
    parts_.history.write(kept.body, state);
    parts_.jams.write(kept.body, state);
  }
  for (Tile* tile : all_tiles_)
    for (const Courses::Replaced& r : tile->courses().replaced())
      if (r.earlier == Courses::none) parts_.bodies.take_back(r.body, r.flight, r.version);
  parts_.rests.restore({});
  parts_.jams.restore({}, jam_count_before_);
  parts_.clock = clock_before_;
  const SlabCounters slabs = slab_counters();
  parts_.record.counters() = counters_before_;
  slab_counters() = slabs;
  ++slab_counters().undone;
  parts_.record.replace_from(events_before_, {});
  parts_.bodies.forget_touched();
  engine_.rebuild_from_state();
}

}  // namespace rink::physics::inline RINK_PRECISION
