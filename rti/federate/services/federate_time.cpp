// A federate's requests about its logical time, and the RTI's answers.
#include "rti/federate/services/federate_time.h"

#include "rti/wire/time_messages.h"

namespace rink::rti {

void FederateTime::enable_regulation(double lookahead) {
  clock_.ask_regulation(lookahead);
  uses_.sender.keep_time();
  basis_.frames.enqueue(EnableTimeRegulationMessage{lookahead});
}

void FederateTime::disable_regulation() {
  clock_.ask_no_regulation();
  deletions_.clear();
  basis_.frames.enqueue(
      TimeSwitchMessage{static_cast<std::uint8_t>(TimeSwitch::disable_regulation)});
}

void FederateTime::enable_constrained() {
  clock_.ask_constrained();
  uses_.sender.keep_time();
  basis_.frames.enqueue(
      TimeSwitchMessage{static_cast<std::uint8_t>(TimeSwitch::enable_constrained)});
}

void FederateTime::disable_constrained() {
  clock_.ask_no_constrained();
  basis_.frames.enqueue(
      TimeSwitchMessage{static_cast<std::uint8_t>(TimeSwitch::disable_constrained)});
}

void FederateTime::request_advance(AdvanceKind kind, LogicalTime time) {
  clock_.ask_advance(kind, time.value);
  basis_.frames.enqueue(AdvanceRequestMessage{static_cast<std::uint8_t>(kind), time.value});
}

void FederateTime::modify_lookahead(double lookahead) {
  clock_.ask_lookahead(lookahead);
  basis_.frames.enqueue(ModifyLookaheadMessage{lookahead});
}

void FederateTime::query_bounds() { basis_.frames.enqueue(QueryTimeBoundsMessage{}); }

bool FederateTime::handle_regulation_enabled(Reader& reader) {
  TimeRegulationEnabledMessage message;
  if (!exchange(reader, message) || !clock_.regulation_enabled(message.time, message.earliest))
    return false;
  basis_.callbacks.time_regulation_enabled(LogicalTime(message.time));
  return true;
}

bool FederateTime::handle_constrained_enabled(Reader& reader) {
  TimeConstrainedEnabledMessage message;
  if (!exchange(reader, message) || !clock_.constrained_enabled(message.seconds)) return false;
  basis_.callbacks.time_constrained_enabled(LogicalTime(message.seconds));
  return true;
}

bool FederateTime::handle_grant(Reader& reader) {
  TimeAdvanceGrantMessage message;
  if (!exchange(reader, message) || !clock_.granted(message.seconds)) return false;
  ++basis_.counters.time_advance_grants;
  basis_.callbacks.time_advance_grant(LogicalTime(message.seconds));
  return true;
}

bool FederateTime::handle_retraction(Reader& reader) {
  RequestRetractionMessage message;
  if (!exchange(reader, message)) return false;
  basis_.callbacks.request_retraction({{message.sender}, message.number, message.time});
  return true;
}

bool FederateTime::handle_bounds(Reader& reader) {
  TimeBoundsMessage message;
  if (!exchange(reader, message)) return false;
  basis_.callbacks.time_bounds(message.galt, message.lits);
  return true;
}

}  // namespace rink::rti
