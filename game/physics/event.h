// What a world reports of what happened in it.
#pragma once

#include <optional>

#include "game/physics/body.h"
#include "game/physics/counters.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// What happened to `body` and `other` at `time` [s]; `other` is nothing for a wall, the edge of a
/// goal, and wherever one body alone is concerned.
struct Event {
  Real time = 0.0;
  EventKind kind = EventKind::puck_puck;
  BodyId body;
  std::optional<BodyId> other;
};

/// `puck` crossed the goal line at `end` (x = 0 or x = length) with its centre at `time` and is out
/// of play from then on.
struct Goal {
  Real time = 0.0;
  BodyId puck;
  End end = End::left;
};

}  // namespace rink::physics::inline RINK_PRECISION
