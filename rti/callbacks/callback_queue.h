// Callbacks that wait until their federate asks for them: the evoked model of IEEE
// 1516.1-2010, 10.41.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <vector>

#include "rti/callbacks/callback_arguments.h"
#include "rti/federate_ambassador.h"
#include "rti/wire/bytes.h"

namespace rink::rti {

/// Takes the place of a federate and records each callback with a copy of its arguments, one after
/// the other in one buffer, so nothing is allocated per callback once that has grown. The rejected
/// alternative is keeping the messages and reading them late: one message may be many callbacks (a
/// block of updates, a grant with what was queued by time), and the ambassador would answer its
/// peers late. Every callback is here; a test compares the two lists.
class CallbackQueue final : public FederateAmbassador {
 public:
  /// `federate` must outlive it.
  explicit CallbackQueue(FederateAmbassador& federate) : federate_(federate) {}

  bool is_empty() const { return taken_ == records_.size(); }
  std::size_t waiting_bytes() const { return records_.size() - taken_; }
  std::size_t memory_bytes() const { return records_.capacity() + delivering_.capacity(); }
  /// Delivers the oldest callback; there must be one. What the callback causes to be queued comes
  /// after all that waits.
  void deliver_one();
  bool is_delivering() const { return is_delivering_; }
  /// Asserts that whole records follow each other to the end.
  void check() const;

  void joined(FederateHandle federate) override { put<&FederateAmbassador::joined>(federate); }
  void join_refused(Refusal refusal, std::string_view why) override {
    put<&FederateAmbassador::join_refused>(refusal, why);
  }
  void connection_lost(std::string_view why) override {
    put<&FederateAmbassador::connection_lost>(why);
  }

  // Federation management.
  void federation_execution_created(std::string_view federation, HlaError error) override {
    put<&FederateAmbassador::federation_execution_created>(federation, error);
  }
  void federation_execution_destroyed(std::string_view federation, HlaError error) override {
    put<&FederateAmbassador::federation_execution_destroyed>(federation, error);
  }
  void report_management(const std::vector<FederationReport>& reports) override {
    put<&FederateAmbassador::report_management>(reports);
  }
  void report_federation_executions(
      const std::vector<FederationExecutionInformation>& executions) override {
    put<&FederateAmbassador::report_federation_executions>(executions);
  }
  void synchronization_point_registration_succeeded(std::string_view label) override {
    put<&FederateAmbassador::synchronization_point_registration_succeeded>(label);
  }
  void synchronization_point_registration_failed(std::string_view label,
                                                 SynchronizationFailure failure) override {
    put<&FederateAmbassador::synchronization_point_registration_failed>(label, failure);
  }
  void announce_synchronization_point(std::string_view label, Bytes tag) override {
    put<&FederateAmbassador::announce_synchronization_point>(label, tag);
  }
  void federation_synchronized(std::string_view label,
                               std::span<const FederateHandle> failed) override {
    put<&FederateAmbassador::federation_synchronized>(label, failed);
  }
  void initiate_federate_save(std::string_view label) override {
    put<&FederateAmbassador::initiate_federate_save>(label);
  }
  void initiate_federate_save_with_time(std::string_view label, LogicalTime time) override {
    put<&FederateAmbassador::initiate_federate_save_with_time>(label, time);
  }
  void federation_saved() override { put<&FederateAmbassador::federation_saved>(); }
  void federation_not_saved(SaveFailure failure, std::string_view why) override {
    put<&FederateAmbassador::federation_not_saved>(failure, why);
  }
  void federation_save_status_response(std::span<const FederateSaveStatus> all) override {
    put<&FederateAmbassador::federation_save_status_response>(all);
  }
  void request_federation_restore_succeeded(std::string_view label) override {
    put<&FederateAmbassador::request_federation_restore_succeeded>(label);
  }
  void request_federation_restore_failed(std::string_view label, std::string_view why) override {
    put<&FederateAmbassador::request_federation_restore_failed>(label, why);
  }
  void federation_restore_begun() override { put<&FederateAmbassador::federation_restore_begun>(); }
  void initiate_federate_restore(std::string_view label, std::string_view name,
                                 FederateHandle federate) override {
    put<&FederateAmbassador::initiate_federate_restore>(label, name, federate);
  }
  void federation_restored() override { put<&FederateAmbassador::federation_restored>(); }
  void federation_not_restored(RestoreFailure failure, std::string_view why) override {
    put<&FederateAmbassador::federation_not_restored>(failure, why);
  }
  void federation_restore_status_response(std::span<const FederateRestoreStatus> all) override {
    put<&FederateAmbassador::federation_restore_status_response>(all);
  }
  void write_state(std::vector<std::byte>& state) override { federate_.write_state(state); }
  bool read_state(Bytes state) override { return federate_.read_state(state); }
  void federate_joined(FederateHandle federate, std::string_view name,
                       std::string_view type) override {
    put<&FederateAmbassador::federate_joined>(federate, name, type);
  }
  void federate_resigned(FederateHandle federate, std::string_view name, std::string_view type,
                         ResignReason reason) override {
    put<&FederateAmbassador::federate_resigned>(federate, name, type, reason);
  }

