// What a window that tiles have played enters into the journal of whoever looks at the world, and
// what bodies were before.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "game/physics/bodies/before_images.h"
#include "game/physics/bodies/clock.h"
#include "game/physics/bodies/journal.h"
#include "game/physics/bodies/observers.h"
#include "game/physics/engine/engine.h"
#include "game/physics/events/event_order.h"
#include "game/physics/real.h"
#include "game/physics/slabs/event_merge.h"
#include "game/physics/slabs/tile.h"

namespace rink::physics::inline RINK_PRECISION {

/// Nobody is told of anything while tiles play, in whatever order. Once the window is right, all
/// that they have noted is entered in the order of times and ids, as the plain loop would have.
class WindowJournal {
 public:
  explicit WindowJournal(const Engine::Parts& parts) : parts_(parts) {}
  WindowJournal(const WindowJournal&) = delete;
  WindowJournal& operator=(const WindowJournal&) = delete;

  /// At the beginning of advance() up to later than now: the journal learns what it would from one
  /// loop, which the windows are not.
  void begin_advance();
  /// From here on nobody looks.
  void begin_window();
  /// They do again.
  void end_passes();

  /// After the last pass: puts the events of all tiles in order. False if so many came at one
  /// instant that the engine would have thought of other means.
  bool are_usual(std::span<Tile* const> tiles);
  /// Enters all, and sets the clock to the last of them.
  void accept(std::span<Tile* const> tiles, const SharedWindow& shared,
              const BeforeImages& last_pass);
  void undo();

  /// For the tiles: who looked when the window began.
  const Observers& observers() const { return observers_; }

 private:
  struct Place {
    EventOrder order;
    std::uint32_t tile, entry;
  };

  void enter(const TileJournal& part, const TileJournal::Entry& entry, std::uint64_t at_once);
  void grow_old();
  void keep_flights(std::span<Tile* const> tiles, const SharedWindow& shared);
  void keep_states(std::span<Tile* const> tiles, const BeforeImages& last_pass);
  void list_counts(std::span<Tile* const> tiles);

  Engine::Parts parts_;
  Observers observers_;
  Journal::Mark mark_;
  bool is_sure_ = true;  // whom each event found
  std::vector<std::uint8_t> rooms_before_;
  Clock clock_before_;
  InOrder<Place> places_;
  std::vector<const Flight*> flights_;       // by body, of those that have changed: at first
  std::vector<const ImpactCounts*> counts_;  // likewise, or null
  std::vector<std::uint32_t> whole_;         // who changed otherwise than in a free impact
};

}  // namespace rink::physics::inline RINK_PRECISION
