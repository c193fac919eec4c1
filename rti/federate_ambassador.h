// The callbacks by which the RTI notifies a federate.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rti/hla_error.h"
#include "rti/membership.h"
#include "rti/save/save_status.h"
#include "rti/types.h"
#include "rti/wire/bytes.h"

namespace rink::rti {

struct FederationReport;  // rti/management/federation_report.h

/// All bodies are empty: override what matters. Views handed in are valid during the call.
/// Callbacks may call any service of the ambassador except `receive`, `advance_clock` and
/// `clear_outgoing`.
class FederateAmbassador {
 public:
  virtual ~FederateAmbassador() = default;

  virtual void joined(FederateHandle) {}
  virtual void join_refused(Refusal, std::string_view /*why*/) {}
  /// The RTI is silent or gone, or sent a malformed message; nothing more will arrive.
  virtual void connection_lost(std::string_view /*why*/) {}

  /// Federation management: the result of `create_federation_execution` and
  /// `destroy_federation_execution`; `HlaError::none` is success.
  virtual void federation_execution_created(std::string_view /*federation*/, HlaError) {}
  virtual void federation_execution_destroyed(std::string_view /*federation*/, HlaError) {}
  /// Answers `query_management`.
  virtual void report_management(const std::vector<FederationReport>&) {}
  /// Answers `list_federation_executions`.
  virtual void report_federation_executions(const std::vector<FederationExecutionInformation>&) {}
  virtual void synchronization_point_registration_succeeded(std::string_view /*label*/) {}
  virtual void synchronization_point_registration_failed(std::string_view /*label*/,
                                                         SynchronizationFailure) {}
  virtual void announce_synchronization_point(std::string_view /*label*/, Bytes /*tag*/) {}
  /// `failed` are the federates of the set that reported that they could not achieve it.
  virtual void federation_synchronized(std::string_view /*label*/,
                                       std::span<const FederateHandle> /*failed*/) {}

  /// Saving: between the first of these and the last but one the federate saves itself, and calls
  /// no service but those by which it says so.
  virtual void initiate_federate_save(std::string_view /*label*/) {}
  virtual void initiate_federate_save_with_time(std::string_view /*label*/, LogicalTime) {}
  virtual void federation_saved() {}
  virtual void federation_not_saved(SaveFailure, std::string_view /*why*/) {}
  virtual void federation_save_status_response(std::span<const FederateSaveStatus>) {}
  /// Restoring: the federate restores itself as the one of this name and handle. After
  /// `federation_restored` everything is as it was saved, handles too, and it is sent the present
  /// state of all in its scope.
  virtual void request_federation_restore_succeeded(std::string_view /*label*/) {}
  virtual void request_federation_restore_failed(std::string_view /*label*/,
                                                 std::string_view /*why*/) {}
  virtual void federation_restore_begun() {}
  virtual void initiate_federate_restore(std::string_view /*label*/, std::string_view /*name*/,
                                         FederateHandle) {}
  virtual void federation_restored() {}
  /// Everything is as before the restore began.
  virtual void federation_not_restored(RestoreFailure, std::string_view /*why*/) {}
  virtual void federation_restore_status_response(std::span<const FederateRestoreStatus>) {}
  /// For a layer between the ambassador and the federate: what it knows itself is saved with what
  /// the ambassador knows, and comes back right before `federation_restored`. Neither ever waits.
  /// False if the state is damaged.
  virtual void write_state(std::vector<std::byte>&) {}
  virtual bool read_state(Bytes) { return true; }

  /// Follows `Ambassador::watch_federates`: first once for each federate that is joined (the
  /// watcher too), then whenever one joins or leaves.
  virtual void federate_joined(FederateHandle, std::string_view /*name*/,
                               std::string_view /*type*/) {}
  virtual void federate_resigned(FederateHandle, std::string_view /*name*/,
                                 std::string_view /*type*/, ResignReason) {}

  /// Declaration management: another federate subscribes actively to what this one publishes of the
  /// class, or none does any more.
  virtual void start_registration_for_object_class(ObjectClassHandle) {}
  virtual void stop_registration_for_object_class(ObjectClassHandle) {}
  virtual void turn_interactions_on(InteractionClassHandle) {}
  virtual void turn_interactions_off(InteractionClassHandle) {}
  /// Called if the switch for attribute relevance is on: these attributes of an own object are in
  /// the scope of some active subscriber, or of none any more.
  virtual void turn_updates_on_for_object_instance(ObjectHandle, AttributeSet) {}
  virtual void turn_updates_off_for_object_instance(ObjectHandle, AttributeSet) {}

