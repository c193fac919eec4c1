// Names and handles: the look-ups of IEEE 1516.1-2010, clause 10, answered from the object model.
#include <algorithm>

#include "rti/ambassador.h"

namespace rink::rti {

namespace {

[[noreturn]] void not_found(const char* kind, std::string_view name) { throw RtiException(HlaError::name_not_found, std::string("no ") + kind + " is called '" + std::string(name) + "'"); }

template <class Handle>
Handle found(std::optional<Handle> handle, const char* kind, std::string_view name) {
  if (!handle) not_found(kind, name);
  return *handle;
}

/// The member at a handle's place, or the error that names what is wrong with the handle.
template <class Members, class Handle>
const auto& at(const Members& members, Handle handle, HlaError error) {
  if (handle.value >= members.size()) throw RtiException(error, "handle " + std::to_string(handle.value) + ", but there are " + std::to_string(members.size()));
  return members[handle.value];
}

template <class Classes, class Handle>
std::string qualified(const Classes& classes, Handle handle, HlaError error) {
  std::string name = at(classes, handle, error).name;
  for (Handle parent = classes[handle.value].parent; parent; parent = classes[parent.value].parent) name = classes[parent.value].name + "." + name;
  return name;
}

}  // namespace

FederateHandle Ambassador::get_federate_handle(std::string_view name) const {
  for (const auto& [federate, each] : federates_)
    if (federate && each == name) return federate;
  not_found("federate", name);
}

const std::string& Ambassador::get_federate_name(FederateHandle federate) const {
  for (const auto& [each, name] : federates_)
    if (federate && each == federate) return name;
  throw RtiException(HlaError::name_not_found, "no federate of handle " + std::to_string(federate.value) + " is known");
}

ObjectClassHandle Ambassador::get_object_class_handle(std::string_view name) const { return found(fom_.object_class(name), "object class", name); }

std::string Ambassador::get_object_class_name(ObjectClassHandle object_class) const { return qualified(fom_.object_classes(), object_class, HlaError::object_class_not_defined); }

ObjectClassHandle Ambassador::get_known_object_class_handle(ObjectHandle object) const {
  const KnownObject* known = const_cast<Ambassador*>(this)->find(object);
  if (known == nullptr) throw RtiException(HlaError::object_instance_not_known, "object " + std::to_string(object.value));
  return {known->object_class};
}

AttributeHandle Ambassador::get_attribute_handle(ObjectClassHandle object_class, std::string_view name) const {
  at(fom_.object_classes(), object_class, HlaError::object_class_not_defined);
  return found(fom_.attribute(object_class, name), "attribute of that class", name);
}

const std::string& Ambassador::get_attribute_name(ObjectClassHandle object_class, AttributeHandle attribute) const {
  return at(at(fom_.object_classes(), object_class, HlaError::object_class_not_defined).attributes, attribute, HlaError::attribute_not_defined).name;
}

InteractionClassHandle Ambassador::get_interaction_class_handle(std::string_view name) const { return found(fom_.interaction_class(name), "interaction class", name); }

std::string Ambassador::get_interaction_class_name(InteractionClassHandle interaction_class) const {
  return qualified(fom_.interaction_classes(), interaction_class, HlaError::interaction_class_not_defined);
}

ParameterHandle Ambassador::get_parameter_handle(InteractionClassHandle interaction_class, std::string_view name) const {
  at(fom_.interaction_classes(), interaction_class, HlaError::interaction_class_not_defined);
  return found(fom_.parameter(interaction_class, name), "parameter of that class", name);
}

const std::string& Ambassador::get_parameter_name(InteractionClassHandle interaction_class, ParameterHandle parameter) const {
  return at(at(fom_.interaction_classes(), interaction_class, HlaError::interaction_class_not_defined).parameters, parameter, HlaError::interaction_parameter_not_defined).name;
}

Transportation Ambassador::get_transportation_type(std::string_view name) {
  for (const Transportation each : {Transportation::reliable, Transportation::best_effort})
    if (get_transportation_type_name(each) == name) return each;
  not_found("transportation type", name);
}

std::string_view Ambassador::get_transportation_type_name(Transportation transportation) { return transportation == Transportation::reliable ? "HLAreliable" : "HLAbestEffort"; }

Order Ambassador::get_order_type(std::string_view name) {
  for (const Order each : {Order::receive, Order::timestamp})
    if (get_order_name(each) == name) return each;
  not_found("order type", name);
}

std::string_view Ambassador::get_order_name(Order order) { return order == Order::receive ? "Receive" : "TimeStamp"; }

}  // namespace rink::rti
