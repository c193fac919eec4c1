// Save and restore, which Rink does not offer.
#include "rti/standard/services/save_services.h"

namespace rink::standard {

namespace {

/// What a federate outside an execution gets is the standard's refusal all the same.
void refuse_saving(Federate& federate, const std::wstring& service) {
  federate.call([&](rti::Ambassador&, FederateState&) {
    throw rti1516e::RTIinternalError(service + L": this RTI neither saves nor restores");
  });
}

}  // namespace

void SaveServices::requestFederationSave(std::wstring const&) {
  refuse_saving(federate(), L"requestFederationSave");
}
void SaveServices::requestFederationSave(std::wstring const&, rti1516e::LogicalTime const&) {
  refuse_saving(federate(), L"requestFederationSave");
}
void SaveServices::federateSaveBegun() { refuse_saving(federate(), L"federateSaveBegun"); }
void SaveServices::federateSaveComplete() { refuse_saving(federate(), L"federateSaveComplete"); }
void SaveServices::federateSaveNotComplete() {
  refuse_saving(federate(), L"federateSaveNotComplete");
}
void SaveServices::abortFederationSave() { refuse_saving(federate(), L"abortFederationSave"); }
void SaveServices::queryFederationSaveStatus() {
  refuse_saving(federate(), L"queryFederationSaveStatus");
}
void SaveServices::requestFederationRestore(std::wstring const&) {
  refuse_saving(federate(), L"requestFederationRestore");
}
void SaveServices::federateRestoreComplete() {
  refuse_saving(federate(), L"federateRestoreComplete");
}
void SaveServices::federateRestoreNotComplete() {
  refuse_saving(federate(), L"federateRestoreNotComplete");
}
void SaveServices::abortFederationRestore() {
  refuse_saving(federate(), L"abortFederationRestore");
}
void SaveServices::queryFederationRestoreStatus() {
  refuse_saving(federate(), L"queryFederationRestoreStatus");
}

}  // namespace rink::standard
