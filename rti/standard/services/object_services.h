// Object management (clause 6).
#pragma once

#include "rti/standard/services/declaration_services.h"

namespace rink::standard {

class ObjectServices : public DeclarationServices {
 public:
  void reserveObjectInstanceName(std::wstring const& theObjectInstanceName) override;
  void releaseObjectInstanceName(std::wstring const& theObjectInstanceName) override;
  void reserveMultipleObjectInstanceName(
      std::set<std::wstring> const& theObjectInstanceNames) override;
  void releaseMultipleObjectInstanceName(
      std::set<std::wstring> const& theObjectInstanceNames) override;
  rti1516e::ObjectInstanceHandle registerObjectInstance(
      rti1516e::ObjectClassHandle theClass) override;
  rti1516e::ObjectInstanceHandle registerObjectInstance(
      rti1516e::ObjectClassHandle theClass, std::wstring const& theObjectInstanceName) override;
  void updateAttributeValues(rti1516e::ObjectInstanceHandle theObject,
                             rti1516e::AttributeHandleValueMap const& theAttributeValues,
                             rti1516e::VariableLengthData const& theUserSuppliedTag) override;
  rti1516e::MessageRetractionHandle updateAttributeValues(
      rti1516e::ObjectInstanceHandle theObject,
      rti1516e::AttributeHandleValueMap const& theAttributeValues,
      rti1516e::VariableLengthData const& theUserSuppliedTag,
      rti1516e::LogicalTime const& theTime) override;
  void sendInteraction(rti1516e::InteractionClassHandle theInteraction,
                       rti1516e::ParameterHandleValueMap const& theParameterValues,
                       rti1516e::VariableLengthData const& theUserSuppliedTag) override;
  rti1516e::MessageRetractionHandle sendInteraction(
      rti1516e::InteractionClassHandle theInteraction,
      rti1516e::ParameterHandleValueMap const& theParameterValues,
      rti1516e::VariableLengthData const& theUserSuppliedTag,
      rti1516e::LogicalTime const& theTime) override;
  void deleteObjectInstance(rti1516e::ObjectInstanceHandle theObject,
                            rti1516e::VariableLengthData const& theUserSuppliedTag) override;
  rti1516e::MessageRetractionHandle deleteObjectInstance(
      rti1516e::ObjectInstanceHandle theObject,
      rti1516e::VariableLengthData const& theUserSuppliedTag,
      rti1516e::LogicalTime const& theTime) override;
  void localDeleteObjectInstance(rti1516e::ObjectInstanceHandle theObject) override;
  void requestAttributeValueUpdate(rti1516e::ObjectInstanceHandle theObject,
                                   rti1516e::AttributeHandleSet const& theAttributes,
                                   rti1516e::VariableLengthData const& theUserSuppliedTag) override;
  void requestAttributeValueUpdate(rti1516e::ObjectClassHandle theClass,
                                   rti1516e::AttributeHandleSet const& theAttributes,
                                   rti1516e::VariableLengthData const& theUserSuppliedTag) override;
  void requestAttributeTransportationTypeChange(rti1516e::ObjectInstanceHandle theObject,
                                                rti1516e::AttributeHandleSet const& theAttributes,
                                                rti1516e::TransportationType theType) override;
  void queryAttributeTransportationType(rti1516e::ObjectInstanceHandle theObject,
                                        rti1516e::AttributeHandle theAttribute) override;
  void requestInteractionTransportationTypeChange(rti1516e::InteractionClassHandle theClass,
                                                  rti1516e::TransportationType theType) override;
  void queryInteractionTransportationType(rti1516e::FederateHandle theFederate,
                                          rti1516e::InteractionClassHandle theInteraction) override;
};

}  // namespace rink::standard
