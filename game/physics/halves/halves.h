// How long each puck may stay in its half of the field: the rule of possession (docs/play.md), on
// any world.
#pragma once

#include <algorithm>
#include <cassert>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "game/physics/event.h"
#include "game/physics/event_budget.h"
#include "game/physics/halves/half_crossings.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// A puck in play, the half in which its centre is, and the instant up to which it may stay [s].
struct HalfStay {
  BodyId puck;
  Half half = Half::both;
  Real until = 0.0;
  friend bool operator==(const HalfStay&, const HalfStay&) = default;
};

/// Follows pucks from crossing to crossing of the halfway line. Crossings are those of closed
/// forms, so that nothing depends on how far a world is played at a time; but whoever plays it
/// must do so by advance(), for a course that an event ends is known until then only. Looks at
/// each of the pucks at each event: a rule for few of them.
class Halves {
 public:
  /// No rule: nothing is followed.
  Halves() = default;
  /// `line` [m]: the halfway line's x. `stay` [s], above 0: how long a puck may stay.
  Halves(Real line, Real stay) : line_(line), stay_(stay) { assert(stay > 0.0); }

  bool are_kept() const { return stay_ > 0.0; }
  /// Also follows `puck`, whose number is above those before (asserted), from the world's now() on.
  template <class AnyWorld>
  void follow(const AnyWorld& world, BodyId puck) {
    assert(pucks_.empty() || pucks_.back().puck < puck);
    pucks_.push_back({.puck = puck});
    look(pucks_.back(), motion_in(world, puck), world.now());
  }

  /// As world.advance(until), but its `view`, which calls bodies by their numbers, is looked at
  /// after each event, and it ends where a stay does. Goals end it, and so does a `budget`.
  template <class AnyWorld, class View>
  std::optional<Goal> advance(AnyWorld& world, const View& view, Real until, EventBudget* budget);

  /// The puck was put elsewhere, or is about to be: its stay begins anew where it is looked at
  /// next.
  void restart(BodyId puck) { followed(puck).is_in_play = false; }
  /// It could not be put elsewhere: it may stay until then [s].
  void prolong(BodyId puck, Real until) { followed(puck).until = until; }
  /// Brings all up to the world's now(), after an event or a call of place().
  template <class View>
  void look(const View& view);
  /// As they are in another simulation of the same world; nothing is played here from now on.
  void show(std::span<const HalfStay> stays);
  /// As they were saved at the world's now(): then it is played on from there.
  template <class View>
  void restore(const View& view, std::span<const HalfStay> stays);

  /// In order of pucks.
  std::vector<HalfStay> stays() const;
  /// When the first stay ends [s]; infinite if none does.
  Real next() const;

 private:
  struct Followed {
    BodyId puck{};
    bool is_in_play = false;
    Half half = Half::both;
    Real until = 0.0;
    Motion motion{};
    HalfCrossings crossings{};
    std::size_t passed = 0;  ///< how many of them are over
  };
  template <class View>
  static std::optional<Motion> motion_in(const View& view, BodyId puck) {
    return view.is_in_play(puck) ? std::optional(view.motion(puck)) : std::nullopt;
  }
  Followed& followed(BodyId puck) {
    const auto found = std::ranges::lower_bound(pucks_, puck, {}, &Followed::puck);
    assert(found != pucks_.end() && found->puck == puck);
    return *found;
  }
  void look(Followed& puck, const std::optional<Motion>& motion, Real now);
  void pass_crossings(Followed& puck, Real now) const;
  void enter(Followed& puck, Half half, Real time) const {
    puck.half = half, puck.until = time + stay_;
  }

  Real line_ = 0.0, stay_ = 0.0;
  std::vector<Followed> pucks_;
};

template <class View>
void Halves::look(const View& view) {
  for (Followed& puck : pucks_) look(puck, motion_in(view, puck.puck), view.now());
}

template <class AnyWorld, class View>
std::optional<Goal> Halves::advance(AnyWorld& world, const View& view, Real until,
                                    EventBudget* budget) {
  assert(are_kept() && (budget == nullptr || !budget->is_exceeded()));
  for (;;) {
    EventBudget one = EventBudget::of_one_event();
    const std::optional<Goal> goal = world.advance(std::min(until, next()), one);
    look(view);
    if (budget != nullptr)
      for (const ChargedEvent& event : one.recent()) budget->charge(event);
    if (goal || !one.is_exceeded() || (budget != nullptr && budget->is_exceeded())) return goal;
  }
}

template <class View>
void Halves::restore(const View& view, std::span<const HalfStay> stays) {
  for (Followed& puck : pucks_) puck.is_in_play = false;
  look(view);
  show(stays);
}

}  // namespace rink::physics::inline RINK_PRECISION
