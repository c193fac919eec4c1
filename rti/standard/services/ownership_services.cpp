// Ownership management.
#include "rti/standard/services/ownership_services.h"

#include "rti/standard/handles.h"
#include "rti/standard/values.h"

namespace rink::standard {

void OwnershipServices::unconditionalAttributeOwnershipDivestiture(
    rti1516e::ObjectInstanceHandle theObject, rti1516e::AttributeHandleSet const& theAttributes) {
  federate().call([&](rti::Ambassador& core, FederateState&) {
    const rti::AttributeSet attributes = to_core(theAttributes);
    core.unconditional_attribute_ownership_divestiture(to_core(theObject), attributes);
  });
}

void OwnershipServices::negotiatedAttributeOwnershipDivestiture(
    rti1516e::ObjectInstanceHandle theObject, rti1516e::AttributeHandleSet const& theAttributes,
    rti1516e::VariableLengthData const& theUserSuppliedTag) {
  federate().call([&](rti::Ambassador& core, FederateState&) {
    const rti::AttributeSet attributes = to_core(theAttributes);
    core.negotiated_attribute_ownership_divestiture(to_core(theObject), attributes,
                                                    bytes_of(theUserSuppliedTag));
  });
}

void OwnershipServices::confirmDivestiture(rti1516e::ObjectInstanceHandle theObject,
                                           rti1516e::AttributeHandleSet const& confirmedAttributes,
                                           rti1516e::VariableLengthData const& theUserSuppliedTag) {
  federate().call([&](rti::Ambassador& core, FederateState&) {
    const rti::AttributeSet attributes = to_core(confirmedAttributes);
    core.confirm_divestiture(to_core(theObject), attributes, bytes_of(theUserSuppliedTag));
  });
}

void OwnershipServices::attributeOwnershipAcquisition(
    rti1516e::ObjectInstanceHandle theObject, rti1516e::AttributeHandleSet const& desiredAttributes,
    rti1516e::VariableLengthData const& theUserSuppliedTag) {
  federate().call([&](rti::Ambassador& core, FederateState&) {
    const rti::AttributeSet attributes = to_core(desiredAttributes);
    core.attribute_ownership_acquisition(to_core(theObject), attributes,
                                         bytes_of(theUserSuppliedTag));
  });
}

void OwnershipServices::attributeOwnershipAcquisitionIfAvailable(
    rti1516e::ObjectInstanceHandle theObject,
    rti1516e::AttributeHandleSet const& desiredAttributes) {
  federate().call([&](rti::Ambassador& core, FederateState&) {
    const rti::AttributeSet attributes = to_core(desiredAttributes);
    core.attribute_ownership_acquisition_if_available(to_core(theObject), attributes);
  });
}

void OwnershipServices::attributeOwnershipReleaseDenied(
    rti1516e::ObjectInstanceHandle theObject, rti1516e::AttributeHandleSet const& theAttributes) {
  federate().call([&](rti::Ambassador& core, FederateState&) {
    const rti::AttributeSet attributes = to_core(theAttributes);
    core.attribute_ownership_release_denied(to_core(theObject), attributes);
  });
}

void OwnershipServices::cancelNegotiatedAttributeOwnershipDivestiture(
    rti1516e::ObjectInstanceHandle theObject, rti1516e::AttributeHandleSet const& theAttributes) {
  federate().call([&](rti::Ambassador& core, FederateState&) {
    const rti::AttributeSet attributes = to_core(theAttributes);
    core.cancel_negotiated_attribute_ownership_divestiture(to_core(theObject), attributes);
  });
}

void OwnershipServices::cancelAttributeOwnershipAcquisition(
    rti1516e::ObjectInstanceHandle theObject, rti1516e::AttributeHandleSet const& theAttributes) {
  federate().call([&](rti::Ambassador& core, FederateState&) {
    const rti::AttributeSet attributes = to_core(theAttributes);
    core.cancel_attribute_ownership_acquisition(to_core(theObject), attributes);
  });
}

/// The RTI decides; this waits for its answer.
void OwnershipServices::attributeOwnershipDivestitureIfWanted(
    rti1516e::ObjectInstanceHandle theObject, rti1516e::AttributeHandleSet const& theAttributes,
    rti1516e::AttributeHandleSet& theDivestedAttributes) {
  rti::AttributeSet divested;
  federate().ask(
      [&](rti::Ambassador& core, FederateState& state) {
        const rti::AttributeSet attributes = to_core(theAttributes);
        core.attribute_ownership_divestiture_if_wanted(to_core(theObject), attributes);
        state.answers.divestiture = {to_core(theObject), attributes, {}, {}};
      },
      [&](const Answers& answers) {
        const Answers::Divestiture& answer = *answers.divestiture;
        divested = answer.divested;
        return (answer.divested | answer.kept).includes(answer.asked);
      });
  theDivestedAttributes = to_standard(divested);
}

void OwnershipServices::queryAttributeOwnership(rti1516e::ObjectInstanceHandle theObject,
                                                rti1516e::AttributeHandle theAttribute) {
  federate().call([&](rti::Ambassador& core, FederateState&) {
    core.query_attribute_ownership(to_core(theObject), to_core(theAttribute));
  });
}

bool OwnershipServices::isAttributeOwnedByFederate(rti1516e::ObjectInstanceHandle theObject,
                                                   rti1516e::AttributeHandle theAttribute) {
  return federate().call([&](rti::Ambassador& core, FederateState&) {
    return core.is_attribute_owned_by_federate(to_core(theObject), to_core(theAttribute));
  });
}

}  // namespace rink::standard
