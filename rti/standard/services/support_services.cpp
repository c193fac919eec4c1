// The other support services.
#include "rti/standard/services/support_services.h"

#include "rti/standard/handles.h"
#include "rti/standard/wide_text.h"

namespace rink::standard {

rti1516e::ResignAction SupportServices::getAutomaticResignDirective() {
  return federate().call([](rti::Ambassador&, FederateState& state) {
    return static_cast<rti1516e::ResignAction>(state.resign_directive);
  });
}

void SupportServices::setAutomaticResignDirective(rti1516e::ResignAction resignAction) {
  federate().call([&](rti::Ambassador& core, FederateState& state) {
    if (resignAction < rti1516e::UNCONDITIONALLY_DIVEST_ATTRIBUTES ||
        resignAction > rti1516e::NO_ACTION)
      throw rti1516e::InvalidResignAction(L"there is no such action");
    const auto action = static_cast<rti::ResignAction>(resignAction);
    core.set_automatic_resign_directive(action);
    state.resign_directive = action;
  });
}

unsigned long SupportServices::normalizeFederateHandle(rti1516e::FederateHandle theFederateHandle) {
  return federate().call([&](rti::Ambassador& core, FederateState&) -> unsigned long {
    try {
      core.get_federate_name(to_core(theFederateHandle));
    } catch (const rti::RtiException& error) {
      throw rti1516e::InvalidFederateHandle(to_wide(error.what()));
    }
    return to_core(theFederateHandle).value;
  });
}

unsigned long SupportServices::normalizeServiceGroup(rti1516e::ServiceGroup theServiceGroup) {
  return federate().call([&](rti::Ambassador&, FederateState&) -> unsigned long {
    if (theServiceGroup < rti1516e::FEDERATION_MANAGEMENT ||
        theServiceGroup > rti1516e::SUPPORT_SERVICES)
      throw rti1516e::InvalidServiceGroup(L"there is no such group");
    return static_cast<unsigned long>(theServiceGroup);
  });
}

void SupportServices::enableObjectClassRelevanceAdvisorySwitch() {
  federate().call([](rti::Ambassador& core, FederateState&) {
    core.enable_object_class_relevance_advisory_switch();
  });
}

void SupportServices::disableObjectClassRelevanceAdvisorySwitch() {
  federate().call([](rti::Ambassador& core, FederateState&) {
    core.disable_object_class_relevance_advisory_switch();
  });
}

void SupportServices::enableAttributeRelevanceAdvisorySwitch() {
  federate().call([](rti::Ambassador& core, FederateState&) {
    core.enable_attribute_relevance_advisory_switch();
  });
}

void SupportServices::disableAttributeRelevanceAdvisorySwitch() {
  federate().call([](rti::Ambassador& core, FederateState&) {
    core.disable_attribute_relevance_advisory_switch();
  });
}

void SupportServices::enableAttributeScopeAdvisorySwitch() {
  federate().call(
      [](rti::Ambassador& core, FederateState&) { core.enable_attribute_scope_advisory_switch(); });
}

void SupportServices::disableAttributeScopeAdvisorySwitch() {
  federate().call([](rti::Ambassador& core, FederateState&) {
    core.disable_attribute_scope_advisory_switch();
  });
}

void SupportServices::enableInteractionRelevanceAdvisorySwitch() {
  federate().call([](rti::Ambassador& core, FederateState&) {
    core.enable_interaction_relevance_advisory_switch();
  });
}

void SupportServices::disableInteractionRelevanceAdvisorySwitch() {
  federate().call([](rti::Ambassador& core, FederateState&) {
    core.disable_interaction_relevance_advisory_switch();
  });
}

bool SupportServices::evokeCallback(double approximateMinimumTimeInSeconds) {
  return federate().evoke_one(approximateMinimumTimeInSeconds);
}

bool SupportServices::evokeMultipleCallbacks(double approximateMinimumTimeInSeconds,
                                             double approximateMaximumTimeInSeconds) {
  return federate().evoke_many(approximateMinimumTimeInSeconds, approximateMaximumTimeInSeconds);
}

void SupportServices::enableCallbacks() { federate().enable_callbacks(true); }

void SupportServices::disableCallbacks() { federate().enable_callbacks(false); }

std::auto_ptr<rti1516e::LogicalTimeFactory> SupportServices::getTimeFactory() const {
  return std::auto_ptr<rti1516e::LogicalTimeFactory>(
      federate()
          .call([](rti::Ambassador&, FederateState& state) { return state.times.factory(); })
          .release());
}

rti1516e::FederateHandle SupportServices::decodeFederateHandle(
    rti1516e::VariableLengthData const& encodedValue) const {
  return federate().call([&](rti::Ambassador&, FederateState&) {
    return rti1516e::FederateHandleFriend::decode(encodedValue);
  });
}

rti1516e::ObjectClassHandle SupportServices::decodeObjectClassHandle(
    rti1516e::VariableLengthData const& encodedValue) const {
  return federate().call([&](rti::Ambassador&, FederateState&) {
    return rti1516e::ObjectClassHandleFriend::decode(encodedValue);
  });
}

rti1516e::InteractionClassHandle SupportServices::decodeInteractionClassHandle(
    rti1516e::VariableLengthData const& encodedValue) const {
  return federate().call([&](rti::Ambassador&, FederateState&) {
    return rti1516e::InteractionClassHandleFriend::decode(encodedValue);
  });
}

rti1516e::ObjectInstanceHandle SupportServices::decodeObjectInstanceHandle(
    rti1516e::VariableLengthData const& encodedValue) const {
  return federate().call([&](rti::Ambassador&, FederateState&) {
    return rti1516e::ObjectInstanceHandleFriend::decode(encodedValue);
  });
}

rti1516e::AttributeHandle SupportServices::decodeAttributeHandle(
    rti1516e::VariableLengthData const& encodedValue) const {
  return federate().call([&](rti::Ambassador&, FederateState&) {
    return rti1516e::AttributeHandleFriend::decode(encodedValue);
  });
}

rti1516e::ParameterHandle SupportServices::decodeParameterHandle(
    rti1516e::VariableLengthData const& encodedValue) const {
  return federate().call([&](rti::Ambassador&, FederateState&) {
    return rti1516e::ParameterHandleFriend::decode(encodedValue);
  });
}

rti1516e::DimensionHandle SupportServices::decodeDimensionHandle(
    rti1516e::VariableLengthData const& encodedValue) const {
  return federate().call([&](rti::Ambassador&, FederateState&) {
    return rti1516e::DimensionHandleFriend::decode(encodedValue);
  });
}

rti1516e::MessageRetractionHandle SupportServices::decodeMessageRetractionHandle(
    rti1516e::VariableLengthData const& encodedValue) const {
  return federate().call([&](rti::Ambassador&, FederateState&) {
    return rti1516e::MessageRetractionHandleFriend::decode(encodedValue);
  });
}

rti1516e::RegionHandle SupportServices::decodeRegionHandle(
    rti1516e::VariableLengthData const& encodedValue) const {
  return federate().call([&](rti::Ambassador&, FederateState&) {
    return rti1516e::RegionHandleFriend::decode(encodedValue);
  });
}

}  // namespace rink::standard

namespace rti1516e {

RTIambassadorFactory::RTIambassadorFactory() = default;
RTIambassadorFactory::~RTIambassadorFactory() = default;

std::auto_ptr<RTIambassador> RTIambassadorFactory::createRTIambassador() {
  return std::auto_ptr<RTIambassador>(new rink::standard::SupportServices);
}

std::wstring rtiName() { return L"Rink"; }
std::wstring rtiVersion() { return L"" RINK_VERSION; }

}  // namespace rti1516e
