// What becomes of a window that tiles have played: what they found is entered, or taken back.
#include <algorithm>
#include <cassert>
#include <utility>

#include "game/physics/bodies/impact_history.h"
#include "game/physics/bodies/jams.h"
#include "game/physics/engine/rest_contacts.h"
#include "game/physics/slabs/event_merge.h"
#include "game/physics/slabs/slabs.h"
#include "im/basics/sorted_set.h"

namespace rink::physics::inline RINK_PRECISION {

void Slabs::accept() {
  slab_counters().late += late_count();
  if (budget_ != nullptr) charge();
  take_clock();
  note_changes();
  add_counters();
  merge_events();
  enter_books();
  journal_.accept(all_tiles_, shared_, last_pass_->images());
  parts_.clock.arrive(shared_.end);
}

/// With all events at once, and who had the last of them. As the plain loop has it, none comes
/// before what had been played already.
void Slabs::charge() {
  std::vector<ChargedEvent>& events = last_pass_->tile().impact().charged();
  for (const auto& tile : tiles_) {
    const std::vector<ChargedEvent>& more = tile->impact().charged();
    events.insert(events.end(), more.begin(), more.end());
  }
  keep_latest(events);
  for (ChargedEvent& event : events) event.time = std::max(event.time, before_.clock.now);
  budget_->charge_together(shared_.end, events_played(), events);
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
  if (parts_.bodies.changes().lists_all(count)) return;
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
    sum.disc_impacts += part.disc_impacts, sum.wall_impacts += part.wall_impacts;
    sum.bat_impacts += part.bat_impacts, sum.post_impacts += part.post_impacts;
    sum.crossings += part.crossings, sum.stale_events += part.stale_events;
    sum.predictions += part.predictions;
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
    for (const Event& event : tile->record().events()) {
      const std::uint32_t body = event.body.index,
                          other = event.other ? event.other->index : partner::field_parts;
      merged.push_back({{event.time, std::min(body, other), std::max(body, other)}, event});
    }
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
  journal_.undo();
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
  last_pass_->solver_failed() ? engine_.rebuild_from_state() : look_anew();
}

/// Who had an event or was hit is listed where it was and looks around once more; what all others
/// expect holds again.
void Slabs::look_anew() {
  listed_.clear();
  lists_.add_due_to(listed_);
  for (Tile* tile : all_tiles_)
    for (const Courses::Replaced& r : tile->courses().replaced()) listed_.push_back(r.body);
  make_sorted_set(listed_);
  for (const std::uint32_t body : listed_) {
    parts_.places.remove(body);
    parts_.places.insert(body, position_at(parts_.bodies, body, shared_.begin),
                         extent_of(parts_.bodies, body));
  }
  WindowQueue& queue = *parts_.events.windows();
  queue.reopen(shared_.begin, shared_.end, {});  // or each event would be sorted in at once
  for (const std::uint32_t body : listed_) last_pass_->tile().predict(body);
  queue.reopen(shared_.begin, shared_.end, queue.listed());
}

}  // namespace rink::physics::inline RINK_PRECISION
