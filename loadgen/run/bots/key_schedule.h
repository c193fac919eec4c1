// The keys that a crowd's bots press: all in order of time, and each bot's alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "game/model/key.h"

namespace rink::loadgen {

struct KeyChange {
  game::Key key;
  bool is_down;
};
struct DueKey {
  double time;        ///< simulated [s]
  std::uint32_t bot;  ///< its number in the crowd
  KeyChange change;
};

/// The players and the time from which a crowd takes keys of a plan.
struct PlanPart {
  std::uint32_t first = 0, count = 0;  ///< players
  double begun_s = 0.0;                ///< keys up to then have been pressed; 0: none
  double until_s = 0.0;
};

/// Either all keys are taken by the clock, or each bot takes its own at its turns.
class KeySchedule {
 public:
  KeySchedule() = default;
  /// `plan` is ordered by time.
  KeySchedule(std::span<const game::InputEvent> plan, const PlanPart& part);

  /// The instant of the next key of all bots [s]; nothing if all were taken.
  std::optional<double> next_s() const;
  /// Takes that key; there must be one (asserted).
  const DueKey& take();
  /// The next key of `bot` that is due by `instant` [s], or null.
  const DueKey* take_due(std::uint32_t bot, double instant);

 private:
  void list_by_bot(std::uint32_t bot_count);

  std::vector<DueKey> keys_;
  std::size_t next_ = 0;
  /// Numbers of keys: bot k's that are still to come are those from next_of_bot_[k] up to
  /// end_of_bot_[k] of by_bot_.
  std::vector<std::uint32_t> by_bot_, next_of_bot_, end_of_bot_;
};

}  // namespace rink::loadgen
