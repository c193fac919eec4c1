// A federate's side of the RTI: services in, bytes out; bytes in, callbacks out.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "im/filter.h"
#include "rti/advisory_switches.h"
#include "rti/ambassador_counters.h"
#include "rti/baselines/keyframe_memory.h"
#include "rti/callbacks/callback_queue.h"
#include "rti/federate_ambassador.h"
#include "rti/distribution/region_book.h"
#include "rti/fom/fom_lookup.h"
#include "rti/hla_error.h"
#include "rti/wire/frame.h"
#include "rti/wire/message.h"
#include "rti/objects/arrival_order.h"
#include "rti/objects/declared_state.h"
#include "rti/objects/known_object.h"
#include "rti/objects/name_book.h"
#include "rti/wire/object_block.h"
#include "rti/wire/ownership_messages.h"
#include "rti/objects/object_map.h"
#include "rti/patience.h"
#include "rti/time/federate_clock.h"
#include "rti/wire/stream.h"

namespace rink::rti {

struct DeltaHeader;

/// One federate. No I/O, no clock, no thread: its owner carries `outgoing` to the RTI and what comes back to `receive`, and hands in the time.
/// Services assert on the programmer's mistakes (an object of somebody else, an undeclared class).
class Ambassador : public FomLookup, public AdvisorySwitches<Ambassador> {
 public:
  /// Both must outlive the ambassador.
  Ambassador(const Fom& fom, FederateAmbassador& callbacks, const Patience& patience = {}, CallbackModel model = CallbackModel::immediate);

  /// Federation management. These three ask the host, before the join; answered by `federation_execution_created`, `…_destroyed` and
  /// `report_federation_executions`. The new execution has this ambassador's object model, which the host must offer. Throw FederateAlreadyExecutionMember.
  void create_federation_execution(std::string_view federation) { create_federation_execution(federation, fom_); }
  /// The same with another model that the host offers.
  void create_federation_execution(std::string_view federation, const Fom& model);
  void destroy_federation_execution(std::string_view federation);
  void list_federation_executions();
  /// Asks for the counters of the management object model, answered by `report_management`: before the join about every execution of the host, after it about one's own.
  void query_management();
  /// `join` ends with `joined` or `join_refused`. Declarations and regions may follow `join` at once; objects and interactions only `joined`.
  /// Throws FederateAlreadyExecutionMember. After `resign` nothing may be called but `outgoing` and `clear_outgoing`; its objects are deleted.
  void join(std::string_view federation, std::string_view federate_name, std::string_view federate_type);
  void resign();
  bool is_joined() const { return phase_ == Phase::joined; }
  FederateHandle federate() const { return federate_; }
  /// `synchronization_point_registration_succeeded` or `…_failed` follows. Who is in `members` is told and must achieve it; an empty set is all who are joined,
  /// those included who join before it is reached. Who leaves is no longer waited for. Label at most 255 bytes, tag 1,024.
  void register_synchronization_point(std::string_view label, Bytes tag = {}, std::span<const FederateHandle> members = {});
  /// Once for each announced label; throws SynchronizationPointLabelNotAnnounced. Without success the federate is among those that failed.
  void synchronization_point_achieved(std::string_view label, bool is_success = true);
  /// Asks to be told who is there, who comes and who goes.
  void watch_federates();

  /// Declaration management. A later call for the same class (and region) replaces the earlier one.
  void publish_object_class_attributes(ObjectClassHandle object_class, AttributeSet attributes);
  void unpublish_object_class(ObjectClassHandle object_class);
  /// Without a region: the default region, that is everything. Who subscribes passively hears as much, but counts for no advisory.
  void subscribe_object_class_attributes(ObjectClassHandle object_class, AttributeSet attributes, RegionHandle region = {}, bool is_active = true);
  void unsubscribe_object_class(ObjectClassHandle object_class, RegionHandle region = {});
  void publish_interaction_class(InteractionClassHandle interaction_class);
  void unpublish_interaction_class(InteractionClassHandle interaction_class);
  void subscribe_interaction_class(InteractionClassHandle interaction_class, bool is_active = true);
  void unsubscribe_interaction_class(InteractionClassHandle interaction_class);

