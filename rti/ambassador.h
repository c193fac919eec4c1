// A federate's side of the RTI: services in, bytes out; bytes in, callbacks out. Their arguments
// are in rti/types.h, callbacks in rti/federate_ambassador.h, object models in rti/fom/fom.h.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "rti/ambassador_counters.h"
#include "rti/federate_ambassador.h"
#include "rti/hla_error.h"
#include "rti/types.h"
#include "rti/wire/bytes.h"

namespace rink::rti {

class AmbassadorParts;
class FederateClock;
class Fom;

/// One federate. No I/O, no clock, no thread: its owner carries `outgoing` to the RTI and what
/// comes back to `receive`, and hands in the time. Services throw `RtiException` with the
/// standard's name of what is wrong.
class Ambassador {
 public:
  /// Limit of the callbacks that wait to be evoked and of the messages held back for them [bytes].
  static constexpr std::size_t waiting_callbacks_max = 64u << 20;

  /// Both must outlive the ambassador.
  Ambassador(const Fom& fom, FederateAmbassador& callbacks, const Timeouts& timeouts = {},
             CallbackModel model = CallbackModel::immediate);

  /// Federation management. These three ask the host before the join. The answers are
  /// `federation_execution_created`, `…_destroyed` and `report_federation_executions`. The new
  /// execution has this ambassador's object model, which the host must offer. Throw
  /// FederateAlreadyExecutionMember.
  void create_federation_execution(std::string_view federation);
  /// The same with another model that the host offers.
  void create_federation_execution(std::string_view federation, const Fom& model);
  void destroy_federation_execution(std::string_view federation);
  void list_federation_executions();
  /// Asks for the counters of the management object model; `report_management` answers. Before the
  /// join the counters are those of every execution of the host, after it those of the own
  /// execution.
  void query_management();
  /// Beyond the standard: one bit for the host of the federation execution, which knows what it
  /// means (FederationExecution::take_notice). Throws FederateNotExecutionMember.
  void notify_host();
  /// `join` ends with `joined` or `join_refused`. Declarations and regions may follow `join` at
  /// once; objects and interactions only `joined`. Throws FederateAlreadyExecutionMember. After
  /// `resign` nothing may be called but `outgoing` and `clear_outgoing`; its objects are deleted.
  void join(std::string_view federation, std::string_view federate_name,
            std::string_view federate_type);
  void resign();
  bool is_joined() const;
  FederateHandle federate() const;
  /// `synchronization_point_registration_succeeded` or `…_failed` follows. The federates in
  /// `members` are notified and must achieve the point; an empty set means all that are joined, and
  /// all that join before the point is reached. The RTI does not wait for a federate that has left.
  /// Label at most 255 bytes, tag 1,024.
  void register_synchronization_point(std::string_view label, Bytes tag = {},
                                      std::span<const FederateHandle> members = {});
  /// Once for each announced label; throws SynchronizationPointLabelNotAnnounced. Without success
  /// the federate is among those that failed.
  void synchronization_point_achieved(std::string_view label, bool is_success = true);
  /// Asks for notices of all federates that are joined, that join and that leave.
  void watch_federates();
  /// Saves the federation under this label (docs/rti.md, "Save and restore"), now or once every
  /// time-constrained federate has been granted `time`: `initiate_federate_save` goes to all, each
  /// says that it begins and how it ended, and `federation_saved` or `federation_not_saved`
  /// follows. A later request replaces one that has not begun. All services but these, `resign` and
  /// look-ups are refused meanwhile: SaveInProgress, RestoreInProgress. At a time:
  /// FederateUnableToUseTime unless the federate regulates, LogicalTimeAlreadyPassed.
  void request_federation_save(std::string_view label);
  void request_federation_save(std::string_view label, LogicalTime time);
  /// SaveNotInitiated, FederateHasNotBegunSave, SaveNotInProgress.
  void federate_save_begun();
  void federate_save_complete();
  void federate_save_not_complete();
  void abort_federation_save();
  void query_federation_save_status();
  /// The federation must have federates of the types and as many as were saved: each takes the
  /// place of one, that of its name if there is one. RestoreNotRequested, RestoreNotInProgress.
  void request_federation_restore(std::string_view label);
  void federate_restore_complete();
  void federate_restore_not_complete();
  void abort_federation_restore();
  void query_federation_restore_status();

