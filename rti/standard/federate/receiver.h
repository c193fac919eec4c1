// Turns what the core calls back into the standard's callbacks, which then wait for the federate.
#pragma once

#include <mutex>
#include <tuple>
#include <utility>

#include "rti/federate_ambassador.h"
#include "rti/standard/federate/federate_state.h"

namespace rink::standard {

/// Called by the core, under the federate's mutex. Callbacks that change what the federate has been
/// told take the mutex when they are delivered.
class Receiver final : public rti::FederateAmbassador {
 public:
  Receiver(FederateState& state, std::mutex& mutex) : state_(state), mutex_(mutex) {}

  void joined(rti::FederateHandle federate) override;
  void join_refused(rti::Refusal refusal, std::string_view why) override;
  void connection_lost(std::string_view why) override;

  void federation_execution_created(std::string_view federation, rti::HlaError error) override;
  void federation_execution_destroyed(std::string_view federation, rti::HlaError error) override;
  void report_federation_executions(
      const std::vector<rti::FederationExecutionInformation>& executions) override;
  void synchronization_point_registration_succeeded(std::string_view label) override;
  void synchronization_point_registration_failed(std::string_view label,
                                                 rti::SynchronizationFailure failure) override;
  void announce_synchronization_point(std::string_view label, rti::Bytes tag) override;
  void federation_synchronized(std::string_view label,
                               std::span<const rti::FederateHandle> failed) override;
  void federate_joined(rti::FederateHandle federate, std::string_view name,
                       std::string_view type) override;

  void initiate_federate_save(std::string_view label) override;
  void initiate_federate_save_with_time(std::string_view label, rti::LogicalTime time) override;
  void federation_saved() override;
  void federation_not_saved(rti::SaveFailure failure, std::string_view why) override;
  void federation_save_status_response(std::span<const rti::FederateSaveStatus> all) override;
  void request_federation_restore_succeeded(std::string_view label) override;
  void request_federation_restore_failed(std::string_view label, std::string_view why) override;
  void federation_restore_begun() override;
  void initiate_federate_restore(std::string_view label, std::string_view name,
                                 rti::FederateHandle federate) override;
  void federation_restored() override;
  void federation_not_restored(rti::RestoreFailure failure, std::string_view why) override;
  void federation_restore_status_response(std::span<const rti::FederateRestoreStatus> all) override;
  void write_state(std::vector<std::byte>& state) override;
  bool read_state(rti::Bytes state) override;

  void start_registration_for_object_class(rti::ObjectClassHandle object_class) override;
  void stop_registration_for_object_class(rti::ObjectClassHandle object_class) override;
  void turn_interactions_on(rti::InteractionClassHandle interaction_class) override;
  void turn_interactions_off(rti::InteractionClassHandle interaction_class) override;
  void turn_updates_on_for_object_instance(rti::ObjectHandle object,
                                           rti::AttributeSet attributes) override;
  void turn_updates_off_for_object_instance(rti::ObjectHandle object,
                                            rti::AttributeSet attributes) override;

  void object_instance_name_reservation_succeeded(std::string_view name) override;
  void object_instance_name_reservation_failed(std::string_view name) override;
  void multiple_object_instance_name_reservation_succeeded(
      const std::vector<std::string>& names) override;
  void multiple_object_instance_name_reservation_failed(
      const std::vector<std::string>& names) override;
  void confirm_attribute_transportation_type_change(rti::ObjectHandle object,
                                                    rti::AttributeSet attributes,
                                                    rti::Transportation transportation) override;
  void report_attribute_transportation_type(rti::ObjectHandle object,
                                            rti::AttributeHandle attribute,
                                            rti::Transportation transportation) override;
  void confirm_interaction_transportation_type_change(rti::InteractionClassHandle interaction_class,
                                                      rti::Transportation transportation) override;
  void report_interaction_transportation_type(rti::FederateHandle federate,
                                              rti::InteractionClassHandle interaction_class,
                                              rti::Transportation transportation) override;

