// Where agents of a trace are: by their legs, and without them.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "loadgen/mobility/mobility_trace.h"

namespace rink::loadgen {

/// By the leg of `instant_s`; the agent must be there.
inline Vector2 place_at(const Agent& agent, double instant_s) {
  const Leg leg = leg_at(agent, instant_s);
  EXPECT_TRUE(leg.is_there) << agent.id << " at " << instant_s;
  return leg.place + (instant_s - leg.since_s) * leg.velocity;
}

/// Where the agent of these points is at `instant_s`, by looking at them one by one; nothing before
/// the first and after the last.
inline std::optional<Vector2> interpolated(const std::vector<TracePoint>& points,
                                           double instant_s) {
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (points[k].time_s == instant_s) return Vector2(points[k].x, points[k].y);
    if (k + 1 == points.size() || points[k].time_s > instant_s || points[k + 1].time_s < instant_s)
      continue;
    const double part = (instant_s - points[k].time_s) / (points[k + 1].time_s - points[k].time_s);
    return Vector2((1.0 - part) * points[k].x + part * points[k + 1].x,
                   (1.0 - part) * points[k].y + part * points[k + 1].y);
  }
  return std::nullopt;
}

}  // namespace rink::loadgen
