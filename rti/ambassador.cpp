// Forwards every service of `Ambassador` to the part that does it.
#include "rti/ambassador.h"

#include "rti/federate/ambassador_parts.h"
#include "rti/save/kept_ambassador.h"

namespace rink::rti {

static_assert(Ambassador::waiting_callbacks_max == CallbackGate::waiting_max);

Ambassador::Ambassador(const Fom& fom, FederateAmbassador& callbacks, const Timeouts& timeouts,
                       CallbackModel model)
    : parts_(std::make_unique<AmbassadorParts>(fom, callbacks, timeouts, model)) {
  AmbassadorParts& parts = *parts_;
  parts.saves.keep_by(
      [&parts](std::vector<std::byte>& state) { write_state(parts, state); },
      [&parts](Bytes state, std::uint32_t block) { return read_state(parts, state, block); });
}
Ambassador::~Ambassador() = default;

void Ambassador::create_federation_execution(std::string_view federation) {
  parts_->questions.create_federation_execution(federation, parts_->ground.fom);
}
void Ambassador::create_federation_execution(std::string_view federation, const Fom& model) {
  parts_->questions.create_federation_execution(federation, model);
}
void Ambassador::destroy_federation_execution(std::string_view federation) {
  parts_->questions.destroy_federation_execution(federation);
}
void Ambassador::list_federation_executions() { parts_->questions.list_federation_executions(); }
void Ambassador::notify_host() { parts_->questions.notify_host(); }
void Ambassador::query_management() { parts_->questions.query_management(); }
void Ambassador::join(std::string_view federation, std::string_view federate_name,
                      std::string_view federate_type) {
  parts_->join(federation, federate_name, federate_type);
}
void Ambassador::resign() { parts_->session.resign(); }
bool Ambassador::is_joined() const { return parts_->ground.phase.is_joined(); }
FederateHandle Ambassador::federate() const { return parts_->ground.phase.federate(); }
void Ambassador::register_synchronization_point(std::string_view label, Bytes tag,
                                                std::span<const FederateHandle> members) {
  active().synchronization.register_point(label, tag, members);
}
void Ambassador::synchronization_point_achieved(std::string_view label, bool is_success) {
  active().synchronization.achieve(label, is_success);
}
void Ambassador::watch_federates() { active().session.watch_federates(); }
AmbassadorParts& Ambassador::active() {
  parts_->saves.require_idle();
  return *parts_;
}
void Ambassador::request_federation_save(std::string_view label) {
  parts_->saves.request(label, {});
}
void Ambassador::request_federation_save(std::string_view label, LogicalTime time) {
  parts_->saves.request(label, time);
}
void Ambassador::federate_save_begun() { parts_->saves.begun(); }
void Ambassador::federate_save_complete() { parts_->saves.complete(true); }
void Ambassador::federate_save_not_complete() { parts_->saves.complete(false); }
void Ambassador::abort_federation_save() { parts_->saves.abort(); }
void Ambassador::query_federation_save_status() { parts_->saves.query(); }
void Ambassador::request_federation_restore(std::string_view label) {
  parts_->saves.request_restore(label);
}
void Ambassador::federate_restore_complete() { parts_->saves.complete_restore(true); }
void Ambassador::federate_restore_not_complete() { parts_->saves.complete_restore(false); }
void Ambassador::abort_federation_restore() { parts_->saves.abort_restore(); }
void Ambassador::query_federation_restore_status() { parts_->saves.query_restore(); }
void Ambassador::publish_object_class_attributes(ObjectClassHandle object_class,
                                                 AttributeSet attributes) {
  active().declarations.publish(object_class, attributes);
}
void Ambassador::unpublish_object_class(ObjectClassHandle object_class) {
  active().declarations.publish(object_class, {});
}
void Ambassador::subscribe_object_class_attributes(ObjectClassHandle object_class,
                                                   AttributeSet attributes, RegionHandle region,
                                                   bool is_active) {
  active().declarations.subscribe(object_class, attributes, region, is_active);
}
void Ambassador::unsubscribe_object_class(ObjectClassHandle object_class, RegionHandle region) {
  active().declarations.subscribe(object_class, {}, region, true);
}
void Ambassador::publish_interaction_class(InteractionClassHandle interaction_class) {
  active().declarations.publish(interaction_class, true);
}
void Ambassador::unpublish_interaction_class(InteractionClassHandle interaction_class) {
  active().declarations.publish(interaction_class, false);
}
void Ambassador::subscribe_interaction_class(InteractionClassHandle interaction_class,
                                             bool is_active) {
  active().declarations.subscribe(interaction_class,
                                  is_active ? Listening::active : Listening::passive);
}
void Ambassador::unsubscribe_interaction_class(InteractionClassHandle interaction_class) {
  active().declarations.subscribe(interaction_class, Listening::none);
}
void Ambassador::unconditional_attribute_ownership_divestiture(ObjectHandle object,
                                                               AttributeSet attributes) {
  active().owners.divest(object, attributes);
}
void Ambassador::negotiated_attribute_ownership_divestiture(ObjectHandle object,
                                                            AttributeSet attributes, Bytes tag) {
  active().owners.offer(object, attributes, tag);
}
void Ambassador::confirm_divestiture(ObjectHandle object, AttributeSet attributes, Bytes tag) {
  active().owners.confirm(object, attributes, tag);
}
void Ambassador::cancel_negotiated_attribute_ownership_divestiture(ObjectHandle object,
                                                                   AttributeSet attributes) {
  active().owners.withdraw_offer(object, attributes);
}
void Ambassador::attribute_ownership_release_denied(ObjectHandle object, AttributeSet attributes) {
  active().owners.deny_release(object, attributes);
}
void Ambassador::attribute_ownership_divestiture_if_wanted(ObjectHandle object,
                                                           AttributeSet attributes) {
  active().owners.divest_if_wanted(object, attributes);
}
void Ambassador::attribute_ownership_acquisition(ObjectHandle object, AttributeSet attributes,
                                                 Bytes tag) {
  active().owners.acquire(object, attributes, tag);
}
void Ambassador::attribute_ownership_acquisition_if_available(ObjectHandle object,
                                                              AttributeSet attributes) {
  active().owners.acquire_if_available(object, attributes);
}
void Ambassador::cancel_attribute_ownership_acquisition(ObjectHandle object,
                                                        AttributeSet attributes) {
  active().owners.cancel_acquisition(object, attributes);
}
void Ambassador::query_attribute_ownership(ObjectHandle object, AttributeHandle attribute) {
  active().owners.query(object, attribute);
}
bool Ambassador::is_attribute_owned_by_federate(ObjectHandle object, AttributeHandle attribute) {
  return active().owners.is_owned(object, attribute);
}
void Ambassador::set_automatic_resign_directive(ResignAction action) {
  active().owners.set_directive(action);
}
void Ambassador::resign(ResignAction action) { parts_->resign(action); }
ObjectHandle Ambassador::register_object_instance(ObjectClassHandle object_class,
                                                  std::string_view name) {
  return active().objects.register_instance(object_class, name);
}
void Ambassador::delete_object_instance(ObjectHandle object) {
  active().objects.delete_instance(object);
}
void Ambassador::local_delete_object_instance(ObjectHandle object) {
  active().objects.forget_instance(object);
}
void Ambassador::reserve_object_instance_name(std::string_view name) {
  active().names.reserve(name);
}
void Ambassador::reserve_multiple_object_instance_names(std::span<const std::string_view> names) {
  active().names.reserve_set(names);
}
void Ambassador::release_object_instance_name(std::string_view name) {
  active().names.release_set(std::span(&name, 1));
}
void Ambassador::release_multiple_object_instance_names(std::span<const std::string_view> names) {
  active().names.release_set(names);
}
void Ambassador::request_attribute_value_update(ObjectClassHandle object_class,
                                                AttributeSet attributes, Bytes tag) {
  active().objects.request_update(object_class, attributes, tag);
}
void Ambassador::request_attribute_value_update(ObjectHandle object, AttributeSet attributes,
                                                Bytes tag) {
  active().objects.request_update(object, attributes, tag);
}
void Ambassador::request_attribute_transportation_type_change(ObjectHandle object,
                                                              AttributeSet attributes,
                                                              Transportation transportation) {
  active().transportation.change(object, attributes, transportation);
}
void Ambassador::query_attribute_transportation_type(ObjectHandle object,
                                                     AttributeHandle attribute) {
  active().transportation.query(object, attribute);
}
void Ambassador::request_interaction_transportation_type_change(
    InteractionClassHandle interaction_class, Transportation transportation) {
  active().transportation.change(interaction_class, transportation);
}
void Ambassador::query_interaction_transportation_type(FederateHandle federate,
                                                       InteractionClassHandle interaction_class) {
  active().transportation.query(federate, interaction_class);
}
void Ambassador::update_attribute_values(ObjectHandle object, AttributeSet attributes, Bytes values,
                                         const Stamp& stamp) {
  active().updates.update(object, attributes, values, stamp);
}
void Ambassador::send_interaction(InteractionClassHandle interaction_class, Bytes parameters,
                                  const Stamp& stamp) {
  active().updates.send(interaction_class, {}, parameters, stamp);
}
void Ambassador::send_directed_interaction(InteractionClassHandle interaction_class,
                                           FederateHandle receiver, Bytes parameters,
                                           const Stamp& stamp) {
  active().updates.send(interaction_class, receiver, parameters, stamp);
}
RegionHandle Ambassador::create_region() { return active().regions.create(); }
RegionHandle Ambassador::create_region(DimensionSet dimensions) {
  return active().regions.create(dimensions);
}
void Ambassador::set_region(RegionHandle region, const im::Region& bounds) {
  active().ground.regions.set_plane(region, bounds);
}
void Ambassador::set_range_bounds(RegionHandle region, DimensionHandle dimension,
                                  const Range& range) {
  active().ground.regions.set_range(region, dimension, range);
}
Range Ambassador::get_range_bounds(RegionHandle region, DimensionHandle dimension) const {
  return parts_->ground.regions.range(region, dimension);
}
DimensionSet Ambassador::get_dimension_handle_set(RegionHandle region) const {
  return parts_->ground.regions.dimensions(region);
}
void Ambassador::commit_region_modifications(RegionHandle region) {
  active().regions.commit(std::span<const RegionHandle>(&region, 1));
}
void Ambassador::commit_region_modifications(std::span<const RegionHandle> regions) {
  active().regions.commit(regions);
}
void Ambassador::commit_region_modifications(std::span<const RegionBounds> regions) {
  active().regions.commit(regions);
}
void Ambassador::delete_region(RegionHandle region) { active().regions.remove(region); }
void Ambassador::associate_regions_for_updates(ObjectHandle object, RegionHandle region) {
  active().regions.associate(object, region);
}
void Ambassador::associate_regions_for_updates(ObjectHandle object,
                                               std::span<const AttributeRegions> pairs) {
  active().regions.associate(object, pairs, true);
}
void Ambassador::unassociate_regions_for_updates(ObjectHandle object,
                                                 std::span<const AttributeRegions> pairs) {
  active().regions.associate(object, pairs, false);
}
ObjectHandle Ambassador::register_object_instance_with_regions(
    ObjectClassHandle object_class, std::span<const AttributeRegions> pairs,
    std::string_view name) {
  return active().regions.register_instance(object_class, pairs, name);
}
void Ambassador::subscribe_object_class_attributes_with_regions(
    ObjectClassHandle object_class, std::span<const AttributeRegions> pairs, bool is_active) {
  active().regions.subscribe(object_class, pairs,
                             is_active ? RegionAction::add : RegionAction::add_passively);
}
void Ambassador::unsubscribe_object_class_attributes_with_regions(
    ObjectClassHandle object_class, std::span<const AttributeRegions> pairs) {
  active().regions.subscribe(object_class, pairs, RegionAction::remove);
}
void Ambassador::subscribe_interaction_class_with_regions(InteractionClassHandle interaction_class,
                                                          std::span<const RegionHandle> regions,
                                                          bool is_active) {
  active().regions.subscribe(interaction_class, regions,
                             is_active ? Listening::active : Listening::passive);
}
void Ambassador::unsubscribe_interaction_class_with_regions(
    InteractionClassHandle interaction_class, std::span<const RegionHandle> regions) {
  active().regions.subscribe(interaction_class, regions, Listening::none);
}
void Ambassador::send_interaction_with_regions(InteractionClassHandle interaction_class,
                                               Bytes parameters,
                                               std::span<const RegionHandle> regions,
                                               const Stamp& stamp) {
  active().regions.send(interaction_class, parameters, regions, stamp);
}
void Ambassador::request_attribute_value_update_with_regions(
    ObjectClassHandle object_class, std::span<const AttributeRegions> pairs) {
  active().regions.request_update(object_class, pairs);
}
FederateHandle Ambassador::get_federate_handle(std::string_view name) const {
  return parts_->session.handle_of(name);
}
const std::string& Ambassador::get_federate_name(FederateHandle federate) const {
  return parts_->session.name_of(federate);
}
ObjectHandle Ambassador::get_object_instance_handle(std::string_view name) const {
  return parts_->names.handle_of(name);
}
std::string Ambassador::get_object_instance_name(ObjectHandle object) const {
  return parts_->names.name_of(object);
}
ObjectClassHandle Ambassador::get_known_object_class_handle(ObjectHandle object) const {
  return parts_->objects.class_of(object);
}
bool Ambassador::evoke_callback() { return parts_->ground.gate.evoke(1); }
bool Ambassador::evoke_multiple_callbacks(std::size_t count_max) {
  return parts_->ground.gate.evoke(count_max);
}
void Ambassador::disable_callbacks() { parts_->disable_callbacks(); }
void Ambassador::enable_callbacks() { parts_->enable_callbacks(); }
void Ambassador::enable_time_regulation(double lookahead) {
  active().time.enable_regulation(lookahead);
}
void Ambassador::disable_time_regulation() { active().time.disable_regulation(); }
void Ambassador::enable_time_constrained() { active().time.enable_constrained(); }
void Ambassador::disable_time_constrained() { active().time.disable_constrained(); }
void Ambassador::time_advance_request(LogicalTime time) {
  active().time.request_advance(AdvanceKind::time_advance, time);
}
void Ambassador::time_advance_request_available(LogicalTime time) {
  active().time.request_advance(AdvanceKind::time_advance_available, time);
}
void Ambassador::next_message_request(LogicalTime time) {
  active().time.request_advance(AdvanceKind::next_message, time);
}
void Ambassador::next_message_request_available(LogicalTime time) {
  active().time.request_advance(AdvanceKind::next_message_available, time);
}
void Ambassador::flush_queue_request(LogicalTime time) {
  active().time.request_advance(AdvanceKind::flush_queue, time);
}
void Ambassador::modify_lookahead(double lookahead) { active().time.modify_lookahead(lookahead); }
void Ambassador::enable_asynchronous_delivery() { active().time.set_asynchronous(true); }
void Ambassador::disable_asynchronous_delivery() { active().time.set_asynchronous(false); }
LogicalTime Ambassador::query_logical_time() const {
  return LogicalTime(parts_->time.clock().time());
}
double Ambassador::query_lookahead() const { return parts_->time.clock().lookahead(); }
void Ambassador::query_time_bounds() { active().time.query_bounds(); }
const FederateClock& Ambassador::clock() const { return parts_->time.clock(); }
RetractionHandle Ambassador::update_attribute_values(ObjectHandle object, AttributeSet attributes,
                                                     Bytes values, LogicalTime time,
                                                     std::uint64_t tag) {
  return active().time.update(object, attributes, values, {time, tag});
}
RetractionHandle Ambassador::send_interaction(InteractionClassHandle interaction_class,
                                              Bytes parameters, LogicalTime time,
                                              std::uint64_t tag) {
  return active().time.send(interaction_class, {}, parameters, {time, tag});
}
RetractionHandle Ambassador::send_directed_interaction(InteractionClassHandle interaction_class,
                                                       FederateHandle receiver, Bytes parameters,
                                                       LogicalTime time, std::uint64_t tag) {
  return active().time.send(interaction_class, receiver, parameters, {time, tag});
}
RetractionHandle Ambassador::delete_object_instance(ObjectHandle object, LogicalTime time,
                                                    std::uint64_t tag) {
  return active().time.delete_instance(object, {time, tag});
}
void Ambassador::retract(const RetractionHandle& handle) { active().time.retract(handle); }
void Ambassador::change_attribute_order_type(ObjectHandle object, AttributeSet attributes,
                                             Order order) {
  active().time.change_order(object, attributes, order);
}
void Ambassador::change_interaction_order_type(InteractionClassHandle interaction_class,
                                               Order order) {
  active().time.change_order(interaction_class, order);
}
bool Ambassador::receive(Bytes bytes) { return parts_->receive(bytes); }
void Ambassador::receive_datagram(Bytes datagram) { parts_->receive_datagram(datagram); }
void Ambassador::expect_datagrams(std::size_t size_max) { parts_->expect_datagrams(size_max); }
std::span<const Datagram> Ambassador::outgoing_datagrams() { return parts_->outgoing_datagrams(); }
void Ambassador::clear_outgoing_datagrams() { parts_->clear_outgoing_datagrams(); }
Bytes Ambassador::outgoing() const { return parts_->ground.frames.bytes(); }
void Ambassador::clear_outgoing() { parts_->clear_outgoing(); }
void Ambassador::advance_clock(double now, bool is_behind) {
  parts_->advance_clock(now, is_behind);
}
void Ambassador::disconnected(std::string_view why) { parts_->lose(why); }
const AmbassadorCounters& Ambassador::counters() const { return parts_->ground.counters; }
std::size_t Ambassador::memory_bytes() const {
  return sizeof(AmbassadorParts) + parts_->memory_bytes();
}

}  // namespace rink::rti
