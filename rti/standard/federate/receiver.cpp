// Callbacks of federation and declaration management and of time.
#include "rti/standard/federate/receiver.h"

#include <set>
#include <string>

#include "rti/standard/handles.h"
#include "rti/standard/values.h"
#include "rti/standard/wide_text.h"

namespace rink::standard {

namespace {

using User = rti1516e::FederateAmbassador;

std::set<std::wstring> wide_names(const std::vector<std::string>& names) {
  std::set<std::wstring> wide;
  for (const std::string& each : names) wide.insert(to_wide(each));
  return wide;
}

}  // namespace

void Receiver::joined(rti::FederateHandle) { state_.answers.is_joined = true; }

void Receiver::join_refused(rti::Refusal refusal, std::string_view why) {
  state_.answers.join_refused = {rti::error_of(refusal), std::string(why)};
}

void Receiver::connection_lost(std::string_view why) {
  state_.lost_because = why;
  deliver([](User& user, const std::wstring& reason) { user.connectionLost(reason); },
          to_wide(why));
}

void Receiver::federation_execution_created(std::string_view, rti::HlaError error) {
  state_.answers.created = error;
}

void Receiver::federation_execution_destroyed(std::string_view, rti::HlaError error) {
  state_.answers.destroyed = error;
}

void Receiver::report_federation_executions(
    const std::vector<rti::FederationExecutionInformation>& executions) {
  rti1516e::FederationExecutionInformationVector list;
  list.reserve(executions.size());
  for (const rti::FederationExecutionInformation& each : executions)
    list.emplace_back(to_wide(each.federation), rti1516e::HLAfloat64TimeName);
  deliver([](User& user, const auto& found) { user.reportFederationExecutions(found); }, list);
}

void Receiver::synchronization_point_registration_succeeded(std::string_view label) {
  deliver([](User& user,
             const std::wstring& wide) { user.synchronizationPointRegistrationSucceeded(wide); },
          to_wide(label));
}

void Receiver::synchronization_point_registration_failed(std::string_view label,
                                                         rti::SynchronizationFailure failure) {
  // Rink's own limit, which the standard has no reason for, is told as the label's fault.
  const auto reason = failure == rti::SynchronizationFailure::member_not_joined
                          ? rti1516e::SYNCHRONIZATION_SET_MEMBER_NOT_JOINED
                          : rti1516e::SYNCHRONIZATION_POINT_LABEL_NOT_UNIQUE;
  deliver([](User& user, const std::wstring& wide,
             auto why) { user.synchronizationPointRegistrationFailed(wide, why); },
          to_wide(label), reason);
}

void Receiver::announce_synchronization_point(std::string_view label, rti::Bytes tag) {
  deliver(
      [](User& user, const std::wstring& wide, const rti1516e::VariableLengthData& data) {
        user.announceSynchronizationPoint(wide, data);
      },
      to_wide(label), data_of(tag));
}

void Receiver::federation_synchronized(std::string_view label,
                                       std::span<const rti::FederateHandle> failed) {
  rti1516e::FederateHandleSet set;
  for (const rti::FederateHandle each : failed) set.insert(to_standard(each));
  deliver(
      [](User& user, const std::wstring& wide, const rti1516e::FederateHandleSet& federates) {
        user.federationSynchronized(wide, federates);
      },
      to_wide(label), set);
}

void Receiver::federate_joined(rti::FederateHandle federate, std::string_view, std::string_view) {
  if (federate == state_.core->federate()) state_.answers.is_self_known = true;
}

void Receiver::start_registration_for_object_class(rti::ObjectClassHandle object_class) {
  deliver([](User& user, const auto& handle) { user.startRegistrationForObjectClass(handle); },
          to_standard(object_class));
}

void Receiver::stop_registration_for_object_class(rti::ObjectClassHandle object_class) {
  deliver([](User& user, const auto& handle) { user.stopRegistrationForObjectClass(handle); },
          to_standard(object_class));
}

void Receiver::turn_interactions_on(rti::InteractionClassHandle interaction_class) {
  deliver([](User& user, const auto& handle) { user.turnInteractionsOn(handle); },
          to_standard(interaction_class));
}

void Receiver::turn_interactions_off(rti::InteractionClassHandle interaction_class) {
  deliver([](User& user, const auto& handle) { user.turnInteractionsOff(handle); },
          to_standard(interaction_class));
}

void Receiver::turn_updates_on_for_object_instance(rti::ObjectHandle object,
                                                   rti::AttributeSet attributes) {
  deliver_of(
      object,
      [](User& user, const auto& handle, const auto& set) {
        user.turnUpdatesOnForObjectInstance(handle, set);
      },
      to_standard(object), to_standard(attributes));
}

void Receiver::turn_updates_off_for_object_instance(rti::ObjectHandle object,
                                                    rti::AttributeSet attributes) {
  deliver_of(
      object,
      [](User& user, const auto& handle, const auto& set) {
        user.turnUpdatesOffForObjectInstance(handle, set);
      },
      to_standard(object), to_standard(attributes));
}

void Receiver::object_instance_name_reservation_succeeded(std::string_view name) {
  state_.reserved_names.emplace(name);
  deliver([](User& user,
             const std::wstring& wide) { user.objectInstanceNameReservationSucceeded(wide); },
          to_wide(name));
}

void Receiver::object_instance_name_reservation_failed(std::string_view name) {
  deliver(
      [](User& user, const std::wstring& wide) { user.objectInstanceNameReservationFailed(wide); },
      to_wide(name));
}

void Receiver::multiple_object_instance_name_reservation_succeeded(
    const std::vector<std::string>& names) {
  state_.reserved_names.insert(names.begin(), names.end());
  deliver([](User& user,
             const auto& wide) { user.multipleObjectInstanceNameReservationSucceeded(wide); },
          wide_names(names));
}

void Receiver::multiple_object_instance_name_reservation_failed(
    const std::vector<std::string>& names) {
  deliver(
      [](User& user, const auto& wide) { user.multipleObjectInstanceNameReservationFailed(wide); },
      wide_names(names));
}

void Receiver::time_regulation_enabled(rti::LogicalTime time) {
  state_.deliveries.put([this, now = time.value](User& user) {
    std::unique_lock lock(mutex_);
    state_.time.is_regulation_pending = false;
    state_.time.now = now;
    const auto told = state_.times.time(now);
    lock.unlock();
    user.timeRegulationEnabled(*told);
  });
}

void Receiver::time_constrained_enabled(rti::LogicalTime time) {
  state_.deliveries.put([this, now = time.value](User& user) {
    std::unique_lock lock(mutex_);
    state_.time.is_constrained_pending = false;
    state_.time.now = now;
    const auto told = state_.times.time(now);
    lock.unlock();
    user.timeConstrainedEnabled(*told);
  });
}

void Receiver::time_advance_grant(rti::LogicalTime time) {
  state_.deliveries.put([this, now = time.value](User& user) {
    std::unique_lock lock(mutex_);
    state_.time.is_advancing = false;
    state_.time.now = now;
    const auto told = state_.times.time(now);
    lock.unlock();
    user.timeAdvanceGrant(*told);
  });
}

void Receiver::request_retraction(const rti::RetractionHandle& handle) {
  if (state_.deliveries.take_back(handle)) return;
  deliver([](User& user, const auto& retracted) { user.requestRetraction(retracted); },
          to_standard(handle));
}

void Receiver::time_bounds(double galt, double lits) { state_.answers.bounds = {galt, lits}; }

}  // namespace rink::standard
