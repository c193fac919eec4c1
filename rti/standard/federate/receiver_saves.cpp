// Callbacks of saving and restoring.
#include "rti/standard/federate/receiver.h"
#include "rti/standard/handles.h"
#include "rti/standard/wide_text.h"

namespace rink::standard {

namespace {

using User = rti1516e::FederateAmbassador;

rti1516e::SaveFailureReason reason_of(rti::SaveFailure failure) {
  switch (failure) {
    case rti::SaveFailure::rti_unable_to_save:
      return rti1516e::RTI_UNABLE_TO_SAVE;
    case rti::SaveFailure::federate_reported_failure:
      return rti1516e::FEDERATE_REPORTED_FAILURE_DURING_SAVE;
    case rti::SaveFailure::federate_resigned:
      return rti1516e::FEDERATE_RESIGNED_DURING_SAVE;
    case rti::SaveFailure::save_time_cannot_be_honored:
      return rti1516e::SAVE_TIME_CANNOT_BE_HONORED;
    case rti::SaveFailure::save_aborted:
      return rti1516e::SAVE_ABORTED;
    case rti::SaveFailure::rti_detected_failure:
      break;
  }
  return rti1516e::RTI_DETECTED_FAILURE_DURING_SAVE;
}

rti1516e::RestoreFailureReason reason_of(rti::RestoreFailure failure) {
  switch (failure) {
    case rti::RestoreFailure::rti_unable_to_restore:
      return rti1516e::RTI_UNABLE_TO_RESTORE;
    case rti::RestoreFailure::federate_reported_failure:
      return rti1516e::FEDERATE_REPORTED_FAILURE_DURING_RESTORE;
    case rti::RestoreFailure::federate_resigned:
      return rti1516e::FEDERATE_RESIGNED_DURING_RESTORE;
    case rti::RestoreFailure::restore_aborted:
      return rti1516e::RESTORE_ABORTED;
    case rti::RestoreFailure::rti_detected_failure:
      break;
  }
  return rti1516e::RTI_DETECTED_FAILURE_DURING_RESTORE;
}

rti1516e::SaveStatus told_status(rti::SaveStatus status) {
  switch (status) {
    case rti::SaveStatus::instructed:
      return rti1516e::FEDERATE_INSTRUCTED_TO_SAVE;
    case rti::SaveStatus::saving:
      return rti1516e::FEDERATE_SAVING;
    case rti::SaveStatus::waiting:
      return rti1516e::FEDERATE_WAITING_FOR_FEDERATION_TO_SAVE;
    case rti::SaveStatus::none:
      break;
  }
  return rti1516e::NO_SAVE_IN_PROGRESS;
}

rti1516e::RestoreStatus told_status(rti::RestoreStatus status) {
  switch (status) {
    case rti::RestoreStatus::request_pending:
      return rti1516e::FEDERATE_RESTORE_REQUEST_PENDING;
    case rti::RestoreStatus::waiting_to_begin:
      return rti1516e::FEDERATE_WAITING_FOR_RESTORE_TO_BEGIN;
    case rti::RestoreStatus::prepared:
      return rti1516e::FEDERATE_PREPARED_TO_RESTORE;
    case rti::RestoreStatus::restoring:
      return rti1516e::FEDERATE_RESTORING;
    case rti::RestoreStatus::waiting:
      return rti1516e::FEDERATE_WAITING_FOR_FEDERATION_TO_RESTORE;
    case rti::RestoreStatus::none:
      break;
  }
  return rti1516e::NO_RESTORE_IN_PROGRESS;
}

}  // namespace

void Receiver::initiate_federate_save(std::string_view label) {
  deliver([](User& user, const std::wstring& wide) { user.initiateFederateSave(wide); },
          to_wide(label));
}

void Receiver::initiate_federate_save_with_time(std::string_view label, rti::LogicalTime time) {
  deliver([](User& user, const std::wstring& wide, const Times& times,
             double value) { user.initiateFederateSave(wide, *times.time(value)); },
          to_wide(label), state_.times, time.value);
}

void Receiver::federation_saved() {
  deliver([](User& user) { user.federationSaved(); });
}

void Receiver::federation_not_saved(rti::SaveFailure failure, std::string_view) {
  deliver([](User& user, auto reason) { user.federationNotSaved(reason); }, reason_of(failure));
}

void Receiver::federation_save_status_response(std::span<const rti::FederateSaveStatus> all) {
  rti1516e::FederateHandleSaveStatusPairVector list;
  list.reserve(all.size());
  for (const rti::FederateSaveStatus& each : all)
    list.emplace_back(to_standard(each.federate), told_status(each.status));
  deliver([](User& user, const auto& found) { user.federationSaveStatusResponse(found); }, list);
}

void Receiver::request_federation_restore_succeeded(std::string_view label) {
  deliver(
      [](User& user, const std::wstring& wide) { user.requestFederationRestoreSucceeded(wide); },
      to_wide(label));
}

void Receiver::request_federation_restore_failed(std::string_view label, std::string_view) {
  deliver([](User& user, const std::wstring& wide) { user.requestFederationRestoreFailed(wide); },
          to_wide(label));
}

void Receiver::federation_restore_begun() {
  deliver([](User& user) { user.federationRestoreBegun(); });
}

void Receiver::initiate_federate_restore(std::string_view label, std::string_view name,
                                         rti::FederateHandle federate) {
  deliver([](User& user, const std::wstring& wide, const std::wstring& wide_name,
             const auto& handle) { user.initiateFederateRestore(wide, wide_name, handle); },
          to_wide(label), to_wide(name), to_standard(federate));
}

void Receiver::federation_restored() {
  deliver([](User& user) { user.federationRestored(); });
}

void Receiver::federation_not_restored(rti::RestoreFailure failure, std::string_view) {
  deliver([](User& user, auto reason) { user.federationNotRestored(reason); }, reason_of(failure));
}

void Receiver::federation_restore_status_response(std::span<const rti::FederateRestoreStatus> all) {
  rti1516e::FederateRestoreStatusVector list;
  list.reserve(all.size());
  for (const rti::FederateRestoreStatus& each : all)
    list.emplace_back(to_standard(each.before), to_standard(each.after), told_status(each.status));
  deliver([](User& user, const auto& found) { user.federationRestoreStatusResponse(found); }, list);
}

void Receiver::write_state(std::vector<std::byte>& state) {
  rti::Writer writer(state);
  state_.keep(writer);
}

bool Receiver::read_state(rti::Bytes state) {
  rti::Reader reader(state);
  return state_.keep(reader) && reader.is_at_end();
}

}  // namespace rink::standard
