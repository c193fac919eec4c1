// A client's progress in joining a game: a seat, the start barrier, or the reason of a refusal.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "game/replication/attributes.h"
#include "rti/membership.h"

namespace rink::game {

class Joining {
 public:
  enum class State : std::uint8_t { joining, seated, ready, playing, refused, lost };

  State state() const { return state_; }
  /// Why the state is refused or lost.
  const std::string& error() const { return error_; }
  /// Why the RTI refused the join, if it did.
  const std::optional<rti::Refusal>& refusal() const { return refusal_; }
  const std::optional<SeatOffer>& seat() const { return seat_; }

  void refuse(rti::Refusal refusal, std::string_view why);
  void lose(std::string_view why);
  /// Handles an offer; false if the server has no seat, then the client is refused. An unexpected
  /// offer is ignored.
  bool offer(const SeatOffer& offer);
  /// The client has subscribed around its seat.
  void sit_down();
  /// The client wants no bat, and watches from now on.
  void watch();
  /// The own bat is in sight.
  void see_bat();
  /// The client is called to the start barrier; take_call() is true once, when it is ready for it.
  void call() { is_called_ = true; }
  bool take_call() { return state_ == State::ready && std::exchange(is_called_, false); }
  /// The barrier is reached, or the client came late. Without effect unless it is ready.
  void play();

 private:
  State state_ = State::joining;
  bool is_called_ = false;  ///< to the start barrier
  std::optional<SeatOffer> seat_;
  std::optional<rti::Refusal> refusal_;
  std::string error_;
};

}  // namespace rink::game
