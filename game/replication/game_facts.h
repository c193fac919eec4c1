// What conditions and scores may ask of the entities of a game (im/filter.h, `Facts`).
#pragma once

#include <cstdint>
#include <vector>

#include "game/control/game.h"
#include "im/filter.h"

namespace rink::game {

/// Notices by looking when motions change, so ages count from the look after the change.
class GameFacts {
 public:
  /// Of `entity` at `game.now()`, which is `now` [s] on the filter's clock. Motions of engines that
  /// keep no closed form never count as changed. Time that goes back begins another game.
  im::Facts of(const Game& game, const Entity& entity, double now);

 private:
  struct Seen {
    bool is_known = false;
    std::uint32_t version = 0;
    im::Facts facts;
  };
  std::vector<Seen> seen_;  // by entity
  double played_to_ = 0.0;  // game time of the last look [s]
};

}  // namespace rink::game
