// Checks each point against the one before.
#include "loadgen/mobility/trace_builder.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>
#include <utility>

#include "loadgen/experiment/parameter.h"

namespace rink::loadgen {
namespace {

constexpr double time_max_s = 1e9;

std::string count_text(std::size_t count) { return std::to_string(count); }

}  // namespace

TraceBuilder::TraceBuilder(std::string file, const TraceRules& rules)
    : file_(std::move(file)), rules_(rules) {
  assert(rules.gap_s >= 0.0);
}

void TraceBuilder::refuse(std::size_t line, const std::string& why) const {
  throw game::SceneError(file_ + ":" + std::to_string(line) + ": " + why);
}

void TraceBuilder::refuse_all(const std::string& why) const {
  throw game::SceneError(file_ + ": " + why);
}

std::uint32_t TraceBuilder::agent(std::string_view id, std::size_t line) {
  if (id.empty()) refuse(line, "an agent without an id: expected a name or a number");
  const auto [place, is_new] =
      numbers_.try_emplace(std::string(id), static_cast<std::uint32_t>(trace_.agents.size()));
  if (!is_new) return place->second;
  if (trace_.agents.size() == rules_.agents_max)
    refuse(line, "agent " + place->first + " is one too many: allowed are " +
                     count_text(rules_.agents_max) + " agents");
  trace_.agents.push_back({.id = place->first, .points = {}, .returns = {}});
  lines_.push_back(0);
  return place->second;
}

std::string TraceBuilder::last_of(const Agent& agent, std::uint32_t number) const {
  const TracePoint& last = agent.points.back();
  return "t = " + shortest(last.time_s) + " in line " + std::to_string(lines_[number]);
}

void TraceBuilder::check(const Agent& agent, const TracePoint& point, std::size_t line) const {
  const auto refuse_value = [&](const char* name, double value, const std::string& expected) {
    refuse(line,
           "agent " + agent.id + ": " + name + " = " + shortest(value) + ": expected " + expected);
  };
  if (!(std::abs(point.time_s) <= time_max_s))
    refuse_value("t", point.time_s, "a number of seconds from -1e9 to 1e9");
  for (const auto& [name, value, axis] :
       {std::tuple("x", point.x, 0), std::tuple("y", point.y, 1)}) {
    if (!std::isfinite(value)) refuse_value(name, value, "a number of metres");
    if (rules_.field && !(value >= 0.0 && value <= (*rules_.field)[axis]))
      refuse_value(name, value,
                   "a place on the field, from 0 to " + shortest((*rules_.field)[axis]) + " m");
  }
}

void TraceBuilder::add(std::uint32_t number, const TracePoint& point, std::size_t line, Way way) {
  assert(number < trace_.agents.size());
  Agent& agent = trace_.agents[number];
  check(agent, point, line);
  if (!agent.points.empty()) {
    const TracePoint& last = agent.points.back();
    if (point == last) return;
    if (point.time_s <= last.time_s)
      refuse(line, "agent " + agent.id + ": t = " + shortest(point.time_s) + " after " +
                       last_of(agent, number) + ": expected times of an agent that rise");
    const double wait_s = point.time_s - last.time_s;
    if (rules_.gap_s > 0.0 && wait_s > rules_.gap_s) way = Way::away;
    const double speed = std::hypot(point.x - last.x, point.y - last.y) / wait_s;
    if (way == Way::straight && !(speed <= agent_speed_max * (1.0 + 1e-6)))  // times are rounded
      refuse(line, "agent " + agent.id + " comes at " + shortest(std::round(speed)) + " m/s from " +
                       last_of(agent, number) + ": allowed is " + shortest(agent_speed_max) +
                       " m/s, or in CSV a gap_s that says it was away");
    if (way == Way::away) agent.returns.push_back(static_cast<std::uint32_t>(agent.points.size()));
  }
  if (point_count_ == rules_.points_max)
    refuse(line, "one point too many: allowed are " + count_text(rules_.points_max) +
                     " points of all agents");
  ++point_count_;
  agent.points.push_back(point);
  lines_[number] = static_cast<std::uint32_t>(line);
  if (point_count_ == 1) trace_.begin_s = trace_.end_s = point.time_s;
  if (point_count_ == 1) trace_.low = trace_.high = {point.x, point.y};
  trace_.begin_s = std::min(trace_.begin_s, point.time_s);
  trace_.end_s = std::max(trace_.end_s, point.time_s);
  trace_.low = trace_.low.cwiseMin(Vector2(point.x, point.y));
  trace_.high = trace_.high.cwiseMax(Vector2(point.x, point.y));
  if ((trace_.high - trace_.low).maxCoeff() > trace_span_max)
    refuse(line, "agent " + agent.id + " is at (" + shortest(point.x) + ", " + shortest(point.y) +
                     "): allowed are places within a square of " + shortest(trace_span_max) + " m");
}

void TraceBuilder::hold_to_end() {
  const double end_s = trace_.end_s;
  for (std::uint32_t number = 0; number < trace_.agents.size(); ++number) {
    const Agent& agent = trace_.agents[number];
    if (agent.points.empty() || agent.points.back().time_s == end_s) continue;
    const TracePoint last = agent.points.back();
    const double gap_s = std::exchange(rules_.gap_s, 0.0);
    add(number, {end_s, last.x, last.y}, lines_[number]);
    rules_.gap_s = gap_s;
  }
}

MobilityTrace TraceBuilder::finish() {
  if (trace_.agents.empty()) refuse_all("no agents: expected one at least");
  for (const Agent& agent : trace_.agents)
    if (agent.points.empty()) refuse_all("agent " + agent.id + " has no place: expected a point");
  assert(trace_.begin_s <= trace_.end_s);
  return std::move(trace_);
}

}  // namespace rink::loadgen
