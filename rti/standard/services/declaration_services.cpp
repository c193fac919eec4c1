// Declaration management: the standard's services add to and take from what is declared, the core's
// replace it.
#include "rti/standard/services/declaration_services.h"

#include "rti/standard/handles.h"
#include "rti/standard/services/choices.h"

namespace rink::standard {

namespace {

/// The privilege to delete is published with any attribute, and is never subscribed to.
rti::AttributeSet declarable(const rti1516e::AttributeHandleSet& attributes) {
  return to_core(attributes).without(rti::AttributeSet{rti::privilege_to_delete_object});
}

void publish(rti::Ambassador& core, FederateState& state, rti::ObjectClassHandle object_class,
             rti::AttributeSet attributes) {
  if (attributes.is_empty()) core.unpublish_object_class(object_class);
  else core.publish_object_class_attributes(object_class, attributes);
  state.declarations.objects[object_class].published = attributes;
}

void subscribe(rti::Ambassador& core, FederateState& state, rti::ObjectClassHandle object_class,
               rti::AttributeSet active, rti::AttributeSet passive) {
  const rti::AttributeSet all = active | passive;
  if (all.is_empty()) core.unsubscribe_object_class(object_class);
  else core.subscribe_object_class_attributes(object_class, all, {}, !active.is_empty());
  ObjectClassDeclaration& declaration = state.declarations.objects[object_class];
  declaration.active = active;
  declaration.passive = passive;
}

/// Throws ObjectClassNotDefined or AttributeNotDefined.
void check_attributes(const rti::Ambassador& core, rti::ObjectClassHandle object_class,
                      rti::AttributeSet attributes) {
  core.get_object_class_name(object_class);
  for (const rti::AttributeHandle each : attributes) core.get_attribute_name(object_class, each);
}

}  // namespace

void DeclarationServices::publishObjectClassAttributes(
    rti1516e::ObjectClassHandle theClass, rti1516e::AttributeHandleSet const& attributeList) {
  federate().call([&](rti::Ambassador& core, FederateState& state) {
    const rti::AttributeSet attributes = declarable(attributeList);
    const rti::ObjectClassHandle object_class = to_core(theClass);
    check_attributes(core, object_class, attributes);
    publish(core, state, object_class,
            state.declarations.objects[object_class].published | attributes);
  });
}

void DeclarationServices::unpublishObjectClass(rti1516e::ObjectClassHandle theClass) {
  federate().call([&](rti::Ambassador& core, FederateState& state) {
    core.get_object_class_name(to_core(theClass));
    publish(core, state, to_core(theClass), {});
  });
}

void DeclarationServices::unpublishObjectClassAttributes(
    rti1516e::ObjectClassHandle theClass, rti1516e::AttributeHandleSet const& attributeList) {
  federate().call([&](rti::Ambassador& core, FederateState& state) {
    const rti::AttributeSet attributes = declarable(attributeList);
    const rti::ObjectClassHandle object_class = to_core(theClass);
    check_attributes(core, object_class, attributes);
    publish(core, state, object_class,
            state.declarations.objects[object_class].published.without(attributes));
  });
}

void DeclarationServices::publishInteractionClass(rti1516e::InteractionClassHandle theInteraction) {
  federate().call([&](rti::Ambassador& core, FederateState&) {
    core.publish_interaction_class(to_core(theInteraction));
  });
}

void DeclarationServices::unpublishInteractionClass(
    rti1516e::InteractionClassHandle theInteraction) {
  federate().call([&](rti::Ambassador& core, FederateState&) {
    core.unpublish_interaction_class(to_core(theInteraction));
  });
}

void DeclarationServices::subscribeObjectClassAttributes(
    rti1516e::ObjectClassHandle theClass, rti1516e::AttributeHandleSet const& attributeList,
    bool active, std::wstring const& updateRateDesignator) {
  federate().call([&](rti::Ambassador& core, FederateState& state) {
    check_update_rate(updateRateDesignator);
    const rti::AttributeSet attributes = declarable(attributeList);
    const rti::ObjectClassHandle object_class = to_core(theClass);
    check_attributes(core, object_class, attributes);
    const ObjectClassDeclaration& now = state.declarations.objects[object_class];
    if (active)
      subscribe(core, state, object_class, now.active | attributes,
                now.passive.without(attributes));
    else
      subscribe(core, state, object_class, now.active.without(attributes),
                now.passive | attributes);
  });
}

void DeclarationServices::unsubscribeObjectClass(rti1516e::ObjectClassHandle theClass) {
  federate().call([&](rti::Ambassador& core, FederateState& state) {
    core.get_object_class_name(to_core(theClass));
    subscribe(core, state, to_core(theClass), {}, {});
  });
}

void DeclarationServices::unsubscribeObjectClassAttributes(
    rti1516e::ObjectClassHandle theClass, rti1516e::AttributeHandleSet const& attributeList) {
  federate().call([&](rti::Ambassador& core, FederateState& state) {
    const rti::AttributeSet attributes = declarable(attributeList);
    const rti::ObjectClassHandle object_class = to_core(theClass);
    check_attributes(core, object_class, attributes);
    const ObjectClassDeclaration& now = state.declarations.objects[object_class];
    subscribe(core, state, object_class, now.active.without(attributes),
              now.passive.without(attributes));
  });
}

void DeclarationServices::subscribeInteractionClass(rti1516e::InteractionClassHandle theClass,
                                                    bool active) {
  federate().call([&](rti::Ambassador& core, FederateState& state) {
    core.subscribe_interaction_class(to_core(theClass), active);
    state.declarations.interactions[to_core(theClass)].is_subscribed = true;
  });
}

void DeclarationServices::unsubscribeInteractionClass(rti1516e::InteractionClassHandle theClass) {
  federate().call([&](rti::Ambassador& core, FederateState& state) {
    core.unsubscribe_interaction_class(to_core(theClass));
    state.declarations.interactions[to_core(theClass)].is_subscribed = false;
  });
}

}  // namespace rink::standard