  /// Declaration management. A later call for the same class (and region) replaces the earlier one.
  void publish_object_class_attributes(ObjectClassHandle object_class, AttributeSet attributes);
  void unpublish_object_class(ObjectClassHandle object_class);
  /// Without a region the subscription has the default region, which overlaps everything. A passive
  /// subscription receives as much as an active one but counts for no advisory.
  void subscribe_object_class_attributes(ObjectClassHandle object_class, AttributeSet attributes,
                                         RegionHandle region = {}, bool is_active = true);
  void unsubscribe_object_class(ObjectClassHandle object_class, RegionHandle region = {});
  void publish_interaction_class(InteractionClassHandle interaction_class);
  void unpublish_interaction_class(InteractionClassHandle interaction_class);
  void subscribe_interaction_class(InteractionClassHandle interaction_class, bool is_active = true);
  void unsubscribe_interaction_class(InteractionClassHandle interaction_class);

  /// Ownership management (clause 7). The privilege to delete an object is its attribute
  /// `privilege_to_delete_object`. The RTI decides and answers by callbacks; a federate loses an
  /// attribute only by its own request or consent. Throws `RtiException`: ObjectInstanceNotKnown,
  /// AttributeNotDefined, AttributeNotOwned and those named. Tags have at most 1,024 bytes.
  /// Successive calls that differ in the object only travel as one block.
  void unconditional_attribute_ownership_divestiture(ObjectHandle object, AttributeSet attributes);
  /// Offers the attributes and keeps them until another federate wants them,
  /// `request_divestiture_confirmation` has reported it and the federate has confirmed.
  /// AttributeAlreadyBeingDivested.
  void negotiated_attribute_ownership_divestiture(ObjectHandle object, AttributeSet attributes,
                                                  Bytes tag = {});
  /// The attributes are no longer owned from now on; if the federate that wanted them has left
  /// meanwhile, `attribute_ownership_kept` gives them back. AttributeDivestitureWasNotRequested,
  /// NoAcquisitionPending.
  void confirm_divestiture(ObjectHandle object, AttributeSet attributes, Bytes tag = {});
  void cancel_negotiated_attribute_ownership_divestiture(
      ObjectHandle object, AttributeSet attributes);  ///< AttributeDivestitureWasNotRequested
  void attribute_ownership_release_denied(ObjectHandle object, AttributeSet attributes);
  /// The result, which the standard returns at once, arrives by `attribute_ownership_divested` and
  /// `attribute_ownership_kept`; until then the attributes are not owned.
  void attribute_ownership_divestiture_if_wanted(ObjectHandle object, AttributeSet attributes);
  /// ObjectClassNotPublished, AttributeNotPublished, FederateOwnsAttributes; the second also
  /// AttributeAlreadyBeingAcquired.
  void attribute_ownership_acquisition(ObjectHandle object, AttributeSet attributes,
                                       Bytes tag = {});
  void attribute_ownership_acquisition_if_available(ObjectHandle object, AttributeSet attributes);
  /// Ends with the confirmation of the cancellation, or with the acquisition.
  /// AttributeAlreadyOwned, AttributeAcquisitionWasNotRequested.
  void cancel_attribute_ownership_acquisition(ObjectHandle object, AttributeSet attributes);
  /// Answered by `inform_attribute_ownership` or `attribute_is_not_owned`.
  void query_attribute_ownership(ObjectHandle object, AttributeHandle attribute);
  bool is_attribute_owned_by_federate(ObjectHandle object, AttributeHandle attribute);
  /// Sets what happens to the federate's objects if its connection is lost (10.4); the default is
  /// cancel_then_delete_then_divest.
  void set_automatic_resign_directive(ResignAction action);
  /// Resigns with this action. Throws OwnershipAcquisitionPending or FederateOwnsAttributes if the
  /// action leaves any of these.
  void resign(ResignAction action);

