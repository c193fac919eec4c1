// The server's logical time and matches: when the game advances, and when it begins anew.
#include <algorithm>
#include <cassert>

#include "game/net/server/server.h"
#include "rti/time/federate_clock.h"

namespace rink::game {

/// In real time only the server regulates, so every request is granted at once, and its own timer
/// decides when it ticks.
void Server::time_regulation_enabled(rti::LogicalTime) { publisher_->keep_order(); }

/// Called once per tick, after its states were published.
void Server::ask_for_turns() {
  const rti::FederateClock& clock = ambassador_.clock();
  if (!clock.is_regulating() || !clock.is_constrained() || clock.is_advancing()) return;
  if (const auto wanted = turns_.wanted(game_.now(), clock.time()))
    ambassador_.time_advance_request(rti::LogicalTime(*wanted));
}

bool Server::may_step() const {
  return seats_.player_count() > 0 &&
         turns_.may_step(seats_.are_all_turns_done(), game_.now(), ambassador_.clock().time());
}

void Server::send_pace(std::optional<rti::FederateHandle> federate, double now) {
  std::vector<std::byte> bytes;
  encode(bytes, turns_.pace());
  const rti::Stamp stamp{.time = now, .tag = 0};
  if (federate) ambassador_.send_directed_interaction(model_.pace, *federate, bytes, stamp);
  else ambassador_.send_interaction(model_.pace, bytes, stamp);
}

double Server::simulated_at_clock(double now) const {
  return std::max(hosted_ ? hosted_->simulated(now) : now, game_.now());
}

double Server::follow_match(double real_s) {
  assert(hosted_);
  if (shared_) hosted_->follow(shared_->match()->state());
  now_();  // so that a standstill is noticed first
  if (hosted_->advance(real_s)) {
    finish_record();  // of one that was given up
    keys_.begin();
    publisher_->retire_all();
    game_ = hosted_->begin(game_);
    for (const InputEvent& event : hosted_->take_begun()) keys_.record(event);
    budget_.begin();
  }
  if (hosted_->is_over() && (!shared_ || shared_->has_shown_all())) finish_record();
  const bool is_ahead = shared_ != nullptr && hosted_->state().phase == MatchPhase::playing;
  return hosted_->goal(real_s, game_.now()) + (is_ahead ? turns_.tick_s() : 0.0);
}

void Server::finish_record() {
  assert(hosted_);
  hosted_->finish(game_, keys_.recorded());
}

}  // namespace rink::game
