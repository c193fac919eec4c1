// The sets, maps and records of the standard's C++ API.
#pragma once

#include <RTI/Enums.h>
#include <RTI/Handle.h>
#include <RTI/SpecificConfig.h>

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace rti1516e {

using AttributeHandleSet = std::set<AttributeHandle>;
using ParameterHandleSet = std::set<ParameterHandle>;
using FederateHandleSet = std::set<FederateHandle>;
using DimensionHandleSet = std::set<DimensionHandle>;
using RegionHandleSet = std::set<RegionHandle>;

using AttributeHandleValueMap = std::map<AttributeHandle, VariableLengthData>;
using ParameterHandleValueMap = std::map<ParameterHandle, VariableLengthData>;

using AttributeHandleSetRegionHandleSetPair = std::pair<AttributeHandleSet, RegionHandleSet>;
using AttributeHandleSetRegionHandleSetPairVector =
    std::vector<AttributeHandleSetRegionHandleSetPair>;

using FederateHandleSaveStatusPair = std::pair<FederateHandle, SaveStatus>;
using FederateHandleSaveStatusPairVector = std::vector<FederateHandleSaveStatusPair>;

class RTI_EXPORT FederateRestoreStatus {
 public:
  FederateRestoreStatus(FederateHandle const& thePreHandle, FederateHandle const& thePostHandle,
                        RestoreStatus theStatus);

  FederateHandle preRestoreHandle;
  FederateHandle postRestoreHandle;
  RestoreStatus status;
};
using FederateRestoreStatusVector = std::vector<FederateRestoreStatus>;

class RTI_EXPORT FederationExecutionInformation {
 public:
  FederationExecutionInformation(std::wstring const& theFederationExecutionName,
                                 std::wstring const& theLogicalTimeImplementationName);

  std::wstring federationExecutionName;
  std::wstring logicalTimeImplementationName;
};
using FederationExecutionInformationVector = std::vector<FederationExecutionInformation>;

class RTI_EXPORT SupplementalReflectInfo {
 public:
  SupplementalReflectInfo();
  SupplementalReflectInfo(FederateHandle const& theFederateHandle);
  SupplementalReflectInfo(RegionHandleSet const& theRegionHandleSet);
  SupplementalReflectInfo(FederateHandle const& theFederateHandle,
                          RegionHandleSet const& theRegionHandleSet);

  bool hasProducingFederate;
  bool hasSentRegions;
  FederateHandle producingFederate;
  RegionHandleSet sentRegions;
};

class RTI_EXPORT SupplementalReceiveInfo {
 public:
  SupplementalReceiveInfo();
  SupplementalReceiveInfo(FederateHandle const& theFederateHandle);
  SupplementalReceiveInfo(RegionHandleSet const& theRegionHandleSet);
  SupplementalReceiveInfo(FederateHandle const& theFederateHandle,
                          RegionHandleSet const& theRegionHandleSet);

  bool hasProducingFederate;
  bool hasSentRegions;
  FederateHandle producingFederate;
  RegionHandleSet sentRegions;
};

class RTI_EXPORT SupplementalRemoveInfo {
 public:
  SupplementalRemoveInfo();
  SupplementalRemoveInfo(FederateHandle const& theFederateHandle);

  bool hasProducingFederate;
  FederateHandle producingFederate;
};

}  // namespace rti1516e
