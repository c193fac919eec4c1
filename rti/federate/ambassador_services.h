// The services of a federate's side: what Ambassador, which documents them, forwards to.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "im/region.h"
#include "rti/federate/advisory_switches.h"
#include "rti/federate/ambassador_parts.h"

namespace rink::rti {

class AmbassadorServices final : public AmbassadorParts,
                                 public AdvisorySwitches<AmbassadorServices> {
 public:
  AmbassadorServices(const Fom& fom, FederateAmbassador& callbacks, const Patience& patience = {},
                     CallbackModel model = CallbackModel::immediate);
  void create_federation_execution(std::string_view federation) {
    questions_.create_federation_execution(federation, fom_);
  }
  void create_federation_execution(std::string_view federation, const Fom& model) {
    questions_.create_federation_execution(federation, model);
  }
  void destroy_federation_execution(std::string_view federation) {
    questions_.destroy_federation_execution(federation);
  }
  void list_federation_executions() { questions_.list_federation_executions(); }
  void query_management() { questions_.query_management(); }
  void join(std::string_view federation, std::string_view federate_name,
            std::string_view federate_type) {
    session_.join(federation, federate_name, federate_type);
    regions_.sign(federate_name);
  }
  void resign() { session_.resign(); }
  bool is_joined() const { return phase_.is_joined(); }
  FederateHandle federate() const { return phase_.federate(); }
  void register_synchronization_point(std::string_view label, Bytes tag = {},
                                      std::span<const FederateHandle> members = {}) {
    synchronization_.register_point(label, tag, members);
  }
  void synchronization_point_achieved(std::string_view label, bool is_success = true) {
    synchronization_.achieve(label, is_success);
  }
  void watch_federates() { session_.watch_federates(); }
  void publish_object_class_attributes(ObjectClassHandle object_class, AttributeSet attributes);
  void unpublish_object_class(ObjectClassHandle object_class);
  void subscribe_object_class_attributes(ObjectClassHandle object_class, AttributeSet attributes,
                                         RegionHandle region = {}, bool is_active = true);
  void unsubscribe_object_class(ObjectClassHandle object_class, RegionHandle region = {});
  void publish_interaction_class(InteractionClassHandle interaction_class);
  void unpublish_interaction_class(InteractionClassHandle interaction_class);
  void subscribe_interaction_class(InteractionClassHandle interaction_class, bool is_active = true);
  void unsubscribe_interaction_class(InteractionClassHandle interaction_class);
  void unconditional_attribute_ownership_divestiture(ObjectHandle object, AttributeSet attributes);
  void negotiated_attribute_ownership_divestiture(ObjectHandle object, AttributeSet attributes,
                                                  Bytes tag = {});
  void confirm_divestiture(ObjectHandle object, AttributeSet attributes, Bytes tag = {});
  void cancel_negotiated_attribute_ownership_divestiture(ObjectHandle object,
                                                         AttributeSet attributes);
  void attribute_ownership_release_denied(ObjectHandle object, AttributeSet attributes);
  void attribute_ownership_divestiture_if_wanted(ObjectHandle object, AttributeSet attributes);
  void attribute_ownership_acquisition(ObjectHandle object, AttributeSet attributes,
                                       Bytes tag = {});
  void attribute_ownership_acquisition_if_available(ObjectHandle object, AttributeSet attributes);
  void cancel_attribute_ownership_acquisition(ObjectHandle object, AttributeSet attributes);
  void query_attribute_ownership(ObjectHandle object, AttributeHandle attribute);
  bool is_attribute_owned_by_federate(ObjectHandle object, AttributeHandle attribute);
  void set_automatic_resign_directive(ResignAction action);
  void resign(ResignAction action);
  ObjectHandle register_object_instance(ObjectClassHandle object_class, std::string_view name = {});
  void delete_object_instance(ObjectHandle object);
  void local_delete_object_instance(ObjectHandle object);
  void reserve_object_instance_name(std::string_view name) { names_.reserve(name); }
  void reserve_multiple_object_instance_names(std::span<const std::string_view> names) {
    names_.reserve_set(names);
  }
  void release_object_instance_name(std::string_view name) {
    names_.release_set(std::span(&name, 1));
  }
  void release_multiple_object_instance_names(std::span<const std::string_view> names) {
    names_.release_set(names);
  }
  void request_attribute_value_update(ObjectClassHandle object_class, AttributeSet attributes,
                                      Bytes tag = {});
  void request_attribute_value_update(ObjectHandle object, AttributeSet attributes, Bytes tag = {});
  void request_attribute_transportation_type_change(ObjectHandle object, AttributeSet attributes,
                                                    Transportation transportation);
  void query_attribute_transportation_type(ObjectHandle object, AttributeHandle attribute);
  void request_interaction_transportation_type_change(InteractionClassHandle interaction_class,
                                                      Transportation transportation);
  void query_interaction_transportation_type(FederateHandle federate,
                                             InteractionClassHandle interaction_class);
  void update_attribute_values(ObjectHandle object, AttributeSet attributes, Bytes values,
                               const Stamp& stamp);
  void send_interaction(InteractionClassHandle interaction_class, Bytes parameters,
                        const Stamp& stamp);
  void send_directed_interaction(InteractionClassHandle interaction_class, FederateHandle receiver,
                                 Bytes parameters, const Stamp& stamp);
  RegionHandle create_region();
  RegionHandle create_region(DimensionSet dimensions);
  void set_region(RegionHandle region, const im::Region& bounds);
  void set_range_bounds(RegionHandle region, DimensionHandle dimension, const Range& range);
  Range get_range_bounds(RegionHandle region, DimensionHandle dimension) const;
  DimensionSet get_dimension_handle_set(RegionHandle region) const;
  void commit_region_modifications(RegionHandle region);
  void commit_region_modifications(std::span<const RegionHandle> regions);
  void commit_region_modifications(std::span<const RegionBounds> regions);
  void delete_region(RegionHandle region);
  void associate_regions_for_updates(ObjectHandle object, RegionHandle region);
  void associate_regions_for_updates(ObjectHandle object, std::span<const AttributeRegions> pairs);
  void unassociate_regions_for_updates(ObjectHandle object,
                                       std::span<const AttributeRegions> pairs);
  ObjectHandle register_object_instance_with_regions(ObjectClassHandle object_class,
                                                     std::span<const AttributeRegions> pairs,
                                                     std::string_view name = {});
  void subscribe_object_class_attributes_with_regions(ObjectClassHandle object_class,
                                                      std::span<const AttributeRegions> pairs,
                                                      bool is_active = true);
  void unsubscribe_object_class_attributes_with_regions(ObjectClassHandle object_class,
                                                        std::span<const AttributeRegions> pairs);
  void subscribe_interaction_class_with_regions(InteractionClassHandle interaction_class,
                                                std::span<const RegionHandle> regions,
                                                bool is_active = true);
  void unsubscribe_interaction_class_with_regions(InteractionClassHandle interaction_class,
                                                  std::span<const RegionHandle> regions);
  void send_interaction_with_regions(InteractionClassHandle interaction_class, Bytes parameters,
                                     std::span<const RegionHandle> regions, const Stamp& stamp);
  void request_attribute_value_update_with_regions(ObjectClassHandle object_class,
                                                   std::span<const AttributeRegions> pairs);
  FederateHandle get_federate_handle(std::string_view name) const {
    return session_.handle_of(name);
  }
  const std::string& get_federate_name(FederateHandle federate) const {
    return session_.name_of(federate);
  }
  ObjectHandle get_object_instance_handle(std::string_view name) const {
    return names_.handle_of(name);
  }
  std::string get_object_instance_name(ObjectHandle object) const { return names_.name_of(object); }
  ObjectClassHandle get_known_object_class_handle(ObjectHandle object) const;
  bool evoke_callback() { return gate_.evoke(1); }
  bool evoke_multiple_callbacks(std::size_t count_max = ~std::size_t{0}) {
    return gate_.evoke(count_max);
  }
  void disable_callbacks();
  void enable_callbacks();
  void enable_time_regulation(double lookahead);
  void disable_time_regulation();
  void enable_time_constrained();
  void disable_time_constrained();
  void time_advance_request(LogicalTime time) { request_advance(AdvanceKind::time_advance, time); }
  void time_advance_request_available(LogicalTime time) {
    request_advance(AdvanceKind::time_advance_available, time);
  }
  void next_message_request(LogicalTime time) { request_advance(AdvanceKind::next_message, time); }
  void next_message_request_available(LogicalTime time) {
    request_advance(AdvanceKind::next_message_available, time);
  }
  void flush_queue_request(LogicalTime time) { request_advance(AdvanceKind::flush_queue, time); }
  void modify_lookahead(double lookahead);
  void enable_asynchronous_delivery() { clock_.ask_asynchronous(true); }
  void disable_asynchronous_delivery() { clock_.ask_asynchronous(false); }
  LogicalTime query_logical_time() const { return LogicalTime(clock_.time()); }
  double query_lookahead() const { return clock_.lookahead(); }
  void query_time_bounds();
  const FederateClock& clock() const { return clock_; }
  RetractionHandle update_attribute_values(ObjectHandle object, AttributeSet attributes,
                                           Bytes values, LogicalTime time, std::uint64_t tag = 0);
  RetractionHandle send_interaction(InteractionClassHandle interaction_class, Bytes parameters,
                                    LogicalTime time, std::uint64_t tag = 0);
  RetractionHandle send_directed_interaction(InteractionClassHandle interaction_class,
                                             FederateHandle receiver, Bytes parameters,
                                             LogicalTime time, std::uint64_t tag = 0);
  RetractionHandle delete_object_instance(ObjectHandle object, LogicalTime time,
                                          std::uint64_t tag = 0);
  void retract(const RetractionHandle& handle);
  void change_attribute_order_type(ObjectHandle object, AttributeSet attributes, Order order);
  void change_interaction_order_type(InteractionClassHandle interaction_class, Order order);
  bool receive(Bytes bytes);
  void receive_datagram(Bytes datagram);
  void expect_datagrams(std::size_t size_max);
  std::span<const Datagram> outgoing_datagrams();
  void clear_outgoing_datagrams();
  Bytes outgoing() const { return frames_.bytes(); }
  void clear_outgoing();
  void advance_clock(double now);
  void disconnected(std::string_view why) { lose(why); }
  const AmbassadorCounters& counters() const { return counters_; }
  std::size_t memory_bytes() const;

 private:
  friend AdvisorySwitches<AmbassadorServices>;
};

}  // namespace rink::rti
