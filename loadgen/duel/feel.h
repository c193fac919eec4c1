// Compares what players are shown of a match over a delayed network with the true state.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "loadgen/duel/duel.h"

namespace rink::loadgen {

/// Distances between shown and true positions at the displayed instant [m].
struct ShownError {
  std::uint64_t count = 0;
  double mean = 0.0, p50 = 0.0, p90 = 0.0, p99 = 0.0, greatest = 0.0;
};

/// The figures of both players together.
struct Feel {
  double played_s = 0.0;             ///< simulated, per player
  ShownError own, other, puck;       ///< at the instant at which each is shown
  double corrections_per_min = 0.0;  ///< of the own bat, visible ones
  double correction_mean = 0.0, correction_greatest = 0.0;  ///< of these [m]
  double puck_corrections_per_min = 0.0, puck_correction_mean = 0.0;
  double other_corrections_per_min = 0.0, other_correction_mean = 0.0;
  double lead_s = 0.0;  ///< how far the own bat is shown ahead of the other
  double payload_bytes_per_s =
      0.0;  ///< down, per player, all that was sent while the match was played
  double sent_bytes_per_s = 0.0;  ///< up, per player
  std::uint64_t keys = 0,
                late_keys = 0;  ///< late: felt more than 0.1 ms later than their player counted on
  std::uint64_t pushes = 0;     ///< of `keys`
  bool is_replayed = false;     ///< the record led to the same hash
};

/// Plays one match, or `seconds` of it if it takes longer, and compares.
Feel feel_of(const rti::Fom& fom, const game::Scene& scene, const std::string& scene_text,
             const DuelSettings& settings, double seconds);

}  // namespace rink::loadgen
