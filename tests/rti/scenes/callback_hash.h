// A federate that hashes every callback it is told, with all of its arguments.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "rti/federate_ambassador.h"
#include "rti/management/federation_report.h"
#include "rti/wire/bytes.h"

namespace rink::rti::testing {

/// FNV-1a.
class ByteHash {
 public:
  void add(Bytes bytes) {
    for (const std::byte each : bytes)
      value_ = (value_ ^ std::to_integer<std::uint64_t>(each)) * 0x100000001b3u;
  }
  void add(std::string_view text) { add(std::as_bytes(std::span(text))); }
  void add(std::uint64_t number) { add(std::as_bytes(std::span(&number, 1))); }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

/// Each callback is a number, in the order of rti/federate_ambassador.h, then its arguments. One
/// that a derived class overrides must be passed on.
class CallbackHash : public FederateAmbassador {
 public:
  /// `hash` may be shared with others: what goes out beside what comes in.
  explicit CallbackHash(ByteHash& hash) : hash_(hash) {}

  void joined(FederateHandle federate) override { note(1, federate); }
  void join_refused(Refusal refusal, std::string_view why) override { note(2, refusal, why); }
  void connection_lost(std::string_view why) override { note(3, why); }
  void federation_execution_created(std::string_view federation, HlaError error) override {
    note(4, federation, error);
  }
  void federation_execution_destroyed(std::string_view federation, HlaError error) override {
    note(5, federation, error);
  }
  void report_management(const std::vector<FederationReport>& reports) override {
    note(6, reports.size());
    for (const FederationReport& each : reports) {
      note(each.federation, each.model, each.filter, each.objects);
      for (const std::uint64_t drops : each.drops) note(drops);
      for (const FederateReport& one : each.federates)
        note(one.federate, one.name, one.type, one.counts.bytes_sent, one.counts.bytes_received,
             one.counts.objects_owned, one.counts.logical_time);
    }
  }
  void report_federation_executions(
      const std::vector<FederationExecutionInformation>& executions) override {
    note(7, executions.size());
    for (const FederationExecutionInformation& each : executions)
      note(each.federation, each.model, each.federates);
  }
  void synchronization_point_registration_succeeded(std::string_view label) override {
    note(8, label);
  }
  void synchronization_point_registration_failed(std::string_view label,
                                                 SynchronizationFailure failure) override {
    note(9, label, failure);
  }
  void announce_synchronization_point(std::string_view label, Bytes tag) override {
    note(10, label, tag);
  }
  void federation_synchronized(std::string_view label,
                               std::span<const FederateHandle> failed) override {
    note(11, label);
    for (const FederateHandle each : failed) note(each);
  }
  void federate_joined(FederateHandle federate, std::string_view name,
                       std::string_view type) override {
    note(12, federate, name, type);
  }
  void federate_resigned(FederateHandle federate, std::string_view name, std::string_view type,
                         ResignReason reason) override {
    note(13, federate, name, type, reason);
  }
  void start_registration_for_object_class(ObjectClassHandle object_class) override {
    note(14, object_class);
  }
  void stop_registration_for_object_class(ObjectClassHandle object_class) override {
    note(15, object_class);
  }
  void turn_interactions_on(InteractionClassHandle interaction_class) override {
    note(16, interaction_class);
  }
  void turn_interactions_off(InteractionClassHandle interaction_class) override {
    note(17, interaction_class);
  }
  void turn_updates_on_for_object_instance(ObjectHandle object, AttributeSet attributes) override {
    note(18, object, attributes);
  }
  void turn_updates_off_for_object_instance(ObjectHandle object, AttributeSet attributes) override {
    note(19, object, attributes);
  }
  void object_instance_name_reservation_succeeded(std::string_view name) override {
    note(20, name);
  }
  void object_instance_name_reservation_failed(std::string_view name) override { note(21, name); }
  void multiple_object_instance_name_reservation_succeeded(
      const std::vector<std::string>& names) override {
    note(22, names.size());
    for (const std::string& each : names) note(each);
  }
  void multiple_object_instance_name_reservation_failed(
      const std::vector<std::string>& names) override {
    note(23, names.size());
    for (const std::string& each : names) note(each);
  }
  void confirm_attribute_transportation_type_change(ObjectHandle object, AttributeSet attributes,
                                                    Transportation type) override {
    note(24, object, attributes, type);
  }
  void report_attribute_transportation_type(ObjectHandle object, AttributeHandle attribute,
                                            Transportation type) override {
    note(25, object, attribute, type);
  }
  void confirm_interaction_transportation_type_change(InteractionClassHandle interaction_class,
                                                      Transportation type) override {
    note(26, interaction_class, type);
  }
  void report_interaction_transportation_type(FederateHandle federate,
                                              InteractionClassHandle interaction_class,
                                              Transportation type) override {
    note(27, federate, interaction_class, type);
  }
  void discover_object_instance(ObjectHandle object, ObjectClassHandle object_class,
                                std::string_view name) override {
    note(28, object, object_class, name);
  }
  void reflect_attribute_values(ObjectHandle object, AttributeSet attributes, Bytes values,
                                const Stamp& stamp) override {
    note(29, object, attributes, values, stamp);
  }
  void attributes_in_scope(ObjectHandle object) override { note(30, object); }
  void attributes_out_of_scope(ObjectHandle object) override { note(31, object); }
  void provide_attribute_value_update(ObjectHandle object, AttributeSet attributes,
                                      Bytes tag) override {
    note(32, object, attributes, tag);
  }
  void remove_object_instance(ObjectHandle object) override { note(33, object); }
  void request_attribute_ownership_assumption(ObjectHandle object, AttributeSet attributes,
                                              Bytes tag) override {
    note(34, object, attributes, tag);
  }
  void request_divestiture_confirmation(ObjectHandle object, AttributeSet attributes) override {
    note(35, object, attributes);
  }
  void attribute_ownership_acquisition_notification(ObjectHandle object, AttributeSet attributes,
                                                    Bytes tag) override {
    note(36, object, attributes, tag);
  }
  void attribute_ownership_unavailable(ObjectHandle object, AttributeSet attributes) override {
    note(37, object, attributes);
  }
  void request_attribute_ownership_release(ObjectHandle object, AttributeSet attributes,
                                           Bytes tag) override {
    note(38, object, attributes, tag);
  }
  void confirm_attribute_ownership_acquisition_cancellation(ObjectHandle object,
                                                            AttributeSet attributes) override {
    note(39, object, attributes);
  }
  void inform_attribute_ownership(ObjectHandle object, AttributeHandle attribute,
                                  FederateHandle owner) override {
    note(40, object, attribute, owner);
  }
  void attribute_is_not_owned(ObjectHandle object, AttributeHandle attribute) override {
    note(41, object, attribute);
  }
  void attribute_ownership_divested(ObjectHandle object, AttributeSet attributes) override {
    note(42, object, attributes);
  }
  void attribute_ownership_kept(ObjectHandle object, AttributeSet attributes) override {
    note(43, object, attributes);
  }
  void receive_interaction(InteractionClassHandle interaction_class, Bytes parameters,
                           FederateHandle sender, const Stamp& stamp) override {
    note(44, interaction_class, parameters, sender, stamp);
  }
  void time_regulation_enabled(LogicalTime time) override { note(45, time); }
  void time_constrained_enabled(LogicalTime time) override { note(46, time); }
  void time_advance_grant(LogicalTime time) override { note(47, time); }
  void request_retraction(const RetractionHandle& handle) override { note(48, handle); }
  void time_bounds(double galt, double lits) override { note(49, galt, lits); }
  void reflect_attribute_values_with_time(ObjectHandle object, AttributeSet attributes,
                                          Bytes values, const TimedStamp& timed) override {
    note(50, timed);
    reflect_attribute_values(object, attributes, values, timed.stamp);
  }
  void receive_interaction_with_time(InteractionClassHandle interaction_class, Bytes parameters,
                                     FederateHandle sender, const TimedStamp& timed) override {
    note(51, timed);
    receive_interaction(interaction_class, parameters, sender, timed.stamp);
  }
  void remove_object_instance_with_time(ObjectHandle object, const TimedStamp& timed) override {
    note(52, timed);
    remove_object_instance(object);
  }

 private:
  template <class... Arguments>
  void note(const Arguments&... arguments) {
    (add(arguments), ...);
  }
  template <class Number>
  requires(std::is_arithmetic_v<Number> || std::is_enum_v<Number>) void add(Number number) {
    hash_.add(std::as_bytes(std::span(&number, 1)));
  }
  template <class Handle>
  requires requires(const Handle& handle) { handle.value; }
  void add(const Handle& handle) { add(handle.value); }
  void add(AttributeSet attributes) { add(static_cast<std::uint32_t>(attributes.bits)); }
  void add(Bytes bytes) { add(bytes.size()), hash_.add(bytes); }
  void add(std::string_view text) { add(text.size()), hash_.add(text); }
  void add(const std::string& text) { add(std::string_view(text)); }
  void add(const Stamp& stamp) { note(stamp.time, stamp.tag); }
  void add(const RetractionHandle& handle) { note(handle.sender, handle.number, handle.time); }
  void add(const TimedStamp& timed) { note(timed.stamp, timed.is_in_order, timed.handle); }

  ByteHash& hash_;
};

}  // namespace rink::rti::testing
