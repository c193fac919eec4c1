// The RTI object by which players hear how their hosted match stands, and the answers to who asks
// for the server's time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "game/control/match_flow.h"
#include "game/replication/object_model.h"
#include "rti/ambassador.h"

namespace rink::game {

/// Of a server that has joined.
class MatchBoard {
 public:
  /// Registers the object. `scene_text` and `tick_s` are told once, to whoever comes. All that is
  /// handed in by reference must outlive the board.
  MatchBoard(rti::Ambassador& ambassador, const ObjectModel& model, const std::string& scene_text,
             double tick_s);

  /// Says so if the state is another than before.
  void show(const MatchState& state, const rti::Stamp& stamp);
  /// Tells `federate` when its question came, `now_s` on the server's clock.
  void answer(rti::FederateHandle federate, std::uint64_t number, double now_s);
  /// True once after something was said that should not wait for the next tick.
  bool take_urgent() { return std::exchange(is_urgent_, false); }

 private:
  rti::Ambassador& ambassador_;
  const ObjectModel& model_;
  rti::ObjectHandle match_;
  std::optional<MatchState> shown_;
  bool is_urgent_ = false;
};

}  // namespace rink::game