  /// Ownership management (clause 7). The privilege to delete an object is its attribute `privilege_to_delete_object`. The RTI decides and answers by callbacks;
  /// a federate loses an attribute by its own word only. Throws `RtiException`: ObjectInstanceNotKnown, AttributeNotDefined, AttributeNotOwned and those named.
  /// Tags have at most 1,024 bytes. Successive calls that differ in the object only travel as one block.
  void unconditional_attribute_ownership_divestiture(ObjectHandle object, AttributeSet attributes);
  /// Keeps them until somebody takes them, `request_divestiture_confirmation` says so and it is confirmed. AttributeAlreadyBeingDivested.
  void negotiated_attribute_ownership_divestiture(ObjectHandle object, AttributeSet attributes, Bytes tag = {});
  /// From now on they are not owned; should whoever wanted them have gone meanwhile, `attribute_ownership_kept` gives them back.
  /// AttributeDivestitureWasNotRequested, NoAcquisitionPending.
  void confirm_divestiture(ObjectHandle object, AttributeSet attributes, Bytes tag = {});
  void cancel_negotiated_attribute_ownership_divestiture(ObjectHandle object, AttributeSet attributes);  ///< AttributeDivestitureWasNotRequested
  void attribute_ownership_release_denied(ObjectHandle object, AttributeSet attributes);
  /// What the standard returns comes by `attribute_ownership_divested` and `attribute_ownership_kept`; until then they are not owned.
  void attribute_ownership_divestiture_if_wanted(ObjectHandle object, AttributeSet attributes);
  /// ObjectClassNotPublished, AttributeNotPublished, FederateOwnsAttributes; the second also AttributeAlreadyBeingAcquired.
  void attribute_ownership_acquisition(ObjectHandle object, AttributeSet attributes, Bytes tag = {});
  void attribute_ownership_acquisition_if_available(ObjectHandle object, AttributeSet attributes);
  /// Ends with the confirmation of the cancellation, or with the acquisition. AttributeAlreadyOwned, AttributeAcquisitionWasNotRequested.
  void cancel_attribute_ownership_acquisition(ObjectHandle object, AttributeSet attributes);
  /// Answered by `inform_attribute_ownership` or `attribute_is_not_owned`.
  void query_attribute_ownership(ObjectHandle object, AttributeHandle attribute);
  bool is_attribute_owned_by_federate(ObjectHandle object, AttributeHandle attribute);
  /// What becomes of its objects should it be lost (10.4); at first cancel_then_delete_then_divest.
  void set_automatic_resign_directive(ResignAction action);
  /// Resigns so. OwnershipAcquisitionPending, FederateOwnsAttributes if the action leaves any of these.
  void resign(ResignAction action);

  /// Object management. The handle is usable at once; empty after `object_block` registrations (rti/wire/message.h). A name that was not reserved is reserved by this; if it is not
  /// free, `object_instance_name_reservation_failed` tells so and the object goes by its default name. IllegalName, ObjectInstanceNameInUse if that is known here.
  ObjectHandle register_object_instance(ObjectClassHandle object_class, std::string_view name = {});
  void delete_object_instance(ObjectHandle object);
  /// As if it had never been discovered: it will be when it next comes into scope. FederateOwnsAttributes, OwnershipAcquisitionPending.
  void local_delete_object_instance(ObjectHandle object);
  /// Answered by `object_instance_name_reservation_succeeded` or `…_failed`, a set as one. IllegalName, NameSetWasEmpty; a release that is none throws ObjectInstanceNameNotReserved.
  void reserve_object_instance_name(std::string_view name);
  void reserve_multiple_object_instance_names(std::span<const std::string_view> names);
  void release_object_instance_name(std::string_view name) { release_multiple_object_instance_names(std::span(&name, 1)); }
  void release_multiple_object_instance_names(std::span<const std::string_view> names);
  /// Asks the owners for values: `provide_attribute_value_update`, with the tag of at most 1,024 bytes.
  void request_attribute_value_update(ObjectClassHandle object_class, AttributeSet attributes, Bytes tag = {});
  void request_attribute_value_update(ObjectHandle object, AttributeSet attributes, Bytes tag = {});
  /// Confirmed by a callback, as what is asked for is answered by one (6.23 to 6.30). AttributeNotOwned, InteractionClassNotPublished.
  void request_attribute_transportation_type_change(ObjectHandle object, AttributeSet attributes, Transportation transportation);
  void query_attribute_transportation_type(ObjectHandle object, AttributeHandle attribute);
  void request_interaction_transportation_type_change(InteractionClassHandle interaction_class, Transportation transportation);
  void query_interaction_transportation_type(FederateHandle federate, InteractionClassHandle interaction_class);
  /// `values` as in `reflect_attribute_values`. Successive updates of one class, set and stamp travel as one block.
  void update_attribute_values(ObjectHandle object, AttributeSet attributes, Bytes values, const Stamp& stamp);
  /// To all who subscribe to the class, never back to the sender. At most 32 KiB.
  void send_interaction(InteractionClassHandle interaction_class, Bytes parameters, const Stamp& stamp);
  /// The same to one federate only, if it subscribes.
  void send_directed_interaction(InteractionClassHandle interaction_class, FederateHandle receiver, Bytes parameters, const Stamp& stamp);

