// Impacts that concern no third body, as a tile plays them: of two pucks, or of one with a wall, a
// bat or a post.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "game/physics/bodies/bodies.h"
#include "game/physics/bodies/body_records.h"
#include "game/physics/bodies/impact_history.h"
#include "game/physics/bodies/partner.h"
#include "game/physics/body.h"
#include "game/physics/engine/engine.h"
#include "game/physics/event_budget.h"
#include "game/physics/flight/straight_flight.h"
#include "game/physics/real.h"
#include "game/physics/slabs/books.h"
#include "game/physics/slabs/tile_journal.h"

namespace rink::physics::inline RINK_PRECISION {

/// The arithmetic of Impact without its questions, so the same bits.
class TileImpact {
 public:
  explicit TileImpact(const Engine::Parts& engine);
  TileImpact(const TileImpact&) = delete;
  TileImpact& operator=(const TileImpact&) = delete;

  /// Nothing has been played of the window. Lists impacts for a budget if it `is_charged`.
  void begin_window(bool is_charged);
  /// Restarts the flights of both. False, with nothing done, if they might come to rest on each
  /// other or hop, or if one of them is no free puck.
  bool bounce(std::uint32_t low, std::uint32_t high, Real time);
  /// Restarts the flight of one that hits a wall. False, with nothing done, if it might come to
  /// rest there, touches another wall as well or may be at the edge of a goal, or is no free puck.
  bool rebound(std::uint32_t body, Partner wall, Real time);
  /// Restarts the flights of a free puck and a bat, or of the puck at a post. False, with nothing
  /// done, if they might come to rest, if energy is lost or accounted for, or if one is not free.
  bool strike(std::uint32_t one, std::uint32_t two, Real time);
  /// Who was struck, in the order in which an event names them.
  std::uint32_t low() const { return low_; }
  Partner high() const { return high_; }
  /// Counts a strike that is settled as one of an instant.
  void count_meeting(Real instant_begin);
  /// As if the last of these had not been.
  void take_back();
  /// Enters in books, charges and history what it did.
  void settle(Real time);

  /// Of the last bounce(); low_before() also of a rebound():
  const Flight& low_before() const { return low_before_; }
  const Flight& high_before() const { return high_before_; }
  /// Whether their gap was a rounding, and no overlap or distance that is another's fault, and no
  /// wall was near.
  bool was_near() const { return was_near_; }

  /// What impacts took from the energy since begin_window(); others add to it.
  std::vector<BookEntry>& book() { return book_; }
  /// The impacts since then, if a budget wants them; others add to these, too.
  std::vector<ChargedEvent>& charged() { return charged_; }
  /// What the history said before an impact.
  struct Counted {
    std::uint32_t body;
    ImpactCounts before;
  };
  /// Since then, in the order in which they came here.
  std::span<const Counted> counted() const { return counted_; }
  /// What whoever looks at the world is told of impacts that are settled.
  TileJournal& journal() { return journal_; }
  /// Takes from the history what was entered there since begin_window().
  void undo();

 private:
  bool is_off_walls(const Body& body) const;
  bool is_off_walls(const RealVector& position, const RealVector& extent) const;
  bool may_strike(std::uint32_t body, std::uint32_t other) const;
  Flight flight_at(std::uint32_t body, Real time) const;
  bool is_clear_of_others(const Body& body, Partner wall, const RealVector& position) const;
  void keep_counts(std::uint32_t body);
  void count(std::uint32_t body, Real time);
  void enter_drag(std::uint32_t body, const Flight& before, const EventOrder& order);
  void enter(std::uint32_t body, const Flight& before, const EventOrder& order);
  void enter_in_journal(Real time);

  Bodies& bodies_;
  ImpactHistory& history_;
  const Field& field_;
  const RestitutionTable& restitution_;
  Real rest_speed_, puck_drag_;
  bool keeps_books_;
  std::uint32_t low_ = 0;
  Partner high_ = 0;  // or the wall
  Real given_back_ = 1.0;
  Flight low_before_{}, high_before_{};
  Gap gap_{};
  bool was_near_ = false, is_charged_ = false;
  std::vector<BookEntry> book_;
  std::vector<ChargedEvent> charged_;
  std::vector<Counted> counted_;
  TileJournal journal_;
};

}  // namespace rink::physics::inline RINK_PRECISION
