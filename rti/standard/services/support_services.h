// The other support services: the resign directive, switches, callbacks, encoded handles.
#pragma once

#include "rti/standard/services/lookup_services.h"

namespace rink::standard {

class SupportServices : public LookupServices {
 public:
  rti1516e::ResignAction getAutomaticResignDirective() override;
  void setAutomaticResignDirective(rti1516e::ResignAction resignAction) override;
  unsigned long normalizeFederateHandle(rti1516e::FederateHandle theFederateHandle) override;
  unsigned long normalizeServiceGroup(rti1516e::ServiceGroup theServiceGroup) override;
  void enableObjectClassRelevanceAdvisorySwitch() override;
  void disableObjectClassRelevanceAdvisorySwitch() override;
  void enableAttributeRelevanceAdvisorySwitch() override;
  void disableAttributeRelevanceAdvisorySwitch() override;
  void enableAttributeScopeAdvisorySwitch() override;
  void disableAttributeScopeAdvisorySwitch() override;
  void enableInteractionRelevanceAdvisorySwitch() override;
  void disableInteractionRelevanceAdvisorySwitch() override;
  bool evokeCallback(double approximateMinimumTimeInSeconds) override;
  bool evokeMultipleCallbacks(double approximateMinimumTimeInSeconds,
                              double approximateMaximumTimeInSeconds) override;
  void enableCallbacks() override;
  void disableCallbacks() override;
// The standard returns what C++ has deprecated since.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
  std::auto_ptr<rti1516e::LogicalTimeFactory> getTimeFactory() const override;
#pragma GCC diagnostic pop
  rti1516e::FederateHandle decodeFederateHandle(
      rti1516e::VariableLengthData const& encodedValue) const override;
  rti1516e::ObjectClassHandle decodeObjectClassHandle(
      rti1516e::VariableLengthData const& encodedValue) const override;
  rti1516e::InteractionClassHandle decodeInteractionClassHandle(
      rti1516e::VariableLengthData const& encodedValue) const override;
  rti1516e::ObjectInstanceHandle decodeObjectInstanceHandle(
      rti1516e::VariableLengthData const& encodedValue) const override;
  rti1516e::AttributeHandle decodeAttributeHandle(
      rti1516e::VariableLengthData const& encodedValue) const override;
  rti1516e::ParameterHandle decodeParameterHandle(
      rti1516e::VariableLengthData const& encodedValue) const override;
  rti1516e::DimensionHandle decodeDimensionHandle(
      rti1516e::VariableLengthData const& encodedValue) const override;
  rti1516e::MessageRetractionHandle decodeMessageRetractionHandle(
      rti1516e::VariableLengthData const& encodedValue) const override;
  rti1516e::RegionHandle decodeRegionHandle(
      rti1516e::VariableLengthData const& encodedValue) const override;
};

}  // namespace rink::standard