  /// Data distribution management (ambassador_regions.cpp); docs/rti.md, "Regions". What is set is local; a commit takes effect at the RTI's next match. The same region may serve
  /// subscriptions and updates; one that was never committed overlaps nothing. Without dimensions a region is over X and Y [m], needs no such dimensions in the model, and holds for
  /// whole objects; the services with `pairs` are the standard's: each attribute must have all dimensions of its regions. Empty if all `region_max` regions are in use.
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
  void unassociate_regions_for_updates(ObjectHandle object, std::span<const AttributeRegions> pairs);
  ObjectHandle register_object_instance_with_regions(ObjectClassHandle object_class, std::span<const AttributeRegions> pairs, std::string_view name = {});
  /// Adds to what is subscribed to already.
  void subscribe_object_class_attributes_with_regions(ObjectClassHandle object_class, std::span<const AttributeRegions> pairs, bool is_active = true);
  void unsubscribe_object_class_attributes_with_regions(ObjectClassHandle object_class, std::span<const AttributeRegions> pairs);
  void subscribe_interaction_class_with_regions(InteractionClassHandle interaction_class, std::span<const RegionHandle> regions, bool is_active = true);
  void unsubscribe_interaction_class_with_regions(InteractionClassHandle interaction_class, std::span<const RegionHandle> regions);
  /// To all who subscribe to the class without a region, or with one that overlaps one of these.
  void send_interaction_with_regions(InteractionClassHandle interaction_class, Bytes parameters, std::span<const RegionHandle> regions, const Stamp& stamp);
  /// Asks the owners of attributes whose regions overlap those of a pair, or that are of the default region, for an update: `provide_attribute_value_update`.
  void request_attribute_value_update_with_regions(ObjectClassHandle object_class, std::span<const AttributeRegions> pairs);

  /// Look-ups beyond those of the object model; NameNotFound. Federates are known from `watch_federates`, and oneself.
  FederateHandle get_federate_handle(std::string_view name) const;
  const std::string& get_federate_name(FederateHandle federate) const;
  /// Of objects that are known or own; ObjectInstanceNotKnown.
  ObjectHandle get_object_instance_handle(std::string_view name) const;
  std::string get_object_instance_name(ObjectHandle object) const;
  ObjectClassHandle get_known_object_class_handle(ObjectHandle object) const;

  /// Callbacks. In the evoked model the federate is told nothing until it asks; these tell it the oldest, or up to `count_max` in their order, and return whether more
  /// wait. In the immediate model they do nothing. Who lets more than `waiting_callbacks_max` bytes wait loses its connection. Throw CallNotAllowedFromWithinCallback.
  bool evoke_callback();
  bool evoke_multiple_callbacks(std::size_t count_max = ~std::size_t{0});
  /// From now on the federate is told nothing, in either model, until callbacks are enabled again: in the immediate model all at once, within this call.
  void disable_callbacks();
  void enable_callbacks();
  static constexpr std::size_t waiting_callbacks_max = 64u << 20;

