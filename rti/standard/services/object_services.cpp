// Object management.
#include "rti/standard/services/object_services.h"

#include "rti/standard/handles.h"
#include "rti/standard/services/choices.h"
#include "rti/standard/services/registration.h"
#include "rti/standard/values.h"
#include "rti/standard/wide_text.h"

namespace rink::standard {

namespace {

std::vector<std::string> narrow_names(const std::set<std::wstring>& names) {
  std::vector<std::string> all;
  all.reserve(names.size());
  for (const std::wstring& each : names) all.push_back(to_utf8(each));
  return all;
}

/// The same memory for each update.
const Update& update_of(const rti::Ambassador& core, FederateState& state, rti::ObjectHandle object,
                        const rti1516e::AttributeHandleValueMap& values) {
  encode_update(core.fom(), core.get_known_object_class_handle(object), values, state.sent);
  return state.sent;
}

}  // namespace

void ObjectServices::reserveObjectInstanceName(std::wstring const& theObjectInstanceName) {
  federate().call([&](rti::Ambassador& core, FederateState&) {
    core.reserve_object_instance_name(to_utf8(theObjectInstanceName));
  });
}

void ObjectServices::releaseObjectInstanceName(std::wstring const& theObjectInstanceName) {
  federate().call([&](rti::Ambassador& core, FederateState& state) {
    const std::string name = to_utf8(theObjectInstanceName);
    core.release_object_instance_name(name);
    state.reserved_names.erase(name);
  });
}

void ObjectServices::reserveMultipleObjectInstanceName(
    std::set<std::wstring> const& theObjectInstanceNames) {
  federate().call([&](rti::Ambassador& core, FederateState&) {
    const std::vector<std::string> names = narrow_names(theObjectInstanceNames);
    core.reserve_multiple_object_instance_names(
        std::vector<std::string_view>(names.begin(), names.end()));
  });
}

void ObjectServices::releaseMultipleObjectInstanceName(
    std::set<std::wstring> const& theObjectInstanceNames) {
  federate().call([&](rti::Ambassador& core, FederateState& state) {
    const std::vector<std::string> names = narrow_names(theObjectInstanceNames);
    core.release_multiple_object_instance_names(
        std::vector<std::string_view>(names.begin(), names.end()));
    for (const std::string& each : names) state.reserved_names.erase(each);
  });
}

rti1516e::ObjectInstanceHandle ObjectServices::registerObjectInstance(
    rti1516e::ObjectClassHandle theClass) {
  return federate().call([&](rti::Ambassador& core, FederateState& state) {
    return registered(core, state, to_core(theClass),
                      core.register_object_instance(to_core(theClass)));
  });
}

rti1516e::ObjectInstanceHandle ObjectServices::registerObjectInstance(
    rti1516e::ObjectClassHandle theClass, std::wstring const& theObjectInstanceName) {
  return federate().call([&](rti::Ambassador& core, FederateState& state) {
    const std::string name = reserved_name(state, theObjectInstanceName);
    return registered(core, state, to_core(theClass),
                      core.register_object_instance(to_core(theClass), name));
  });
}

void ObjectServices::updateAttributeValues(
    rti1516e::ObjectInstanceHandle theObject,
    rti1516e::AttributeHandleValueMap const& theAttributeValues,
    rti1516e::VariableLengthData const& theUserSuppliedTag) {
  federate().call([&](rti::Ambassador& core, FederateState& state) {
    const Update& update = update_of(core, state, to_core(theObject), theAttributeValues);
    if (update.attributes.is_empty()) return;
    core.update_attribute_values(to_core(theObject), update.attributes, update.values,
                                 tag_stamp(theUserSuppliedTag, {}));
  });
}

rti1516e::MessageRetractionHandle ObjectServices::updateAttributeValues(
    rti1516e::ObjectInstanceHandle theObject,
    rti1516e::AttributeHandleValueMap const& theAttributeValues,
    rti1516e::VariableLengthData const& theUserSuppliedTag, rti1516e::LogicalTime const& theTime) {
  return federate().call([&](rti::Ambassador& core, FederateState& state) {
    const Update& update = update_of(core, state, to_core(theObject), theAttributeValues);
    const double time = state.times.number(theTime);
    const rti::Stamp stamp = tag_stamp(theUserSuppliedTag, time);
    if (update.attributes.is_empty()) return rti1516e::MessageRetractionHandle();
    return to_standard(core.update_attribute_values(
        to_core(theObject), update.attributes, update.values, rti::LogicalTime(time), stamp.tag));
  });
}

void ObjectServices::sendInteraction(rti1516e::InteractionClassHandle theInteraction,
                                     rti1516e::ParameterHandleValueMap const& theParameterValues,
                                     rti1516e::VariableLengthData const& theUserSuppliedTag) {
  federate().call([&](rti::Ambassador& core, FederateState&) {
    const Message message =
        message_of(core, to_core(theInteraction), theParameterValues, theUserSuppliedTag, {});
    core.send_interaction(to_core(theInteraction), message.parameters, message.stamp);
  });
}

rti1516e::MessageRetractionHandle ObjectServices::sendInteraction(
    rti1516e::InteractionClassHandle theInteraction,
    rti1516e::ParameterHandleValueMap const& theParameterValues,
    rti1516e::VariableLengthData const& theUserSuppliedTag, rti1516e::LogicalTime const& theTime) {
  return federate().call([&](rti::Ambassador& core, FederateState& state) {
    const double time = state.times.number(theTime);
    const Message message =
        message_of(core, to_core(theInteraction), theParameterValues, theUserSuppliedTag, time);
    return to_standard(core.send_interaction(to_core(theInteraction), message.parameters,
                                             rti::LogicalTime(time), message.stamp.tag));
  });
}

/// A deletion in receive order has no room for a tag.
void ObjectServices::deleteObjectInstance(rti1516e::ObjectInstanceHandle theObject,
                                          rti1516e::VariableLengthData const&) {
  federate().call([&](rti::Ambassador& core, FederateState& state) {
    core.delete_object_instance(to_core(theObject));
    state.forget(to_core(theObject));
  });
}

rti1516e::MessageRetractionHandle ObjectServices::deleteObjectInstance(
    rti1516e::ObjectInstanceHandle theObject,
    rti1516e::VariableLengthData const& theUserSuppliedTag, rti1516e::LogicalTime const& theTime) {
  return federate().call([&](rti::Ambassador& core, FederateState& state) {
    const double time = state.times.number(theTime);
    const rti::Stamp stamp = tag_stamp(theUserSuppliedTag, time);
    const rti::RetractionHandle handle =
        core.delete_object_instance(to_core(theObject), rti::LogicalTime(time), stamp.tag);
    state.forget(to_core(theObject), handle);
    return to_standard(handle);
  });
}

void ObjectServices::localDeleteObjectInstance(rti1516e::ObjectInstanceHandle theObject) {
  federate().call([&](rti::Ambassador& core, FederateState& state) {
    core.local_delete_object_instance(to_core(theObject));
    state.forget(to_core(theObject));
  });
}

void ObjectServices::requestAttributeValueUpdate(
    rti1516e::ObjectInstanceHandle theObject, rti1516e::AttributeHandleSet const& theAttributes,
    rti1516e::VariableLengthData const& theUserSuppliedTag) {
  federate().call([&](rti::Ambassador& core, FederateState&) {
    const rti::AttributeSet attributes = to_core(theAttributes);
    core.request_attribute_value_update(to_core(theObject), attributes,
                                        bytes_of(theUserSuppliedTag));
  });
}

void ObjectServices::requestAttributeValueUpdate(
    rti1516e::ObjectClassHandle theClass, rti1516e::AttributeHandleSet const& theAttributes,
    rti1516e::VariableLengthData const& theUserSuppliedTag) {
  federate().call([&](rti::Ambassador& core, FederateState&) {
    const rti::AttributeSet attributes = to_core(theAttributes);
    core.request_attribute_value_update(to_core(theClass), attributes,
                                        bytes_of(theUserSuppliedTag));
  });
}

void ObjectServices::requestAttributeTransportationTypeChange(
    rti1516e::ObjectInstanceHandle theObject, rti1516e::AttributeHandleSet const& theAttributes,
    rti1516e::TransportationType theType) {
  federate().call([&](rti::Ambassador& core, FederateState&) {
    const rti::AttributeSet attributes = to_core(theAttributes);
    const rti::Transportation transportation = to_core(theType);
    core.request_attribute_transportation_type_change(to_core(theObject), attributes,
                                                      transportation);
  });
}

void ObjectServices::queryAttributeTransportationType(rti1516e::ObjectInstanceHandle theObject,
                                                      rti1516e::AttributeHandle theAttribute) {
  federate().call([&](rti::Ambassador& core, FederateState&) {
    core.query_attribute_transportation_type(to_core(theObject), to_core(theAttribute));
  });
}

void ObjectServices::requestInteractionTransportationTypeChange(
    rti1516e::InteractionClassHandle theClass, rti1516e::TransportationType theType) {
  federate().call([&](rti::Ambassador& core, FederateState&) {
    const rti::Transportation transportation = to_core(theType);
    core.request_interaction_transportation_type_change(to_core(theClass), transportation);
  });
}

void ObjectServices::queryInteractionTransportationType(
    rti1516e::FederateHandle theFederate, rti1516e::InteractionClassHandle theInteraction) {
  federate().call([&](rti::Ambassador& core, FederateState&) {
    core.query_interaction_transportation_type(to_core(theFederate), to_core(theInteraction));
  });
}

}  // namespace rink::standard
