// Save and restore.
#include "rti/standard/services/save_services.h"

#include "rti/standard/wide_text.h"

namespace rink::standard {

void SaveServices::requestFederationSave(std::wstring const& label) {
  federate().call_at_once(
      [&](rti::Ambassador& core, FederateState&) { core.request_federation_save(to_utf8(label)); });
}
void SaveServices::requestFederationSave(std::wstring const& label,
                                         rti1516e::LogicalTime const& theTime) {
  federate().call_at_once([&](rti::Ambassador& core, FederateState& state) {
    core.request_federation_save(to_utf8(label), rti::LogicalTime(state.times.number(theTime)));
  });
}
void SaveServices::federateSaveBegun() {
  federate().call_at_once(
      [](rti::Ambassador& core, FederateState&) { core.federate_save_begun(); });
}
void SaveServices::federateSaveComplete() {
  federate().call_at_once(
      [](rti::Ambassador& core, FederateState&) { core.federate_save_complete(); });
}
void SaveServices::federateSaveNotComplete() {
  federate().call_at_once(
      [](rti::Ambassador& core, FederateState&) { core.federate_save_not_complete(); });
}
void SaveServices::abortFederationSave() {
  federate().call_at_once(
      [](rti::Ambassador& core, FederateState&) { core.abort_federation_save(); });
}
void SaveServices::queryFederationSaveStatus() {
  federate().call_at_once(
      [](rti::Ambassador& core, FederateState&) { core.query_federation_save_status(); });
}
void SaveServices::requestFederationRestore(std::wstring const& label) {
  federate().call_at_once([&](rti::Ambassador& core, FederateState&) {
    core.request_federation_restore(to_utf8(label));
  });
}
void SaveServices::federateRestoreComplete() {
  federate().call_at_once(
      [](rti::Ambassador& core, FederateState&) { core.federate_restore_complete(); });
}
void SaveServices::federateRestoreNotComplete() {
  federate().call_at_once(
      [](rti::Ambassador& core, FederateState&) { core.federate_restore_not_complete(); });
}
void SaveServices::abortFederationRestore() {
  federate().call_at_once(
      [](rti::Ambassador& core, FederateState&) { core.abort_federation_restore(); });
}
void SaveServices::queryFederationRestoreStatus() {
  federate().call_at_once(
      [](rti::Ambassador& core, FederateState&) { core.query_federation_restore_status(); });
}

}  // namespace rink::standard
