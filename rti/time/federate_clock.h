// A federate's own view of its logical time: what it may request and send now, checked before
// anything is sent.
#pragma once

#include <cstdint>

#include "rti/time/logical_time.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

/// Follows the services and the callbacks of time management. The `ask_…` functions throw
/// `RtiException` with the error's name in IEEE 1516.1-2010, or else note the request; the others
/// note the RTI's answers and return false for an answer to no request.
class FederateClock {
 public:
  /// 8.2: InvalidLookahead, InTimeAdvancingState, RequestForTimeRegulationPending,
  /// TimeRegulationAlreadyEnabled.
  void ask_regulation(double lookahead);
  /// 8.4: TimeRegulationIsNotEnabled.
  void ask_no_regulation();
  /// 8.5: InTimeAdvancingState, RequestForTimeConstrainedPending, TimeConstrainedAlreadyEnabled.
  void ask_constrained();
  /// 8.7: TimeConstrainedIsNotEnabled.
  void ask_no_constrained();
  /// 8.8 to 8.12: LogicalTimeAlreadyPassed, InvalidLogicalTime, InTimeAdvancingState,
  /// RequestForTimeRegulationPending, RequestForTimeConstrainedPending.
  void ask_advance(AdvanceKind kind, double time);
  /// 8.19: InvalidLookahead, InTimeAdvancingState, TimeRegulationIsNotEnabled.
  void ask_lookahead(double lookahead);
  /// 8.14, 8.15: AsynchronousDeliveryAlreadyEnabled, AsynchronousDeliveryAlreadyDisabled.
  void ask_asynchronous(bool is_wanted);
  /// Throws InvalidLogicalTime if a message of that time stamp would be too early.
  void check_send(double time) const;
  /// Checks as `check_send` and returns the number of the message. The federate must be regulating.
  std::uint64_t ask_send(double time);
  /// 8.21: TimeRegulationIsNotEnabled, InvalidMessageRetractionHandle,
  /// MessageCanNoLongerBeRetracted.
  void ask_retraction(const RetractionHandle& handle, FederateHandle self) const;

  bool regulation_enabled(double time, double earliest);
  bool constrained_enabled(double time);
  bool granted(double time);

  bool is_regulating() const { return is_regulating_ && !awaits_regulation_; }
  bool is_constrained() const { return is_constrained_ && !awaits_constraint_; }
  bool is_advancing() const { return is_advancing_; }
  double time() const { return time_; }
  /// 8.20: TimeRegulationIsNotEnabled. The actual lookahead: a shorter one takes effect only as
  /// time advances.
  double lookahead() const;
  /// The least time stamp that the federate may use now.
  double earliest() const;
  /// The least time stamp that the federate may use now or after a grant to a time before that
  /// asked for.
  double earliest_ever() const { return floor_; }
  /// True while messages in receive order have to wait: a constrained federate gets them while it
  /// advances, unless it asked to get them always (8.14).
  bool holds_receive_order() const {
    return is_constrained() && !is_advancing_ && !is_asynchronous_;
  }
  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, is_regulating_, is_constrained_, awaits_regulation_, awaits_constraint_,
                    is_advancing_, is_asynchronous_, kind_, time_, asked_, lookahead_, floor_,
                    sent_count_, final_count_);
  }

 private:
  bool is_regulating_ = false, is_constrained_ = false, awaits_regulation_ = false,
       awaits_constraint_ = false, is_advancing_ = false, is_asynchronous_ = false;
  AdvanceKind kind_ = AdvanceKind::time_advance;
  double time_ = 0.0, asked_ = 0.0, lookahead_ = 0.0;
  double floor_ =
      0.0;  ///< the least time stamp that it may use; never decreases while it regulates
  std::uint64_t sent_count_ = 0;
  std::uint64_t final_count_ =
      0;  ///< of these, those of a regulation that was disabled: they can't be retracted any more
};

}  // namespace rink::rti
