// The RTI object with the state of a hosted match, and the answers to requests for the server's
// time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "game/control/match_flow.h"
#include "game/replication/object_model.h"
#include "rti/ambassador.h"

namespace rink::game {

/// The server must have joined.
class MatchBoard {
 public:
  /// Registers the object. `scene_text` and `tick_s` are sent once to each player. Arguments by
  /// reference must outlive the board.
  MatchBoard(rti::Ambassador& ambassador, const ObjectModel& model, const std::string& scene_text,
             double tick_s);

  /// Publishes the state if it differs from the last one.
  void show(const MatchState& state, const rti::Stamp& stamp);
  /// Answers `federate` with the time at which its question came, `now_s` on the server's clock.
  void answer(rti::FederateHandle federate, std::uint64_t number, double now_s);
  /// True once after a message that should not wait for the next tick.
  bool take_urgent() { return std::exchange(is_urgent_, false); }

 private:
  rti::Ambassador& ambassador_;
  const ObjectModel& model_;
  rti::ObjectHandle match_;
  std::optional<MatchState> shown_;
  bool is_urgent_ = false;
};

}  // namespace rink::game
