// One list of events from those of all tiles.
#include "game/physics/slabs/window_journal.h"

#include <algorithm>
#include <cassert>
#include <tuple>
#include <utility>

#include "game/physics/bodies/impact_history.h"
#include "game/physics/slabs/courses.h"
#include "im/basics/sorted_set.h"

namespace rink::physics::inline RINK_PRECISION {

void WindowJournal::begin_advance() {
  if (parts_.observers.journal != nullptr && parts_.clock.is_played)
    parts_.observers.journal->played = parts_.clock.now;
}

void WindowJournal::begin_window() {
  observers_ = std::exchange(parts_.observers, {});
  if (observers_.journal == nullptr) return;
  mark_ = observers_.journal->mark();
  rooms_before_ = observers_.journal->rooms_of;
  clock_before_ = parts_.clock;
  observers_.journal->parts = Journal::Parts::sure;
}

void WindowJournal::end_passes() {
  parts_.observers = observers_;
  if (observers_.journal == nullptr) return;
  is_sure_ = observers_.journal->parts == Journal::Parts::sure;
  observers_.journal->parts = Journal::Parts::none;
}

bool WindowJournal::are_usual(std::span<Tile* const> tiles) {
  places_.clear();
  if (observers_.journal == nullptr) return true;
  if (!is_sure_) return false;
  for (std::uint32_t tile = 0; tile < tiles.size(); ++tile) {
    const auto entries = tiles[tile]->impact().journal().entries();
    for (std::uint32_t k = 0; k < entries.size(); ++k) places_.add({entries[k].order, tile, k});
  }
  Clock clock = clock_before_;
  return std::ranges::none_of(places_.sort(), [&](const Place& place) {
    clock.count_event(place.order.time);
    return clock.is_endless();
  });
}

void WindowJournal::accept(std::span<Tile* const> tiles, const SharedWindow& shared,
                           const BeforeImages& last_pass) {
  if (observers_.before != nullptr) keep_flights(tiles, shared), keep_states(tiles, last_pass);
  if (observers_.journal == nullptr) return;
  Clock clock = clock_before_;
  for (const Place& place : places_.sorted()) {
    const TileJournal& part = tiles[place.tile]->impact().journal();
    clock.count_event(place.order.time);
    enter(part, part.entries()[place.entry], clock.events_at_once);
  }
  grow_old();
  parts_.clock.instant_begin = clock.instant_begin;
  parts_.clock.events_at_once = clock.events_at_once;
  parts_.clock.solver_failed = clock.solver_failed;
  Counters& counters = parts_.record.counters();
  counters.events_at_once_max =
      std::max(counters.events_at_once_max, observers_.journal->at_once_max);
}

/// An age says who has come at the last instant that has been played.
void WindowJournal::grow_old() {
  const std::span<const Place> places = places_.sorted();
  if (places.empty()) return;
  auto first = places.end();
  while (first != places.begin() && (first - 1)->order.time == places.back().order.time) --first;
  for (; first != places.end(); ++first)
    observers_.journal->begin_event(first->order.time, first->order.lower, first->order.higher);
}

void WindowJournal::enter(const TileJournal& part, const TileJournal::Entry& entry,
                          std::uint64_t at_once) {
  Journal& journal = *observers_.journal;
  journal.count_event(entry.order.time, at_once);
  for (const Change& change : part.changes_of(entry)) {
    journal.changes.push_back(change);
    journal.changes.back().event = journal.event;
    if (change.motion == Change::straight) continue;
    journal.changes.back().motion = static_cast<std::uint32_t>(journal.motions.size());
    journal.motions.push_back(part.motion_of(change));
  }
  const auto entered = part.entered_by(entry);
  journal.entered.insert(journal.entered.end(), entered.begin(), entered.end());
  journal.quiet_events += entry.is_quiet;
  ++journal.event;
}

/// In order of their ids, for which worker has which tile is chance.
void WindowJournal::keep_flights(std::span<Tile* const> tiles, const SharedWindow& shared) {
  const std::uint32_t count = parts_.bodies.count();
  flights_.resize(count);
  for (Tile* tile : tiles)
    for (const Courses::Replaced& r : tile->courses().replaced())
      if (r.earlier == Courses::none) flights_[r.body] = &r.flight;
  for (std::uint32_t body = 0; body < count; ++body)
    if (shared.latest[body].window == shared.number)
      observers_.before->keep_flight(body, *flights_[body]);
}

/// What tiles do changes flights and counts of impacts; all else is as the last pass found it, or
/// as it still is.
void WindowJournal::keep_states(std::span<Tile* const> tiles, const BeforeImages& last_pass) {
  whole_.clear();
  for (const BeforeImages::KeptState& kept : last_pass.states()) whole_.push_back(kept.body);
  for (Tile* tile : tiles) {
    const auto more = tile->impact().journal().whole();
    whole_.insert(whole_.end(), more.begin(), more.end());
  }
  if (whole_.empty()) return;
  make_sorted_set(whole_);
  list_counts(tiles);
  for (const std::uint32_t body : whole_) {
    const bool was_kept = last_pass.has_changed(body) && !last_pass.has_flown_freely(body);
    BodyState state = was_kept ? last_pass.state(body)
                               : state_of(body, parts_.bodies, parts_.history, parts_.jams);
    state.flight = *flights_[body];
    const ImpactCounts* const counts = std::exchange(counts_[body], nullptr);
    if (counts != nullptr && std::tie(counts->window_start, counts->impacts) <
                                 std::tie(state.impacts_begin, state.impacts))
      state.impacts_begin = counts->window_start, state.impacts = counts->impacts;
    observers_.before->keep_state(body, state);
  }
}

/// The first of each body, which tells of the least, as ImpactHistory::take_back() has it.
void WindowJournal::list_counts(std::span<Tile* const> tiles) {
  counts_.resize(parts_.bodies.count(), nullptr);
  for (Tile* tile : tiles)
    for (const TileImpact::Counted& counted : tile->impact().counted()) {
      const ImpactCounts*& first = counts_[counted.body];
      if (first == nullptr || std::tie(counted.before.window_start, counted.before.impacts) <
                                  std::tie(first->window_start, first->impacts))
        first = &counted.before;
    }
}

/// Before anything else is.
void WindowJournal::undo() {
  if (observers_.journal == nullptr) return;
  observers_.journal->go_back(mark_);
  observers_.journal->rooms_of = rooms_before_;
}

}  // namespace rink::physics::inline RINK_PRECISION
