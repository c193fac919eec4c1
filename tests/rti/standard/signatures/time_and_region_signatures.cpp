// The services of clauses 8 to 10, as IEEE 1516.1-2010 declares them.
#include "tests/rti/standard/signatures/has.h"

namespace rti1516e {
namespace {

using rink::standard::testing::has;

// Time management.
static_assert(
    has<RTIambassador, void(LogicalTimeInterval const&)>(&RTIambassador::enableTimeRegulation),
    "enableTimeRegulation");
static_assert(has<RTIambassador, void()>(&RTIambassador::disableTimeRegulation),
              "disableTimeRegulation");
static_assert(has<RTIambassador, void()>(&RTIambassador::enableTimeConstrained),
              "enableTimeConstrained");
static_assert(has<RTIambassador, void()>(&RTIambassador::disableTimeConstrained),
              "disableTimeConstrained");
static_assert(has<RTIambassador, void(LogicalTime const&)>(&RTIambassador::timeAdvanceRequest),
              "timeAdvanceRequest");
static_assert(
    has<RTIambassador, void(LogicalTime const&)>(&RTIambassador::timeAdvanceRequestAvailable),
    "timeAdvanceRequestAvailable");
static_assert(has<RTIambassador, void(LogicalTime const&)>(&RTIambassador::nextMessageRequest),
              "nextMessageRequest");
static_assert(
    has<RTIambassador, void(LogicalTime const&)>(&RTIambassador::nextMessageRequestAvailable),
    "nextMessageRequestAvailable");
static_assert(has<RTIambassador, void(LogicalTime const&)>(&RTIambassador::flushQueueRequest),
              "flushQueueRequest");
static_assert(has<RTIambassador, void()>(&RTIambassador::enableAsynchronousDelivery),
              "enableAsynchronousDelivery");
static_assert(has<RTIambassador, void()>(&RTIambassador::disableAsynchronousDelivery),
              "disableAsynchronousDelivery");
static_assert(has<RTIambassador, bool(LogicalTime&)>(&RTIambassador::queryGALT), "queryGALT");
static_assert(has<RTIambassador, void(LogicalTime&)>(&RTIambassador::queryLogicalTime),
              "queryLogicalTime");
static_assert(has<RTIambassador, bool(LogicalTime&)>(&RTIambassador::queryLITS), "queryLITS");
static_assert(has<RTIambassador, void(LogicalTimeInterval const&)>(&RTIambassador::modifyLookahead),
              "modifyLookahead");
static_assert(has<RTIambassador, void(LogicalTimeInterval&)>(&RTIambassador::queryLookahead),
              "queryLookahead");
static_assert(has<RTIambassador, void(MessageRetractionHandle)>(&RTIambassador::retract),
              "retract");
static_assert(has<RTIambassador, void(ObjectInstanceHandle, AttributeHandleSet const&, OrderType)>(
                  &RTIambassador::changeAttributeOrderType),
              "changeAttributeOrderType");
static_assert(has<RTIambassador, void(InteractionClassHandle, OrderType)>(
                  &RTIambassador::changeInteractionOrderType),
              "changeInteractionOrderType");

// Data distribution management.
static_assert(
    has<RTIambassador, RegionHandle(DimensionHandleSet const&)>(&RTIambassador::createRegion),
    "createRegion");
static_assert(
    has<RTIambassador, void(RegionHandleSet const&)>(&RTIambassador::commitRegionModifications),
    "commitRegionModifications");
static_assert(has<RTIambassador, void(RegionHandle const&)>(&RTIambassador::deleteRegion),
              "deleteRegion");
static_assert(
    has<RTIambassador, ObjectInstanceHandle(ObjectClassHandle,
                                            AttributeHandleSetRegionHandleSetPairVector const&)>(
        &RTIambassador::registerObjectInstanceWithRegions),
    "registerObjectInstanceWithRegions");
static_assert(
    has<RTIambassador, ObjectInstanceHandle(
                           ObjectClassHandle, AttributeHandleSetRegionHandleSetPairVector const&,
                           std::wstring const&)>(&RTIambassador::registerObjectInstanceWithRegions),
    "registerObjectInstanceWithRegions");
static_assert(has<RTIambassador,
                  void(ObjectInstanceHandle, AttributeHandleSetRegionHandleSetPairVector const&)>(
                  &RTIambassador::associateRegionsForUpdates),
              "associateRegionsForUpdates");
static_assert(has<RTIambassador,
                  void(ObjectInstanceHandle, AttributeHandleSetRegionHandleSetPairVector const&)>(
                  &RTIambassador::unassociateRegionsForUpdates),
              "unassociateRegionsForUpdates");
static_assert(
    has<RTIambassador, void(ObjectClassHandle, AttributeHandleSetRegionHandleSetPairVector const&,
                            bool, std::wstring const&)>(
        &RTIambassador::subscribeObjectClassAttributesWithRegions),
    "subscribeObjectClassAttributesWithRegions");
static_assert(
    has<RTIambassador, void(ObjectClassHandle, AttributeHandleSetRegionHandleSetPairVector const&)>(
        &RTIambassador::unsubscribeObjectClassAttributesWithRegions),
    "unsubscribeObjectClassAttributesWithRegions");
static_assert(has<RTIambassador, void(InteractionClassHandle, RegionHandleSet const&, bool)>(
                  &RTIambassador::subscribeInteractionClassWithRegions),
              "subscribeInteractionClassWithRegions");
static_assert(has<RTIambassador, void(InteractionClassHandle, RegionHandleSet const&)>(
                  &RTIambassador::unsubscribeInteractionClassWithRegions),
              "unsubscribeInteractionClassWithRegions");
static_assert(has<RTIambassador, void(InteractionClassHandle, ParameterHandleValueMap const&,
                                      RegionHandleSet const&, VariableLengthData const&)>(
                  &RTIambassador::sendInteractionWithRegions),
              "sendInteractionWithRegions");
static_assert(
    has<RTIambassador, MessageRetractionHandle(
                           InteractionClassHandle, ParameterHandleValueMap const&,
                           RegionHandleSet const&, VariableLengthData const&, LogicalTime const&)>(
        &RTIambassador::sendInteractionWithRegions),
    "sendInteractionWithRegions");
static_assert(
    has<RTIambassador, void(ObjectClassHandle, AttributeHandleSetRegionHandleSetPairVector const&,
                            VariableLengthData const&)>(
        &RTIambassador::requestAttributeValueUpdateWithRegions),
    "requestAttributeValueUpdateWithRegions");

// Support services.
static_assert(has<RTIambassador, ResignAction()>(&RTIambassador::getAutomaticResignDirective),
              "getAutomaticResignDirective");
static_assert(has<RTIambassador, void(ResignAction)>(&RTIambassador::setAutomaticResignDirective),
              "setAutomaticResignDirective");
static_assert(
    has<RTIambassador, FederateHandle(std::wstring const&)>(&RTIambassador::getFederateHandle),
    "getFederateHandle");
static_assert(has<RTIambassador, std::wstring(FederateHandle)>(&RTIambassador::getFederateName),
              "getFederateName");
static_assert(has<RTIambassador, ObjectClassHandle(std::wstring const&)>(
                  &RTIambassador::getObjectClassHandle),
              "getObjectClassHandle");
static_assert(
    has<RTIambassador, std::wstring(ObjectClassHandle)>(&RTIambassador::getObjectClassName),
    "getObjectClassName");
static_assert(has<RTIambassador, ObjectClassHandle(ObjectInstanceHandle)>(
                  &RTIambassador::getKnownObjectClassHandle),
              "getKnownObjectClassHandle");
static_assert(has<RTIambassador, ObjectInstanceHandle(std::wstring const&)>(
                  &RTIambassador::getObjectInstanceHandle),
              "getObjectInstanceHandle");
static_assert(
    has<RTIambassador, std::wstring(ObjectInstanceHandle)>(&RTIambassador::getObjectInstanceName),
    "getObjectInstanceName");
static_assert(has<RTIambassador, AttributeHandle(ObjectClassHandle, std::wstring const&)>(
                  &RTIambassador::getAttributeHandle),
              "getAttributeHandle");
static_assert(has<RTIambassador, std::wstring(ObjectClassHandle, AttributeHandle)>(
                  &RTIambassador::getAttributeName),
              "getAttributeName");
static_assert(has<RTIambassador, double(std::wstring const&)>(&RTIambassador::getUpdateRateValue),
              "getUpdateRateValue");
static_assert(has<RTIambassador, double(ObjectInstanceHandle, AttributeHandle)>(
                  &RTIambassador::getUpdateRateValueForAttribute),
              "getUpdateRateValueForAttribute");
static_assert(has<RTIambassador, InteractionClassHandle(std::wstring const&)>(
                  &RTIambassador::getInteractionClassHandle),
              "getInteractionClassHandle");
static_assert(has<RTIambassador, std::wstring(InteractionClassHandle)>(
                  &RTIambassador::getInteractionClassName),
              "getInteractionClassName");
static_assert(has<RTIambassador, ParameterHandle(InteractionClassHandle, std::wstring const&)>(
                  &RTIambassador::getParameterHandle),
              "getParameterHandle");
static_assert(has<RTIambassador, std::wstring(InteractionClassHandle, ParameterHandle)>(
                  &RTIambassador::getParameterName),
              "getParameterName");
static_assert(has<RTIambassador, OrderType(std::wstring const&)>(&RTIambassador::getOrderType),
              "getOrderType");
static_assert(has<RTIambassador, std::wstring(OrderType)>(&RTIambassador::getOrderName),
              "getOrderName");
static_assert(has<RTIambassador, TransportationType(std::wstring const&)>(
                  &RTIambassador::getTransportationType),
              "getTransportationType");
static_assert(
    has<RTIambassador, std::wstring(TransportationType)>(&RTIambassador::getTransportationName),
    "getTransportationName");
static_assert(has<RTIambassador, DimensionHandleSet(ObjectClassHandle, AttributeHandle)>(
                  &RTIambassador::getAvailableDimensionsForClassAttribute),
              "getAvailableDimensionsForClassAttribute");
static_assert(has<RTIambassador, DimensionHandleSet(InteractionClassHandle)>(
                  &RTIambassador::getAvailableDimensionsForInteractionClass),
              "getAvailableDimensionsForInteractionClass");
static_assert(
    has<RTIambassador, DimensionHandle(std::wstring const&)>(&RTIambassador::getDimensionHandle),
    "getDimensionHandle");
static_assert(has<RTIambassador, std::wstring(DimensionHandle)>(&RTIambassador::getDimensionName),
              "getDimensionName");
static_assert(
    has<RTIambassador, unsigned long(DimensionHandle)>(&RTIambassador::getDimensionUpperBound),
    "getDimensionUpperBound");
static_assert(
    has<RTIambassador, DimensionHandleSet(RegionHandle)>(&RTIambassador::getDimensionHandleSet),
    "getDimensionHandleSet");
static_assert(
    has<RTIambassador, RangeBounds(RegionHandle, DimensionHandle)>(&RTIambassador::getRangeBounds),
    "getRangeBounds");
static_assert(has<RTIambassador, void(RegionHandle, DimensionHandle, RangeBounds const&)>(
                  &RTIambassador::setRangeBounds),
              "setRangeBounds");
static_assert(
    has<RTIambassador, unsigned long(FederateHandle)>(&RTIambassador::normalizeFederateHandle),
    "normalizeFederateHandle");
static_assert(
    has<RTIambassador, unsigned long(ServiceGroup)>(&RTIambassador::normalizeServiceGroup),
    "normalizeServiceGroup");
static_assert(has<RTIambassador, void()>(&RTIambassador::enableObjectClassRelevanceAdvisorySwitch),
              "enableObjectClassRelevanceAdvisorySwitch");
static_assert(has<RTIambassador, void()>(&RTIambassador::disableObjectClassRelevanceAdvisorySwitch),
              "disableObjectClassRelevanceAdvisorySwitch");
static_assert(has<RTIambassador, void()>(&RTIambassador::enableAttributeRelevanceAdvisorySwitch),
              "enableAttributeRelevanceAdvisorySwitch");
static_assert(has<RTIambassador, void()>(&RTIambassador::disableAttributeRelevanceAdvisorySwitch),
              "disableAttributeRelevanceAdvisorySwitch");
static_assert(has<RTIambassador, void()>(&RTIambassador::enableAttributeScopeAdvisorySwitch),
              "enableAttributeScopeAdvisorySwitch");
static_assert(has<RTIambassador, void()>(&RTIambassador::disableAttributeScopeAdvisorySwitch),
              "disableAttributeScopeAdvisorySwitch");
static_assert(has<RTIambassador, void()>(&RTIambassador::enableInteractionRelevanceAdvisorySwitch),
              "enableInteractionRelevanceAdvisorySwitch");
static_assert(has<RTIambassador, void()>(&RTIambassador::disableInteractionRelevanceAdvisorySwitch),
              "disableInteractionRelevanceAdvisorySwitch");
static_assert(has<RTIambassador, bool(double)>(&RTIambassador::evokeCallback), "evokeCallback");
static_assert(has<RTIambassador, bool(double, double)>(&RTIambassador::evokeMultipleCallbacks),
              "evokeMultipleCallbacks");
static_assert(has<RTIambassador, void()>(&RTIambassador::enableCallbacks), "enableCallbacks");
static_assert(has<RTIambassador, void()>(&RTIambassador::disableCallbacks), "disableCallbacks");
static_assert(
    has<RTIambassador, std::auto_ptr<LogicalTimeFactory>() const>(&RTIambassador::getTimeFactory),
    "getTimeFactory");
static_assert(has<RTIambassador, FederateHandle(VariableLengthData const&) const>(
                  &RTIambassador::decodeFederateHandle),
              "decodeFederateHandle");
static_assert(has<RTIambassador, ObjectClassHandle(VariableLengthData const&) const>(
                  &RTIambassador::decodeObjectClassHandle),
              "decodeObjectClassHandle");
static_assert(has<RTIambassador, InteractionClassHandle(VariableLengthData const&) const>(
                  &RTIambassador::decodeInteractionClassHandle),
              "decodeInteractionClassHandle");
static_assert(has<RTIambassador, ObjectInstanceHandle(VariableLengthData const&) const>(
                  &RTIambassador::decodeObjectInstanceHandle),
              "decodeObjectInstanceHandle");
static_assert(has<RTIambassador, AttributeHandle(VariableLengthData const&) const>(
                  &RTIambassador::decodeAttributeHandle),
              "decodeAttributeHandle");
static_assert(has<RTIambassador, ParameterHandle(VariableLengthData const&) const>(
                  &RTIambassador::decodeParameterHandle),
              "decodeParameterHandle");
static_assert(has<RTIambassador, DimensionHandle(VariableLengthData const&) const>(
                  &RTIambassador::decodeDimensionHandle),
              "decodeDimensionHandle");
static_assert(has<RTIambassador, MessageRetractionHandle(VariableLengthData const&) const>(
                  &RTIambassador::decodeMessageRetractionHandle),
              "decodeMessageRetractionHandle");
static_assert(has<RTIambassador, RegionHandle(VariableLengthData const&) const>(
                  &RTIambassador::decodeRegionHandle),
              "decodeRegionHandle");

}  // namespace
}  // namespace rti1516e