  /// Time management: docs/rti.md. Every federate begins at logical time 0, neither regulating nor constrained. Refused by the errors that `FederateClock` names.
  void enable_time_regulation(double lookahead);
  void disable_time_regulation();
  void enable_time_constrained();
  void disable_time_constrained();
  void time_advance_request(LogicalTime time) { request_advance(AdvanceKind::time_advance, time); }
  void time_advance_request_available(LogicalTime time) { request_advance(AdvanceKind::time_advance_available, time); }
  void next_message_request(LogicalTime time) { request_advance(AdvanceKind::next_message, time); }
  void next_message_request_available(LogicalTime time) { request_advance(AdvanceKind::next_message_available, time); }
  void flush_queue_request(LogicalTime time) { request_advance(AdvanceKind::flush_queue, time); }
  void modify_lookahead(double lookahead);
  /// While granted, a constrained federate gets messages in receive order only if this is on; else they wait for its next request.
  void enable_asynchronous_delivery() { clock_.ask_asynchronous(true); }
  void disable_asynchronous_delivery() { clock_.ask_asynchronous(false); }
  LogicalTime query_logical_time() const { return LogicalTime(clock_.time()); }
  double query_lookahead() const { return clock_.lookahead(); }
  /// Asks the RTI for GALT and LITS; `time_bounds` answers.
  void query_time_bounds();
  const FederateClock& clock() const { return clock_; }
  /// The same as the services without a time, but in time-stamp order where that is what the object model or `change_..._order_type` says and the federate regulates: only then
  /// is there a handle. What of an update goes in receive order goes at once, stamped with that time.
  RetractionHandle update_attribute_values(ObjectHandle object, AttributeSet attributes, Bytes values, LogicalTime time, std::uint64_t tag = 0);
  RetractionHandle send_interaction(InteractionClassHandle interaction_class, Bytes parameters, LogicalTime time, std::uint64_t tag = 0);
  RetractionHandle send_directed_interaction(InteractionClassHandle interaction_class, FederateHandle receiver, Bytes parameters, LogicalTime time, std::uint64_t tag = 0);
  RetractionHandle delete_object_instance(ObjectHandle object, LogicalTime time, std::uint64_t tag = 0);
  /// Takes back what was sent in time-stamp order. A deletion that is taken back gives the object back.
  void retract(const RetractionHandle& handle);
  void change_attribute_order_type(ObjectHandle object, AttributeSet attributes, Order order);
  void change_interaction_order_type(InteractionClassHandle interaction_class, Order order);

  /// Bytes from the RTI, cut anywhere. False after a protocol error, which `connection_lost` has explained: close the connection.
  bool receive(Bytes bytes);
  /// A datagram of the RTI, whole; in any order, doubled or not at all. One that makes no sense is counted and otherwise ignored.
  void receive_datagram(Bytes datagram);
  /// There is a way for datagrams: from now on the order of frames matters too, for an older datagram may come after them.
  void expect_datagrams() { has_datagrams_ = true; }
  /// The datagram that must go to the RTI, if not empty, and that it has gone. `clear_outgoing` says no word of it.
  Bytes outgoing_datagram() const { return outgoing_datagram_; }
  void clear_outgoing_datagram();
  /// What must go to the RTI, and that it has gone.
  Bytes outgoing() const { return outgoing_.bytes(); }
  void clear_outgoing();
  /// `now` [s] never decreases; the origin is free. Says that we live when idle, notices a silent RTI.
  void advance_clock(double now);
  /// The connection is gone: `connection_lost` follows unless the federate resigned or was refused.
  void disconnected(std::string_view why);

  const AmbassadorCounters& counters() const { return counters_; }
  /// Of buffers and tables, the ambassador itself not counted.
  std::size_t memory_bytes() const;

