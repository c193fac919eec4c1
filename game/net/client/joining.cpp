// The transitions between states of joining; a call that does not fit the state is ignored.
#include "game/net/client/joining.h"

#include <cassert>

namespace rink::game {

void Joining::refuse(rti::Refusal refusal, std::string_view why) {
  state_ = State::refused;
  refusal_ = refusal;
  error_ = why;
}

void Joining::lose(std::string_view why) {
  state_ = State::lost;
  error_ = why;
}

bool Joining::offer(const SeatOffer& offer) {
  if (state_ != State::joining) return true;
  if (offer.bat == SeatOffer::no_bat) {
    state_ = State::refused;
    error_ = "no bat is free";
    return false;
  }
  seat_ = offer;
  return true;
}

void Joining::sit_down() {
  assert(state_ == State::joining && seat_);
  state_ = State::seated;
}

void Joining::watch() {
  assert(state_ == State::joining);
  seat_ = SeatOffer{};
  state_ = State::playing;
}

void Joining::see_bat() {
  if (state_ == State::seated) state_ = State::ready;
}

void Joining::play() {
  if (state_ == State::ready) state_ = State::playing;
}

}  // namespace rink::game