  // Declarations, objects and interactions.
  void start_registration_for_object_class(ObjectClassHandle object_class) override {
    put<&FederateAmbassador::start_registration_for_object_class>(object_class);
  }
  void stop_registration_for_object_class(ObjectClassHandle object_class) override {
    put<&FederateAmbassador::stop_registration_for_object_class>(object_class);
  }
  void turn_interactions_on(InteractionClassHandle interaction_class) override {
    put<&FederateAmbassador::turn_interactions_on>(interaction_class);
  }
  void turn_interactions_off(InteractionClassHandle interaction_class) override {
    put<&FederateAmbassador::turn_interactions_off>(interaction_class);
  }
  void turn_updates_on_for_object_instance(ObjectHandle object, AttributeSet attributes) override {
    put<&FederateAmbassador::turn_updates_on_for_object_instance>(object, attributes);
  }
  void turn_updates_off_for_object_instance(ObjectHandle object, AttributeSet attributes) override {
    put<&FederateAmbassador::turn_updates_off_for_object_instance>(object, attributes);
  }
  void discover_object_instance(ObjectHandle object, ObjectClassHandle object_class,
                                std::string_view name) override {
    put<&FederateAmbassador::discover_object_instance>(object, object_class, name);
  }
  void reflect_attribute_values(ObjectHandle object, AttributeSet attributes, Bytes values,
                                const Stamp& stamp) override {
    put<&FederateAmbassador::reflect_attribute_values>(object, attributes, values, stamp);
  }
  void attributes_in_scope(ObjectHandle object) override {
    put<&FederateAmbassador::attributes_in_scope>(object);
  }
  void attributes_out_of_scope(ObjectHandle object) override {
    put<&FederateAmbassador::attributes_out_of_scope>(object);
  }
  void provide_attribute_value_update(ObjectHandle object, AttributeSet attributes,
                                      Bytes tag) override {
    put<&FederateAmbassador::provide_attribute_value_update>(object, attributes, tag);
  }
  void object_instance_name_reservation_succeeded(std::string_view name) override {
    put<&FederateAmbassador::object_instance_name_reservation_succeeded>(name);
  }
  void object_instance_name_reservation_failed(std::string_view name) override {
    put<&FederateAmbassador::object_instance_name_reservation_failed>(name);
  }
  void multiple_object_instance_name_reservation_succeeded(
      const std::vector<std::string>& names) override {
    put<&FederateAmbassador::multiple_object_instance_name_reservation_succeeded>(names);
  }
  void multiple_object_instance_name_reservation_failed(
      const std::vector<std::string>& names) override {
    put<&FederateAmbassador::multiple_object_instance_name_reservation_failed>(names);
  }
  void confirm_attribute_transportation_type_change(ObjectHandle object, AttributeSet attributes,
                                                    Transportation type) override {
    put<&FederateAmbassador::confirm_attribute_transportation_type_change>(object, attributes,
                                                                           type);
  }
  void report_attribute_transportation_type(ObjectHandle object, AttributeHandle attribute,
                                            Transportation type) override {
    put<&FederateAmbassador::report_attribute_transportation_type>(object, attribute, type);
  }
  void confirm_interaction_transportation_type_change(InteractionClassHandle interaction_class,
                                                      Transportation type) override {
    put<&FederateAmbassador::confirm_interaction_transportation_type_change>(interaction_class,
                                                                             type);
  }
  void report_interaction_transportation_type(FederateHandle federate,
                                              InteractionClassHandle interaction_class,
                                              Transportation type) override {
    put<&FederateAmbassador::report_interaction_transportation_type>(federate, interaction_class,
                                                                     type);
  }
  void remove_object_instance(ObjectHandle object) override {
    put<&FederateAmbassador::remove_object_instance>(object);
  }
  void receive_interaction(InteractionClassHandle interaction_class, Bytes parameters,
                           FederateHandle sender, const Stamp& stamp) override {
    put<&FederateAmbassador::receive_interaction>(interaction_class, parameters, sender, stamp);
  }
  void receive_host_message(Bytes content) override {
    put<&FederateAmbassador::receive_host_message>(content);
  }

