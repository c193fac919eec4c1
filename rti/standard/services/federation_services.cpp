// Federation management.
#include "rti/standard/services/federation_services.h"

#include "rti/standard/handles.h"
#include "rti/standard/values.h"
#include "rti/standard/wide_text.h"

namespace rink::standard {

namespace {

std::vector<std::string> narrow(const std::vector<std::wstring>& names) {
  std::vector<std::string> all;
  all.reserve(names.size());
  for (const std::wstring& each : names) all.push_back(to_utf8(each));
  return all;
}

/// Throws CouldNotOpenMIM or ErrorReadingMIM, so that a fault of the MIM is not one of the model's.
void check_mim(const std::string& file) {
  try {
    load_model({file});
  } catch (const rti1516e::CouldNotOpenFDD& fault) {
    throw rti1516e::CouldNotOpenMIM(fault.what());
  } catch (const rti1516e::ErrorReadingFDD& fault) {
    throw rti1516e::ErrorReadingMIM(fault.what());
  } catch (const rti1516e::InconsistentFDD& fault) {
    throw rti1516e::ErrorReadingMIM(fault.what());
  }
}

}  // namespace

void FederationServices::connect(rti1516e::FederateAmbassador& federateAmbassador,
                                 rti1516e::CallbackModel theCallbackModel,
                                 std::wstring const& localSettingsDesignator) {
  federate().connect(federateAmbassador, theCallbackModel, localSettingsDesignator);
}

void FederationServices::disconnect() { federate().disconnect(); }

void FederationServices::createFederationExecution(
    std::wstring const& federationExecutionName, std::wstring const& fomModule,
    std::wstring const& logicalTimeImplementationName) {
  createFederationExecution(federationExecutionName, std::vector<std::wstring>{fomModule},
                            logicalTimeImplementationName);
}

void FederationServices::createFederationExecution(
    std::wstring const& federationExecutionName, std::vector<std::wstring> const& fomModules,
    std::wstring const& logicalTimeImplementationName) {
  federate().create(to_utf8(federationExecutionName), narrow(fomModules),
                    logicalTimeImplementationName);
}

void FederationServices::createFederationExecutionWithMIM(
    std::wstring const& federationExecutionName, std::vector<std::wstring> const& fomModules,
    std::wstring const& mimModule, std::wstring const& logicalTimeImplementationName) {
  if (mimModule == L"HLAstandardMIM")
    throw rti1516e::DesignatorIsHLAstandardMIM(L"it stands behind every model without being named");
  check_mim(to_utf8(mimModule));
  std::vector<std::wstring> modules = fomModules;
  modules.push_back(mimModule);
  createFederationExecution(federationExecutionName, modules, logicalTimeImplementationName);
}

void FederationServices::destroyFederationExecution(std::wstring const& federationExecutionName) {
  federate().destroy(to_utf8(federationExecutionName));
}

void FederationServices::listFederationExecutions() { federate().list(); }

rti1516e::FederateHandle FederationServices::joinFederationExecution(
    std::wstring const& federateType, std::wstring const& federationExecutionName,
    std::vector<std::wstring> const& additionalFomModules) {
  federate().check_outside_callback();
  return to_standard(federate().join({}, to_utf8(federateType), to_utf8(federationExecutionName),
                                     narrow(additionalFomModules)));
}

rti1516e::FederateHandle FederationServices::joinFederationExecution(
    std::wstring const& federateName, std::wstring const& federateType,
    std::wstring const& federationExecutionName,
    std::vector<std::wstring> const& additionalFomModules) {
  federate().check_outside_callback();
  return to_standard(federate().join(to_utf8(federateName), to_utf8(federateType),
                                     to_utf8(federationExecutionName),
                                     narrow(additionalFomModules)));
}

void FederationServices::resignFederationExecution(rti1516e::ResignAction resignAction) {
  federate().check_outside_callback();
  if (resignAction < rti1516e::UNCONDITIONALLY_DIVEST_ATTRIBUTES ||
      resignAction > rti1516e::NO_ACTION)
    throw rti1516e::InvalidResignAction(L"there is no such action");
  federate().resign(static_cast<rti::ResignAction>(resignAction));
}

void FederationServices::registerFederationSynchronizationPoint(
    std::wstring const& label, rti1516e::VariableLengthData const& theUserSuppliedTag) {
  federate().call([&](rti::Ambassador& core, FederateState&) {
    core.register_synchronization_point(to_utf8(label), bytes_of(theUserSuppliedTag));
  });
}

void FederationServices::registerFederationSynchronizationPoint(
    std::wstring const& label, rti1516e::VariableLengthData const& theUserSuppliedTag,
    rti1516e::FederateHandleSet const& synchronizationSet) {
  federate().call([&](rti::Ambassador& core, FederateState&) {
    const std::vector<rti::FederateHandle> members = to_core(synchronizationSet);
    core.register_synchronization_point(to_utf8(label), bytes_of(theUserSuppliedTag), members);
  });
}

void FederationServices::synchronizationPointAchieved(std::wstring const& label,
                                                      bool successfully) {
  federate().call([&](rti::Ambassador& core, FederateState&) {
    core.synchronization_point_achieved(to_utf8(label), successfully);
  });
}

}  // namespace rink::standard
