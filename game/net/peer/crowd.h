// The bots that one peer plays: they see what the owners of their bats show them, and their keys go
// back there.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "game/control/game.h"
#include "game/peer/session/session.h"
#include "game/players/player.h"

namespace rink::game {

/// What a live player did, as a number of peer::Key::input, and back; `time` and `player` are left
/// out.
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

  /// How many pucks the one of these kinds wants to see who wants to see most.
  static std::uint32_t pucks_wanted(const Scene& scene, const std::vector<std::string>& kinds);

  /// After a commit of `session`'s peer: whoever is shown something decides, and the keys are on
  /// their way.
  void act(peer::Session& session);
  std::uint64_t presses() const { return presses_; }

 private:
  struct Bot {
    std::uint32_t bat;
    BatController controller;
    std::unique_ptr<Player> player;  ///< nobody: random
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
