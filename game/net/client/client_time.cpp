// A client that takes turns, or keeps logical time with the server: what it asks for after each
// tick.
#include <algorithm>
#include <cassert>
#include <cmath>

#include "game/net/client/client.h"
#include "game/net/tick_grid.h"
#include "rti/time/federate_clock.h"

namespace rink::game {
namespace {

/// So often a client on the server's timer asks how far the server is. Who can't ask for one tick
/// after the other as fast as they come would else fall back for ever.
constexpr std::uint64_t ticks_per_question = 8;

}  // namespace

void Client::receive_pace(rti::Bytes parameters, const rti::Stamp& stamp) {
  Pace told;
  if (!decode(parameters, told)) return;
  const bool is_first = !pace_;
  if (is_first) pace_ = told;
  if (is_synchronous() && !is_time_managed()) {
    has_turn_ = true;
    turn_s_ = stamp.time;
    pass_if_absent();
  }
  if (!is_first || !is_time_managed()) return;
  ambassador_.enable_asynchronous_delivery();  // discoveries and the RTI's own news need not wait
                                               // for a tick
  if (is_synchronous()) {
    for (const rti::InteractionClassHandle each : {model_.key_down, model_.key_up, model_.update})
      ambassador_.change_interaction_order_type(each, rti::Order::timestamp);
    ambassador_.enable_time_regulation(TickGrid{pace_->ticks_per_second}.lookahead());
  }
  ambassador_.enable_time_constrained();
}

/// True unless it should keep logical time and can't yet.
bool Client::is_time_kept() const {
  const rti::FederateClock& clock = ambassador_.clock();
  return !is_time_managed() ||
         (clock.is_constrained() && (!is_synchronous() || clock.is_regulating()));
}

void Client::time_regulation_enabled(rti::LogicalTime) { begin_time(); }
void Client::time_constrained_enabled(rti::LogicalTime) { begin_time(); }

void Client::begin_time() {
  if (!is_time_kept()) return;
  if (!is_synchronous() || pace_->is_late != 0) ask_for_tick();
  else has_turn_ = true;
  reach_barrier_once_ready();
}

/// Who waits for turns is never ahead by more than one tick; who does not may be ahead by any
/// number, which then come together.
void Client::ask_for_tick() {
  const TickGrid grid{pace_->ticks_per_second};
  std::uint64_t tick = grid.next(ambassador_.clock().time());
  if (!is_synchronous()) {
    tick = std::max(tick, grid.last(galt_));
    if (grants_ % ticks_per_question == 0) {
      awaits_bounds_ = true;
      ambassador_.query_time_bounds();
    }
  }
  ambassador_.time_advance_request(rti::LogicalTime(grid.heard(tick)));
}

void Client::time_advance_grant(rti::LogicalTime now) {
  ++grants_;
  if (is_synchronous()) {
    has_turn_ = true;
    const TickGrid grid{pace_->ticks_per_second};
    turn_s_ = static_cast<double>(grid.last(now.value)) / grid.rate_hz;
    pass_if_absent();
  } else if (!awaits_bounds_) {
    ask_for_tick();
  }
}

/// The answer comes after the grant if that could be given at once, which is when there may be more
/// to ask for.
void Client::time_bounds(double galt, double) {
  awaits_bounds_ = false;
  galt_ = std::isfinite(galt) ? galt : 0.0;
  if (!ambassador_.clock().is_advancing()) ask_for_tick();
}

/// Who came late and has not sat down yet keeps nobody waiting.
void Client::pass_if_absent() {
  if (pace_->is_late != 0 && state_ != State::playing) end_turn();
}

void Client::end_turn() {
  if (!is_time_managed()) {
    has_turn_ = false;
    return ambassador_.send_interaction(model_.update, {}, {});
  }
  assert(has_turn_);
  has_turn_ = false;
  ambassador_.send_interaction(model_.update, {}, rti::LogicalTime(ambassador_.clock().earliest()));
  ask_for_tick();
}

}  // namespace rink::game
