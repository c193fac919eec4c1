// A tile's part of what is entered into the journal of whoever looks at the world
// (bodies/journal.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "game/physics/bodies/bodies.h"
#include "game/physics/bodies/journal.h"
#include "game/physics/bodies/observers.h"
#include "game/physics/bodies/partner.h"
#include "game/physics/events/event_order.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// Of one window. A body's room, which its own events alone end, is written where the journal has
/// it; all else waits here, for only the whole window has an order.
class TileJournal {
 public:
  /// An event, and what is entered of it: so many changes, and bodies that left their rooms by it,
  /// from the first of each.
  struct Entry {
    EventOrder order;
    std::uint32_t change = 0, entered = 0;
    std::uint16_t change_count = 0, entered_count = 0;
    bool is_quiet = false;
  };
  /// A simple impact of a body, and of another one that can move or `partner::none`.
  struct Meeting {
    EventOrder order;
    std::uint32_t body;
    Partner other;
    std::uint64_t mixed_digest;  ///< as Journal's
    bool is_free;                ///< of two pucks, in a world in which such are counted
  };

  explicit TileJournal(const Bodies& bodies) : bodies_(bodies) {}

  /// Nothing has been played. For these; nothing is kept for nobody.
  void begin_window(const Observers& observers);
  bool is_kept() const { return is_kept_; }
  /// As Journal's; 0 if nobody keeps one.
  std::uint64_t digest_of(std::uint32_t body, std::uint32_t count) const {
    return journal_ != nullptr ? journal_->digest_of(body, count) : 0;
  }
  /// After the impact.
  void note(const Meeting& meeting);
  /// Takes from the journal what the engine's event at this place has just entered, if anything.
  void take(const EventOrder& order);

  std::span<const Entry> entries() const { return entries_; }
  std::span<const Change> changes_of(const Entry& entry) const {
    return std::span(changes_).subspan(entry.change, entry.change_count);
  }
  std::span<const std::uint32_t> entered_by(const Entry& entry) const {
    return std::span(entered_).subspan(entry.entered, entry.entered_count);
  }
  const Motion& motion_of(const Change& change) const { return motions_[change.motion]; }
  /// Who changed otherwise than in a free impact; some more than once.
  std::span<const std::uint32_t> whole() const { return whole_; }

 private:
  void enter(std::uint32_t body, const Meeting& meeting);

  const Bodies& bodies_;
  Journal* journal_ = nullptr;
  bool is_kept_ = false;
  Journal::Mark mark_;  // of the journal, which stays as it was
  std::vector<Entry> entries_;
  std::vector<Change> changes_;
  std::vector<Motion> motions_;
  std::vector<std::uint32_t> entered_, whole_;
};

}  // namespace rink::physics::inline RINK_PRECISION
