// Look-ups in the object model.
#include "rti/fom/fom_lookup.h"

#include "rti/hla_error.h"

namespace rink::rti {

namespace {

[[noreturn]] void not_found(const char* kind, std::string_view name) {
  throw RtiException(HlaError::name_not_found,
                     std::string("no ") + kind + " is called '" + std::string(name) + "'");
}

template <class Handle>
Handle found(std::optional<Handle> handle, const char* kind, std::string_view name) {
  if (!handle) not_found(kind, name);
  return *handle;
}

/// The member at a handle's place, or the error that names what is wrong with the handle.
template <class Members, class Handle>
const auto& at(const Members& members, Handle handle, HlaError error) {
  if (handle.value >= members.size())
    throw RtiException(error, "handle " + std::to_string(handle.value) + ", but there are " +
                                  std::to_string(members.size()));
  return members[handle.value];
}

template <class Classes, class Handle>
std::string qualified(const Classes& classes, Handle handle, HlaError error) {
  std::string name = at(classes, handle, error).name;
  for (Handle parent = classes[handle.value].parent; parent; parent = classes[parent.value].parent)
    name = classes[parent.value].name + "." + name;
  return name;
}

}  // namespace

ObjectClassHandle FomLookup::get_object_class_handle(std::string_view name) const {
  return found(fom_.object_class(name), "object class", name);
}

std::string FomLookup::get_object_class_name(ObjectClassHandle object_class) const {
  return qualified(fom_.object_classes(), object_class, HlaError::object_class_not_defined);
}

AttributeHandle FomLookup::get_attribute_handle(ObjectClassHandle object_class,
                                                std::string_view name) const {
  at(fom_.object_classes(), object_class, HlaError::object_class_not_defined);
  return found(fom_.attribute(object_class, name), "attribute of that class", name);
}

const std::string& FomLookup::get_attribute_name(ObjectClassHandle object_class,
                                                 AttributeHandle attribute) const {
  return at(at(fom_.object_classes(), object_class, HlaError::object_class_not_defined).attributes,
            attribute, HlaError::attribute_not_defined)
      .name;
}

InteractionClassHandle FomLookup::get_interaction_class_handle(std::string_view name) const {
  return found(fom_.interaction_class(name), "interaction class", name);
}

std::string FomLookup::get_interaction_class_name(InteractionClassHandle interaction_class) const {
  return qualified(fom_.interaction_classes(), interaction_class,
                   HlaError::interaction_class_not_defined);
}

ParameterHandle FomLookup::get_parameter_handle(InteractionClassHandle interaction_class,
                                                std::string_view name) const {
  at(fom_.interaction_classes(), interaction_class, HlaError::interaction_class_not_defined);
  return found(fom_.parameter(interaction_class, name), "parameter of that class", name);
}

const std::string& FomLookup::get_parameter_name(InteractionClassHandle interaction_class,
                                                 ParameterHandle parameter) const {
  return at(at(fom_.interaction_classes(), interaction_class,
               HlaError::interaction_class_not_defined)
                .parameters,
            parameter, HlaError::interaction_parameter_not_defined)
      .name;
}

Transportation FomLookup::get_transportation_type(std::string_view name) {
  for (const Transportation each : {Transportation::reliable, Transportation::best_effort})
    if (get_transportation_type_name(each) == name) return each;
  not_found("transportation type", name);
}

std::string_view FomLookup::get_transportation_type_name(Transportation transportation) {
  return transportation == Transportation::reliable ? "HLAreliable" : "HLAbestEffort";
}

Order FomLookup::get_order_type(std::string_view name) {
  for (const Order each : {Order::receive, Order::timestamp})
    if (get_order_name(each) == name) return each;
  not_found("order type", name);
}

std::string_view FomLookup::get_order_name(Order order) {
  return order == Order::receive ? "Receive" : "TimeStamp";
}

void FomLookup::check(DimensionHandle dimension) const {
  if (dimension.value >= fom_.dimensions().size())
    throw RtiException(HlaError::invalid_dimension_handle,
                       "the model has no dimension " + std::to_string(dimension.value));
}

DimensionHandle FomLookup::get_dimension_handle(std::string_view name) const {
  const auto found = fom_.dimension(name);
  if (!found)
    throw RtiException(HlaError::name_not_found,
                       "no dimension is called '" + std::string(name) + "'");
  return *found;
}

const std::string& FomLookup::get_dimension_name(DimensionHandle dimension) const {
  check(dimension);
  return fom_.at(dimension).name;
}

std::optional<std::uint32_t> FomLookup::get_dimension_upper_bound(DimensionHandle dimension) const {
  check(dimension);
  return fom_.at(dimension).upper_bound;
}

DimensionSet FomLookup::get_available_dimensions_for_class_attribute(
    ObjectClassHandle object_class, AttributeHandle attribute) const {
  if (object_class.value >= fom_.object_classes().size())
    throw RtiException(HlaError::object_class_not_defined,
                       "object class " + std::to_string(object_class.value));
  const auto& attributes = fom_.at(object_class).attributes;
  if (attribute.value >= attributes.size())
    throw RtiException(HlaError::attribute_not_defined,
                       "attribute " + std::to_string(attribute.value) + " of class '" +
                           fom_.at(object_class).name + "'");
  return attributes[attribute.value].dimensions;
}

DimensionSet FomLookup::get_available_dimensions_for_interaction_class(
    InteractionClassHandle interaction_class) const {
  if (interaction_class.value >= fom_.interaction_classes().size())
    throw RtiException(HlaError::interaction_class_not_defined,
                       "interaction class " + std::to_string(interaction_class.value));
  return fom_.at(interaction_class).dimensions;
}

}  // namespace rink::rti
