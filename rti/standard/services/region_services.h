// Data distribution management (clause 9), and the ranges of regions.
#pragma once

#include "rti/standard/services/time_services.h"

namespace rink::standard {

class RegionServices : public TimeServices {
 public:
  rti1516e::RegionHandle createRegion(rti1516e::DimensionHandleSet const& theDimensions) override;
  void commitRegionModifications(rti1516e::RegionHandleSet const& theRegionHandleSet) override;
  void deleteRegion(rti1516e::RegionHandle const& theRegion) override;
  rti1516e::ObjectInstanceHandle registerObjectInstanceWithRegions(
      rti1516e::ObjectClassHandle theClass,
      rti1516e::AttributeHandleSetRegionHandleSetPairVector const&
          theAttributeHandleSetRegionHandleSetPairVector) override;
  rti1516e::ObjectInstanceHandle registerObjectInstanceWithRegions(
      rti1516e::ObjectClassHandle theClass,
      rti1516e::AttributeHandleSetRegionHandleSetPairVector const&
          theAttributeHandleSetRegionHandleSetPairVector,
      std::wstring const& theObjectInstanceName) override;
  void associateRegionsForUpdates(rti1516e::ObjectInstanceHandle theObject,
                                  rti1516e::AttributeHandleSetRegionHandleSetPairVector const&
                                      theAttributeHandleSetRegionHandleSetPairVector) override;
  void unassociateRegionsForUpdates(rti1516e::ObjectInstanceHandle theObject,
                                    rti1516e::AttributeHandleSetRegionHandleSetPairVector const&
                                        theAttributeHandleSetRegionHandleSetPairVector) override;
  void subscribeObjectClassAttributesWithRegions(
      rti1516e::ObjectClassHandle theClass,
      rti1516e::AttributeHandleSetRegionHandleSetPairVector const&
          theAttributeHandleSetRegionHandleSetPairVector,
      bool active, std::wstring const& updateRateDesignator) override;
  void unsubscribeObjectClassAttributesWithRegions(
      rti1516e::ObjectClassHandle theClass,
      rti1516e::AttributeHandleSetRegionHandleSetPairVector const&
          theAttributeHandleSetRegionHandleSetPairVector) override;
  void subscribeInteractionClassWithRegions(rti1516e::InteractionClassHandle theClass,
                                            rti1516e::RegionHandleSet const& theRegionHandleSet,
                                            bool active) override;
  void unsubscribeInteractionClassWithRegions(
      rti1516e::InteractionClassHandle theClass,
      rti1516e::RegionHandleSet const& theRegionHandleSet) override;
  void sendInteractionWithRegions(rti1516e::InteractionClassHandle theInteraction,
                                  rti1516e::ParameterHandleValueMap const& theParameterValues,
                                  rti1516e::RegionHandleSet const& theRegionHandleSet,
                                  rti1516e::VariableLengthData const& theUserSuppliedTag) override;
  rti1516e::MessageRetractionHandle sendInteractionWithRegions(
      rti1516e::InteractionClassHandle theInteraction,
      rti1516e::ParameterHandleValueMap const& theParameterValues,
      rti1516e::RegionHandleSet const& theRegionHandleSet,
      rti1516e::VariableLengthData const& theUserSuppliedTag,
      rti1516e::LogicalTime const& theTime) override;
  void requestAttributeValueUpdateWithRegions(
      rti1516e::ObjectClassHandle theClass,
      rti1516e::AttributeHandleSetRegionHandleSetPairVector const& theSet,
      rti1516e::VariableLengthData const& theUserSuppliedTag) override;
  rti1516e::DimensionHandleSet getDimensionHandleSet(
      rti1516e::RegionHandle theRegionHandle) override;
  rti1516e::RangeBounds getRangeBounds(rti1516e::RegionHandle theRegionHandle,
                                       rti1516e::DimensionHandle theDimensionHandle) override;
  void setRangeBounds(rti1516e::RegionHandle theRegionHandle,
                      rti1516e::DimensionHandle theDimensionHandle,
                      rti1516e::RangeBounds const& theRangeBounds) override;
};

}  // namespace rink::standard
