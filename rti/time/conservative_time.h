// Conservative time management: no federate is granted a time before which another could still send
// to it.
#pragma once

#include <vector>

#include "rti/time/least_tree.h"
#include "rti/time/time_management.h"
#include "rti/time/time_queue.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

/// The lower bound on time stamps of Fujimoto 1998, with federates that wait for their next message
/// solved in closed form instead of by rounds of null messages (Chandy and Misra 1979):
/// docs/rti.md, "Time management", has the algorithm and its proof. A request, a message or a grant
/// costs a logarithm of the number of federates.
class ConservativeTime final : public TimeManagement {
 public:
  bool enable_regulation(std::uint32_t federate, double lookahead) override;
  bool disable_regulation(std::uint32_t federate) override;
  bool enable_constrained(std::uint32_t federate) override;
  bool disable_constrained(std::uint32_t federate) override;
  bool modify_lookahead(std::uint32_t federate, double lookahead) override;
  bool request(std::uint32_t federate, AdvanceKind kind, double time) override;
  void remove(std::uint32_t federate, TimeListener& listener) override;
  bool may_send(std::uint32_t federate, double time) const override;
  double earliest(std::uint32_t federate) const override;
  bool is_constrained(std::uint32_t federate) const override;
  bool is_regulating(std::uint32_t federate) const override;
  void enqueue(std::uint32_t federate, const TimedEntry& entry) override;
  void withdraw(std::uint32_t federate, const TimedEntry& entry) override;
  void settle(TimeListener& listener) override;
  double galt(std::uint32_t federate) const override;
  double lits(std::uint32_t federate) const override;
  double time(std::uint32_t federate) const override;
  /// Asserts that the trees hold what follows from the clocks.
  void check() const;
  template <class Stream>
  bool keep(Stream& stream) {
    if (!keep_all(stream, clocks_)) return false;
    if (Stream::is_reading) weigh_all();
    return true;
  }

 private:
  struct Clock {
    bool is_regulating = false, is_constrained = false;
    bool awaits_regulation = false, awaits_constraint = false,
         is_advancing = false;                     ///< asked for and not yet granted
    AdvanceKind kind = AdvanceKind::time_advance;  ///< of the present request
    double asked = 0.0;                            ///< the time asked for, while advancing
    double enabling = 0.0;  ///< the time that regulation begins at, while awaited
    double time = 0.0;      ///< logical time
    double lookahead = 0.0;
    double floor = 0.0;  ///< regulating: the least time stamp it may use, or may use once its
                         ///< request is granted; never decreases
    double horizon =
        0.0;  ///< the least time stamp that may still reach it without being in its past
    TimeQueue queue;
    template <class Stream>
    bool keep(Stream& stream) {
      return keep_all(stream, is_regulating, is_constrained, awaits_regulation, awaits_constraint,
                      is_advancing, kind, asked, enabling, time, lookahead, floor, horizon, queue);
    }
  };
  const Clock& clock(std::uint32_t federate) const;
  Clock& clock(std::uint32_t federate);
  bool awaits_message(const Clock& clock) const {
    return clock.is_advancing && clock.is_constrained && is_next_message(clock.kind);
  }
  static double goal(const Clock& clock);
  double need(const Clock& clock) const;
  void weigh(std::uint32_t federate);
  void weigh_all();
  double least_of_others(std::uint32_t federate, double bound) const;
  bool can_serve(std::uint32_t federate) const;
  void serve(std::uint32_t federate, TimeListener& listener);
  void advance(std::uint32_t federate, double galt, TimeListener& listener);
  void deliver(std::uint32_t federate, double until, TimeListener& listener);

  std::vector<Clock> clocks_;  ///< by federate
  /// By federate, infinite where there is nothing. Bounds: the least time stamp that a regulating
  /// federate can still use if nobody sends to it.
  LeastTree bounds_;
  /// For federates that wait for their next message: an earlier message can lower their bound to
  /// the later of their floor and the message's time + lookahead.
  LeastTree floors_, lookaheads_;
  /// The GALT at which a federate's request can be granted.
  LeastTree needs_;
};

}  // namespace rink::rti
