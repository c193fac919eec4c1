// Names and handles.
#include "rti/standard/services/lookup_services.h"

#include <limits>

#include "rti/standard/handles.h"
#include "rti/standard/services/choices.h"
#include "rti/standard/wide_text.h"

namespace rink::standard {

namespace {

/// Look-ups refuse a handle of nothing, or a name, by other names than services do.
template <class Found, class Refused, class Lookup>
auto looked_up(Federate& federate, const Lookup& lookup) {
  try {
    return federate.call(lookup);
  } catch (const Found& error) {
    throw Refused(error.what());
  }
}
template <class Lookup>
auto of_object_class(Federate& federate, const Lookup& lookup) {
  return looked_up<rti1516e::ObjectClassNotDefined, rti1516e::InvalidObjectClassHandle>(federate,
                                                                                        lookup);
}
template <class Lookup>
auto of_interaction_class(Federate& federate, const Lookup& lookup) {
  return looked_up<rti1516e::InteractionClassNotDefined, rti1516e::InvalidInteractionClassHandle>(
      federate, lookup);
}

/// A qualified name may leave out the root.
std::string qualified(const std::wstring& wide, const std::string& root) {
  std::string name = to_utf8(wide);
  if (name.find('.') == std::string::npos || name.starts_with(root + ".")) return name;
  return root + "." + name;
}

const KnownObject& known_object(const FederateState& state,
                                const rti1516e::ObjectInstanceHandle& object) {
  const auto found = state.objects.find(to_core(object));
  if (found == state.objects.end())
    throw rti1516e::ObjectInstanceNotKnown(L"there is no object " + object.toString());
  return found->second;
}

}  // namespace

rti1516e::FederateHandle LookupServices::getFederateHandle(std::wstring const& theName) {
  return federate().call([&](rti::Ambassador& core, FederateState&) {
    return to_standard(core.get_federate_handle(to_utf8(theName)));
  });
}

std::wstring LookupServices::getFederateName(rti1516e::FederateHandle theHandle) {
  return looked_up<rti1516e::NameNotFound, rti1516e::FederateHandleNotKnown>(
      federate(), [&](rti::Ambassador& core, FederateState&) {
        if (!theHandle.isValid()) throw rti1516e::InvalidFederateHandle(L"the handle is empty");
        return to_wide(core.get_federate_name(to_core(theHandle)));
      });
}

rti1516e::ObjectClassHandle LookupServices::getObjectClassHandle(std::wstring const& theName) {
  return federate().call([&](rti::Ambassador& core, FederateState&) {
    return to_standard(core.get_object_class_handle(qualified(theName, "HLAobjectRoot")));
  });
}

std::wstring LookupServices::getObjectClassName(rti1516e::ObjectClassHandle theHandle) {
  return of_object_class(federate(), [&](rti::Ambassador& core, FederateState&) {
    return to_wide(core.get_object_class_name(to_core(theHandle)));
  });
}

rti1516e::ObjectClassHandle LookupServices::getKnownObjectClassHandle(
    rti1516e::ObjectInstanceHandle theObject) {
  return federate().call([&](rti::Ambassador&, FederateState& state) {
    return to_standard(known_object(state, theObject).object_class);
  });
}

rti1516e::ObjectInstanceHandle LookupServices::getObjectInstanceHandle(
    std::wstring const& theName) {
  return looked_up<rti1516e::NameNotFound, rti1516e::ObjectInstanceNotKnown>(
      federate(), [&](rti::Ambassador& core, FederateState&) {
        return to_standard(core.get_object_instance_handle(to_utf8(theName)));
      });
}

std::wstring LookupServices::getObjectInstanceName(rti1516e::ObjectInstanceHandle theHandle) {
  return federate().call([&](rti::Ambassador&, FederateState& state) {
    return to_wide(known_object(state, theHandle).name);
  });
}

rti1516e::AttributeHandle LookupServices::getAttributeHandle(rti1516e::ObjectClassHandle whichClass,
                                                             std::wstring const& theAttributeName) {
  return of_object_class(federate(), [&](rti::Ambassador& core, FederateState&) {
    return to_standard(core.get_attribute_handle(to_core(whichClass), to_utf8(theAttributeName)));
  });
}

std::wstring LookupServices::getAttributeName(rti1516e::ObjectClassHandle whichClass,
                                              rti1516e::AttributeHandle theHandle) {
  return of_object_class(federate(), [&](rti::Ambassador& core, FederateState&) {
    return to_wide(core.get_attribute_name(to_core(whichClass), to_core(theHandle)));
  });
}

double LookupServices::getUpdateRateValue(std::wstring const& updateRateDesignator) {
  federate().call([](rti::Ambassador&, FederateState&) {});
  check_update_rate(updateRateDesignator);
  return 0.0;
}

/// 0: updates are never thinned out for a subscriber's sake.
double LookupServices::getUpdateRateValueForAttribute(rti1516e::ObjectInstanceHandle theObject,
                                                      rti1516e::AttributeHandle theAttribute) {
  return federate().call([&](rti::Ambassador& core, FederateState& state) {
    core.get_attribute_name(known_object(state, theObject).object_class, to_core(theAttribute));
    return 0.0;
  });
}

rti1516e::InteractionClassHandle LookupServices::getInteractionClassHandle(
    std::wstring const& theName) {
  return federate().call([&](rti::Ambassador& core, FederateState&) {
    return to_standard(core.get_interaction_class_handle(qualified(theName, "HLAinteractionRoot")));
  });
}

std::wstring LookupServices::getInteractionClassName(rti1516e::InteractionClassHandle theHandle) {
  return of_interaction_class(federate(), [&](rti::Ambassador& core, FederateState&) {
    return to_wide(core.get_interaction_class_name(to_core(theHandle)));
  });
}

rti1516e::ParameterHandle LookupServices::getParameterHandle(
    rti1516e::InteractionClassHandle whichClass, std::wstring const& theName) {
  return of_interaction_class(federate(), [&](rti::Ambassador& core, FederateState&) {
    return to_standard(core.get_parameter_handle(to_core(whichClass), to_utf8(theName)));
  });
}

std::wstring LookupServices::getParameterName(rti1516e::InteractionClassHandle whichClass,
                                              rti1516e::ParameterHandle theHandle) {
  return of_interaction_class(federate(), [&](rti::Ambassador& core, FederateState&) {
    return to_wide(core.get_parameter_name(to_core(whichClass), to_core(theHandle)));
  });
}

rti1516e::OrderType LookupServices::getOrderType(std::wstring const& orderName) {
  return looked_up<rti1516e::NameNotFound, rti1516e::InvalidOrderName>(
      federate(), [&](rti::Ambassador&, FederateState&) {
        return rti::Ambassador::get_order_type(to_utf8(orderName)) == rti::Order::receive
                   ? rti1516e::RECEIVE
                   : rti1516e::TIMESTAMP;
      });
}

std::wstring LookupServices::getOrderName(rti1516e::OrderType orderType) {
  return federate().call([&](rti::Ambassador&, FederateState&) {
    return to_wide(rti::Ambassador::get_order_name(to_core<rti1516e::InvalidOrderType>(orderType)));
  });
}

rti1516e::TransportationType LookupServices::getTransportationType(
    std::wstring const& transportationName) {
  return looked_up<rti1516e::NameNotFound, rti1516e::InvalidTransportationName>(
      federate(), [&](rti::Ambassador&, FederateState&) {
        return rti::Ambassador::get_transportation_type(to_utf8(transportationName)) ==
                       rti::Transportation::reliable
                   ? rti1516e::RELIABLE
                   : rti1516e::BEST_EFFORT;
      });
}

std::wstring LookupServices::getTransportationName(
    rti1516e::TransportationType transportationType) {
  return federate().call([&](rti::Ambassador&, FederateState&) {
    return to_wide(rti::Ambassador::get_transportation_type_name(to_core(transportationType)));
  });
}

rti1516e::DimensionHandleSet LookupServices::getAvailableDimensionsForClassAttribute(
    rti1516e::ObjectClassHandle theClass, rti1516e::AttributeHandle theHandle) {
  return of_object_class(federate(), [&](rti::Ambassador& core, FederateState&) {
    return to_standard(
        core.get_available_dimensions_for_class_attribute(to_core(theClass), to_core(theHandle)));
  });
}

rti1516e::DimensionHandleSet LookupServices::getAvailableDimensionsForInteractionClass(
    rti1516e::InteractionClassHandle theClass) {
  return of_interaction_class(federate(), [&](rti::Ambassador& core, FederateState&) {
    return to_standard(core.get_available_dimensions_for_interaction_class(to_core(theClass)));
  });
}

rti1516e::DimensionHandle LookupServices::getDimensionHandle(std::wstring const& theName) {
  return federate().call([&](rti::Ambassador& core, FederateState&) {
    return to_standard(core.get_dimension_handle(to_utf8(theName)));
  });
}

std::wstring LookupServices::getDimensionName(rti1516e::DimensionHandle theHandle) {
  return federate().call([&](rti::Ambassador& core, FederateState&) {
    return to_wide(core.get_dimension_name(to_core(theHandle)));
  });
}

/// A dimension that the model gives no bound, which only Rink knows, has the greatest one.
unsigned long LookupServices::getDimensionUpperBound(rti1516e::DimensionHandle theHandle) {
  return federate().call([&](rti::Ambassador& core, FederateState&) {
    return static_cast<unsigned long>(core.get_dimension_upper_bound(to_core(theHandle))
                                          .value_or(std::numeric_limits<std::uint32_t>::max()));
  });
}

}  // namespace rink::standard
