// How far a federate is with joining its federation execution.
#pragma once

#include <cassert>
#include <cstdint>

#include "rti/handles.h"
#include "rti/hla_error.h"

namespace rink::rti {

/// The phases follow in one direction: a federate joins once, and a membership that has ended stays
/// ended.
class JoinPhase {
 public:
  bool is_idle() const { return phase_ == Phase::idle; }
  bool is_joining() const { return phase_ == Phase::joining; }
  bool is_joined() const { return phase_ == Phase::joined; }
  bool has_ended() const { return phase_ == Phase::ended; }
  /// True if the federate may send anything but questions to a host.
  bool may_send() const { return is_joining() || is_joined(); }
  /// Empty before it has joined.
  FederateHandle federate() const { return federate_; }

  /// Throw FederateNotExecutionMember.
  void require_joined() const {
    if (!is_joined()) refuse();
  }
  void require_sending() const {
    if (!may_send()) refuse();
  }

  void begin_joining() {
    assert(is_idle());
    phase_ = Phase::joining;
  }
  void joined(FederateHandle federate) {
    assert(is_joining());
    phase_ = Phase::joined;
    federate_ = federate;
  }
  void restored(FederateHandle federate) {
    assert(is_joined());
    federate_ = federate;
  }
  void end() { phase_ = Phase::ended; }

 private:
  enum class Phase : std::uint8_t { idle, joining, joined, ended };
  [[noreturn]] void refuse() const {
    throw RtiException(
        HlaError::federate_not_execution_member,
        has_ended() ? "this federate has left its federation execution" : "join first");
  }

  Phase phase_ = Phase::idle;
  FederateHandle federate_;
};

}  // namespace rink::rti