  // Time management.
  void time_regulation_enabled(LogicalTime time) override {
    put<&FederateAmbassador::time_regulation_enabled>(time);
  }
  void time_constrained_enabled(LogicalTime time) override {
    put<&FederateAmbassador::time_constrained_enabled>(time);
  }
  void time_advance_grant(LogicalTime time) override {
    put<&FederateAmbassador::time_advance_grant>(time);
  }
  void request_retraction(const RetractionHandle& handle) override {
    put<&FederateAmbassador::request_retraction>(handle);
  }
  void time_bounds(double galt, double lits) override {
    put<&FederateAmbassador::time_bounds>(galt, lits);
  }
  void reflect_attribute_values_with_time(ObjectHandle object, AttributeSet attributes,
                                          Bytes values, const TimedStamp& timed) override {
    put<&FederateAmbassador::reflect_attribute_values_with_time>(object, attributes, values, timed);
  }
  void receive_interaction_with_time(InteractionClassHandle interaction_class, Bytes parameters,
                                     FederateHandle sender, const TimedStamp& timed) override {
    put<&FederateAmbassador::receive_interaction_with_time>(interaction_class, parameters, sender,
                                                            timed);
  }
  void remove_object_instance_with_time(ObjectHandle object, const TimedStamp& timed) override {
    put<&FederateAmbassador::remove_object_instance_with_time>(object, timed);
  }
  // Ownership.
  void request_attribute_ownership_assumption(ObjectHandle object, AttributeSet attributes,
                                              Bytes tag) override {
    put<&FederateAmbassador::request_attribute_ownership_assumption>(object, attributes, tag);
  }
  void request_divestiture_confirmation(ObjectHandle object, AttributeSet attributes) override {
    put<&FederateAmbassador::request_divestiture_confirmation>(object, attributes);
  }
  void attribute_ownership_acquisition_notification(ObjectHandle object, AttributeSet attributes,
                                                    Bytes tag) override {
    put<&FederateAmbassador::attribute_ownership_acquisition_notification>(object, attributes, tag);
  }
  void attribute_ownership_unavailable(ObjectHandle object, AttributeSet attributes) override {
    put<&FederateAmbassador::attribute_ownership_unavailable>(object, attributes);
  }
  void request_attribute_ownership_release(ObjectHandle object, AttributeSet attributes,
                                           Bytes tag) override {
    put<&FederateAmbassador::request_attribute_ownership_release>(object, attributes, tag);
  }
  void confirm_attribute_ownership_acquisition_cancellation(ObjectHandle object,
                                                            AttributeSet attributes) override {
    put<&FederateAmbassador::confirm_attribute_ownership_acquisition_cancellation>(object,
                                                                                   attributes);
  }
  void inform_attribute_ownership(ObjectHandle object, AttributeHandle attribute,
                                  FederateHandle owner) override {
    put<&FederateAmbassador::inform_attribute_ownership>(object, attribute, owner);
  }
  void attribute_is_not_owned(ObjectHandle object, AttributeHandle attribute) override {
    put<&FederateAmbassador::attribute_is_not_owned>(object, attribute);
  }
  void attribute_ownership_divested(ObjectHandle object, AttributeSet attributes) override {
    put<&FederateAmbassador::attribute_ownership_divested>(object, attributes);
  }
  void attribute_ownership_kept(ObjectHandle object, AttributeSet attributes) override {
    put<&FederateAmbassador::attribute_ownership_kept>(object, attributes);
  }

 private:
  /// A record: this, then the arguments, each at a multiple of `alignment`.
  struct Header {
    void (*deliver)(FederateAmbassador& federate, const std::byte* arguments);
    std::size_t size;  ///< of the whole record [bytes]
  };
  static constexpr std::size_t header_size = (sizeof(Header) + ArgumentWriter::alignment - 1) /
                                             ArgumentWriter::alignment * ArgumentWriter::alignment;
  /// Writes one callback at the end.
  template <auto callback, class... Arguments>
  void put(const Arguments&... arguments);

  FederateAmbassador& federate_;
  std::vector<std::byte> records_;
  std::size_t taken_ = 0;  ///< bytes of `records_` that were delivered
  std::vector<std::byte>
      delivering_;  ///< the record that is delivered: its callback may make the others move
  bool is_delivering_ = false;
};

template <auto callback, class... Arguments>
void CallbackQueue::put(const Arguments&... arguments) {
  const std::size_t start = records_.size();
  ArgumentWriter writer(records_);
  writer.put(Header{});
  (writer.put(arguments), ...);
  const auto deliver = [](FederateAmbassador& federate, const std::byte* at) {
    ArgumentReader reader(at);
    const std::tuple<Arguments...> values{
        reader.take<Arguments>()...};  // in braces: from left to right
    std::apply([&federate](const Arguments&... each) { (federate.*callback)(each...); }, values);
  };
  const Header header{deliver, records_.size() - start};
  std::memcpy(records_.data() + start, &header, sizeof header);
}

}  // namespace rink::rti
