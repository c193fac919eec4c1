// A client that cannot ask for ticks as fast as they come asks now and then how far the server is,
// or it would fall behind for ever.
#include "game/net/client/turn_taker.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rink::game {
namespace {

/// A client on the server's timer asks how far the server is once in so many ticks.
constexpr std::uint64_t ticks_per_question = 8;

}  // namespace

bool TurnTaker::is_time_kept(bool is_constrained, bool is_regulating) const {
  return !is_time_managed() || (is_constrained && (!is_synchronous() || is_regulating));
}

bool TurnTaker::receive(const Pace& pace, double simulated_s) {
  const bool is_first = !pace_;
  if (is_first) pace_ = pace;
  if (is_synchronous() && !is_time_managed()) {
    has_turn_ = true;
    turn_s_ = simulated_s;
  }
  return is_first;
}

bool TurnTaker::begin() {
  assert(pace_);
  if (!is_synchronous() || is_late()) return true;
  has_turn_ = true;
  return false;
}

TurnTaker::Request TurnTaker::next(double granted) {
  assert(pace_);
  std::uint64_t tick = grid().next(granted);
  bool asks_bounds = false;
  if (!is_synchronous()) {
    tick = std::max(tick, grid().last(galt_));
    asks_bounds = grants_ % ticks_per_question == 0;
    awaits_bounds_ = awaits_bounds_ || asks_bounds;
  }
  return {grid().received(tick), asks_bounds};
}

bool TurnTaker::grant(double granted) {
  assert(pace_);
  ++grants_;
  if (!is_synchronous()) return !awaits_bounds_;
  has_turn_ = true;
  turn_s_ = static_cast<double>(grid().last(granted)) / grid().rate_hz;
  return false;
}

bool TurnTaker::receive_bounds(double galt) {
  if (!awaits_bounds_) return false;
  awaits_bounds_ = false;
  galt_ = std::isfinite(galt) ? galt : 0.0;
  return true;
}

}  // namespace rink::game
