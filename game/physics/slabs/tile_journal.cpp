// Entries as Engine and FreeImpact make them.
#include "game/physics/slabs/tile_journal.h"

#include <cassert>

#include "game/physics/bodies/change_entries.h"

namespace rink::physics::inline RINK_PRECISION {

void TileJournal::begin_window(const Observers& observers) {
  journal_ = observers.journal;
  is_kept_ = journal_ != nullptr || observers.before != nullptr;
  if (journal_ != nullptr) mark_ = journal_->mark();
  entries_.clear(), changes_.clear(), motions_.clear(), entered_.clear(), whole_.clear();
}

void TileJournal::note(const Meeting& meeting) {
  assert(is_kept_);
  const bool is_of_two = is_body(meeting.other);
  if (!meeting.is_free) {
    whole_.push_back(meeting.body);
    if (is_of_two) whole_.push_back(meeting.other);
  }
  if (journal_ == nullptr) return;
  const auto entry_of = [&](std::uint32_t body) { return Journal::Entry{body, bodies_[body], 0}; };
  entries_.push_back({.order = meeting.order,
                      .change = static_cast<std::uint32_t>(changes_.size()),
                      .entered = static_cast<std::uint32_t>(entered_.size())});
  Entry& entry = entries_.back();
  entry.is_quiet =
      meeting.is_free && journal_->is_quiet(entry_of(meeting.body), entry_of(meeting.other));
  if (entry.is_quiet) return;
  enter(meeting.body, meeting);
  if (is_of_two) enter(meeting.other, meeting);
}

void TileJournal::enter(std::uint32_t body, const Meeting& meeting) {
  const Body& b = bodies_[body];
  const std::uint32_t number = journal_->number_of(body);
  Entry& entry = entries_.back();
  if (std::uint8_t& room = journal_->rooms_of[body]; room != 0) {
    room = 0, entered_.push_back(number);
    ++entry.entered_count;
  }
  ++entry.change_count;
  const std::uint64_t conditions = conditions_of(bodies_, body) ^ meeting.mixed_digest;
  changes_.push_back(
      {meeting.order.time, b.x, b.y, b.vx, b.vy, b.time, conditions, number, 0, Change::straight});
  if (!b.is(Body::curved)) return;
  changes_.back().motion = static_cast<std::uint32_t>(motions_.size());
  motions_.push_back(bodies_.motion(body));
}

void TileJournal::take(const EventOrder& order) {
  if (journal_ == nullptr || journal_->times.size() == mark_.times) return;
  const Journal& from = *journal_;
  const std::span<const Change> changes = std::span(from.changes).subspan(mark_.changes);
  const auto entered = std::span(from.entered).subspan(mark_.entered);
  assert(from.times.size() == mark_.times + 1);  // of very many changes the window is undone
  entries_.push_back({.order = order,
                      .change = static_cast<std::uint32_t>(changes_.size()),
                      .entered = static_cast<std::uint32_t>(entered_.size()),
                      .change_count = static_cast<std::uint16_t>(changes.size()),
                      .entered_count = static_cast<std::uint16_t>(entered.size()),
                      .is_quiet = from.quiet_events > mark_.quiet_events});
  for (const Change& change : changes) {
    changes_.push_back(change);
    if (change.motion == Change::straight) continue;
    changes_.back().motion = static_cast<std::uint32_t>(motions_.size());
    motions_.push_back(from.motions[change.motion]);
  }
  entered_.insert(entered_.end(), entered.begin(), entered.end());
  journal_->go_back(mark_);
}

}  // namespace rink::physics::inline RINK_PRECISION
