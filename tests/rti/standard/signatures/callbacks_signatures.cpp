// The callbacks, as IEEE 1516.1-2010 declares them.
#include "tests/rti/standard/signatures/has.h"

namespace rti1516e {
namespace {

using rink::standard::testing::has;

// Federation management.
static_assert(
    has<FederateAmbassador, void(std::wstring const&)>(&FederateAmbassador::connectionLost),
    "connectionLost");
static_assert(has<FederateAmbassador, void(FederationExecutionInformationVector const&)>(
                  &FederateAmbassador::reportFederationExecutions),
              "reportFederationExecutions");
static_assert(has<FederateAmbassador, void(std::wstring const&)>(
                  &FederateAmbassador::synchronizationPointRegistrationSucceeded),
              "synchronizationPointRegistrationSucceeded");
static_assert(has<FederateAmbassador, void(std::wstring const&, SynchronizationPointFailureReason)>(
                  &FederateAmbassador::synchronizationPointRegistrationFailed),
              "synchronizationPointRegistrationFailed");
static_assert(has<FederateAmbassador, void(std::wstring const&, VariableLengthData const&)>(
                  &FederateAmbassador::announceSynchronizationPoint),
              "announceSynchronizationPoint");
static_assert(has<FederateAmbassador, void(std::wstring const&, FederateHandleSet const&)>(
                  &FederateAmbassador::federationSynchronized),
              "federationSynchronized");
static_assert(
    has<FederateAmbassador, void(std::wstring const&)>(&FederateAmbassador::initiateFederateSave),
    "initiateFederateSave");
static_assert(has<FederateAmbassador, void(std::wstring const&, LogicalTime const&)>(
                  &FederateAmbassador::initiateFederateSave),
              "initiateFederateSave");
static_assert(has<FederateAmbassador, void()>(&FederateAmbassador::federationSaved),
              "federationSaved");
static_assert(
    has<FederateAmbassador, void(SaveFailureReason)>(&FederateAmbassador::federationNotSaved),
    "federationNotSaved");
static_assert(has<FederateAmbassador, void(FederateHandleSaveStatusPairVector const&)>(
                  &FederateAmbassador::federationSaveStatusResponse),
              "federationSaveStatusResponse");
static_assert(has<FederateAmbassador, void(std::wstring const&)>(
                  &FederateAmbassador::requestFederationRestoreSucceeded),
              "requestFederationRestoreSucceeded");
static_assert(has<FederateAmbassador, void(std::wstring const&)>(
                  &FederateAmbassador::requestFederationRestoreFailed),
              "requestFederationRestoreFailed");
static_assert(has<FederateAmbassador, void()>(&FederateAmbassador::federationRestoreBegun),
              "federationRestoreBegun");
static_assert(
    has<FederateAmbassador, void(std::wstring const&, std::wstring const&, FederateHandle)>(
        &FederateAmbassador::initiateFederateRestore),
    "initiateFederateRestore");
static_assert(has<FederateAmbassador, void()>(&FederateAmbassador::federationRestored),
              "federationRestored");
static_assert(
    has<FederateAmbassador, void(RestoreFailureReason)>(&FederateAmbassador::federationNotRestored),
    "federationNotRestored");
static_assert(has<FederateAmbassador, void(FederateRestoreStatusVector const&)>(
                  &FederateAmbassador::federationRestoreStatusResponse),
              "federationRestoreStatusResponse");

// Declaration management.
static_assert(has<FederateAmbassador, void(ObjectClassHandle)>(
                  &FederateAmbassador::startRegistrationForObjectClass),
              "startRegistrationForObjectClass");
static_assert(has<FederateAmbassador, void(ObjectClassHandle)>(
                  &FederateAmbassador::stopRegistrationForObjectClass),
              "stopRegistrationForObjectClass");
static_assert(
    has<FederateAmbassador, void(InteractionClassHandle)>(&FederateAmbassador::turnInteractionsOn),
    "turnInteractionsOn");
static_assert(
    has<FederateAmbassador, void(InteractionClassHandle)>(&FederateAmbassador::turnInteractionsOff),
    "turnInteractionsOff");

// Object management.
static_assert(has<FederateAmbassador, void(std::wstring const&)>(
                  &FederateAmbassador::objectInstanceNameReservationSucceeded),
              "objectInstanceNameReservationSucceeded");
static_assert(has<FederateAmbassador, void(std::wstring const&)>(
                  &FederateAmbassador::objectInstanceNameReservationFailed),
              "objectInstanceNameReservationFailed");
static_assert(has<FederateAmbassador, void(std::set<std::wstring> const&)>(
                  &FederateAmbassador::multipleObjectInstanceNameReservationSucceeded),
              "multipleObjectInstanceNameReservationSucceeded");
static_assert(has<FederateAmbassador, void(std::set<std::wstring> const&)>(
                  &FederateAmbassador::multipleObjectInstanceNameReservationFailed),
              "multipleObjectInstanceNameReservationFailed");
static_assert(
    has<FederateAmbassador, void(ObjectInstanceHandle, ObjectClassHandle, std::wstring const&)>(
        &FederateAmbassador::discoverObjectInstance),
    "discoverObjectInstance");
static_assert(
    has<FederateAmbassador, void(ObjectInstanceHandle, ObjectClassHandle, std::wstring const&,
                                 FederateHandle)>(&FederateAmbassador::discoverObjectInstance),
    "discoverObjectInstance");
static_assert(has<FederateAmbassador, void(ObjectInstanceHandle, AttributeHandleValueMap const&,
                                           VariableLengthData const&, OrderType, TransportationType,
                                           SupplementalReflectInfo)>(
                  &FederateAmbassador::reflectAttributeValues),
              "reflectAttributeValues");
static_assert(has<FederateAmbassador, void(ObjectInstanceHandle, AttributeHandleValueMap const&,
                                           VariableLengthData const&, OrderType, TransportationType,
                                           LogicalTime const&, OrderType, SupplementalReflectInfo)>(
                  &FederateAmbassador::reflectAttributeValues),
              "reflectAttributeValues");
static_assert(
    has<FederateAmbassador,
        void(ObjectInstanceHandle, AttributeHandleValueMap const&, VariableLengthData const&,
             OrderType, TransportationType, LogicalTime const&, OrderType, MessageRetractionHandle,
             SupplementalReflectInfo)>(&FederateAmbassador::reflectAttributeValues),
    "reflectAttributeValues");
static_assert(
    has<FederateAmbassador, void(InteractionClassHandle, ParameterHandleValueMap const&,
                                 VariableLengthData const&, OrderType, TransportationType,
                                 SupplementalReceiveInfo)>(&FederateAmbassador::receiveInteraction),
    "receiveInteraction");
static_assert(has<FederateAmbassador, void(InteractionClassHandle, ParameterHandleValueMap const&,
                                           VariableLengthData const&, OrderType, TransportationType,
                                           LogicalTime const&, OrderType, SupplementalReceiveInfo)>(
                  &FederateAmbassador::receiveInteraction),
              "receiveInteraction");
static_assert(
    has<FederateAmbassador,
        void(InteractionClassHandle, ParameterHandleValueMap const&, VariableLengthData const&,
             OrderType, TransportationType, LogicalTime const&, OrderType, MessageRetractionHandle,
             SupplementalReceiveInfo)>(&FederateAmbassador::receiveInteraction),
    "receiveInteraction");
static_assert(has<FederateAmbassador, void(ObjectInstanceHandle, VariableLengthData const&,
                                           OrderType, SupplementalRemoveInfo)>(
                  &FederateAmbassador::removeObjectInstance),
              "removeObjectInstance");
static_assert(
    has<FederateAmbassador, void(ObjectInstanceHandle, VariableLengthData const&, OrderType,
                                 LogicalTime const&, OrderType, SupplementalRemoveInfo)>(
        &FederateAmbassador::removeObjectInstance),
    "removeObjectInstance");
static_assert(has<FederateAmbassador, void(ObjectInstanceHandle, VariableLengthData const&,
                                           OrderType, LogicalTime const&, OrderType,
                                           MessageRetractionHandle, SupplementalRemoveInfo)>(
                  &FederateAmbassador::removeObjectInstance),
              "removeObjectInstance");
static_assert(has<FederateAmbassador, void(ObjectInstanceHandle, AttributeHandleSet const&)>(
                  &FederateAmbassador::attributesInScope),
              "attributesInScope");
static_assert(has<FederateAmbassador, void(ObjectInstanceHandle, AttributeHandleSet const&)>(
                  &FederateAmbassador::attributesOutOfScope),
              "attributesOutOfScope");
static_assert(has<FederateAmbassador,
                  void(ObjectInstanceHandle, AttributeHandleSet const&, VariableLengthData const&)>(
                  &FederateAmbassador::provideAttributeValueUpdate),
              "provideAttributeValueUpdate");
static_assert(has<FederateAmbassador, void(ObjectInstanceHandle, AttributeHandleSet const&)>(
                  &FederateAmbassador::turnUpdatesOnForObjectInstance),
              "turnUpdatesOnForObjectInstance");
static_assert(has<FederateAmbassador,
                  void(ObjectInstanceHandle, AttributeHandleSet const&, std::wstring const&)>(
                  &FederateAmbassador::turnUpdatesOnForObjectInstance),
              "turnUpdatesOnForObjectInstance");
static_assert(has<FederateAmbassador, void(ObjectInstanceHandle, AttributeHandleSet const&)>(
                  &FederateAmbassador::turnUpdatesOffForObjectInstance),
              "turnUpdatesOffForObjectInstance");
static_assert(
    has<FederateAmbassador, void(ObjectInstanceHandle, AttributeHandleSet, TransportationType)>(
        &FederateAmbassador::confirmAttributeTransportationTypeChange),
    "confirmAttributeTransportationTypeChange");
static_assert(
    has<FederateAmbassador, void(ObjectInstanceHandle, AttributeHandle, TransportationType)>(
        &FederateAmbassador::reportAttributeTransportationType),
    "reportAttributeTransportationType");
static_assert(has<FederateAmbassador, void(InteractionClassHandle, TransportationType)>(
                  &FederateAmbassador::confirmInteractionTransportationTypeChange),
              "confirmInteractionTransportationTypeChange");
static_assert(
    has<FederateAmbassador, void(FederateHandle, InteractionClassHandle, TransportationType)>(
        &FederateAmbassador::reportInteractionTransportationType),
    "reportInteractionTransportationType");

// Ownership management.
static_assert(has<FederateAmbassador,
                  void(ObjectInstanceHandle, AttributeHandleSet const&, VariableLengthData const&)>(
                  &FederateAmbassador::requestAttributeOwnershipAssumption),
              "requestAttributeOwnershipAssumption");
static_assert(has<FederateAmbassador, void(ObjectInstanceHandle, AttributeHandleSet const&)>(
                  &FederateAmbassador::requestDivestitureConfirmation),
              "requestDivestitureConfirmation");
static_assert(has<FederateAmbassador,
                  void(ObjectInstanceHandle, AttributeHandleSet const&, VariableLengthData const&)>(
                  &FederateAmbassador::attributeOwnershipAcquisitionNotification),
              "attributeOwnershipAcquisitionNotification");
static_assert(has<FederateAmbassador, void(ObjectInstanceHandle, AttributeHandleSet const&)>(
                  &FederateAmbassador::attributeOwnershipUnavailable),
              "attributeOwnershipUnavailable");
static_assert(has<FederateAmbassador,
                  void(ObjectInstanceHandle, AttributeHandleSet const&, VariableLengthData const&)>(
                  &FederateAmbassador::requestAttributeOwnershipRelease),
              "requestAttributeOwnershipRelease");
static_assert(has<FederateAmbassador, void(ObjectInstanceHandle, AttributeHandleSet const&)>(
                  &FederateAmbassador::confirmAttributeOwnershipAcquisitionCancellation),
              "confirmAttributeOwnershipAcquisitionCancellation");
static_assert(has<FederateAmbassador, void(ObjectInstanceHandle, AttributeHandle, FederateHandle)>(
                  &FederateAmbassador::informAttributeOwnership),
              "informAttributeOwnership");
static_assert(has<FederateAmbassador, void(ObjectInstanceHandle, AttributeHandle)>(
                  &FederateAmbassador::attributeIsNotOwned),
              "attributeIsNotOwned");
static_assert(has<FederateAmbassador, void(ObjectInstanceHandle, AttributeHandle)>(
                  &FederateAmbassador::attributeIsOwnedByRTI),
              "attributeIsOwnedByRTI");

// Time management.
static_assert(
    has<FederateAmbassador, void(LogicalTime const&)>(&FederateAmbassador::timeRegulationEnabled),
    "timeRegulationEnabled");
static_assert(
    has<FederateAmbassador, void(LogicalTime const&)>(&FederateAmbassador::timeConstrainedEnabled),
    "timeConstrainedEnabled");
static_assert(
    has<FederateAmbassador, void(LogicalTime const&)>(&FederateAmbassador::timeAdvanceGrant),
    "timeAdvanceGrant");
static_assert(
    has<FederateAmbassador, void(MessageRetractionHandle)>(&FederateAmbassador::requestRetraction),
    "requestRetraction");

}  // namespace
}  // namespace rti1516e