 private:
  friend AdvisorySwitches<Ambassador>;
  enum class Phase : std::uint8_t { idle, joining, joined, ended };
  /// Appends a message; the block of updates that grows at the end is over. Throws FederateNotExecutionMember.
  template <class Message>
  void say(Message message);
  template <class Message>
  void append(Message& message);
  [[noreturn]] void refuse_stranger() const;
  bool is_ours(ObjectHandle object) const { return object.value / object_block == object_block_; }
  KnownObject* find(ObjectHandle object);
  void forget(ObjectHandle object);
  bool is_gone(ObjectHandle object) const;
  bool settle_gone(ObjectHandle object);
  void withdraw_publication(ObjectClassHandle object_class, AttributeSet attributes, bool is_all);
  bool take_frame(Bytes frame);
  bool take_message(Reader& reader);
  bool take_membership(Reader& reader, std::uint8_t kind);
  // Federation management (ambassador_management.cpp).
  template <class Message>
  void ask(Message message);
  bool take_synchronization(Reader& reader, MessageKind kind);
  bool take_host_answer(Reader& reader, MessageKind kind);
  bool take_execution(Reader& reader);
  bool take_report(Reader& reader, MessageKind kind);
  bool take_federate(Reader& reader, std::uint8_t kind);
  bool take_digest(Reader& reader);
  bool take_provide_update(Reader& reader);
  // Objects beyond updates (ambassador_objects.cpp).
  void ask_names(std::uint8_t word, std::span<const std::string_view> names);
  bool take_names(Reader& reader);
  bool take_transportation(Reader& reader);
  bool take_object(Reader& reader, std::uint8_t kind);
  bool take_scope(Reader& reader, std::uint8_t kind);
  bool take_stamp(Reader& reader);
  bool take_updates(Reader& reader);
  bool take_interaction(Reader& reader);
  void associate_regions(ObjectHandle object, std::span<const AttributeRegions> pairs, bool is_added);
  void subscribe_with_regions(ObjectClassHandle object_class, std::span<const AttributeRegions> pairs, RegionAction action);
  void say_regional_class(ObjectClassHandle object_class, std::span<const AttributeRegions> pairs, RegionAction action);
  void subscribe_with_regions(InteractionClassHandle interaction_class, std::span<const RegionHandle> regions, Listening listening);
  void write_numbers(std::span<const RegionHandle> regions);
  template <class Tell>
  void for_each_message(std::span<const AttributeRegions> pairs, Tell tell);
  ObjectClassHandle own_class(ObjectHandle object);
  using FomLookup::check;
  void check(ObjectClassHandle object_class, std::span<const AttributeRegions> pairs) const;
  void check(InteractionClassHandle interaction_class, std::span<const RegionHandle> regions) const;
  // Periodic state (ambassador_baselines.cpp).
  enum class DeltaOutcome : std::uint8_t { decoded, no_baseline, malformed };
  bool take_keyframe(Reader& reader);
  void end_keyframe();
  bool take_deltas(Reader& reader);
  DeltaOutcome take_periodic(BitReader& bits, const QuantisedCodec& codec, const DeltaHeader& header, std::uint32_t object, const Stamp& stamp);
  // Ownership (ambassador_ownership.cpp).
  AttributeSet all_of(const KnownObject& known) const;
  template <class Visit>
  void for_each_known(Visit visit);
  KnownObject& known_or_throw(ObjectHandle object, AttributeSet attributes);
  AttributeSet owned_of(ObjectHandle object, const KnownObject& known) const;
  Holding& holding_of(ObjectHandle object, const KnownObject& known);
  void settle_holding(ObjectHandle object, KnownObject& known);
  void check_update(ObjectHandle object, AttributeSet attributes);
  AttributeSet require_owned(ObjectHandle object, AttributeSet attributes);       ///< returns what is offered
  AttributeSet require_acquirable(ObjectHandle object, AttributeSet attributes);  ///< returns what is being acquired
  void ask_ownership(OwnershipRequest request, ObjectHandle object, AttributeSet attributes, Bytes tag);
  void give_up(OwnershipRequest request, ObjectHandle object, AttributeSet attributes, Bytes tag);
  void say_directive(ResignAction action);
  bool take_ownership(Reader& reader, std::uint8_t kind);
  void take_notice(ObjectHandle object, KnownObject& known, OwnershipNotice notice, AttributeSet attributes, Bytes tag);
  void call_back(ObjectHandle object, OwnershipNotice notice, AttributeSet attributes, Bytes tag);
  /// Says the header of `object`, in one block with those before it if they had the same.
  template <class Header>
  void say_of(Header header, ObjectHandle object);
  void lose(std::string_view why);
  bool hold(Bytes bytes);
  bool take_bytes(Bytes bytes);

  // Datagrams (ambassador_datagrams.cpp).
  bool take_datagram(const DatagramHead& head, Reader& reader);
  bool take_datagram_updates(const DatagramHead& head, Reader& reader);
  void apply_datagram(Bytes datagram);
  void apply_held_datagrams();
  void acknowledge_datagrams();

  // Declarations (ambassador_declarations.cpp).
  void require_class(ObjectClassHandle object_class, AttributeSet attributes) const;
  void require_class(InteractionClassHandle interaction_class) const;
  void require_published(InteractionClassHandle interaction_class) const;
  static void require_name(std::string_view name);
  void declare_publication(InteractionClassHandle interaction_class, bool is_published);
  void declare_subscription(InteractionClassHandle interaction_class, Listening listening);
  void switch_advisory(Advisory advisory, bool is_on);
  void advise(ObjectClassHandle object_class);
  void advise(InteractionClassHandle interaction_class);
  bool take_class_relevance(Reader& reader);
  bool take_object_relevance(Reader& reader);
  bool may_spare() const;
  bool spares_interaction(InteractionClassHandle interaction_class);
  bool spare(ObjectHandle object, const KnownObject& known, AttributeSet attributes, Bytes values, const Stamp& stamp);
  void release_spared(ObjectClassHandle object_class, AttributeSet heard);
  void release_spared(ObjectHandle object);
  void say_update(ObjectHandle object, ObjectClassHandle object_class, AttributeSet attributes, Bytes values, const Stamp& stamp);
  void begin_updates(ObjectClassHandle object_class, AttributeSet attributes, const Stamp& stamp);

