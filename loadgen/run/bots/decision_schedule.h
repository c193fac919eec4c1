// When each bot of a crowd that decides for itself does so.
#pragma once

#include <cstdint>
#include <vector>

namespace rink::loadgen {

/// Bots take turns, each by its phase within game::decision_period. Decisions have a schedule of
/// their own, as planned keys have: a bot that is late is late for it.
class DecisionSchedule {
 public:
  /// Nobody decides.
  DecisionSchedule() = default;
  /// `count` bots, who play bats `first`, first + 1, ...
  DecisionSchedule(std::uint32_t first, std::uint32_t count);

  bool is_empty() const { return order_.empty(); }
  /// Who joins a game that runs already, at `simulated_s` [s], decides from then on.
  void begin(double simulated_s);
  /// The simulated instant of the next decision of all [s]; not if it is empty (asserted).
  double next_s() const;
  /// Whose that is; the next one comes after it.
  std::uint32_t take();
  /// Of a crowd that takes the server's turns: true if `bot` is to decide by `instant` [s], at most
  /// once in each period.
  bool take_due(std::uint32_t bot, double instant);

 private:
  std::vector<double> phases_;        ///< in order of turns
  std::vector<std::uint32_t> order_;  ///< bots by their phases
  std::uint64_t next_turn_ = 0;       ///< decisions made by all
  std::vector<double> next_of_bot_;   ///< where the server waits for turns
};

}  // namespace rink::loadgen
