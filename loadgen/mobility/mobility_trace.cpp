// Finds the leg of an instant by bisection.
#include "loadgen/mobility/mobility_trace.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <limits>

namespace rink::loadgen {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The first point after `instant_s`.
auto point_after(const Agent& agent, double instant_s) {
  return std::upper_bound(
      agent.points.begin(), agent.points.end(), instant_s,
      [](double instant, const TracePoint& point) { return instant < point.time_s; });
}

Vector2 place_of(const TracePoint& point) { return {point.x, point.y}; }

}  // namespace

Leg leg_at(const Agent& agent, double instant_s) {
  assert(!agent.points.empty() && std::isfinite(instant_s));
  const auto next = point_after(agent, instant_s);
  if (next == agent.points.begin())
    return {.since_s = -infinity, .until_s = next->time_s, .place = place_of(*next)};
  const TracePoint& last = *std::prev(next);
  const auto number = static_cast<std::uint32_t>(next - agent.points.begin());
  if (next != agent.points.end() && !std::ranges::binary_search(agent.returns, number))
    return {.since_s = last.time_s,
            .until_s = next->time_s,
            .place = place_of(last),
            .velocity = (place_of(*next) - place_of(last)) / (next->time_s - last.time_s),
            .is_there = true};
  const bool is_there = instant_s == last.time_s;
  return {.since_s = last.time_s,
          .until_s = is_there                     ? std::nextafter(instant_s, infinity)
                     : next == agent.points.end() ? infinity
                                                  : next->time_s,
          .place = place_of(last),
          .is_there = is_there};
}

double there_until(const Agent& agent, double instant_s) {
  if (!leg_at(agent, instant_s).is_there) return -infinity;
  const auto next =
      static_cast<std::uint32_t>(point_after(agent, instant_s) - agent.points.begin());
  const auto back = std::ranges::lower_bound(agent.returns, next);
  const std::size_t end = back == agent.returns.end() ? agent.points.size() : *back;
  assert(end > 0);
  return agent.points[end - 1].time_s;
}

}  // namespace rink::loadgen
