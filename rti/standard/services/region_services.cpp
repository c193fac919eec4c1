// Data distribution management.
#include "rti/standard/services/region_services.h"

#include "rti/standard/handles.h"
#include "rti/standard/services/choices.h"
#include "rti/standard/services/registration.h"

namespace rink::standard {

using Pairs = rti1516e::AttributeHandleSetRegionHandleSetPairVector;

rti1516e::RegionHandle RegionServices::createRegion(
    rti1516e::DimensionHandleSet const& theDimensions) {
  return federate().call([&](rti::Ambassador& core, FederateState&) {
    const rti::DimensionSet dimensions = to_core(theDimensions);
    const rti::RegionHandle region = core.create_region(dimensions);
    if (!region) throw rti1516e::RTIinternalError(L"the federate has too many regions");
    return to_standard(region);
  });
}

void RegionServices::commitRegionModifications(
    rti1516e::RegionHandleSet const& theRegionHandleSet) {
  federate().call([&](rti::Ambassador& core, FederateState&) {
    const std::vector<rti::RegionHandle> regions = to_core(theRegionHandleSet);
    core.commit_region_modifications(regions);
  });
}

void RegionServices::deleteRegion(rti1516e::RegionHandle const& theRegion) {
  federate().call(
      [&](rti::Ambassador& core, FederateState&) { core.delete_region(to_core(theRegion)); });
}

rti1516e::ObjectInstanceHandle RegionServices::registerObjectInstanceWithRegions(
    rti1516e::ObjectClassHandle theClass,
    Pairs const& theAttributeHandleSetRegionHandleSetPairVector) {
  return federate().call([&](rti::Ambassador& core, FederateState& state) {
    const auto pairs = to_core(theAttributeHandleSetRegionHandleSetPairVector);
    return registered(core, state, to_core(theClass),
                      core.register_object_instance_with_regions(to_core(theClass), pairs));
  });
}

rti1516e::ObjectInstanceHandle RegionServices::registerObjectInstanceWithRegions(
    rti1516e::ObjectClassHandle theClass,
    Pairs const& theAttributeHandleSetRegionHandleSetPairVector,
    std::wstring const& theObjectInstanceName) {
  return federate().call([&](rti::Ambassador& core, FederateState& state) {
    const auto pairs = to_core(theAttributeHandleSetRegionHandleSetPairVector);
    const std::string name = reserved_name(state, theObjectInstanceName);
    return registered(core, state, to_core(theClass),
                      core.register_object_instance_with_regions(to_core(theClass), pairs, name));
  });
}

void RegionServices::associateRegionsForUpdates(
    rti1516e::ObjectInstanceHandle theObject,
    Pairs const& theAttributeHandleSetRegionHandleSetPairVector) {
  federate().call([&](rti::Ambassador& core, FederateState&) {
    const auto pairs = to_core(theAttributeHandleSetRegionHandleSetPairVector);
    core.associate_regions_for_updates(to_core(theObject), pairs);
  });
}

void RegionServices::unassociateRegionsForUpdates(
    rti1516e::ObjectInstanceHandle theObject,
    Pairs const& theAttributeHandleSetRegionHandleSetPairVector) {
  federate().call([&](rti::Ambassador& core, FederateState&) {
    const auto pairs = to_core(theAttributeHandleSetRegionHandleSetPairVector);
    core.unassociate_regions_for_updates(to_core(theObject), pairs);
  });
}

void RegionServices::subscribeObjectClassAttributesWithRegions(
    rti1516e::ObjectClassHandle theClass,
    Pairs const& theAttributeHandleSetRegionHandleSetPairVector, bool active,
    std::wstring const& updateRateDesignator) {
  federate().call([&](rti::Ambassador& core, FederateState& state) {
    check_update_rate(updateRateDesignator);
    const auto pairs = to_core(theAttributeHandleSetRegionHandleSetPairVector);
    core.subscribe_object_class_attributes_with_regions(to_core(theClass), pairs, active);
    auto& regional = state.declarations.objects[to_core(theClass)].regional;
    for (const rti::AttributeRegions& pair : pairs)
      for (const rti::RegionHandle region : pair.regions)
        regional[region] = regional[region] | pair.attributes;
  });
}

void RegionServices::unsubscribeObjectClassAttributesWithRegions(
    rti1516e::ObjectClassHandle theClass,
    Pairs const& theAttributeHandleSetRegionHandleSetPairVector) {
  federate().call([&](rti::Ambassador& core, FederateState& state) {
    const auto pairs = to_core(theAttributeHandleSetRegionHandleSetPairVector);
    core.unsubscribe_object_class_attributes_with_regions(to_core(theClass), pairs);
    auto& regional = state.declarations.objects[to_core(theClass)].regional;
    for (const rti::AttributeRegions& pair : pairs)
      for (const rti::RegionHandle region : pair.regions)
        regional[region] = regional[region].without(pair.attributes);
  });
}

void RegionServices::subscribeInteractionClassWithRegions(
    rti1516e::InteractionClassHandle theClass, rti1516e::RegionHandleSet const& theRegionHandleSet,
    bool active) {
  federate().call([&](rti::Ambassador& core, FederateState& state) {
    const std::vector<rti::RegionHandle> regions = to_core(theRegionHandleSet);
    core.subscribe_interaction_class_with_regions(to_core(theClass), regions, active);
    state.declarations.interactions[to_core(theClass)].regions.insert(regions.begin(),
                                                                      regions.end());
  });
}

void RegionServices::unsubscribeInteractionClassWithRegions(
    rti1516e::InteractionClassHandle theClass,
    rti1516e::RegionHandleSet const& theRegionHandleSet) {
  federate().call([&](rti::Ambassador& core, FederateState& state) {
    const std::vector<rti::RegionHandle> regions = to_core(theRegionHandleSet);
    core.unsubscribe_interaction_class_with_regions(to_core(theClass), regions);
    for (const rti::RegionHandle region : regions)
      state.declarations.interactions[to_core(theClass)].regions.erase(region);
  });
}

void RegionServices::sendInteractionWithRegions(
    rti1516e::InteractionClassHandle theInteraction,
    rti1516e::ParameterHandleValueMap const& theParameterValues,
    rti1516e::RegionHandleSet const& theRegionHandleSet,
    rti1516e::VariableLengthData const& theUserSuppliedTag) {
  federate().call([&](rti::Ambassador& core, FederateState&) {
    const std::vector<rti::RegionHandle> regions = to_core(theRegionHandleSet);
    const Message message =
        message_of(core, to_core(theInteraction), theParameterValues, theUserSuppliedTag, {});
    core.send_interaction_with_regions(to_core(theInteraction), message.parameters, regions,
                                       message.stamp);
  });
}

/// Interactions with regions go in receive order, with their time but without a handle.
rti1516e::MessageRetractionHandle RegionServices::sendInteractionWithRegions(
    rti1516e::InteractionClassHandle theInteraction,
    rti1516e::ParameterHandleValueMap const& theParameterValues,
    rti1516e::RegionHandleSet const& theRegionHandleSet,
    rti1516e::VariableLengthData const& theUserSuppliedTag, rti1516e::LogicalTime const& theTime) {
  return federate().call([&](rti::Ambassador& core, FederateState& state) {
    const std::vector<rti::RegionHandle> regions = to_core(theRegionHandleSet);
    const Message message = message_of(core, to_core(theInteraction), theParameterValues,
                                       theUserSuppliedTag, state.times.number(theTime));
    core.send_interaction_with_regions(to_core(theInteraction), message.parameters, regions,
                                       message.stamp);
    return rti1516e::MessageRetractionHandle();
  });
}

/// Requests with regions carry no tag.
void RegionServices::requestAttributeValueUpdateWithRegions(rti1516e::ObjectClassHandle theClass,
                                                            Pairs const& theSet,
                                                            rti1516e::VariableLengthData const&) {
  federate().call([&](rti::Ambassador& core, FederateState&) {
    const auto pairs = to_core(theSet);
    core.request_attribute_value_update_with_regions(to_core(theClass), pairs);
  });
}

rti1516e::DimensionHandleSet RegionServices::getDimensionHandleSet(
    rti1516e::RegionHandle theRegionHandle) {
  return federate().call([&](rti::Ambassador& core, FederateState&) {
    return to_standard(core.get_dimension_handle_set(to_core(theRegionHandle)));
  });
}

rti1516e::RangeBounds RegionServices::getRangeBounds(rti1516e::RegionHandle theRegionHandle,
                                                     rti1516e::DimensionHandle theDimensionHandle) {
  return federate().call([&](rti::Ambassador& core, FederateState&) {
    const rti::Range range =
        core.get_range_bounds(to_core(theRegionHandle), to_core(theDimensionHandle));
    return rti1516e::RangeBounds(static_cast<unsigned long>(range.low),
                                 static_cast<unsigned long>(range.high));
  });
}

void RegionServices::setRangeBounds(rti1516e::RegionHandle theRegionHandle,
                                    rti1516e::DimensionHandle theDimensionHandle,
                                    rti1516e::RangeBounds const& theRangeBounds) {
  const rti::Range range{static_cast<double>(theRangeBounds.getLowerBound()),
                         static_cast<double>(theRangeBounds.getUpperBound())};
  federate().call([&](rti::Ambassador& core, FederateState&) {
    core.set_range_bounds(to_core(theRegionHandle), to_core(theDimensionHandle), range);
  });
}

}  // namespace rink::standard
