// A scene and its keys as peers share them: the division, the windows, and the hash of the whole in the end.
#pragma once

#include <cstdint>
#include <vector>

#include "game/control/game.h"
#include "game/net/peer/greetings.h"
#include "game/peer/protocol.h"

namespace rink::game {

/// What one peer had of it.
struct PlayedPart {
  peer::PeerCounters counters;
  std::uint64_t owned = 0, ghosts = 0;  ///< at the end
  double halo = 0.0;                    ///< m, likewise
  std::uint64_t result_bytes = 0;       ///< sent, with the own bodies' last states
  std::uint64_t hash = 0;               ///< of the whole: Game::hash(), as rink simulate prints it
};

/// The same for all who are given the same scene and keys.
class SharedGame {
 public:
  /// `recorded` keys come beside the scene's own. Throws SceneError for what peers cannot share: goals, and players who enter or leave.
  SharedGame(const Scene& scene, const std::vector<InputEvent>& recorded);

  Luggage luggage() const;
  peer::Division division(peer::PeerNumber peer_count) const;
  /// Plays peer `number`'s part to the end of `terms`. Throws peer::ProtocolError, and what `mail` throws.
  PlayedPart play(const Terms& terms, peer::PeerNumber number, peer::Mail& mail) const;

 private:
  double first_halo(double window) const;
  std::vector<peer::Key> thrusts() const;
  std::uint64_t hash(std::uint64_t world, double until) const;

  Scene scene_;
  std::vector<InputEvent> keys_;  ///< in the order in which a Game applies them
  Game start_;                    ///< never advanced
};

}  // namespace rink::game
