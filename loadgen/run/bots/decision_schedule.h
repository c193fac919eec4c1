// The instants at which bots decide that choose their own keys.
#pragma once

#include <cstdint>
#include <vector>

namespace rink::loadgen {

/// Bots take turns, each by its phase within game::decision_period. Decisions have a fixed
/// schedule, as planned keys have, so that a late bot counts as late.
class DecisionSchedule {
 public:
  /// No bot decides.
  DecisionSchedule() = default;
  /// `count` bots, which play bats `first`, first + 1, ...
  DecisionSchedule(std::uint32_t first, std::uint32_t count);

  bool is_empty() const { return order_.empty(); }
  /// A crowd that joins a running game at `simulated_s` [s] decides from then on.
  void begin(double simulated_s);
  /// The simulated instant of the next decision of all bots [s]; the schedule must not be empty
  /// (asserted).
  double next_s() const;
  /// Takes that decision and returns its bot.
  std::uint32_t take();
  /// For a crowd in the server's turns: true if `bot` has a decision due by `instant` [s], at most
  /// once in each period.
  bool take_due(std::uint32_t bot, double instant);

 private:
  std::vector<double> phases_;        ///< in order of turns
  std::vector<std::uint32_t> order_;  ///< bots by their phases
  std::uint64_t next_turn_ = 0;       ///< decisions made by all
  std::vector<double> next_of_bot_;   ///< where the server waits for turns
};

}  // namespace rink::loadgen
