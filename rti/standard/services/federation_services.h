// Federation management (clause 4) without save and restore.
#pragma once

#include <memory>

#include "rti/standard/federate/federate.h"
#include "rti/standard/standard_headers.h"

namespace rink::standard {

class FederationServices : public rti1516e::RTIambassador {
 public:
  ~FederationServices() override { federate_->close(); }
  void connect(rti1516e::FederateAmbassador& federateAmbassador,
               rti1516e::CallbackModel theCallbackModel,
               std::wstring const& localSettingsDesignator) override;
  void disconnect() override;
  void createFederationExecution(std::wstring const& federationExecutionName,
                                 std::wstring const& fomModule,
                                 std::wstring const& logicalTimeImplementationName) override;
  void createFederationExecution(std::wstring const& federationExecutionName,
                                 std::vector<std::wstring> const& fomModules,
                                 std::wstring const& logicalTimeImplementationName) override;
  void createFederationExecutionWithMIM(std::wstring const& federationExecutionName,
                                        std::vector<std::wstring> const& fomModules,
                                        std::wstring const& mimModule,
                                        std::wstring const& logicalTimeImplementationName) override;
  void destroyFederationExecution(std::wstring const& federationExecutionName) override;
  void listFederationExecutions() override;
  rti1516e::FederateHandle joinFederationExecution(
      std::wstring const& federateType, std::wstring const& federationExecutionName,
      std::vector<std::wstring> const& additionalFomModules) override;
  rti1516e::FederateHandle joinFederationExecution(
      std::wstring const& federateName, std::wstring const& federateType,
      std::wstring const& federationExecutionName,
      std::vector<std::wstring> const& additionalFomModules) override;
  void resignFederationExecution(rti1516e::ResignAction resignAction) override;
  void registerFederationSynchronizationPoint(
      std::wstring const& label, rti1516e::VariableLengthData const& theUserSuppliedTag) override;
  void registerFederationSynchronizationPoint(
      std::wstring const& label, rti1516e::VariableLengthData const& theUserSuppliedTag,
      rti1516e::FederateHandleSet const& synchronizationSet) override;
  void synchronizationPointAchieved(std::wstring const& label, bool successfully) override;

 protected:
  Federate& federate() const { return *federate_; }

 private:
  const std::shared_ptr<Federate> federate_ = std::make_shared<Federate>();
};

}  // namespace rink::standard
