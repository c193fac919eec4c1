// The places of a server's ticks and its players' turns in logical time; the same numbers at both
// ends.
#pragma once

#include <cmath>
#include <cstdint>

namespace rink::game {

/// Tick k is played up to k h, h = 1 / rate, and its states carry that time stamp. Around it, in
/// fractions of h that leave both ends room for rounding:
///   +1/8  a player is granted this, having heard tick k, and then takes the turn that leads to
///   tick k + 1 +3/8  the time stamp of what it says in that turn: its lookahead is 1/4 +1/2  the
///   server is granted this, having heard every such turn, and plays tick k + 1 +3/4  the earliest
///   that it may then say: its lookahead is 1/4, too; tick k + 1 is later
struct TickGrid {
  double rate_hz = 1.0;

  double lookahead() const { return 0.25 / rate_hz; }
  /// A player's time once it has received tick `number`.
  double received(std::uint64_t number) const {
    return (static_cast<double>(number) + 0.125) / rate_hz;
  }
  /// The first tick that a player that was granted `time` may not have received; at least 1, for
  /// tick 0 is the start, which is sent without a time stamp.
  std::uint64_t next(double time) const {
    const std::uint64_t number = last(time);
    return number > 0 && received(number) > time ? number : number + 1;
  }
  /// The last tick that was received at `time`, which is below 1e12 ticks: 0 if none.
  std::uint64_t last(double time) const {
    return static_cast<std::uint64_t>(std::fmax(0.0, std::floor(time * rate_hz - 0.125 + 1e-6)));
  }
  /// The server's time once it has received all turns that lead to the tick after the one at
  /// `tick_s`.
  double turns_heard(double tick_s) const { return tick_s + 0.5 / rate_hz; }
};

}  // namespace rink::game