  /// Object management. The handle is usable at once; empty if the block is used up before the RTI
  /// has given a further one, which it does once half is used (rti/wire/message.h). Registering
  /// reserves a name that was not reserved; if the name is not free,
  /// `object_instance_name_reservation_failed` follows and the object has its default name.
  /// IllegalName, ObjectInstanceNameInUse if that is known here.
  ObjectHandle register_object_instance(ObjectClassHandle object_class, std::string_view name = {});
  void delete_object_instance(ObjectHandle object);
  /// Forgets the object as if it had never been discovered; it is discovered again when it next
  /// comes into scope. FederateOwnsAttributes, OwnershipAcquisitionPending.
  void local_delete_object_instance(ObjectHandle object);
  /// `object_instance_name_reservation_succeeded` or `…_failed` answers, once for a whole set.
  /// Throws IllegalName, NameSetWasEmpty, and ObjectInstanceNameNotReserved for the release of a
  /// name that is not reserved.
  void reserve_object_instance_name(std::string_view name);
  void reserve_multiple_object_instance_names(std::span<const std::string_view> names);
  void release_object_instance_name(std::string_view name);
  void release_multiple_object_instance_names(std::span<const std::string_view> names);
  /// Asks the owners for values: `provide_attribute_value_update`, with the tag of at most 1,024
  /// bytes.
  void request_attribute_value_update(ObjectClassHandle object_class, AttributeSet attributes,
                                      Bytes tag = {});
  void request_attribute_value_update(ObjectHandle object, AttributeSet attributes, Bytes tag = {});
  /// A callback confirms each change and answers each query (6.23 to 6.30). AttributeNotOwned,
  /// InteractionClassNotPublished.
  void request_attribute_transportation_type_change(ObjectHandle object, AttributeSet attributes,
                                                    Transportation transportation);
  void query_attribute_transportation_type(ObjectHandle object, AttributeHandle attribute);
  void request_interaction_transportation_type_change(InteractionClassHandle interaction_class,
                                                      Transportation transportation);
  void query_interaction_transportation_type(FederateHandle federate,
                                             InteractionClassHandle interaction_class);
  /// `values` as in `reflect_attribute_values`. Successive updates of one class, set and stamp
  /// travel as one block.
  void update_attribute_values(ObjectHandle object, AttributeSet attributes, Bytes values,
                               const Stamp& stamp);
  /// Sends to all federates that subscribe to the class, never back to the sender. At most 32 KiB.
  void send_interaction(InteractionClassHandle interaction_class, Bytes parameters,
                        const Stamp& stamp);
  /// Sends to one federate only, if it subscribes.
  void send_directed_interaction(InteractionClassHandle interaction_class, FederateHandle receiver,
                                 Bytes parameters, const Stamp& stamp);

  /// Data distribution management; docs/rti.md, "Regions". Setting a range
  /// is local; a commit takes effect at the RTI's next match. The same region may serve
  /// subscriptions and updates; one that was never committed overlaps nothing. Without dimensions a
  /// region is over X and Y [m], needs no such dimensions in the model, and holds for whole
  /// objects; the services with `pairs` are the standard's: each attribute must have all dimensions
  /// of its regions. Empty if all `region_max` regions are in use.
  RegionHandle create_region();
  RegionHandle create_region(DimensionSet dimensions);
  void set_region(RegionHandle region, const im::Region& bounds);
  void set_range_bounds(RegionHandle region, DimensionHandle dimension, const Range& range);
  Range get_range_bounds(RegionHandle region, DimensionHandle dimension) const;
  DimensionSet get_dimension_handle_set(RegionHandle region) const;
  void commit_region_modifications(RegionHandle region);
  void commit_region_modifications(std::span<const RegionHandle> regions);
  /// Sets and commits many at once; the caller vouches for handles and bounds.
  void commit_region_modifications(std::span<const RegionBounds> regions);
  /// Throws RegionInUseForUpdateOrSubscription if an own object or a subscription uses it.
  void delete_region(RegionHandle region);
  /// Replaces all regions of the object; an empty handle gives it back to the default region.
  void associate_regions_for_updates(ObjectHandle object, RegionHandle region);
  void associate_regions_for_updates(ObjectHandle object, std::span<const AttributeRegions> pairs);
  void unassociate_regions_for_updates(ObjectHandle object,
                                       std::span<const AttributeRegions> pairs);
  ObjectHandle register_object_instance_with_regions(ObjectClassHandle object_class,
                                                     std::span<const AttributeRegions> pairs,
                                                     std::string_view name = {});
  /// Adds to the subscriptions that exist.
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
  /// Sends to all federates that subscribe to the class without a region, or with one that overlaps
  /// one of these.
  void send_interaction_with_regions(InteractionClassHandle interaction_class, Bytes parameters,
                                     std::span<const RegionHandle> regions, const Stamp& stamp);
  /// Asks the owners of attributes whose regions overlap those of a pair, or that are of the
  /// default region, for an update: `provide_attribute_value_update`.
  void request_attribute_value_update_with_regions(ObjectClassHandle object_class,
                                                   std::span<const AttributeRegions> pairs);

