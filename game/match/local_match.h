// A match that is played here: by two at one keyboard, or by one against a bot.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "game/control/key_log.h"
#include "game/match/match_source.h"
#include "game/match/noises.h"
#include "game/match/sight.h"
#include "game/players/player.h"

namespace rink::game {

struct LocalMatchSettings {
  std::string opponent{};    ///< one of player_kinds(), who plays the right bat: chaser-beginner, chaser and chaser-expert are three strengths; empty: a second person
  std::string scene_text{};  ///< the scene's file, so that records need no other
  std::uint64_t seed = 1;  ///< of the bot's mistakes
  FlowTimes times{};
};

/// Hand 0 plays the left bat, hand 1 the right one. Everything is shown as it is.
class LocalMatch final : public MatchSource {
 public:
  /// There must be no match_objection() to `scene` (asserted).
  LocalMatch(const Scene& scene, const LocalMatchSettings& settings);

  void advance(double now_s) override;
  const MatchSight& sight() const override { return sight_; }
  std::uint32_t hand_count() const override { return settings_.opponent.empty() ? 2 : 1; }
  void press(std::uint32_t hand, Key key, bool is_down) override;
  void pause(bool is_wanted) override;
  /// One keyboard asks for all who sit at it, and a bot always plays again.
  void rematch() override;

  /// The match ends here, so that there is a record of it.
  void finish();
  /// Records of the matches that came to their end, or were given up, since they were last taken.
  std::vector<KeyLog> take_finished() { return std::exchange(finished_, {}); }
  const Game& game() const { return game_; }

 private:
  struct PressedKey {
    std::uint32_t player;
    Key key;
    bool is_down;
  };

  void begin();
  void play(double until);
  void decide(double instant);
  void press_at(double instant, const PressedKey& key);
  void show(double now_s);

  Scene scene_;
  LocalMatchSettings settings_;
  MatchFlow flow_;
  Game game_;
  std::unique_ptr<Player> bot_;
  KeysHeld bot_holds_;
  std::uint64_t decisions_ = 0;
  std::vector<PressedKey> pressed_;
  std::vector<InputEvent> events_;
  std::vector<KeyLog> finished_;
  bool is_finished_ = true;  ///< the present match is recorded
  std::uint32_t number_ = 0;
  double now_s_ = 0.0;
  bool has_begun_ = false;
  MatchSight sight_;
  NoiseDetector noises_;
  GoalWatch goals_;
};

}  // namespace rink::game
