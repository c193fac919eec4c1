// Players that play a game offline on its true state, and the log of their keys.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "game/control/game.h"
#include "game/players/attention.h"
#include "game/players/player.h"

namespace rink::game {

/// A game and a player for each of its bats. Each player decides on the true state every
/// decision_period, at a phase of its own; keys take effect at that instant. The same arguments
/// give the same events, and submitting these to a Game of the same scene gives the same game, bit
/// for bit.
class Playing {
 public:
  /// The kind of a bat without a player of its own: the caller plays it by press().
  static constexpr const char* hand = "hand";
  /// The kind of a bat that is left alone.
  static constexpr const char* nobody = "nobody";

  /// `kinds`, at least one: bat k is played by kind k modulo their number, each `hand`, `nobody`,
  /// "random" or one of player_kinds() (asserted). `until`: how long random players press keys [s].
  /// `engine`: what moves the bodies.
  Playing(const Scene& scene, const std::vector<std::string>& kinds, std::uint64_t seed,
          double until, const physics::SimulatorChoice& engine = {});

  /// Plays up to and including `until` [s].
  void advance(double until) { play(until, nullptr); }
  /// As Game's.
  bool advance(double until, physics::EventBudget& budget) { return play(until, &budget); }

  /// A key of `player`, whose kind is `hand` (asserted), at now(), or right after it if others have
  /// pressed theirs then.
  void press(std::uint32_t player, Key key, bool is_down);
  /// As press: the bat is pushed so from now on.
  void push(std::uint32_t player, const Push& push);

  const Game& game() const { return game_; }
  /// As Game's: makes `events` list all events of bodies in the last `advance`.
  void record_events(bool is_wanted);
  std::span<const physics::Event> events() const { return happened_; }
  /// Pucks that went to the other side as their time in one half was over.
  std::uint64_t serve_count() const { return serve_count_; }
  /// All keys and pushes up to now(), ordered by time, then player.
  std::vector<InputEvent> keys() const;

  /// Asserts that seats are in order of phase and keys in order of time, each of a player.
  void check() const;

 private:
  struct Seat {
    std::uint32_t number;
    double phase;
    std::unique_ptr<Player> player;
    KeysHeld held;
    Nearest<EntityId> watched;  ///< pucks it has an eye on
    std::uint64_t decisions = 0;
  };

  bool play(double until, physics::EventBudget* budget);
  bool play_until(double instant, physics::EventBudget* budget);
  void decide(Seat& seat, double instant);
  void look_about(Seat& seat, const Vector2& from, double instant);
  void locate_pucks(double instant);
  void press(Seat& seat, KeysHeld wanted, double instant);
  void submit(const InputEvent& event);

  Game game_;
  std::vector<Seat> seats_;  ///< in order of phase
  std::uint64_t turn_ = 0;   ///< decisions made; seats take turns
  std::vector<InputEvent> planned_, decided_;
  std::vector<SeenEntity> seen_;
  struct Located {
    EntityId puck;
    Vector2 position;
  };
  std::vector<Located> located_;  ///< all pucks in play, where they were at located_s_
  double located_s_ = -1.0;
  std::uint64_t serve_count_ = 0;
  bool records_events_ = false;
  std::vector<physics::Event> happened_;
};

}  // namespace rink::game
