// An impact of two pucks that concerns no third body, as a tile plays it.
#pragma once

#include <cstdint>
#include <vector>

#include "game/physics/bodies/bodies.h"
#include "game/physics/bodies/impact_history.h"
#include "game/physics/body.h"
#include "game/physics/engine/engine.h"
#include "game/physics/flight/straight_flight.h"
#include "game/physics/real.h"
#include "game/physics/slabs/books.h"

namespace rink::physics::inline RINK_PRECISION {

/// The arithmetic of Impact without its questions, so the same bits.
class PairImpact {
 public:
  explicit PairImpact(const Engine::Parts& engine);
  PairImpact(const PairImpact&) = delete;
  PairImpact& operator=(const PairImpact&) = delete;

  /// Nothing has been played of the window.
  void begin_window();
  /// Restarts the flights of both. False, with nothing done, if they might come to rest on each
  /// other or hop, or if one of them is no free puck.
  bool bounce(std::uint32_t low, std::uint32_t high, Real time);
  /// As if bounce() had not been.
  void take_back();
  /// Enters in books and history what bounce() did.
  void settle(Real time);

  /// Of the last bounce():
  const Flight& low_before() const { return low_before_; }
  const Flight& high_before() const { return high_before_; }
  /// Whether their gap was a rounding, and no overlap or distance that is another's fault.
  bool was_near() const { return was_near_; }

  /// What impacts took from the energy since begin_window(); others add to it.
  std::vector<BookEntry>& book() { return book_; }
  /// Takes from the history what was entered there since begin_window().
  void undo();

 private:
  /// What the history said before an impact.
  struct Counted {
    std::uint32_t body, impacts;
    Real window_start;
  };

  void count(std::uint32_t body, Real time);
  void enter_drag(std::uint32_t body, const Flight& before, const EventOrder& order);
  void enter(std::uint32_t body, const Flight& before, const EventOrder& order);

  Bodies& bodies_;
  ImpactHistory& history_;
  const RestitutionTable& restitution_;
  Real rest_speed_, puck_drag_;
  bool keeps_books_;
  std::uint32_t low_ = 0, high_ = 0;
  Real given_back_ = 1.0;
  Flight low_before_{}, high_before_{};
  bool was_near_ = false;
  std::vector<BookEntry> book_;
  std::vector<Counted> counted_;
};

}  // namespace rink::physics::inline RINK_PRECISION
