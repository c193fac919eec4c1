// How a server goes on with a game that has more events than it can play in time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "game/control/game.h"
#include "game/physics/event_budget.h"

namespace rink::game {

struct TickBudgetSettings {
  std::uint64_t events_per_s = 0;  ///< of simulated time that are played in time; 0: any
  double tick_s = 1.0 / 30.0;      ///< between two ticks
  bool has_whole_ticks = false;    ///< states exist at ticks alone, as under time management: one
                                   ///< that is cut short is played on, to its end, before the next
};

/// What came of it.
struct TickBudgetCounters {
  std::uint64_t ticks_cut_short = 0;      ///< whole ticks count once for each part but the last
  double played_s = 0.0, wanted_s = 0.0;  ///< simulated time of these ticks, or of all such parts

  /// Of that of the ticks: real time, or the players' turns.
  double pace() const { return wanted_s > 0.0 ? played_s / wanted_s : 1.0; }
};

/// "N ticks were cut short, and the game fell S s behind".
std::string text_of(const TickBudgetCounters& counters);

/// A second that has more events than may be is cut short where they exceed it; from then on each
/// tick, or part of one, plays a quarter of a tick's share of them, until the next second begins.
/// So the game falls behind, and whoever waits for the server does not wait long. Says so when it
/// first happens, and then at ten times as many ticks.
class TickBudget {
 public:
  explicit TickBudget(const TickBudgetSettings& settings);

  /// Another game is played from now on, which begins at any time.
  void begin();
  /// Plays a tick up to `until` [s]; false if it was cut short. The next call goes on from there,
  /// with whole ticks to the same instant.
  bool advance(Game& game, double until);
  const TickBudgetCounters& counters() const { return counters_; }
  /// What is to be said since the last call, without an end.
  std::optional<std::string> take_complaint() { return std::exchange(complaint_, std::nullopt); }

 private:
  std::uint64_t share() const;
  void say(const Game& game);

  TickBudgetSettings settings_;
  std::optional<physics::EventBudget> events_;
  TickBudgetCounters counters_;
  std::uint64_t said_at_ = 1;  // ticks
  std::optional<std::string> complaint_;
};

}  // namespace rink::game
