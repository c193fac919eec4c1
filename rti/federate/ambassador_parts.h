// What an ambassador is made of; for its own sources only.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "rti/ambassador_counters.h"
#include "rti/distribution/region_book.h"
#include "rti/federate/advisory_switches.h"
#include "rti/federate/ambassador_basis.h"
#include "rti/federate/delivery/callback_gate.h"
#include "rti/federate/delivery/keyframe_reader.h"
#include "rti/federate/delivery/link_watch.h"
#include "rti/federate/delivery/update_receiver.h"
#include "rti/federate/read_context.h"
#include "rti/federate/services/federate_synchronization.h"
#include "rti/federate/services/host_questions.h"
#include "rti/federate/services/instance_names.h"
#include "rti/federate/services/join_session.h"
#include "rti/federate/services/object_book.h"
#include "rti/federate_ambassador.h"
#include "rti/fom/fom_lookup.h"
#include "rti/hla_error.h"
#include "rti/objects/declared_state.h"
#include "rti/objects/known_object.h"
#include "rti/objects/object_map.h"
#include "rti/time/federate_clock.h"
#include "rti/types.h"
#include "rti/wire/frame.h"
#include "rti/wire/message.h"
#include "rti/wire/ownership_messages.h"
#include "rti/wire/stream.h"

namespace rink::rti {

class BestEffortOutbox;

/// The data of an ambassador, and all of its functions that are no services.
class AmbassadorParts : public FomLookup {
 public:
  static constexpr std::size_t waiting_callbacks_max = CallbackGate::waiting_max;

 protected:
  AmbassadorParts(const Fom& fom, FederateAmbassador& callbacks, const Patience& patience,
                  CallbackModel model);
  ~AmbassadorParts();

  bool take_further_block(Reader& reader);
  void forget(ObjectHandle object);
  void withdraw_publication(ObjectClassHandle object_class, AttributeSet attributes, bool is_all);
  bool take_frame(Bytes frame);
  bool take_message(Reader& reader, ReadContext& context);
  bool take_joined_message(Reader& reader, MessageKind name, ReadContext& context);
  bool take_joined(Reader& reader);
  bool take_expulsion(Reader& reader);
  bool take_provide_update(Reader& reader);
  // Objects beyond updates (ambassador_objects.cpp).
  bool take_transportation(Reader& reader);
  bool take_object(Reader& reader, std::uint8_t kind, const ReadContext& context);
  bool take_scope(Reader& reader, std::uint8_t kind);
  bool take_interaction(Reader& reader, const ReadContext& context);
  void associate_regions(ObjectHandle object, std::span<const AttributeRegions> pairs,
                         bool is_added);
  void subscribe_with_regions(ObjectClassHandle object_class,
                              std::span<const AttributeRegions> pairs, RegionAction action);
  void say_regional_class(ObjectClassHandle object_class, std::span<const AttributeRegions> pairs,
                          RegionAction action);
  void subscribe_with_regions(InteractionClassHandle interaction_class,
                              std::span<const RegionHandle> regions, Listening listening);
  void write_numbers(std::span<const RegionHandle> regions);
  template <class Tell>
  void for_each_message(std::span<const AttributeRegions> pairs, Tell tell);
  ObjectClassHandle own_class(ObjectHandle object);
  using FomLookup::check;
  void check(ObjectClassHandle object_class, std::span<const AttributeRegions> pairs) const;
  void check(InteractionClassHandle interaction_class, std::span<const RegionHandle> regions) const;
  // Ownership (ambassador_ownership.cpp).
  AttributeSet all_of(const KnownObject& known) const;
  const KnownObject& known_or_throw(ObjectHandle object, AttributeSet attributes);
  AttributeSet owned_of(ObjectHandle object, const KnownObject& known) const;
  Holding& holding_of(ObjectHandle object, const KnownObject& known);
  void settle_holding(ObjectHandle object, const KnownObject& known);
  void check_update(ObjectHandle object, AttributeSet attributes);
  static void require_parameters(Bytes parameters);
  static void require_stamp(const Stamp& stamp);
  void require_values(ObjectClassHandle object_class, AttributeSet attributes, Bytes values) const;
  AttributeSet require_owned(ObjectHandle object,
                             AttributeSet attributes);  ///< returns what is offered
  AttributeSet require_acquirable(ObjectHandle object,
                                  AttributeSet attributes);  ///< returns what is being acquired
  void ask_ownership(OwnershipRequest request, ObjectHandle object, AttributeSet attributes,
                     Bytes tag);
  void give_up(OwnershipRequest request, ObjectHandle object, AttributeSet attributes, Bytes tag);
  void say_directive(ResignAction action);
  bool take_ownership(Reader& reader, std::uint8_t kind);
  void take_notice(ObjectHandle object, const KnownObject& known, OwnershipNotice notice,
                   AttributeSet attributes, Bytes tag);
  void call_back(ObjectHandle object, OwnershipNotice notice, AttributeSet attributes, Bytes tag);
  void lose(std::string_view why);
  bool take_bytes(Bytes bytes);

