// The bots that one peer plays: they see the observations of their bats' owners, and send their
// keys there.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "game/control/game.h"
#include "game/peer/session/session.h"
#include "game/players/player.h"

namespace rink::game {

/// An input of a live player as a number of peer::Key::input, and back; `time` and `player` are
/// left out.
std::uint8_t input_of(const InputEvent& event);
InputEvent event_of(std::uint8_t input, double time, std::uint32_t player);

/// Players of the scene's bats from `first` on, `count` of them; bat k is played by kind k modulo
/// their number, as by rink simulate.
class Crowd {
 public:
  struct Settings {
    const std::vector<std::string>& kinds;  ///< "random" or one of player_kinds(), at least one
                                            ///< unless `count` is 0 (asserted)
    std::uint64_t seed = 1;
    std::uint32_t first = 0, count = 0;
    double from = 0.0, until = 0.0;  ///< when random players are to press keys [s]
  };
  Crowd(const Scene& scene, const Game& start, const Settings& settings);

  /// The greatest number of pucks that one of these kinds of players looks at.
  static std::uint32_t pucks_wanted(const Scene& scene, const std::vector<std::string>& kinds);

  /// Call it after a commit of `session`'s peer: bots with observations decide, and their keys are
  /// sent.
  void act(peer::Session& session);
  std::uint64_t presses() const { return presses_; }

 private:
  struct Bot {
    std::uint32_t bat;
    BatController controller;
    std::unique_ptr<Player> player;  ///< null: random
    std::vector<InputEvent> plan;    ///< of a random player
    std::size_t next = 0;
    double decided = -1.0;  ///< the last instant [s]
  };
  void press(peer::Session& session, Bot& bot, const peer::Observation& observation, Key key,
             bool is_down);
  void decide(peer::Session& session, Bot& bot, const peer::Observation& observation);

  std::vector<Bot> bots_;
  std::vector<SeenEntity> seen_;
  std::uint64_t presses_ = 0;
};

}  // namespace rink::game
