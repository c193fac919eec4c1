// The services of clauses 4 to 7, as IEEE 1516.1-2010 declares them.
#include "tests/rti/standard/signatures/has.h"

namespace rti1516e {
namespace {

using rink::standard::testing::has;

// Federation management.
static_assert(has<RTIambassador, void(FederateAmbassador&, CallbackModel, std::wstring const&)>(
                  &RTIambassador::connect),
              "connect");
static_assert(has<RTIambassador, void()>(&RTIambassador::disconnect), "disconnect");
static_assert(
    has<RTIambassador, void(std::wstring const&, std::wstring const&, std::wstring const&)>(
        &RTIambassador::createFederationExecution),
    "createFederationExecution");
static_assert(has<RTIambassador,
                  void(std::wstring const&, std::vector<std::wstring> const&, std::wstring const&)>(
                  &RTIambassador::createFederationExecution),
              "createFederationExecution");
static_assert(has<RTIambassador, void(std::wstring const&, std::vector<std::wstring> const&,
                                      std::wstring const&, std::wstring const&)>(
                  &RTIambassador::createFederationExecutionWithMIM),
              "createFederationExecutionWithMIM");
static_assert(
    has<RTIambassador, void(std::wstring const&)>(&RTIambassador::destroyFederationExecution),
    "destroyFederationExecution");
static_assert(has<RTIambassador, void()>(&RTIambassador::listFederationExecutions),
              "listFederationExecutions");
static_assert(has<RTIambassador, FederateHandle(std::wstring const&, std::wstring const&,
                                                std::vector<std::wstring> const&)>(
                  &RTIambassador::joinFederationExecution),
              "joinFederationExecution");
static_assert(
    has<RTIambassador, FederateHandle(std::wstring const&, std::wstring const&, std::wstring const&,
                                      std::vector<std::wstring> const&)>(
        &RTIambassador::joinFederationExecution),
    "joinFederationExecution");
static_assert(has<RTIambassador, void(ResignAction)>(&RTIambassador::resignFederationExecution),
              "resignFederationExecution");
static_assert(has<RTIambassador, void(std::wstring const&, VariableLengthData const&)>(
                  &RTIambassador::registerFederationSynchronizationPoint),
              "registerFederationSynchronizationPoint");
static_assert(has<RTIambassador,
                  void(std::wstring const&, VariableLengthData const&, FederateHandleSet const&)>(
                  &RTIambassador::registerFederationSynchronizationPoint),
              "registerFederationSynchronizationPoint");
static_assert(has<RTIambassador, void(std::wstring const&, bool)>(
                  &RTIambassador::synchronizationPointAchieved),
              "synchronizationPointAchieved");

// Save and restore.
static_assert(has<RTIambassador, void(std::wstring const&)>(&RTIambassador::requestFederationSave),
              "requestFederationSave");
static_assert(has<RTIambassador, void(std::wstring const&, LogicalTime const&)>(
                  &RTIambassador::requestFederationSave),
              "requestFederationSave");
static_assert(has<RTIambassador, void()>(&RTIambassador::federateSaveBegun), "federateSaveBegun");
static_assert(has<RTIambassador, void()>(&RTIambassador::federateSaveComplete),
              "federateSaveComplete");
static_assert(has<RTIambassador, void()>(&RTIambassador::federateSaveNotComplete),
              "federateSaveNotComplete");
static_assert(has<RTIambassador, void()>(&RTIambassador::abortFederationSave),
              "abortFederationSave");
static_assert(has<RTIambassador, void()>(&RTIambassador::queryFederationSaveStatus),
              "queryFederationSaveStatus");
static_assert(
    has<RTIambassador, void(std::wstring const&)>(&RTIambassador::requestFederationRestore),
    "requestFederationRestore");
static_assert(has<RTIambassador, void()>(&RTIambassador::federateRestoreComplete),
              "federateRestoreComplete");
static_assert(has<RTIambassador, void()>(&RTIambassador::federateRestoreNotComplete),
              "federateRestoreNotComplete");
static_assert(has<RTIambassador, void()>(&RTIambassador::abortFederationRestore),
              "abortFederationRestore");
static_assert(has<RTIambassador, void()>(&RTIambassador::queryFederationRestoreStatus),
              "queryFederationRestoreStatus");

// Declaration management.
static_assert(has<RTIambassador, void(ObjectClassHandle, AttributeHandleSet const&)>(
                  &RTIambassador::publishObjectClassAttributes),
              "publishObjectClassAttributes");
static_assert(has<RTIambassador, void(ObjectClassHandle)>(&RTIambassador::unpublishObjectClass),
              "unpublishObjectClass");
static_assert(has<RTIambassador, void(ObjectClassHandle, AttributeHandleSet const&)>(
                  &RTIambassador::unpublishObjectClassAttributes),
              "unpublishObjectClassAttributes");
static_assert(
    has<RTIambassador, void(InteractionClassHandle)>(&RTIambassador::publishInteractionClass),
    "publishInteractionClass");
static_assert(
    has<RTIambassador, void(InteractionClassHandle)>(&RTIambassador::unpublishInteractionClass),
    "unpublishInteractionClass");
static_assert(has<RTIambassador,
                  void(ObjectClassHandle, AttributeHandleSet const&, bool, std::wstring const&)>(
                  &RTIambassador::subscribeObjectClassAttributes),
              "subscribeObjectClassAttributes");
static_assert(has<RTIambassador, void(ObjectClassHandle)>(&RTIambassador::unsubscribeObjectClass),
              "unsubscribeObjectClass");
static_assert(has<RTIambassador, void(ObjectClassHandle, AttributeHandleSet const&)>(
                  &RTIambassador::unsubscribeObjectClassAttributes),
              "unsubscribeObjectClassAttributes");
static_assert(has<RTIambassador, void(InteractionClassHandle, bool)>(
                  &RTIambassador::subscribeInteractionClass),
              "subscribeInteractionClass");
static_assert(
    has<RTIambassador, void(InteractionClassHandle)>(&RTIambassador::unsubscribeInteractionClass),
    "unsubscribeInteractionClass");

// Object management.
static_assert(
    has<RTIambassador, void(std::wstring const&)>(&RTIambassador::reserveObjectInstanceName),
    "reserveObjectInstanceName");
static_assert(
    has<RTIambassador, void(std::wstring const&)>(&RTIambassador::releaseObjectInstanceName),
    "releaseObjectInstanceName");
static_assert(has<RTIambassador, void(std::set<std::wstring> const&)>(
                  &RTIambassador::reserveMultipleObjectInstanceName),
              "reserveMultipleObjectInstanceName");
static_assert(has<RTIambassador, void(std::set<std::wstring> const&)>(
                  &RTIambassador::releaseMultipleObjectInstanceName),
              "releaseMultipleObjectInstanceName");
static_assert(has<RTIambassador, ObjectInstanceHandle(ObjectClassHandle)>(
                  &RTIambassador::registerObjectInstance),
              "registerObjectInstance");
static_assert(has<RTIambassador, ObjectInstanceHandle(ObjectClassHandle, std::wstring const&)>(
                  &RTIambassador::registerObjectInstance),
              "registerObjectInstance");
static_assert(
    has<RTIambassador, void(ObjectInstanceHandle, AttributeHandleValueMap const&,
                            VariableLengthData const&)>(&RTIambassador::updateAttributeValues),
    "updateAttributeValues");
static_assert(
    has<RTIambassador, MessageRetractionHandle(ObjectInstanceHandle, AttributeHandleValueMap const&,
                                               VariableLengthData const&, LogicalTime const&)>(
        &RTIambassador::updateAttributeValues),
    "updateAttributeValues");
static_assert(has<RTIambassador, void(InteractionClassHandle, ParameterHandleValueMap const&,
                                      VariableLengthData const&)>(&RTIambassador::sendInteraction),
              "sendInteraction");
static_assert(has<RTIambassador,
                  MessageRetractionHandle(InteractionClassHandle, ParameterHandleValueMap const&,
                                          VariableLengthData const&, LogicalTime const&)>(
                  &RTIambassador::sendInteraction),
              "sendInteraction");
static_assert(has<RTIambassador, void(ObjectInstanceHandle, VariableLengthData const&)>(
                  &RTIambassador::deleteObjectInstance),
              "deleteObjectInstance");
static_assert(
    has<RTIambassador, MessageRetractionHandle(ObjectInstanceHandle, VariableLengthData const&,
                                               LogicalTime const&)>(
        &RTIambassador::deleteObjectInstance),
    "deleteObjectInstance");
static_assert(
    has<RTIambassador, void(ObjectInstanceHandle)>(&RTIambassador::localDeleteObjectInstance),
    "localDeleteObjectInstance");
static_assert(has<RTIambassador,
                  void(ObjectInstanceHandle, AttributeHandleSet const&, VariableLengthData const&)>(
                  &RTIambassador::requestAttributeValueUpdate),
              "requestAttributeValueUpdate");
static_assert(has<RTIambassador,
                  void(ObjectClassHandle, AttributeHandleSet const&, VariableLengthData const&)>(
                  &RTIambassador::requestAttributeValueUpdate),
              "requestAttributeValueUpdate");
static_assert(
    has<RTIambassador, void(ObjectInstanceHandle, AttributeHandleSet const&, TransportationType)>(
        &RTIambassador::requestAttributeTransportationTypeChange),
    "requestAttributeTransportationTypeChange");
static_assert(has<RTIambassador, void(ObjectInstanceHandle, AttributeHandle)>(
                  &RTIambassador::queryAttributeTransportationType),
              "queryAttributeTransportationType");
static_assert(has<RTIambassador, void(InteractionClassHandle, TransportationType)>(
                  &RTIambassador::requestInteractionTransportationTypeChange),
              "requestInteractionTransportationTypeChange");
static_assert(has<RTIambassador, void(FederateHandle, InteractionClassHandle)>(
                  &RTIambassador::queryInteractionTransportationType),
              "queryInteractionTransportationType");

// Ownership management.
static_assert(has<RTIambassador, void(ObjectInstanceHandle, AttributeHandleSet const&)>(
                  &RTIambassador::unconditionalAttributeOwnershipDivestiture),
              "unconditionalAttributeOwnershipDivestiture");
static_assert(has<RTIambassador,
                  void(ObjectInstanceHandle, AttributeHandleSet const&, VariableLengthData const&)>(
                  &RTIambassador::negotiatedAttributeOwnershipDivestiture),
              "negotiatedAttributeOwnershipDivestiture");
static_assert(has<RTIambassador,
                  void(ObjectInstanceHandle, AttributeHandleSet const&, VariableLengthData const&)>(
                  &RTIambassador::confirmDivestiture),
              "confirmDivestiture");
static_assert(has<RTIambassador,
                  void(ObjectInstanceHandle, AttributeHandleSet const&, VariableLengthData const&)>(
                  &RTIambassador::attributeOwnershipAcquisition),
              "attributeOwnershipAcquisition");
static_assert(has<RTIambassador, void(ObjectInstanceHandle, AttributeHandleSet const&)>(
                  &RTIambassador::attributeOwnershipAcquisitionIfAvailable),
              "attributeOwnershipAcquisitionIfAvailable");
static_assert(has<RTIambassador, void(ObjectInstanceHandle, AttributeHandleSet const&)>(
                  &RTIambassador::attributeOwnershipReleaseDenied),
              "attributeOwnershipReleaseDenied");
static_assert(
    has<RTIambassador, void(ObjectInstanceHandle, AttributeHandleSet const&, AttributeHandleSet&)>(
        &RTIambassador::attributeOwnershipDivestitureIfWanted),
    "attributeOwnershipDivestitureIfWanted");
static_assert(has<RTIambassador, void(ObjectInstanceHandle, AttributeHandleSet const&)>(
                  &RTIambassador::cancelNegotiatedAttributeOwnershipDivestiture),
              "cancelNegotiatedAttributeOwnershipDivestiture");
static_assert(has<RTIambassador, void(ObjectInstanceHandle, AttributeHandleSet const&)>(
                  &RTIambassador::cancelAttributeOwnershipAcquisition),
              "cancelAttributeOwnershipAcquisition");
static_assert(has<RTIambassador, void(ObjectInstanceHandle, AttributeHandle)>(
                  &RTIambassador::queryAttributeOwnership),
              "queryAttributeOwnership");
static_assert(has<RTIambassador, bool(ObjectInstanceHandle, AttributeHandle)>(
                  &RTIambassador::isAttributeOwnedByFederate),
              "isAttributeOwnedByFederate");

}  // namespace
}  // namespace rti1516e
