// What the events of several tiles took from the energy, entered as one loop would have entered it.
#pragma once

#include <span>

#include "game/physics/bodies/energy_ledger.h"
#include "game/physics/events/event_order.h"
#include "game/physics/real.h"
#include "game/physics/slabs/event_merge.h"

namespace rink::physics::inline RINK_PRECISION {

/// A transfer, and the place of its event in the order of time and bodies.
struct BookEntry {
  EventOrder order;
  EnergyTransfer transfer;
};

/// The books of a window: nothing is entered before the window is known to be right.
class Books {
 public:
  explicit Books(EnergyLedger& ledger) : ledger_(ledger), before_(ledger) {}
  Books(const Books&) = delete;
  Books& operator=(const Books&) = delete;

  bool are_kept() const { return ledger_.is_kept(); }
  void begin_window() {
    before_ = ledger_;
    entries_.clear();
  }
  /// One worker's; those of one event stand in the order in which it took them.
  void add(std::span<const BookEntry> entries) { entries_.add(entries); }
  /// Spends all that was added since begin_window(), in the order of their events.
  void enter();
  /// Back to begin_window().
  void undo() { ledger_ = before_; }

 private:
  EnergyLedger& ledger_;
  EnergyLedger before_;
  InOrder<BookEntry> entries_;
};

}  // namespace rink::physics::inline RINK_PRECISION
