// The flow of matches between two players: countdown, pause, absence, win, rematch. It runs on real
// time; the game itself stands still unless `runs()`.
#pragma once

#include <array>
#include <cassert>
#include <cstdint>
#include <optional>
#include <string>

#include "game/control/game.h"

namespace rink::game {

/// The phases of a match. Simulated time runs in `playing` only.
enum class MatchPhase : std::uint8_t {
  waiting,    ///< for the other player
  countdown,  ///< to the face-off that opens it, or to go on after a pause
  playing,
  paused,
  away,  ///< a player has left and has some time to come back
  over,
  lost  ///< the connection or the match was lost: only callers set this
};

/// The state of a match, besides the game, that players and watchers receive.
struct MatchState {
  std::uint32_t number = 0;  ///< of the match, from 1; 0 before the first
  MatchPhase phase = MatchPhase::waiting;
  double until_s = 0.0;  ///< end of the countdown or of the wait for an absent player [s, real
                         ///< time]
  double clock_real_s = 0.0,
         clock_simulated_s = 0.0;       ///< a simulated instant and its real time; while playing,
                                        ///< both advance from there [s]
  std::array<bool, 2> wants_rematch{};  ///< by player
  std::optional<Team> winner;           ///< once it is over
  /// On whose side the puck is for the last seconds of its time while it is played: then `until_s`
  /// is when it goes to the other; set by the host, no rule depends on it.
  std::optional<Team> holder{};
  bool is_unrecorded = false;  ///< the last match could not be recorded; set by the host, no rule
                               ///< depends on it
  bool takes_keys_alone = false;  ///< no pushes; set by the host, no rule depends on it
  friend bool operator==(const MatchState&, const MatchState&) = default;
};

/// The simulated instant [s] at real time `real_s` by `state`; the end of a countdown is predicted.
double simulated_at(const MatchState& state, double real_s);

/// The reason why `scene` is not for a match of two with a winner; nothing if it is.
std::optional<std::string> match_objection(const Scene& scene);

/// The puck of `team` that goes to the other side first, at `until` [s, simulated].
struct EndingPossession {
  Team team = Team::none;
  double until = 0.0;
};

/// In its last `possession_shown_s` [s]; nothing before, and without such a rule.
inline constexpr double possession_shown_s = 3.0;
std::optional<EndingPossession> ending_possession(const Game& game);

/// How long things take [s].
struct FlowTimes {
  double countdown_s = 3.0;
  double patience_s = 30.0;  ///< wait for an absent player
};

/// The rules around a match of two. Pure: every call takes the real time [s], which never falls.
/// Player 0 is on the left.
class MatchFlow {
 public:
  explicit MatchFlow(const FlowTimes& times = {}) : times_(times) {
    assert(times.countdown_s >= 0.0 && times.patience_s >= 0.0);
  }
  /// Goes on where another flow was. So players are there as `state` demands, and where it leaves
  /// that open as `are_here` says.
  MatchFlow(const FlowTimes& times, const MatchState& state, std::array<bool, 2> are_here);

  /// Lets time pass: countdowns and waits end.
  void advance(double now_s);
  /// `player` takes the seat; one that was absent may continue where the match stopped.
  void enter(std::uint32_t player, double now_s);
  void leave(std::uint32_t player, double now_s);
  /// Any player may pause a running match, and any may resume it, after a countdown.
  void pause(bool is_wanted, double now_s);
  /// Has effect once the match is over. When both have asked the next match begins.
  void ask_rematch(std::uint32_t player, double now_s);
  /// The game has come no further than `simulated_s` [s], for it has too many events; players go on
  /// counting from there.
  void fall_behind(double now_s, double simulated_s);
  /// The host itself stood still from `from_s` to `now_s`, both real time [s]: nothing of that
  /// counts. A match that was played goes on after a countdown.
  void stand_still(double from_s, double now_s);
  /// The match that was just begun goes on from `simulated_s` [s], as one that was played before.
  void begin_at(double simulated_s);
  /// `winner`, a team that has an end, has scored the last goal of the game.
  void win(Team winner, double now_s);

  const MatchState& state() const { return state_; }
  /// True while simulated time runs.
  bool runs() const { return state_.phase == MatchPhase::playing; }
  bool is_here(std::uint32_t player) const {
    assert(player < is_here_.size());
    return is_here_[player];
  }

  /// Asserts that the phase agrees with the players present, the winner and the requests for a
  /// rematch.
  void check() const;

 private:
  bool are_all_here() const { return is_here_[0] && is_here_[1]; }
  void begin_match(double now_s);
  void stop(double now_s);
  void count_down(double now_s);

  FlowTimes times_;
  MatchState state_;
  std::array<bool, 2> is_here_{};
};

}  // namespace rink::game
