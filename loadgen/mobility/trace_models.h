// Mobility traces of any size, drawn from models of crowds (docs/scenes.md, "Traces").
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "loadgen/mobility/mobility_trace.h"

namespace rink::loadgen {

/// What to draw. All models fill a square of `side` metres from time 0 to `duration_s`.
struct TraceModel {
  std::string name;  ///< one of trace_models()
  std::uint32_t count = 1000;
  double side = 0.0;  ///< m; 0: default_side(count)
  double duration_s = 600.0;
  std::uint64_t seed = 1;
  std::size_t points_max = 50'000'000;  ///< of all agents
};

/// Of 25 m^2 per agent: 5 m times the square root of `count`.
double default_side(std::uint32_t count);

/// hotspots, flash-crowd, commuters.
std::vector<std::string> trace_models();

/// The same model and seed give the same bits on every machine. `model.name` is known, `count` and
/// `duration_s` are above 0 (asserted). Throws game::SceneError for more points than allowed.
MobilityTrace drawn_trace(const TraceModel& model);

/// Time that people take for a flight of `distance` [m]: 30.55 l^0.11 s below 500 m, else
/// 0.76 l^0.72 s (Rhee et al. 2011, of GPS traces of 101 walkers and drivers).
double flight_time_s(double distance);

}  // namespace rink::loadgen
