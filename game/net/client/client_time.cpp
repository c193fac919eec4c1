// A client that takes turns, or keeps logical time with the server: its requests after each tick.
#include <cassert>

#include "game/net/client/client.h"
#include "rti/time/federate_clock.h"

namespace rink::game {

void Client::receive_pace(rti::Bytes parameters, const rti::Stamp& stamp) {
  Pace received;
  if (!decode(parameters, received)) return;
  const bool is_first = turns_.receive(received, stamp.time);
  pass_if_absent();
  if (!is_first || !turns_.is_time_managed()) return;
  ambassador_.enable_asynchronous_delivery();  // discoveries and the RTI's own news need not wait
                                               // for a tick
  if (turns_.is_synchronous()) {
    for (const rti::InteractionClassHandle each : {model_.key_down, model_.key_up, model_.update})
      ambassador_.change_interaction_order_type(each, rti::Order::timestamp);
    ambassador_.enable_time_regulation(turns_.lookahead());
  }
  ambassador_.enable_time_constrained();
}

void Client::time_regulation_enabled(rti::LogicalTime) { begin_time(); }
void Client::time_constrained_enabled(rti::LogicalTime) { begin_time(); }

void Client::begin_time() {
  if (!turns_.is_time_managed() || !turns_.is_time_kept(ambassador_.clock())) return;
  if (turns_.begin()) ask_for_tick();
  reach_barrier_once_ready();
}

void Client::ask_for_tick() {
  const TurnTaker::Request request = turns_.next(ambassador_.clock().time());
  if (request.asks_bounds) ambassador_.query_time_bounds();
  ambassador_.time_advance_request(rti::LogicalTime(request.time));
}

void Client::time_advance_grant(rti::LogicalTime now) {
  if (turns_.grant(now.value)) ask_for_tick();
  pass_if_absent();
}

void Client::time_bounds(double galt, double) {
  if (turns_.receive_bounds(galt) && !ambassador_.clock().is_advancing()) ask_for_tick();
}

/// A player that came late and is not seated yet keeps no other waiting.
void Client::pass_if_absent() {
  if (turns_.has_turn() && turns_.is_late() && state() != State::playing) end_turn();
}

void Client::end_turn() {
  assert(turns_.has_turn() || !turns_.is_time_managed());
  turns_.end_turn();
  if (!turns_.is_time_managed()) return ambassador_.send_interaction(model_.update, {}, {});
  ambassador_.send_interaction(model_.update, {}, rti::LogicalTime(ambassador_.clock().earliest()));
  ask_for_tick();
}

}  // namespace rink::game
