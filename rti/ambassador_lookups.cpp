// Forwards the look-ups of names and handles and the advisory switches of `Ambassador`.
#include "rti/ambassador.h"
#include "rti/federate/ambassador_parts.h"

namespace rink::rti {

const Fom& Ambassador::fom() const { return parts_->lookup.fom(); }
ObjectClassHandle Ambassador::get_object_class_handle(std::string_view name) const {
  return parts_->lookup.get_object_class_handle(name);
}
std::string Ambassador::get_object_class_name(ObjectClassHandle object_class) const {
  return parts_->lookup.get_object_class_name(object_class);
}
AttributeHandle Ambassador::get_attribute_handle(ObjectClassHandle object_class,
                                                 std::string_view name) const {
  return parts_->lookup.get_attribute_handle(object_class, name);
}
const std::string& Ambassador::get_attribute_name(ObjectClassHandle object_class,
                                                  AttributeHandle attribute) const {
  return parts_->lookup.get_attribute_name(object_class, attribute);
}
InteractionClassHandle Ambassador::get_interaction_class_handle(std::string_view name) const {
  return parts_->lookup.get_interaction_class_handle(name);
}
std::string Ambassador::get_interaction_class_name(InteractionClassHandle interaction_class) const {
  return parts_->lookup.get_interaction_class_name(interaction_class);
}
ParameterHandle Ambassador::get_parameter_handle(InteractionClassHandle interaction_class,
                                                 std::string_view name) const {
  return parts_->lookup.get_parameter_handle(interaction_class, name);
}
const std::string& Ambassador::get_parameter_name(InteractionClassHandle interaction_class,
                                                  ParameterHandle parameter) const {
  return parts_->lookup.get_parameter_name(interaction_class, parameter);
}
Transportation Ambassador::get_transportation_type(std::string_view name) {
  return FomLookup::get_transportation_type(name);
}
std::string_view Ambassador::get_transportation_type_name(Transportation transportation) {
  return FomLookup::get_transportation_type_name(transportation);
}
Order Ambassador::get_order_type(std::string_view name) { return FomLookup::get_order_type(name); }
std::string_view Ambassador::get_order_name(Order order) {
  return FomLookup::get_order_name(order);
}
DimensionHandle Ambassador::get_dimension_handle(std::string_view name) const {
  return parts_->lookup.get_dimension_handle(name);
}
const std::string& Ambassador::get_dimension_name(DimensionHandle dimension) const {
  return parts_->lookup.get_dimension_name(dimension);
}
std::optional<std::uint32_t> Ambassador::get_dimension_upper_bound(
    DimensionHandle dimension) const {
  return parts_->lookup.get_dimension_upper_bound(dimension);
}
DimensionSet Ambassador::get_available_dimensions_for_class_attribute(
    ObjectClassHandle object_class, AttributeHandle attribute) const {
  return parts_->lookup.get_available_dimensions_for_class_attribute(object_class, attribute);
}
DimensionSet Ambassador::get_available_dimensions_for_interaction_class(
    InteractionClassHandle interaction_class) const {
  return parts_->lookup.get_available_dimensions_for_interaction_class(interaction_class);
}
void Ambassador::enable_object_class_relevance_advisory_switch() {
  active().declarations.switch_advisory(Advisory::object_class_relevance, true);
}
void Ambassador::disable_object_class_relevance_advisory_switch() {
  active().declarations.switch_advisory(Advisory::object_class_relevance, false);
}
void Ambassador::enable_attribute_relevance_advisory_switch() {
  active().declarations.switch_advisory(Advisory::attribute_relevance, true);
}
void Ambassador::disable_attribute_relevance_advisory_switch() {
  active().declarations.switch_advisory(Advisory::attribute_relevance, false);
}
void Ambassador::enable_attribute_scope_advisory_switch() {
  active().declarations.switch_advisory(Advisory::attribute_scope, true);
}
void Ambassador::disable_attribute_scope_advisory_switch() {
  active().declarations.switch_advisory(Advisory::attribute_scope, false);
}
void Ambassador::enable_interaction_relevance_advisory_switch() {
  active().declarations.switch_advisory(Advisory::interaction_relevance, true);
}
void Ambassador::disable_interaction_relevance_advisory_switch() {
  active().declarations.switch_advisory(Advisory::interaction_relevance, false);
}

}  // namespace rink::rti
