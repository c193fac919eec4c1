// Logical time: the requests to advance, and the least time stamp that a federate may still use.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>

#include "rti/types.h"

namespace rink::rti {

/// Infinity in HLA: no message can come any more, or no federate sets a bound.
inline constexpr double time_unbounded = std::numeric_limits<double>::infinity();
inline bool is_valid_time(double time) {
  return time >= 0.0 && time < std::numeric_limits<double>::max();
}
inline bool is_valid_lookahead(double lookahead) {
  return lookahead >= 0.0 && lookahead < std::numeric_limits<double>::max();
}
/// The least instant after `time`.
inline double just_after(double time) { return std::nextafter(time, time_unbounded); }

/// The five requests of IEEE 1516.1-2010, 8.8 to 8.12; the numbers are those on the wire.
enum class AdvanceKind : std::uint8_t {
  time_advance,            ///< to the requested time, with every message up to and at it
  time_advance_available,  ///< the same, but more may come at that very time
  next_message,  ///< to the next message or the requested time, whichever is earlier, with every
                 ///< message at it
  next_message_available,  ///< the same, but more may come at that very time
  flush_queue,             ///< delivers all waiting messages at once, whatever their time
};
inline constexpr std::uint8_t advance_kind_max =
    static_cast<std::uint8_t>(AdvanceKind::flush_queue);
inline bool is_next_message(AdvanceKind kind) {
  return kind == AdvanceKind::next_message || kind == AdvanceKind::next_message_available;
}
/// True if a federate that is so granted to t has received all messages at t.
inline bool is_complete(AdvanceKind kind) {
  return kind == AdvanceKind::time_advance || kind == AdvanceKind::next_message;
}

/// The least time stamp that a federate may use which is at `time`, or requests it, by a request of
/// `kind`. A federate that has received all messages of an instant may send none at it any more,
/// which matters when its lookahead is zero, or so small that the sum is rounded to the time. Both
/// ends compute this and must agree to the last bit.
inline double earliest_stamp(double time, double lookahead, AdvanceKind kind) {
  assert(lookahead >= 0.0);
  const double sum = time + lookahead;
  return is_complete(kind) ? std::max(sum, just_after(time)) : sum;
}

}  // namespace rink::rti