  // Datagrams (ambassador_datagrams.cpp).
  bool take_datagram(const DatagramHead& head, Reader& reader);
  void apply_datagram(Bytes datagram);
  void apply_held_datagrams();
  void acknowledge_datagrams();
  // One's own (ambassador_best_effort.cpp).
  AttributeSet by_datagram(ObjectHandle object, ObjectClassHandle object_class) const;
  AttributeSet say_best_effort(ObjectHandle object, ObjectClassHandle object_class,
                               AttributeSet attributes, Bytes& values, const Stamp& stamp);
  void before_stream(ObjectHandle object, ObjectClassHandle object_class, AttributeSet attributes);
  void release_best_effort();
  void release_best_effort(ObjectClassHandle object_class);
  void release_best_effort(ObjectHandle object, AttributeSet attributes);
  void repair_best_effort();

  // Declarations (ambassador_declarations.cpp).
  void require_class(ObjectClassHandle object_class, AttributeSet attributes) const;
  void require_class(InteractionClassHandle interaction_class) const;
  void require_published(InteractionClassHandle interaction_class) const;
  void declare_publication(InteractionClassHandle interaction_class, bool is_published);
  void declare_subscription(InteractionClassHandle interaction_class, Listening listening);
  void switch_advisory(Advisory advisory, bool is_on);
  void advise(ObjectClassHandle object_class);
  void advise(InteractionClassHandle interaction_class);
  bool take_class_relevance(Reader& reader);
  bool take_object_relevance(Reader& reader);
  bool may_spare() const;
  bool spares_interaction(InteractionClassHandle interaction_class);
  bool spare(ObjectHandle object, const KnownObject& known, AttributeSet attributes, Bytes values,
             const Stamp& stamp);
  void release_spared(ObjectClassHandle object_class, AttributeSet heard);
  void release_spared(ObjectHandle object);
  void say_update(ObjectHandle object, ObjectClassHandle object_class, AttributeSet attributes,
                  Bytes values, const Stamp& stamp);

  // Time management (ambassador_time.cpp).
  void request_advance(AdvanceKind kind, LogicalTime time);
  AttributeSet timestamped(ObjectHandle object, ObjectClassHandle object_class) const;
  RetractionHandle say_timed(LogicalTime time, std::uint64_t tag, Bytes content);
  bool take_time(Reader& reader, std::uint8_t kind, const ReadContext& context);
  bool take_timed(Reader& reader, const ReadContext& context);
  bool postpone(Reader& reader, MessageKind kind, const ReadContext& context);
  bool release_postponed();

  CallbackGate gate_;
  FederateAmbassador& callbacks_;  ///< the federate, or the queue before it
  JoinPhase phase_;
  FrameOutbox frames_{phase_};
  AmbassadorCounters counters_;
  AmbassadorBasis basis_;
  LinkWatch watch_;
  ObjectBook objects_;
  InstanceNames names_;
  FederateSynchronization synchronization_;
  HostQuestions questions_;
  JoinSession session_;
  RegionBook regions_;
  std::vector<Range> ranges_;
  std::vector<std::byte> region_records_;
  ObjectMap<Holding> holdings_;  ///< of objects owned in part or negotiated about
  DeclaredState declared_;
  FrameReader incoming_;
  std::vector<std::byte> coded_;

  // Datagrams.
  Arrivals arrivals_;
  UpdateReceiver update_receiver_;
  KeyframeReader keyframe_reader_;
  DatagramReceipts receipts_;
  std::vector<std::vector<std::byte>> held_datagrams_;  ///< came before the frames that they follow
  std::vector<std::byte> acknowledgement_, cut_values_, best_effort_values_;
  std::vector<Datagram> datagrams_;  ///< that go out
  std::unique_ptr<BestEffortOutbox>
      outbox_;  ///< null until there is a way and something to send by it
  ObjectMap<AttributeSet> made_reliable_;  ///< of objects of ours
  bool is_timed_ = false;                  ///< it has used time management
  double receipts_due_since_ = 0.0;

  FederateClock clock_;
  std::vector<std::byte> postponed_,
      content_;  ///< messages in receive order that wait for the next request; the message inside
                 ///< one that goes in time-stamp order
  std::unordered_map<std::uint32_t, AttributeSet>
      order_changes_;  ///< objects whose attributes go in another order than the model says: those
                       ///< in time-stamp order
  std::vector<Order> interaction_orders_;  ///< by class, once one differs from the model
  std::vector<TimedDeletion>
      deletions_;  ///< in time-stamp order, as long as they can be taken back
};

}  // namespace rink::rti
