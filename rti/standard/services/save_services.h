// Save and restore (4.16 to 4.31).
#pragma once

#include "rti/standard/services/federation_services.h"

namespace rink::standard {

class SaveServices : public FederationServices {
 public:
  void requestFederationSave(std::wstring const& label) override;
  void requestFederationSave(std::wstring const& label,
                             rti1516e::LogicalTime const& theTime) override;
  void federateSaveBegun() override;
  void federateSaveComplete() override;
  void federateSaveNotComplete() override;
  void abortFederationSave() override;
  void queryFederationSaveStatus() override;
  void requestFederationRestore(std::wstring const& label) override;
  void federateRestoreComplete() override;
  void federateRestoreNotComplete() override;
  void abortFederationRestore() override;
  void queryFederationRestoreStatus() override;
};

}  // namespace rink::standard
