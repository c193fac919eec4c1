// Forwards every service of `Ambassador` to the part that does it.
#include "rti/ambassador.h"

#include "rti/federate/ambassador_services.h"

namespace rink::rti {

static_assert(Ambassador::waiting_callbacks_max == CallbackGate::waiting_max);

Ambassador::Ambassador(const Fom& fom, FederateAmbassador& callbacks, const Timeouts& timeouts,
                       CallbackModel model)
    : services_(std::make_unique<AmbassadorServices>(fom, callbacks, timeouts, model)) {}
Ambassador::~Ambassador() = default;

void Ambassador::create_federation_execution(std::string_view federation) {
  services_->create_federation_execution(federation);
}
void Ambassador::create_federation_execution(std::string_view federation, const Fom& model) {
  services_->create_federation_execution(federation, model);
}
void Ambassador::destroy_federation_execution(std::string_view federation) {
  services_->destroy_federation_execution(federation);
}
void Ambassador::list_federation_executions() { services_->list_federation_executions(); }
void Ambassador::query_management() { services_->query_management(); }
void Ambassador::join(std::string_view federation, std::string_view federate_name,
                      std::string_view federate_type) {
  services_->join(federation, federate_name, federate_type);
}
void Ambassador::resign() { services_->resign(); }
bool Ambassador::is_joined() const { return services_->is_joined(); }
FederateHandle Ambassador::federate() const { return services_->federate(); }
void Ambassador::register_synchronization_point(std::string_view label, Bytes tag,
                                                std::span<const FederateHandle> members) {
  services_->register_synchronization_point(label, tag, members);
}
void Ambassador::synchronization_point_achieved(std::string_view label, bool is_success) {
  services_->synchronization_point_achieved(label, is_success);
}
void Ambassador::watch_federates() { services_->watch_federates(); }
void Ambassador::publish_object_class_attributes(ObjectClassHandle object_class,
                                                 AttributeSet attributes) {
  services_->publish_object_class_attributes(object_class, attributes);
}
void Ambassador::unpublish_object_class(ObjectClassHandle object_class) {
  services_->unpublish_object_class(object_class);
}
void Ambassador::subscribe_object_class_attributes(ObjectClassHandle object_class,
                                                   AttributeSet attributes, RegionHandle region,
                                                   bool is_active) {
  services_->subscribe_object_class_attributes(object_class, attributes, region, is_active);
}
void Ambassador::unsubscribe_object_class(ObjectClassHandle object_class, RegionHandle region) {
  services_->unsubscribe_object_class(object_class, region);
}
void Ambassador::publish_interaction_class(InteractionClassHandle interaction_class) {
  services_->publish_interaction_class(interaction_class);
}
void Ambassador::unpublish_interaction_class(InteractionClassHandle interaction_class) {
  services_->unpublish_interaction_class(interaction_class);
}
void Ambassador::subscribe_interaction_class(InteractionClassHandle interaction_class,
                                             bool is_active) {
  services_->subscribe_interaction_class(interaction_class, is_active);
}
void Ambassador::unsubscribe_interaction_class(InteractionClassHandle interaction_class) {
  services_->unsubscribe_interaction_class(interaction_class);
}
void Ambassador::unconditional_attribute_ownership_divestiture(ObjectHandle object,
                                                               AttributeSet attributes) {
  services_->unconditional_attribute_ownership_divestiture(object, attributes);
}
void Ambassador::negotiated_attribute_ownership_divestiture(ObjectHandle object,
                                                            AttributeSet attributes, Bytes tag) {
  services_->negotiated_attribute_ownership_divestiture(object, attributes, tag);
}
void Ambassador::confirm_divestiture(ObjectHandle object, AttributeSet attributes, Bytes tag) {
  services_->confirm_divestiture(object, attributes, tag);
}
void Ambassador::cancel_negotiated_attribute_ownership_divestiture(ObjectHandle object,
                                                                   AttributeSet attributes) {
  services_->cancel_negotiated_attribute_ownership_divestiture(object, attributes);
}
void Ambassador::attribute_ownership_release_denied(ObjectHandle object, AttributeSet attributes) {
  services_->attribute_ownership_release_denied(object, attributes);
}
void Ambassador::attribute_ownership_divestiture_if_wanted(ObjectHandle object,
                                                           AttributeSet attributes) {
  services_->attribute_ownership_divestiture_if_wanted(object, attributes);
}
void Ambassador::attribute_ownership_acquisition(ObjectHandle object, AttributeSet attributes,
                                                 Bytes tag) {
  services_->attribute_ownership_acquisition(object, attributes, tag);
}
void Ambassador::attribute_ownership_acquisition_if_available(ObjectHandle object,
                                                              AttributeSet attributes) {
  services_->attribute_ownership_acquisition_if_available(object, attributes);
}
void Ambassador::cancel_attribute_ownership_acquisition(ObjectHandle object,
                                                        AttributeSet attributes) {
  services_->cancel_attribute_ownership_acquisition(object, attributes);
}
void Ambassador::query_attribute_ownership(ObjectHandle object, AttributeHandle attribute) {
  services_->query_attribute_ownership(object, attribute);
}
bool Ambassador::is_attribute_owned_by_federate(ObjectHandle object, AttributeHandle attribute) {
  return services_->is_attribute_owned_by_federate(object, attribute);
}
void Ambassador::set_automatic_resign_directive(ResignAction action) {
  services_->set_automatic_resign_directive(action);
}
void Ambassador::resign(ResignAction action) { services_->resign(action); }
ObjectHandle Ambassador::register_object_instance(ObjectClassHandle object_class,
                                                  std::string_view name) {
  return services_->register_object_instance(object_class, name);
}
void Ambassador::delete_object_instance(ObjectHandle object) {
  services_->delete_object_instance(object);
}
void Ambassador::local_delete_object_instance(ObjectHandle object) {
  services_->local_delete_object_instance(object);
}
void Ambassador::reserve_object_instance_name(std::string_view name) {
  services_->reserve_object_instance_name(name);
}
void Ambassador::reserve_multiple_object_instance_names(std::span<const std::string_view> names) {
  services_->reserve_multiple_object_instance_names(names);
}
void Ambassador::release_object_instance_name(std::string_view name) {
  services_->release_object_instance_name(name);
}
void Ambassador::release_multiple_object_instance_names(std::span<const std::string_view> names) {
  services_->release_multiple_object_instance_names(names);
}
void Ambassador::request_attribute_value_update(ObjectClassHandle object_class,
                                                AttributeSet attributes, Bytes tag) {
  services_->request_attribute_value_update(object_class, attributes, tag);
}
void Ambassador::request_attribute_value_update(ObjectHandle object, AttributeSet attributes,
                                                Bytes tag) {
  services_->request_attribute_value_update(object, attributes, tag);
}
void Ambassador::request_attribute_transportation_type_change(ObjectHandle object,
                                                              AttributeSet attributes,
                                                              Transportation transportation) {
  services_->request_attribute_transportation_type_change(object, attributes, transportation);
}
void Ambassador::query_attribute_transportation_type(ObjectHandle object,
                                                     AttributeHandle attribute) {
  services_->query_attribute_transportation_type(object, attribute);
}
void Ambassador::request_interaction_transportation_type_change(
    InteractionClassHandle interaction_class, Transportation transportation) {
  services_->request_interaction_transportation_type_change(interaction_class, transportation);
}
void Ambassador::query_interaction_transportation_type(FederateHandle federate,
                                                       InteractionClassHandle interaction_class) {
  services_->query_interaction_transportation_type(federate, interaction_class);
}
void Ambassador::update_attribute_values(ObjectHandle object, AttributeSet attributes, Bytes values,
                                         const Stamp& stamp) {
  services_->update_attribute_values(object, attributes, values, stamp);
}
void Ambassador::send_interaction(InteractionClassHandle interaction_class, Bytes parameters,
                                  const Stamp& stamp) {
  services_->send_interaction(interaction_class, parameters, stamp);
}
void Ambassador::send_directed_interaction(InteractionClassHandle interaction_class,
                                           FederateHandle receiver, Bytes parameters,
                                           const Stamp& stamp) {
  services_->send_directed_interaction(interaction_class, receiver, parameters, stamp);
}
RegionHandle Ambassador::create_region() { return services_->create_region(); }
RegionHandle Ambassador::create_region(DimensionSet dimensions) {
  return services_->create_region(dimensions);
}
void Ambassador::set_region(RegionHandle region, const im::Region& bounds) {
  services_->set_region(region, bounds);
}
void Ambassador::set_range_bounds(RegionHandle region, DimensionHandle dimension,
                                  const Range& range) {
  services_->set_range_bounds(region, dimension, range);
}
Range Ambassador::get_range_bounds(RegionHandle region, DimensionHandle dimension) const {
  return services_->get_range_bounds(region, dimension);
}
DimensionSet Ambassador::get_dimension_handle_set(RegionHandle region) const {
  return services_->get_dimension_handle_set(region);
}
void Ambassador::commit_region_modifications(RegionHandle region) {
  services_->commit_region_modifications(region);
}
void Ambassador::commit_region_modifications(std::span<const RegionHandle> regions) {
  services_->commit_region_modifications(regions);
}
void Ambassador::commit_region_modifications(std::span<const RegionBounds> regions) {
  services_->commit_region_modifications(regions);
}
void Ambassador::delete_region(RegionHandle region) { services_->delete_region(region); }
void Ambassador::associate_regions_for_updates(ObjectHandle object, RegionHandle region) {
  services_->associate_regions_for_updates(object, region);
}
void Ambassador::associate_regions_for_updates(ObjectHandle object,
                                               std::span<const AttributeRegions> pairs) {
  services_->associate_regions_for_updates(object, pairs);
}
void Ambassador::unassociate_regions_for_updates(ObjectHandle object,
                                                 std::span<const AttributeRegions> pairs) {
  services_->unassociate_regions_for_updates(object, pairs);
}
ObjectHandle Ambassador::register_object_instance_with_regions(
    ObjectClassHandle object_class, std::span<const AttributeRegions> pairs,
    std::string_view name) {
  return services_->register_object_instance_with_regions(object_class, pairs, name);
}
void Ambassador::subscribe_object_class_attributes_with_regions(
    ObjectClassHandle object_class, std::span<const AttributeRegions> pairs, bool is_active) {
  services_->subscribe_object_class_attributes_with_regions(object_class, pairs, is_active);
}
void Ambassador::unsubscribe_object_class_attributes_with_regions(
    ObjectClassHandle object_class, std::span<const AttributeRegions> pairs) {
  services_->unsubscribe_object_class_attributes_with_regions(object_class, pairs);
}
void Ambassador::subscribe_interaction_class_with_regions(InteractionClassHandle interaction_class,
                                                          std::span<const RegionHandle> regions,
                                                          bool is_active) {
  services_->subscribe_interaction_class_with_regions(interaction_class, regions, is_active);
}
void Ambassador::unsubscribe_interaction_class_with_regions(
    InteractionClassHandle interaction_class, std::span<const RegionHandle> regions) {
  services_->unsubscribe_interaction_class_with_regions(interaction_class, regions);
}
void Ambassador::send_interaction_with_regions(InteractionClassHandle interaction_class,
                                               Bytes parameters,
                                               std::span<const RegionHandle> regions,
                                               const Stamp& stamp) {
  services_->send_interaction_with_regions(interaction_class, parameters, regions, stamp);
}
void Ambassador::request_attribute_value_update_with_regions(
    ObjectClassHandle object_class, std::span<const AttributeRegions> pairs) {
  services_->request_attribute_value_update_with_regions(object_class, pairs);
}
FederateHandle Ambassador::get_federate_handle(std::string_view name) const {
  return services_->get_federate_handle(name);
}
const std::string& Ambassador::get_federate_name(FederateHandle federate) const {
  return services_->get_federate_name(federate);
}
ObjectHandle Ambassador::get_object_instance_handle(std::string_view name) const {
  return services_->get_object_instance_handle(name);
}
std::string Ambassador::get_object_instance_name(ObjectHandle object) const {
  return services_->get_object_instance_name(object);
}
ObjectClassHandle Ambassador::get_known_object_class_handle(ObjectHandle object) const {
  return services_->get_known_object_class_handle(object);
}
bool Ambassador::evoke_callback() { return services_->evoke_callback(); }
bool Ambassador::evoke_multiple_callbacks(std::size_t count_max) {
  return services_->evoke_multiple_callbacks(count_max);
}
void Ambassador::disable_callbacks() { services_->disable_callbacks(); }
void Ambassador::enable_callbacks() { services_->enable_callbacks(); }
void Ambassador::enable_time_regulation(double lookahead) {
  services_->enable_time_regulation(lookahead);
}
void Ambassador::disable_time_regulation() { services_->disable_time_regulation(); }
void Ambassador::enable_time_constrained() { services_->enable_time_constrained(); }
void Ambassador::disable_time_constrained() { services_->disable_time_constrained(); }
void Ambassador::time_advance_request(LogicalTime time) { services_->time_advance_request(time); }
void Ambassador::time_advance_request_available(LogicalTime time) {
  services_->time_advance_request_available(time);
}
void Ambassador::next_message_request(LogicalTime time) { services_->next_message_request(time); }
void Ambassador::next_message_request_available(LogicalTime time) {
  services_->next_message_request_available(time);
}
void Ambassador::flush_queue_request(LogicalTime time) { services_->flush_queue_request(time); }
void Ambassador::modify_lookahead(double lookahead) { services_->modify_lookahead(lookahead); }
void Ambassador::enable_asynchronous_delivery() { services_->enable_asynchronous_delivery(); }
void Ambassador::disable_asynchronous_delivery() { services_->disable_asynchronous_delivery(); }
LogicalTime Ambassador::query_logical_time() const { return services_->query_logical_time(); }
double Ambassador::query_lookahead() const { return services_->query_lookahead(); }
void Ambassador::query_time_bounds() { services_->query_time_bounds(); }
const FederateClock& Ambassador::clock() const { return services_->clock(); }
RetractionHandle Ambassador::update_attribute_values(ObjectHandle object, AttributeSet attributes,
                                                     Bytes values, LogicalTime time,
                                                     std::uint64_t tag) {
  return services_->update_attribute_values(object, attributes, values, time, tag);
}
RetractionHandle Ambassador::send_interaction(InteractionClassHandle interaction_class,
                                              Bytes parameters, LogicalTime time,
                                              std::uint64_t tag) {
  return services_->send_interaction(interaction_class, parameters, time, tag);
}
RetractionHandle Ambassador::send_directed_interaction(InteractionClassHandle interaction_class,
                                                       FederateHandle receiver, Bytes parameters,
                                                       LogicalTime time, std::uint64_t tag) {
  return services_->send_directed_interaction(interaction_class, receiver, parameters, time, tag);
}
RetractionHandle Ambassador::delete_object_instance(ObjectHandle object, LogicalTime time,
                                                    std::uint64_t tag) {
  return services_->delete_object_instance(object, time, tag);
}
void Ambassador::retract(const RetractionHandle& handle) { services_->retract(handle); }
void Ambassador::change_attribute_order_type(ObjectHandle object, AttributeSet attributes,
                                             Order order) {
  services_->change_attribute_order_type(object, attributes, order);
}
void Ambassador::change_interaction_order_type(InteractionClassHandle interaction_class,
                                               Order order) {
  services_->change_interaction_order_type(interaction_class, order);
}
bool Ambassador::receive(Bytes bytes) { return services_->receive(bytes); }
void Ambassador::receive_datagram(Bytes datagram) { services_->receive_datagram(datagram); }
void Ambassador::expect_datagrams(std::size_t size_max) { services_->expect_datagrams(size_max); }
std::span<const Datagram> Ambassador::outgoing_datagrams() {
  return services_->outgoing_datagrams();
}
void Ambassador::clear_outgoing_datagrams() { services_->clear_outgoing_datagrams(); }
Bytes Ambassador::outgoing() const { return services_->outgoing(); }
void Ambassador::clear_outgoing() { services_->clear_outgoing(); }
void Ambassador::advance_clock(double now) { services_->advance_clock(now); }
void Ambassador::disconnected(std::string_view why) { services_->disconnected(why); }
const AmbassadorCounters& Ambassador::counters() const { return services_->counters(); }
std::size_t Ambassador::memory_bytes() const {
  return sizeof(AmbassadorServices) + services_->memory_bytes();
}

}  // namespace rink::rti
