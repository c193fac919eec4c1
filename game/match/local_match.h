// A match on this machine: two at one keyboard, one against a bot, or two bots to watch.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "game/control/key_log.h"
#include "game/control/match_flow.h"
#include "game/control/playing.h"
#include "game/match/hand_spring.h"
#include "game/match/match_source.h"
#include "game/match/noises.h"
#include "game/match/sight.h"

namespace rink::game {

struct LocalMatchSettings {
  std::uint64_t seed = 1;  ///< of the bots; each rematch takes the next
  std::vector<std::string> players{
      "hand", "hand"};  ///< of the left and the right bat: Playing::hand or a player's kind
  std::string left_name = "left", right_name = "right";
  FlowTimes times{};
  std::string scene_text{};  ///< the scene's file, so that records need no other
};

/// Simulated time follows real time, except in pauses, countdowns and frames longer than
/// `frame_max_s`.
class LocalMatch final : public MatchSource {
 public:
  /// `scene` must be for a match of two with a winner (asserted).
  LocalMatch(const Scene& scene, const LocalMatchSettings& settings);

  static constexpr double frame_max_s = 0.1;

  void advance(double now_s) override;
  const MatchSight& sight() const override { return sight_; }
  std::uint32_t hand_count() const override { return static_cast<std::uint32_t>(hands_.size()); }
  void press(std::uint32_t hand, Key key, bool is_down) override;
  void reach(std::uint32_t hand, const std::optional<Vector2>& place) override;
  std::string why_keys_alone() const override { return ""; }
  void pause(bool is_wanted) override;
  void rematch() override;

  /// One line for the player, shown until another is set.
  void set_notice(std::string notice) { sight_.notice = std::move(notice); }
  /// Ends the match, so that it is recorded.
  void finish();
  /// The record of the present match as it stands; nothing if it has not begun or is recorded.
  std::optional<KeyLog> record_so_far() const;
  /// Records of the matches that ended or were abandoned since the last call.
  std::vector<KeyLog> take_finished() { return std::exchange(finished_, {}); }
  /// The game since the last face-off that opened a match.
  const Playing& playing() const { return *playing_; }

 private:
  struct PressedKey {
    std::uint32_t hand;
    Key key;
    bool is_down;
  };
  void begin(double now_s);
  void play(double duration_s);
  void push_bats();
  void show();

  Scene scene_;
  LocalMatchSettings settings_;
  MatchFlow flow_;
  std::vector<std::uint32_t> hands_;   ///< bats that persons play
  std::array<HandSpring, 2> springs_;  ///< by hand
  std::unique_ptr<Playing> playing_;
  std::vector<PressedKey> pressed_;
  std::vector<KeyLog> finished_;
  bool is_finished_ = true;  ///< the present match is recorded
  std::uint32_t match_number_ = 0;
  double now_s_ = -1.0;
  double played_s_ = 0.0;  ///< simulated time of the present match; the game stops at multiples of
                           ///< key_grid, at which persons press keys
  MatchSight sight_;
  GameSight game_sight_;
  NoiseDetector noises_;
  GoalWatch goals_;
};

}  // namespace rink::game
