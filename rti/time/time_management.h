// The seam of time management: decides when a federate may advance, and delivers the time-stamped
// messages before that.
#pragma once

#include <compare>
#include <cstdint>

#include "rti/time/logical_time.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

/// A message that waits for its receiver's time. Ordered as it is delivered: by time stamp, ties by
/// sender and the sender's count, so that the order does not depend on speed.
struct TimedEntry {
  double time = 0.0;
  std::uint32_t sender = 0;
  std::uint64_t number = 0;
  std::uint32_t message = 0;  ///< the caller's number
  std::uint32_t place = 0;    ///< the caller's number of this receiver of the message
  friend auto operator<=>(const TimedEntry&, const TimedEntry&) = default;
  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, time, sender, number, message, place);
  }
};

/// Receives deliveries and grants. Its functions may query the time management, but not change it.
class TimeListener {
 public:
  virtual ~TimeListener() = default;
  /// Called in time-stamp order, before the grant that the entry belongs to; once per entry that
  /// was not withdrawn.
  virtual void deliver(std::uint32_t federate, const TimedEntry& entry) = 0;
  /// The entry's receiver is gone.
  virtual void discard(std::uint32_t federate, const TimedEntry& entry) = 0;
  /// `earliest`: the least time stamp that the federate may use from now on.
  virtual void regulation_enabled(std::uint32_t federate, double time, double earliest) = 0;
  virtual void constrained_enabled(std::uint32_t federate, double time) = 0;
  virtual void grant(std::uint32_t federate, double time) = 0;
};

/// Federates are small dense numbers, as the federation execution counts them. One that has
/// requested nothing is at time 0, neither regulating nor constrained, and costs nothing. Services
/// return false, and change nothing, where the request is not allowed now. A replacement must keep
/// these promises, with every message that was sent in time-stamp order being known here before its
/// sender's next request:
///   - a constrained federate is delivered messages in order, all up to its grant before that
///   (flush queue: all), and none before a time that it was granted;
///   - a grant goes to the time asked for, or less as the kind of request says, never back, and
///   comes as soon as no regulating federate can send it anything earlier.
class TimeManagement {
 public:
  virtual ~TimeManagement() = default;

  virtual bool enable_regulation(std::uint32_t federate, double lookahead) = 0;
  virtual bool disable_regulation(std::uint32_t federate) = 0;
  virtual bool enable_constrained(std::uint32_t federate) = 0;
  /// The next `settle` delivers all that waits for the federate.
  virtual bool disable_constrained(std::uint32_t federate) = 0;
  virtual bool modify_lookahead(std::uint32_t federate, double lookahead) = 0;
  virtual bool request(std::uint32_t federate, AdvanceKind kind, double time) = 0;
  /// The federate is gone: it holds others back no more.
  virtual void remove(std::uint32_t federate, TimeListener& listener) = 0;

  /// True if the federate may send a message of that time stamp now.
  virtual bool may_send(std::uint32_t federate, double time) const = 0;
  /// The least time stamp that the federate may use, now or later; infinite if it does not
  /// regulate.
  virtual double earliest(std::uint32_t federate) const = 0;
  virtual bool is_constrained(std::uint32_t federate) const = 0;
  virtual bool is_regulating(std::uint32_t federate) const = 0;
  /// `federate` must be constrained.
  virtual void enqueue(std::uint32_t federate, const TimedEntry& entry) = 0;
  /// The entry must be waiting.
  virtual void withdraw(std::uint32_t federate, const TimedEntry& entry) = 0;

  /// Sends all grants that can be given by now.
  virtual void settle(TimeListener& listener) = 0;

  /// Greatest available logical time: nothing earlier can be sent to `federate` any more. Infinite
  /// if no other federate regulates. A time advance request to t is granted at once if t < GALT,
  /// the "available" one if t <= GALT; so one that excludes its own instant is the next double
  /// above it.
  virtual double galt(std::uint32_t federate) const = 0;
  /// Least incoming time stamp: the earliest that `federate` can still receive.
  virtual double lits(std::uint32_t federate) const = 0;
  virtual double time(std::uint32_t federate) const = 0;
};

}  // namespace rink::rti
