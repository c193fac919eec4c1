// Draws the players and instants of traces from a seed, so that the same seed gives the same
// sample.
#pragma once

#include <cstdint>
#include <vector>

namespace rink::game {

/// Of a run of `clients` players, measured from `from_s` to `until_s` of simulated time.
struct SamplingSettings {
  std::uint64_t seed = 1;
  std::uint32_t clients = 0;
  double from_s = 0.0, until_s = 0.0;
  std::uint32_t player_max = 32;       ///< players that are watched, all of them if there are fewer
  std::size_t record_max = 1'000'000;  ///< records kept of each kind, a bound of memory and file
};

/// Up to `player_max` players in a drawn order.
std::vector<std::uint32_t> sampled_players(const SamplingSettings& settings);

/// Ten instants [s] for each measured second, but 20 to 100 in all, ascending: the span is cut into
/// as many equal parts and one instant is drawn uniformly from each, so that samples neither beat
/// with the ticks nor cluster. `stream` parts independent drawings of one seed.
std::vector<double> sampled_instants(const SamplingSettings& settings, std::uint64_t stream);

}  // namespace rink::game