  /// Names of objects. A failure also follows a registration under a name that is not free: the
  /// object has its default name.
  virtual void object_instance_name_reservation_succeeded(std::string_view /*name*/) {}
  virtual void object_instance_name_reservation_failed(std::string_view /*name*/) {}
  virtual void multiple_object_instance_name_reservation_succeeded(
      const std::vector<std::string>& /*names*/) {}
  virtual void multiple_object_instance_name_reservation_failed(
      const std::vector<std::string>& /*names*/) {}
  virtual void confirm_attribute_transportation_type_change(ObjectHandle, AttributeSet,
                                                            Transportation) {}
  virtual void report_attribute_transportation_type(ObjectHandle, AttributeHandle, Transportation) {
  }
  virtual void confirm_interaction_transportation_type_change(InteractionClassHandle,
                                                              Transportation) {}
  virtual void report_interaction_transportation_type(FederateHandle, InteractionClassHandle,
                                                      Transportation) {}

  /// At most once per object. The class is the one it was registered with, which may inherit from
  /// the subscribed one.
  virtual void discover_object_instance(ObjectHandle, ObjectClassHandle,
                                        std::string_view /*name*/) {}
  /// `values` are concatenated in the order of the attributes; one of variable size is preceded by
  /// its length [bytes] as a little-endian u32.
  virtual void reflect_attribute_values(ObjectHandle, AttributeSet, Bytes /*values*/,
                                        const Stamp&) {}
  virtual void attributes_in_scope(ObjectHandle) {}
  virtual void attributes_out_of_scope(ObjectHandle) {}
  /// Another federate requests these attributes of an own object.
  virtual void provide_attribute_value_update(ObjectHandle, AttributeSet,
                                              Bytes /*tag of the request*/) {}
  virtual void remove_object_instance(ObjectHandle) {}

  /// Ownership management. These attributes have no owner or are offered by theirs: the federate
  /// may acquire them if available.
  virtual void request_attribute_ownership_assumption(ObjectHandle, AttributeSet,
                                                      Bytes /*tag of the offer*/) {}
  /// Another federate wants what this one offered: it may confirm.
  virtual void request_divestiture_confirmation(ObjectHandle, AttributeSet) {}
  virtual void attribute_ownership_acquisition_notification(ObjectHandle, AttributeSet,
                                                            Bytes /*tag of the confirmation*/) {}
  virtual void attribute_ownership_unavailable(ObjectHandle, AttributeSet) {}
  /// Another federate wants what this one owns: it may divest, offer or deny, or let the other
  /// wait.
  virtual void request_attribute_ownership_release(ObjectHandle, AttributeSet,
                                                   Bytes /*tag of the acquisition*/) {}
  virtual void confirm_attribute_ownership_acquisition_cancellation(ObjectHandle, AttributeSet) {}
  virtual void inform_attribute_ownership(ObjectHandle, AttributeHandle, FederateHandle) {}
  virtual void attribute_is_not_owned(ObjectHandle, AttributeHandle) {}
  /// Beyond the standard, since services here do not wait for an answer: which attributes a
  /// divestiture if wanted gave away, and which attributes stayed, and are owned again, after such
  /// a divestiture or after a confirmation that came when the other federate no longer wanted them.
  virtual void attribute_ownership_divested(ObjectHandle, AttributeSet) {}
  virtual void attribute_ownership_kept(ObjectHandle, AttributeSet) {}

  virtual void receive_interaction(InteractionClassHandle, Bytes /*parameters*/,
                                   FederateHandle /*sender*/, const Stamp&) {}

  /// Time management. Grants and what is enabled come once for each service that asked; all
  /// messages that belong to a grant come before it.
  virtual void time_regulation_enabled(LogicalTime) {}
  virtual void time_constrained_enabled(LogicalTime) {}
  virtual void time_advance_grant(LogicalTime) {}
  /// The sender retracts a message that this federate has received already.
  virtual void request_retraction(const RetractionHandle&) {}
  /// The answer to `query_time_bounds`: GALT and LITS [s], infinite where nobody sets a bound.
  virtual void time_bounds(double /*galt*/, double /*lits*/) {}
  /// Messages that were sent in time-stamp order. A federate that does not override these receives
  /// them by the callbacks without a time.
  virtual void reflect_attribute_values_with_time(ObjectHandle object, AttributeSet attributes,
                                                  Bytes values, const TimedStamp& timed) {
    reflect_attribute_values(object, attributes, values, timed.stamp);
  }
  virtual void receive_interaction_with_time(InteractionClassHandle interaction_class,
                                             Bytes parameters, FederateHandle sender,
                                             const TimedStamp& timed) {
    receive_interaction(interaction_class, parameters, sender, timed.stamp);
  }
  virtual void remove_object_instance_with_time(ObjectHandle object, const TimedStamp&) {
    remove_object_instance(object);
  }

  /// Beyond the standard: what the host of the federation execution sends to this federate
  /// (FederationExecution::send_host_message), in order with all else.
  virtual void receive_host_message(Bytes /*content*/) {}
};

}  // namespace rink::rti