  /// Look-ups beyond those of the object model; they throw NameNotFound. The federates known are
  /// those that `watch_federates` reported and this one.
  FederateHandle get_federate_handle(std::string_view name) const;
  const std::string& get_federate_name(FederateHandle federate) const;
  /// The object must be own or known, else ObjectInstanceNotKnown.
  ObjectHandle get_object_instance_handle(std::string_view name) const;
  std::string get_object_instance_name(ObjectHandle object) const;
  ObjectClassHandle get_known_object_class_handle(ObjectHandle object) const;

  /// Callbacks. In the evoked model callbacks wait until the federate asks for them; these deliver
  /// the oldest, or up to `count_max` in their order, and return whether more wait. In the
  /// immediate model they do nothing. A federate that lets more than `waiting_callbacks_max` bytes
  /// wait loses its connection. Throw CallNotAllowedFromWithinCallback.
  bool evoke_callback();
  bool evoke_multiple_callbacks(std::size_t count_max = ~std::size_t{0});
  /// No callback is delivered, in either model, until callbacks are enabled again; in the immediate
  /// model enabling delivers all that wait, within the call.
  void disable_callbacks();
  void enable_callbacks();

  /// Time management: docs/rti.md. Every federate begins at logical time 0, neither regulating nor
  /// constrained. Refused by the errors that `FederateClock` names.
  void enable_time_regulation(double lookahead);
  void disable_time_regulation();
  void enable_time_constrained();
  void disable_time_constrained();
  void time_advance_request(LogicalTime time);
  void time_advance_request_available(LogicalTime time);
  void next_message_request(LogicalTime time);
  void next_message_request_available(LogicalTime time);
  void flush_queue_request(LogicalTime time);
  void modify_lookahead(double lookahead);
  /// While granted, a constrained federate gets messages in receive order only if this is on; else
  /// they wait for its next request.
  void enable_asynchronous_delivery();
  void disable_asynchronous_delivery();
  LogicalTime query_logical_time() const;
  double query_lookahead() const;
  /// Asks the RTI for GALT and LITS; `time_bounds` answers.
  void query_time_bounds();
  const FederateClock& clock() const;
  /// The same as the services without a time, but in time-stamp order where that is what the object
  /// model or `change_..._order_type` says and the federate regulates: only then is there a handle.
  /// The part of an update that has receive order is sent at once, stamped with that time.
  RetractionHandle update_attribute_values(ObjectHandle object, AttributeSet attributes,
                                           Bytes values, LogicalTime time, std::uint64_t tag = 0);
  RetractionHandle send_interaction(InteractionClassHandle interaction_class, Bytes parameters,
                                    LogicalTime time, std::uint64_t tag = 0);
  RetractionHandle send_directed_interaction(InteractionClassHandle interaction_class,
                                             FederateHandle receiver, Bytes parameters,
                                             LogicalTime time, std::uint64_t tag = 0);
  RetractionHandle delete_object_instance(ObjectHandle object, LogicalTime time,
                                          std::uint64_t tag = 0);
  /// Takes back what was sent in time-stamp order. A deletion that is taken back gives the object
  /// back.
  void retract(const RetractionHandle& handle);
  void change_attribute_order_type(ObjectHandle object, AttributeSet attributes, Order order);
  void change_interaction_order_type(InteractionClassHandle interaction_class, Order order);

