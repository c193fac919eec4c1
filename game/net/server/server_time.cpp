// The server's part in turns and logical time: tells players the pace, and asks the RTI when all
// has been said that belongs before a tick.
#include "game/net/server/server.h"
#include "game/net/tick_grid.h"
#include "rti/time/federate_clock.h"

namespace rink::game {

/// In real time nobody regulates but the server itself, so it is granted at once whatever it asks
/// for, and its own timer goes on to say when it ticks.
void Server::keep_time() {
  ambassador_.enable_asynchronous_delivery();  // keys in real time, and players who come and go,
                                               // are not to wait for a tick
  ambassador_.enable_time_regulation(TickGrid{1.0 / tick_s_}.lookahead());
  ambassador_.enable_time_constrained();
}

void Server::time_regulation_enabled(rti::LogicalTime) { publisher_->keep_order(); }

/// Once per tick, when its states have been said.
void Server::ask_for_turns() {
  if (!is_time_managed_ || !is_started_) return;
  const double wanted = TickGrid{1.0 / tick_s_}.turns_heard(game_.now());
  const rti::FederateClock& clock = ambassador_.clock();
  if (clock.is_regulating() && clock.is_constrained() && !clock.is_advancing() &&
      clock.time() < wanted)
    ambassador_.time_advance_request(rti::LogicalTime(wanted));
}

bool Server::may_step() const {
  if (!is_time_managed_) return all_turns_done();
  return player_count_ > 0 &&
         ambassador_.clock().time() >= TickGrid{1.0 / tick_s_}.turns_heard(game_.now());
}

void Server::tell_pace(std::optional<rti::FederateHandle> federate, double now) {
  std::vector<std::byte> bytes;
  const Pace pace{.ticks_per_second = 1.0 / tick_s_,
                  .is_synchronous = is_synchronous_,
                  .is_time_managed = is_time_managed_,
                  .is_late = is_called_};
  encode(bytes, pace);
  if (federate)
    ambassador_.send_directed_interaction(model_.pace, *federate, bytes,
                                          rti::Stamp{.time = now, .tag = 0});
  else ambassador_.send_interaction(model_.pace, bytes, rti::Stamp{.time = now, .tag = 0});
}

}  // namespace rink::game
