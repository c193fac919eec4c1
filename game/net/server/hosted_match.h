// Hosts one match of a scene after the other for the two seats: the flow on the clock, and the
// records.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "game/control/game.h"
#include "game/control/key_log.h"
#include "game/control/match_flow.h"

namespace rink::game {

/// Settings of hosted matches: one game of the scene after the other, for the two seats
/// (docs/play.md, "The match over the network").
struct Hosting {
  FlowTimes times;
  std::string scene_text;  ///< the scene's file, which players predict from and records include; at
                           ///< most SceneText::size_max bytes
  std::optional<KeyLog> begun{};  ///< the record that the first match goes on from; there must be
                                  ///< no objection to it by begun_match()
};

/// Reads no clock: `now_s` is real time [s], which never falls. Its owner has the game, which is
/// played and published like any other.
class HostedMatch {
 public:
  /// There must be no match_objection() to the scene (asserted).
  HostedMatch(const Hosting& hosting, const Scene& scene);

  /// Elsewhere the rules are kept to, and the match stands so: what happens here has no effect on
  /// it from now on.
  void follow(const MatchState& state) { led_ = state; }

  /// Time has passed to `now_s`. Call it before all else that has a time: if it was not called for
  /// longer than `stood_still_s` [s], the host stood still meanwhile, which is left out.
  void pass(double now_s);
  static constexpr double stood_still_s = 1.0;

  void enter(std::uint32_t player, double now_s) {
    if (!led_) flow_.enter(player, now_s);
  }
  void leave(std::uint32_t player, double now_s) {
    if (!led_) flow_.leave(player, now_s);
  }
  void pause(bool is_wanted, double now_s) { flow_.pause(is_wanted, now_s); }
  void ask_rematch(std::uint32_t player, double now_s) { flow_.ask_rematch(player, now_s); }

  /// Lets time pass. True if the next match is due: its owner then calls begin().
  bool advance(double now_s);
  /// The game of the next match; `last` is that of the one before.
  Game begin(const Game& last);
  /// What led to the game that was begun last, once: nothing unless that goes on from a record.
  std::vector<InputEvent> take_begun() { return std::exchange(begun_events_, {}); }
  /// The time to which the game, now at `played` [s], must be simulated.
  double goal(double now_s, double played) const;
  /// At `now_s` the game has come no further than `played` [s]: it goes on from there.
  void fall_behind(double now_s, double played) { flow_.fall_behind(now_s, played); }
  /// Ends the match if its game was won, and notes whose puck is about to go to the other side.
  void judge(const Game& game);

  /// Simulated time as players use it [s]; a countdown's end is predicted, so that keys that are
  /// stamped for the first instants of play are not late.
  double simulated(double now_s) const { return simulated_at(present(), now_s); }
  bool are_keys_felt() const;
  bool is_over() const { return present().phase == MatchPhase::over; }
  /// The state to publish to players.
  MatchState state() const;
  /// Simulated time of the matches before this one [s].
  double earlier_s() const { return earlier_s_; }
  const std::string& scene_text() const { return hosting_.scene_text; }

  /// The record of the present match as it stands, with these keys; nothing if it has not begun or
  /// is recorded.
  std::optional<KeyLog> record_so_far(const Game& game,
                                      const std::vector<InputEvent>& events) const;
  /// Makes the record of the present match, once.
  void finish(const Game& game, const std::vector<InputEvent>& events);
  /// Records of the matches that ended or were abandoned since the last call, in order.
  std::vector<KeyLog> take_finished() { return std::exchange(finished_, {}); }
  /// Notes whether the last record could not be written, which players see.
  void set_unrecorded(bool is_unrecorded) { is_unrecorded_ = is_unrecorded; }

 private:
  const MatchState& present() const { return led_ ? *led_ : flow_.state(); }

  Hosting hosting_;
  Scene scene_;
  MatchFlow flow_;
  std::optional<double> passed_s_;  ///< real time
  std::optional<MatchState> led_;   ///< instead of the flow's, by another
  std::uint32_t number_ = 0;        ///< of the match that was begun last
  double earlier_s_ = 0.0;
  std::vector<KeyLog> finished_;
  std::vector<InputEvent> begun_events_;
  bool is_recorded_ = false;  ///< the present match
  std::optional<EndingPossession> ending_possession_;
  bool is_unrecorded_ = false;  ///< the last match could not be recorded
};

}  // namespace rink::game
