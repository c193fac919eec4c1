// Fisher and Yates's shuffle, and one uniform instant per stratum.
#include "game/net/sampling.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

#include "game/model/random_stream.h"

namespace rink::game {

std::vector<std::uint32_t> sampled_players(const SamplingSettings& settings) {
  constexpr std::uint64_t stream = 0x73616d706c65;
  RandomStream random(settings.seed, stream);
  std::vector<std::uint32_t> players(settings.clients);
  std::iota(players.begin(), players.end(), 0u);
  const std::uint32_t wanted = std::min(settings.player_max, settings.clients);
  for (std::uint32_t i = 0; i < wanted; ++i)
    std::swap(players[i], players[i + random.below(settings.clients - i)]);
  assert(wanted <= players.size());
  players.resize(wanted);
  return players;
}

std::vector<double> sampled_instants(const SamplingSettings& settings, std::uint64_t stream) {
  const double span_s = settings.until_s - settings.from_s;
  if (!(span_s > 0.0)) return {};
  const auto count = static_cast<std::uint32_t>(std::clamp(std::ceil(10.0 * span_s), 20.0, 100.0));
  RandomStream random(settings.seed, stream);
  std::vector<double> instants(count);
  for (std::uint32_t i = 0; i < count; ++i)
    instants[i] = settings.from_s + span_s * (i + random.uniform()) / count;
  return instants;
}

}  // namespace rink::game
