// A recorded match for watching, with pause, seeking and slow motion.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "game/control/replay.h"
#include "game/match/match_source.h"
#include "game/match/noises.h"
#include "game/match/sight.h"

namespace rink::game {

class ReplayMatch final : public MatchSource {
 public:
  /// A record that goes on longer after the win stops there; resumed, it is played to its end.
  static constexpr double after_win_s = 2.0;

  /// Throws SceneError, naming file, line and what is wrong, if the record is truncated, altered,
  /// of another version or incomplete.
  explicit ReplayMatch(const std::filesystem::path& file);

  void advance(double now_s) override;
  const MatchSight& sight() const override { return sight_; }
  std::uint32_t hand_count() const override { return 0; }
  void press(std::uint32_t, Key, bool) override {}
  void pause(bool is_wanted) override { is_paused_ = is_wanted; }
  /// Starts again from the beginning.
  void rematch() override;

  double end() const { return replay_.end(); }  ///< simulated [s]
  /// Goes to `instant` [s], or to the nearest one in the record; the next advance() shows it.
  void seek(double instant);
  /// Simulated seconds in a real one: 1 at first, 0 or more.
  void set_speed(double speed);
  double speed() const { return speed_; }
  bool is_paused() const { return is_paused_; }
  /// What each player does at the shown instant.
  struct Input {
    KeysHeld keys;
    Push push;
  };
  const std::vector<Input>& inputs() const { return inputs_; }
  /// Whether the last advance() went where seek() had asked it to go.
  bool was_sought() const { return was_sought_; }
  /// Whether the game ended in the recorded state; nothing before the end was reached.
  std::optional<bool> is_as_recorded() const { return replay_.is_as_recorded(); }

 private:
  void stop_after_win();
  void follow_inputs();
  static Replay read(const std::filesystem::path& file);

  Replay replay_;
  double wanted_ = 0.0;  ///< where to be [s]
  double now_s_ = 0.0, speed_ = 1.0;
  bool has_begun_ = false, is_paused_ = false, is_sought_ = false;
  std::optional<double> won_at_;  ///< when the match was seen to be won [s]
  bool has_stopped_ = false;      ///< after the win
  bool was_sought_ = false;
  std::vector<Input> inputs_;  ///< after the first events_taken_ of the record
  std::size_t events_taken_ = 0;
  MatchSight sight_;
  GameSight game_sight_;
  NoiseDetector noises_;
  GoalWatch goals_;
};

}  // namespace rink::game
