// Names and handles (10.4 to 10.26).
#pragma once

#include "rti/standard/services/region_services.h"

namespace rink::standard {

class LookupServices : public RegionServices {
 public:
  rti1516e::FederateHandle getFederateHandle(std::wstring const& theName) override;
  std::wstring getFederateName(rti1516e::FederateHandle theHandle) override;
  rti1516e::ObjectClassHandle getObjectClassHandle(std::wstring const& theName) override;
  std::wstring getObjectClassName(rti1516e::ObjectClassHandle theHandle) override;
  rti1516e::ObjectClassHandle getKnownObjectClassHandle(
      rti1516e::ObjectInstanceHandle theObject) override;
  rti1516e::ObjectInstanceHandle getObjectInstanceHandle(std::wstring const& theName) override;
  std::wstring getObjectInstanceName(rti1516e::ObjectInstanceHandle theHandle) override;
  rti1516e::AttributeHandle getAttributeHandle(rti1516e::ObjectClassHandle whichClass,
                                               std::wstring const& theAttributeName) override;
  std::wstring getAttributeName(rti1516e::ObjectClassHandle whichClass,
                                rti1516e::AttributeHandle theHandle) override;
  double getUpdateRateValue(std::wstring const& updateRateDesignator) override;
  double getUpdateRateValueForAttribute(rti1516e::ObjectInstanceHandle theObject,
                                        rti1516e::AttributeHandle theAttribute) override;
  rti1516e::InteractionClassHandle getInteractionClassHandle(std::wstring const& theName) override;
  std::wstring getInteractionClassName(rti1516e::InteractionClassHandle theHandle) override;
  rti1516e::ParameterHandle getParameterHandle(rti1516e::InteractionClassHandle whichClass,
                                               std::wstring const& theName) override;
  std::wstring getParameterName(rti1516e::InteractionClassHandle whichClass,
                                rti1516e::ParameterHandle theHandle) override;
  rti1516e::OrderType getOrderType(std::wstring const& orderName) override;
  std::wstring getOrderName(rti1516e::OrderType orderType) override;
  rti1516e::TransportationType getTransportationType(
      std::wstring const& transportationName) override;
  std::wstring getTransportationName(rti1516e::TransportationType transportationType) override;
  rti1516e::DimensionHandleSet getAvailableDimensionsForClassAttribute(
      rti1516e::ObjectClassHandle theClass, rti1516e::AttributeHandle theHandle) override;
  rti1516e::DimensionHandleSet getAvailableDimensionsForInteractionClass(
      rti1516e::InteractionClassHandle theClass) override;
  rti1516e::DimensionHandle getDimensionHandle(std::wstring const& theName) override;
  std::wstring getDimensionName(rti1516e::DimensionHandle theHandle) override;
  unsigned long getDimensionUpperBound(rti1516e::DimensionHandle theHandle) override;
};

}  // namespace rink::standard
