// Bots that play matches at a node without clients: they see what it shows and press keys there.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "game/control/game.h"
#include "game/net/server/shared_play.h"
#include "game/players/player.h"

namespace rink::game {

/// Times are real ones of any clock [s], which is read nowhere. Each bot decides by the last window
/// that was shown, and presses a key for as long after it as clients of nodes do.
class MatchBots {
 public:
  struct Settings {
    std::uint32_t count = 0;
    std::vector<std::string> kinds{"chaser"};  ///< in turn, by bat; "random" too
    std::uint64_t seed = 1;
    double window = 0.0;  ///< [s, simulated]
  };
  /// `scene` and `play`, which hosts matches and has begun, must outlive it.
  MatchBots(const Scene& scene, SharedPlay& play, const Settings& settings);

  /// Shows all that has come, and lets the bots decide; once a match is over they want another.
  /// Throws SessionError if a bot gets no bat, and what has ended the sharing.
  void look();

  /// The match that is shown; its number is 0 before the first.
  const MatchState& state() const { return state_; }
  const Game& game() const { return game_; }
  std::uint64_t presses() const { return presses_; }

 private:
  struct Bot {
    std::uint32_t number;
    std::unique_ptr<Player> player;  ///< null: it presses the keys of `plan`
    std::vector<InputEvent> plan{};
    std::size_t next = 0;  ///< of the plan
    KeysHeld held{};
    double due = 0.0;  ///< its next decision [s, simulated]
  };
  void take_seats();
  Bot bot_at(std::uint32_t number) const;
  void begin_match();
  void act(Bot& bot);
  void hold(Bot& bot, KeysHeld wanted);
  KeysHeld decide(Bot& bot) const;
  void press(Bot& bot, Key key, bool is_down);

  const Scene& scene_;
  SharedPlay& play_;
  Settings settings_;
  Game game_;
  MatchState state_{.winner = std::nullopt};
  std::uint32_t asked_for_ = 0;  ///< the match after which another one was asked for
  std::uint64_t presses_ = 0;
  std::vector<Bot> bots_;
};

}  // namespace rink::game
