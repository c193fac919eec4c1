// The preconditions of clause 8, in the order of its services.
#include "rti/time/federate_clock.h"

#include <cassert>
#include <cstdio>
#include <string>

#include "rti/hla_error.h"

namespace rink::rti {

namespace {

std::string seconds(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g s", value);
  return text;
}

[[noreturn]] void refuse(HlaError error, const std::string& about) {
  throw RtiException(error, about);
}

}  // namespace

void FederateClock::ask_regulation(double lookahead) {
  if (!is_valid_lookahead(lookahead))
    refuse(HlaError::invalid_lookahead,
           "a lookahead of " + seconds(lookahead) + "; it must be finite and not negative");
  if (is_advancing_)
    refuse(HlaError::in_time_advancing_state,
           "regulation can't be enabled while an advance to " + seconds(asked_) + " is under way");
  if (awaits_regulation_)
    refuse(HlaError::request_for_time_regulation_pending, "wait for time_regulation_enabled");
  if (is_regulating_)
    refuse(HlaError::time_regulation_already_enabled, "modify_lookahead changes its lookahead");
  is_regulating_ = awaits_regulation_ = true;
  lookahead_ = lookahead;
}

void FederateClock::ask_no_regulation() {
  if (!is_regulating()) refuse(HlaError::time_regulation_is_not_enabled, "nothing to disable");
  is_regulating_ = false;
  final_count_ = sent_count_;
}

void FederateClock::ask_constrained() {
  if (is_advancing_)
    refuse(HlaError::in_time_advancing_state,
           "constraint can't be enabled while an advance to " + seconds(asked_) + " is under way");
  if (awaits_constraint_)
    refuse(HlaError::request_for_time_constrained_pending, "wait for time_constrained_enabled");
  if (is_constrained_) refuse(HlaError::time_constrained_already_enabled, "it is");
  is_constrained_ = awaits_constraint_ = true;
}

void FederateClock::ask_no_constrained() {
  if (!is_constrained()) refuse(HlaError::time_constrained_is_not_enabled, "nothing to disable");
  is_constrained_ = false;
}

void FederateClock::ask_advance(AdvanceKind kind, double time) {
  if (!is_valid_time(time))
    refuse(HlaError::invalid_logical_time,
           "an advance to " + seconds(time) + "; it must be finite and not negative");
  if (is_advancing_)
    refuse(HlaError::in_time_advancing_state,
           "the advance to " + seconds(asked_) + " has not been granted yet");
  if (awaits_regulation_)
    refuse(HlaError::request_for_time_regulation_pending, "wait for time_regulation_enabled");
  if (awaits_constraint_)
    refuse(HlaError::request_for_time_constrained_pending, "wait for time_constrained_enabled");
  if (time < time_)
    refuse(HlaError::logical_time_already_passed,
           "an advance to " + seconds(time) + " from " + seconds(time_));
  is_advancing_ = true;
  kind_ = kind;
  asked_ = time;
  if (kind == AdvanceKind::time_advance || kind == AdvanceKind::time_advance_available)
    floor_ = std::max(floor_, earliest_stamp(time, lookahead_, kind));
}

void FederateClock::ask_lookahead(double lookahead) {
  if (!is_valid_lookahead(lookahead))
    refuse(HlaError::invalid_lookahead,
           "a lookahead of " + seconds(lookahead) + "; it must be finite and not negative");
  if (is_advancing_)
    refuse(HlaError::in_time_advancing_state,
           "the lookahead can't change while an advance to " + seconds(asked_) + " is under way");
  if (!is_regulating())
    refuse(HlaError::time_regulation_is_not_enabled, "only a regulating federate has a lookahead");
  lookahead_ = lookahead;
  floor_ = std::max(floor_, time_ + lookahead);
}

void FederateClock::ask_asynchronous(bool is_wanted) {
  if (is_wanted && is_asynchronous_)
    refuse(HlaError::asynchronous_delivery_already_enabled, "it is");
  if (!is_wanted && !is_asynchronous_)
    refuse(HlaError::asynchronous_delivery_already_disabled, "it is");
  is_asynchronous_ = is_wanted;
}

double FederateClock::earliest() const {
  assert(!is_advancing_ || asked_ >= time_);
  return is_advancing_ ? std::max(floor_, earliest_stamp(asked_, lookahead_, kind_)) : floor_;
}

double FederateClock::lookahead() const {
  if (!is_regulating())
    refuse(HlaError::time_regulation_is_not_enabled, "only a regulating federate has a lookahead");
  return floor_ > just_after(time_ + lookahead_) ? std::max(lookahead_, floor_ - time_)
                                                 : lookahead_;
}

void FederateClock::check_send(double time) const {
  if (!is_valid_time(time) || time < earliest())
    refuse(HlaError::invalid_logical_time, "a message at " + seconds(time) +
                                               "; the least time stamp allowed is " +
                                               seconds(earliest()));
}

std::uint64_t FederateClock::ask_send(double time) {
  assert(is_regulating());
  check_send(time);
  return sent_count_++;
}

void FederateClock::ask_retraction(const RetractionHandle& handle, FederateHandle self) const {
  if (!is_regulating())
    refuse(HlaError::time_regulation_is_not_enabled, "only a regulating federate retracts");
  if (handle.sender != self || handle.number >= sent_count_)
    refuse(HlaError::invalid_message_retraction_handle,
           "no message of this federate has that handle");
  if (handle.number < final_count_)
    refuse(HlaError::message_can_no_longer_be_retracted,
           "regulation was disabled since it was sent");
  if (handle.time < earliest())
    refuse(HlaError::message_can_no_longer_be_retracted, "its time stamp " + seconds(handle.time) +
                                                             " lies before " + seconds(earliest()) +
                                                             ", the least that could be sent now");
}

bool FederateClock::regulation_enabled(double time, double earliest) {
  if (!awaits_regulation_ || !is_valid_time(time) || time < time_ || earliest < time) return false;
  awaits_regulation_ = false;
  time_ = time;
  floor_ = earliest;
  return true;
}

bool FederateClock::constrained_enabled(double time) {
  if (!awaits_constraint_ || time != time_) return false;
  awaits_constraint_ = false;
  return true;
}

bool FederateClock::granted(double time) {
  if (!is_advancing_ || time < time_ || time > asked_) return false;
  is_advancing_ = false;
  time_ = time;
  if (is_regulating_) floor_ = std::max(floor_, earliest_stamp(time, lookahead_, kind_));
  return true;
}

}  // namespace rink::rti