  /// Bytes from the RTI, cut anywhere. False after a protocol error, which `connection_lost` has
  /// explained: close the connection.
  bool receive(Bytes bytes);
  /// A whole datagram of the RTI; datagrams may arrive in any order, twice or never. A malformed
  /// one is counted and otherwise ignored.
  void receive_datagram(Bytes datagram);
  /// Opens or closes a channel for datagrams; once one has opened, frames are numbered too, for an
  /// older datagram may come after them. `size_max` is the most bytes that a datagram may have now,
  /// 0 while there is no channel. Best-effort updates use the channel unless this federate
  /// uses time management or leaves objects behind.
  void expect_datagrams(std::size_t size_max);
  /// The datagrams that must be sent to the RTI, after `outgoing` or beside it, valid until
  /// `clear_outgoing_datagrams` says that they have been sent. `clear_outgoing` leaves them alone.
  std::span<const Datagram> outgoing_datagrams();
  void clear_outgoing_datagrams();
  /// The bytes that must be sent to the RTI, and the notice that they have been sent.
  Bytes outgoing() const;
  void clear_outgoing();
  /// `now` [s] never decreases; the origin is free. Sends a heartbeat when idle, and notices a
  /// silent RTI. `is_behind`: some of what the RTI has sent may wait unread, so that the time since
  /// the last call is not its silence.
  void advance_clock(double now, bool is_behind = false);
  /// The connection is gone: `connection_lost` follows unless the federate resigned or was refused.
  void disconnected(std::string_view why);

  const AmbassadorCounters& counters() const;
  /// Memory of all parts of the ambassador [bytes].
  std::size_t memory_bytes() const;

  /// Names and handles (clause 10), as the object model alone answers: by name they throw
  /// NameNotFound, for handles of nothing ObjectClassNotDefined, AttributeNotDefined,
  /// InteractionClassNotDefined, InteractionParameterNotDefined, InvalidDimensionHandle. Class
  /// names may stand alone where that is unambiguous, and are given qualified.
  const Fom& fom() const;

  ObjectClassHandle get_object_class_handle(std::string_view name) const;
  std::string get_object_class_name(ObjectClassHandle object_class) const;
  AttributeHandle get_attribute_handle(ObjectClassHandle object_class, std::string_view name) const;
  const std::string& get_attribute_name(ObjectClassHandle object_class,
                                        AttributeHandle attribute) const;
  InteractionClassHandle get_interaction_class_handle(std::string_view name) const;
  std::string get_interaction_class_name(InteractionClassHandle interaction_class) const;
  ParameterHandle get_parameter_handle(InteractionClassHandle interaction_class,
                                       std::string_view name) const;
  const std::string& get_parameter_name(InteractionClassHandle interaction_class,
                                        ParameterHandle parameter) const;
  /// "HLAreliable" and "HLAbestEffort".
  static Transportation get_transportation_type(std::string_view name);
  static std::string_view get_transportation_type_name(Transportation transportation);
  /// "Receive" and "TimeStamp".
  static Order get_order_type(std::string_view name);
  static std::string_view get_order_name(Order order);
  DimensionHandle get_dimension_handle(std::string_view name) const;
  const std::string& get_dimension_name(DimensionHandle dimension) const;
  std::optional<std::uint32_t> get_dimension_upper_bound(DimensionHandle dimension) const;
  DimensionSet get_available_dimensions_for_class_attribute(ObjectClassHandle object_class,
                                                            AttributeHandle attribute) const;
  DimensionSet get_available_dimensions_for_interaction_class(
      InteractionClassHandle interaction_class) const;

  /// 10.27 to 10.34. All are on at first but that of attribute relevance; setting a switch to the
  /// value that it has throws ObjectClassRelevanceAdvisorySwitchIsOn or its like.
  void enable_object_class_relevance_advisory_switch();
  void disable_object_class_relevance_advisory_switch();
  void enable_attribute_relevance_advisory_switch();
  void disable_attribute_relevance_advisory_switch();
  void enable_attribute_scope_advisory_switch();
  void disable_attribute_scope_advisory_switch();
  void enable_interaction_relevance_advisory_switch();
  void disable_interaction_relevance_advisory_switch();

  ~Ambassador();

 private:
  /// The parts, for services that are refused while the federation is saved or restored.
  AmbassadorParts& active();

  std::unique_ptr<AmbassadorParts> parts_;
};

}  // namespace rink::rti