  void discover_object_instance(rti::ObjectHandle object, rti::ObjectClassHandle object_class,
                                std::string_view name) override;
  void reflect_attribute_values(rti::ObjectHandle object, rti::AttributeSet attributes,
                                rti::Bytes values, const rti::Stamp& stamp) override;
  void reflect_attribute_values_with_time(rti::ObjectHandle object, rti::AttributeSet attributes,
                                          rti::Bytes values, const rti::TimedStamp& timed) override;
  void attributes_in_scope(rti::ObjectHandle object) override;
  void attributes_out_of_scope(rti::ObjectHandle object) override;
  void provide_attribute_value_update(rti::ObjectHandle object, rti::AttributeSet attributes,
                                      rti::Bytes tag) override;
  void remove_object_instance(rti::ObjectHandle object) override;
  void remove_object_instance_with_time(rti::ObjectHandle object,
                                        const rti::TimedStamp& timed) override;
  void receive_interaction(rti::InteractionClassHandle interaction_class, rti::Bytes parameters,
                           rti::FederateHandle sender, const rti::Stamp& stamp) override;
  void receive_interaction_with_time(rti::InteractionClassHandle interaction_class,
                                     rti::Bytes parameters, rti::FederateHandle sender,
                                     const rti::TimedStamp& timed) override;

  void request_attribute_ownership_assumption(rti::ObjectHandle object,
                                              rti::AttributeSet attributes,
                                              rti::Bytes tag) override;
  void request_divestiture_confirmation(rti::ObjectHandle object,
                                        rti::AttributeSet attributes) override;
  void attribute_ownership_acquisition_notification(rti::ObjectHandle object,
                                                    rti::AttributeSet attributes,
                                                    rti::Bytes tag) override;
  void attribute_ownership_unavailable(rti::ObjectHandle object,
                                       rti::AttributeSet attributes) override;
  void request_attribute_ownership_release(rti::ObjectHandle object, rti::AttributeSet attributes,
                                           rti::Bytes tag) override;
  void confirm_attribute_ownership_acquisition_cancellation(rti::ObjectHandle object,
                                                            rti::AttributeSet attributes) override;
  void inform_attribute_ownership(rti::ObjectHandle object, rti::AttributeHandle attribute,
                                  rti::FederateHandle owner) override;
  void attribute_is_not_owned(rti::ObjectHandle object, rti::AttributeHandle attribute) override;
  void attribute_ownership_divested(rti::ObjectHandle object,
                                    rti::AttributeSet attributes) override;
  void attribute_ownership_kept(rti::ObjectHandle object, rti::AttributeSet attributes) override;

  void time_regulation_enabled(rti::LogicalTime time) override;
  void time_constrained_enabled(rti::LogicalTime time) override;
  void time_advance_grant(rti::LogicalTime time) override;
  void request_retraction(const rti::RetractionHandle& handle) override;
  void time_bounds(double galt, double lits) override;

 private:
  const rti::Fom& fom() const { return state_.core->fom(); }
  /// Copies its arguments; `call(user, arguments...)` follows when the federate takes callbacks.
  template <class Call, class... Arguments>
  void deliver(Call call, Arguments... arguments);
  /// The same, unless the federate deletes the object before.
  template <class Call, class... Arguments>
  void deliver_of(rti::ObjectHandle object, Call call, Arguments... arguments);
  const KnownObject* knows(rti::ObjectHandle object);
  struct Reception;
  void take(WaitingUpdate& update, rti::Bytes values);
  bool reads(rti::InteractionClassHandle sent, rti::Bytes parameters, const rti::Stamp& stamp,
             Reception& reception) const;
  /// Delivers a removal, after which the federate knows the object no longer.
  template <class Call>
  void remove(rti::ObjectHandle object, Call call);

  FederateState& state_;
  std::mutex& mutex_;
};

template <class Call, class... Arguments>
void Receiver::deliver(Call call, Arguments... arguments) {
  deliver_of({}, std::move(call), std::move(arguments)...);
}

template <class Call, class... Arguments>
void Receiver::deliver_of(rti::ObjectHandle object, Call call, Arguments... arguments) {
  state_.deliveries.put(
      [call, copies = std::tuple(std::move(arguments)...)](rti1516e::FederateAmbassador& user) {
        std::apply([&](const Arguments&... each) { call(user, each...); }, copies);
      },
      {.object = object});
}

}  // namespace rink::standard
