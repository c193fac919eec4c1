// Shows the progress of a long simulation.
#pragma once

#include <cstdint>
#include <ostream>

namespace rink::game {

/// A line that is overwritten in place on a terminal, one plain line every few seconds elsewhere.
/// Short runs show nothing. It reads no clock; callers pass the time.
class SimulateProgress {
 public:
  SimulateProgress(std::ostream& out, bool is_terminal, double until)
      : out_(out), is_terminal_(is_terminal), until_(until) {}

  /// `simulated_s` of the run's time and `event_count` events are done after `wall_s`. Shows it if
  /// a line is due.
  void reached(double simulated_s, std::uint64_t event_count, double wall_s);
  /// Clears the line that is overwritten in place.
  void clear();

 private:
  static constexpr double quiet_s = 2.0, between_lines_s = 5.0, between_overwrites_s = 0.2;

  std::ostream& out_;
  bool is_terminal_;
  double until_;
  double next_s_ = quiet_s;
  bool is_shown_ = false;
};

}  // namespace rink::game
