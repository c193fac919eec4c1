// A mobility trace: which agents there were, and where each was when.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "game/physics/body.h"

namespace rink::loadgen {

using physics::Vector2;

/// An agent was at (x, y) [m] at `time_s` [s].
struct TracePoint {
  double time_s = 0.0, x = 0.0, y = 0.0;
  friend bool operator==(const TracePoint&, const TracePoint&) = default;
};

/// Somebody or something that moves straight and evenly from point to point, and is there from its
/// first point to its last, both included.
struct Agent {
  std::string id;
  std::vector<TracePoint> points;      ///< at least one; times rise
  std::vector<std::uint32_t> returns;  ///< points, ascending, at which it comes back: it was away
                                       ///< since the one before
};

/// How an agent moves from `since_s` until `until_s` [s], exclusive.
struct Leg {
  double since_s = 0.0, until_s = 0.0;
  Vector2 place{0.0, 0.0};  ///< at `since_s`; where an absent agent was last, or will be first [m]
  Vector2 velocity{0.0, 0.0};  ///< m/s
  bool is_there = false;
};

/// The leg of `agent` at `instant_s`. Before the first point it began at minus infinity.
Leg leg_at(const Agent& agent, double instant_s);

/// The end of the stay that `agent` is in at `instant_s` [s]; minus infinity if it is away.
double there_until(const Agent& agent, double instant_s);

struct MobilityTrace {
  std::vector<Agent> agents;              ///< at least one
  double begin_s = 0.0, end_s = 0.0;      ///< of all points
  Vector2 low{0.0, 0.0}, high{0.0, 0.0};  ///< of all points [m]
};

}  // namespace rink::loadgen
