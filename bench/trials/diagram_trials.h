// The scenes of the work-precision diagram, each with its truth.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "bench/trials/trial.h"

namespace rink::accuracy {

/// A scene whose true end is known.
struct DiagramTrial {
  Trial trial{};
  double target = 1e-3;  ///< error at which run times are compared [m]
  std::string truth{};   ///< where truth comes from, in words
  /// Where the movers truly are at the horizon, in the order of their numbers.
  std::function<std::vector<Vector2>(const Trial&)> true_places{};
};

/// All of them, in the order in which they are shown. The same bits each time.
std::vector<DiagramTrial> diagram_trials();

/// Elastic pairs, each alone: closed form in extended precision.
std::vector<Vector2> places_of_pairs(const Trial& trial);
/// Each puck lies at the wall y = 0 and each bat on its puck, all at rest.
std::vector<Vector2> places_of_pressed(const Trial& trial);
/// The exact engine in extended precision.
std::vector<Vector2> places_in_extended_precision(const Trial& trial);
/// The same of a trial without thrust, where all share one drag: without drag, after the time that
/// drag leaves. Independent of how drag is computed.
std::vector<Vector2> places_by_warped_time(const Trial& trial);

/// `count` elastic pucks of radius 0.04 m at `packing` in a square field, Maxwell's speeds about a
/// mean of 1 m/s.
Trial gas(std::uint32_t count, double packing, std::uint64_t seed = 1);

}  // namespace rink::accuracy
