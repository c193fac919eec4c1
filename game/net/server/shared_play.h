// What a server asks of a simulation that it shares with other servers (game/node).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "game/control/game.h"
#include "game/control/match_flow.h"
#include "game/model/key.h"
#include "im/region.h"
#include "rti/transport/transport.h"

namespace rink::game {

/// What this server learns of a window.
struct ShownWindow {
  std::vector<InputEvent> keys;  ///< that took effect in it
  std::vector<EntityId> left,    ///< bodies that it receives no more, since none of its clients
                                 ///< can see them
      told;                      ///< those that changed, or that it receives again
};

/// What a server asks of the matches that it hosts together with others.
class SharedMatch {
 public:
  virtual ~SharedMatch() = default;
  /// How the match that is shown stands, in real time since the start [s].
  virtual MatchState state() = 0;
  /// What a player wants.
  virtual void pause(bool is_wanted) = 0;
  virtual void ask_rematch(std::uint32_t player) = 0;
};

/// All bats are in play from the start, and stay; keys are stamped by whoever owns the bat. Called
/// from one thread, and never waits. Functions throw what has ended the sharing.
class SharedPlay {
 public:
  /// The token of no player.
  static constexpr std::uint64_t nobody = 0;
  /// A player wants a bat: `token` is its own, by which it gets the bat back that it has left, at
  /// this server or another; `player` the bat that it would like best.
  struct SeatQuestion {
    std::uint64_t token = nobody;
    std::optional<std::uint32_t> player{};
  };
  /// The bat that it gets, if one is free.
  struct SeatAnswer {
    std::uint64_t token = nobody;
    std::optional<std::uint32_t> player{};
  };

  virtual ~SharedPlay() = default;

  /// The players who are seated at this server at the start: so many, from the first one on.
  virtual std::uint32_t first_player() const = 0;
  virtual std::uint32_t player_count() const = 0;

  /// To be called while this server waits for its players.
  virtual void check() = 0;
  /// This server's players are there; true once those of all others are.
  virtual bool may_begin() = 0;
  /// The game begins, everywhere at once: answers when, on the clock [s].
  virtual double begin() = 0;

  /// True from then on: bats are asked for, so that two servers do not give away the same.
  virtual bool has_begun() const = 0;
  virtual void ask_seat(const SeatQuestion& question) = 0;
  /// The next answer, in any order, once.
  virtual std::optional<SeatAnswer> next_seat() = 0;
  /// Before the game begins: a player of this token has a bat that is seated at this server.
  virtual void keep_seat(std::uint32_t player, std::uint64_t token) = 0;
  /// The player has left, without pressed keys. Its bat is kept for it for a while.
  virtual void leave_seat(std::uint32_t player, std::uint64_t token) = 0;

  /// A player who is seated here presses or releases a key. In matches it is felt at `time` [s,
  /// simulated] or later, otherwise as soon as may be.
  virtual void press(std::uint32_t player, Key key, bool is_down, double time) = 0;
  /// This server's clients look at these regions now, or one of them at everything.
  virtual void look(std::span<const im::Region> regions, bool at_everything) = 0;
  /// True if all windows that end by `until` [s] are final, so that show_next() shows the last of
  /// them, or no more will be.
  virtual bool has_come(double until) const = 0;
  /// Shows in `game` what happened in the next window that is final and ends by `until` [s];
  /// nothing if there is no such window yet. In the last one the whole game is shown.
  virtual std::optional<ShownWindow> show_next(double until, Game& game) = 0;
  /// True once all that was played was shown: up to the agreed end, or the window in which a side
  /// has won; of matches, the end of the one that is shown.
  virtual bool has_shown_all() const = 0;
  /// What this server has sent each other one by the end of its last window, by number; nothing
  /// before the first window.
  virtual std::vector<rti::TransportCounters> sent() const = 0;
  /// Null if no matches are hosted.
  virtual SharedMatch* match() = 0;
};

}  // namespace rink::game