  // Time management (ambassador_time.cpp).
  void request_advance(AdvanceKind kind, LogicalTime time);
  AttributeSet timestamped(ObjectHandle object, ObjectClassHandle object_class) const;
  RetractionHandle say_timed(LogicalTime time, std::uint64_t tag, Bytes content);
  bool take_time(Reader& reader, std::uint8_t kind);
  bool take_timed(Reader& reader);
  bool postpone(Reader& reader, MessageKind kind);
  bool release_postponed();

  std::unique_ptr<CallbackQueue> queue_;  ///< null in the immediate model, which pays nothing for it
  FederateAmbassador& callbacks_;         ///< the federate, or the queue before it
  bool are_callbacks_enabled_ = true;
  std::vector<std::byte> held_;           ///< what came while callbacks were disabled in the immediate model
  std::string held_loss_;                 ///< and why the connection was lost
  Patience patience_;
  Phase phase_ = Phase::idle;
  FederateHandle federate_;
  std::uint32_t object_block_ = 0, objects_registered_ = 0;
  std::vector<KnownObject> own_;    ///< registered here, by number within our block
  ObjectMap<KnownObject> known_;    ///< of others: few of many, so memory follows what is in sight
  std::vector<GoneObject> gone_;    ///< of others, that the RTI may still tell of
  NameBook names_;
  RegionBook regions_;
  std::vector<Range> ranges_;
  std::string fom_difference_;  ///< from the federation's model, if the RTI told
  std::vector<std::byte> region_records_;
  std::vector<std::pair<FederateHandle, std::string>> federates_;  ///< that we were told of, and ourselves first
  std::vector<std::string> announced_points_;  ///< synchronisation points that we have not achieved yet
  std::vector<FederationExecutionInformation> executions_;  ///< of the list that is being told
  std::vector<FederationReport> reports_;      ///< likewise
  bool has_asked_ = false;                     ///< the host, before the join
  ObjectMap<Holding> holdings_;     ///< of objects owned in part or negotiated about
  DeclaredState declared_;
  ObjectBlockWriter object_block_writer_;  ///< the block of objects at the end of `outgoing_`, if any
  FrameWriter outgoing_;
  FrameReader incoming_;
  OpenUpdates open_;  ///< that still grow at the end of `outgoing_`, if any
  Stamp said_stamp_;                   ///< the last one said
  std::uint64_t stamped_frame_ = 0;    ///< the frame in which it was said: a stamp is good for its frame
  std::optional<Stamp> heard_stamp_;   ///< of the frame being read
  std::vector<std::byte> coded_, decoded_;
  KeyframeMemory keyframes_;

  // Datagrams.
  ArrivalOrder arrivals_;
  DatagramReceipts receipts_;
  std::vector<std::vector<std::byte>> held_datagrams_;  ///< came before the frames that they follow
  std::vector<std::byte> outgoing_datagram_, cut_values_;
  std::uint32_t frames_heard_ = 0;                     ///< from the one that let us in
  bool has_datagrams_ = false;                         ///< one may come
  double receipts_due_since_ = 0.0;

  double now_ = 0.0, last_heard_ = 0.0, last_said_ = 0.0;
  bool has_clock_ = false, has_said_ = false, has_heard_ = false;
  AmbassadorCounters counters_;

  FederateClock clock_;
  const TimedStamp* timed_ = nullptr;     ///< of the message being read, if it was sent in time-stamp order
  std::vector<std::byte> postponed_, content_; ///< messages in receive order that wait for the next request; the message inside one that goes in time-stamp order
  std::unordered_map<std::uint32_t, AttributeSet> order_changes_;  ///< objects whose attributes go in another order than the model says: those in time-stamp order
  std::vector<Order> interaction_orders_;                              ///< by class, once one differs from the model
  std::vector<TimedDeletion> deletions_;       ///< in time-stamp order, as long as they can be taken back
};

}  // namespace rink::rti
