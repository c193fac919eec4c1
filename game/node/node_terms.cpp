// Windows of a tick.
#include "game/node/node_terms.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "game/model/time_grid.h"

namespace rink::game {

Terms terms_of_nodes(std::uint32_t node_count, double until, double tick_s,
                     std::uint32_t balance_windows) {
  Terms terms{.peer_count = node_count,
              .until = until,
              .window = tick_s,
              .balance_windows = balance_windows};
  terms.interest.scheme = nodes_scheme;
  assert(terms.fit());
  return terms;
}

Terms terms_of_matches(std::uint32_t node_count, double tick_s, std::uint32_t balance_windows) {
  const double window = std::max(1.0, std::round(tick_s / tick_grid)) * tick_grid;
  Terms terms = terms_of_nodes(node_count, match_s_max, window, balance_windows);
  terms.interest.scheme = matches_scheme;
  return terms;
}

Fingerprint fingerprint_of_nodes(const SharedGame& game) {
  Fingerprint fingerprint = game.session_fingerprint();
  StateHash keys;
  keys.add(fingerprint.keys), keys.add(std::uint64_t{0x6e6f64657334});
  fingerprint.keys = keys.value();
  return fingerprint;
}

}  // namespace rink::game
