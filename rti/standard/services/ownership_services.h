// Ownership management (clause 7).
#pragma once

#include "rti/standard/services/object_services.h"

namespace rink::standard {

class OwnershipServices : public ObjectServices {
 public:
  void unconditionalAttributeOwnershipDivestiture(
      rti1516e::ObjectInstanceHandle theObject,
      rti1516e::AttributeHandleSet const& theAttributes) override;
  void negotiatedAttributeOwnershipDivestiture(
      rti1516e::ObjectInstanceHandle theObject, rti1516e::AttributeHandleSet const& theAttributes,
      rti1516e::VariableLengthData const& theUserSuppliedTag) override;
  void confirmDivestiture(rti1516e::ObjectInstanceHandle theObject,
                          rti1516e::AttributeHandleSet const& confirmedAttributes,
                          rti1516e::VariableLengthData const& theUserSuppliedTag) override;
  void attributeOwnershipAcquisition(
      rti1516e::ObjectInstanceHandle theObject,
      rti1516e::AttributeHandleSet const& desiredAttributes,
      rti1516e::VariableLengthData const& theUserSuppliedTag) override;
  void attributeOwnershipAcquisitionIfAvailable(
      rti1516e::ObjectInstanceHandle theObject,
      rti1516e::AttributeHandleSet const& desiredAttributes) override;
  void attributeOwnershipReleaseDenied(rti1516e::ObjectInstanceHandle theObject,
                                       rti1516e::AttributeHandleSet const& theAttributes) override;
  void attributeOwnershipDivestitureIfWanted(
      rti1516e::ObjectInstanceHandle theObject, rti1516e::AttributeHandleSet const& theAttributes,
      rti1516e::AttributeHandleSet& theDivestedAttributes) override;
  void cancelNegotiatedAttributeOwnershipDivestiture(
      rti1516e::ObjectInstanceHandle theObject,
      rti1516e::AttributeHandleSet const& theAttributes) override;
  void cancelAttributeOwnershipAcquisition(
      rti1516e::ObjectInstanceHandle theObject,
      rti1516e::AttributeHandleSet const& theAttributes) override;
  void queryAttributeOwnership(rti1516e::ObjectInstanceHandle theObject,
                               rti1516e::AttributeHandle theAttribute) override;
  bool isAttributeOwnedByFederate(rti1516e::ObjectInstanceHandle theObject,
                                  rti1516e::AttributeHandle theAttribute) override;
};

}  // namespace rink::standard
