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
#include "rti/baselines/keyframe_memory.h"
#include "rti/callbacks/callback_queue.h"
#include "rti/distribution/region_book.h"
#include "rti/federate/advisory_switches.h"
#include "rti/federate/delivery/frame_outbox.h"
#include "rti/federate/join_phase.h"
#include "rti/federate/read_context.h"
#include "rti/federate_ambassador.h"
#include "rti/fom/fom_lookup.h"
#include "rti/fom/quantised_codec.h"
#include "rti/hla_error.h"
#include "rti/objects/arrival_order.h"
#include "rti/objects/declared_state.h"
#include "rti/objects/known_object.h"
#include "rti/objects/name_book.h"
#include "rti/objects/object_map.h"
#include "rti/time/federate_clock.h"
#include "rti/types.h"
#include "rti/wire/bit_stream.h"
#include "rti/wire/frame.h"
#include "rti/wire/message.h"
#include "rti/wire/ownership_messages.h"
#include "rti/wire/stream.h"

namespace rink::rti {

class BestEffortOutbox;
struct DeltaHeader;

/// The data of an ambassador, and all of its functions that are no services.
class AmbassadorParts : public FomLookup {
 public:
  static constexpr std::size_t waiting_callbacks_max =
      64u << 20;  ///< of callbacks that wait to be evoked, or of what they would be made of [bytes]

 protected:
  AmbassadorParts(const Fom& fom, FederateAmbassador& callbacks, const Patience& patience,
                  CallbackModel model);
  ~AmbassadorParts();

  bool is_ours(ObjectHandle object) const { return object.value / object_block == object_block_; }
  /// In a block of ours that is used up: what is left of it is among `known_`, as what was acquired
  /// from others.
  bool was_ours(ObjectHandle object) const;
  void begin_further_block();
  bool take_further_block(Reader& reader);
  KnownObject* find(ObjectHandle object);
  void forget(ObjectHandle object);
  bool is_gone(ObjectHandle object) const;
  bool settle_gone(ObjectHandle object);
  void withdraw_publication(ObjectClassHandle object_class, AttributeSet attributes, bool is_all);
  bool take_frame(Bytes frame);
  bool take_message(Reader& reader, ReadContext& context);
  bool take_membership(Reader& reader, std::uint8_t kind);
  // Federation management (ambassador_management.cpp).
  template <class Message>
  void ask(Message message);
  bool take_synchronization(Reader& reader, MessageKind kind);
  bool take_host_answer(Reader& reader, MessageKind kind);
  bool take_execution(Reader& reader);
  bool take_report(Reader& reader, MessageKind kind);
  bool take_federate(Reader& reader, std::uint8_t kind);
  bool take_expulsion(Reader& reader);
  bool take_digest(Reader& reader);
  bool take_provide_update(Reader& reader);
  // Objects beyond updates (ambassador_objects.cpp).
  void ask_names(std::uint8_t word, std::span<const std::string_view> names);
  bool take_names(Reader& reader);
  bool take_transportation(Reader& reader);
  bool take_object(Reader& reader, std::uint8_t kind, const ReadContext& context);
  bool take_scope(Reader& reader, std::uint8_t kind);
  bool take_stamp(Reader& reader, ReadContext& context);
  bool take_updates(Reader& reader, const ReadContext& context);
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
  // Periodic state (ambassador_baselines.cpp).
  enum class DeltaOutcome : std::uint8_t { decoded, no_baseline, malformed };
  bool take_keyframe(Reader& reader);
  void end_keyframe();
  bool take_deltas(Reader& reader, const ReadContext& context);
  DeltaOutcome take_periodic(BitReader& bits, const QuantisedCodec& codec,
                             const DeltaHeader& header, std::uint32_t object, const Stamp& stamp);
  // Ownership (ambassador_ownership.cpp).
  AttributeSet all_of(const KnownObject& known) const;
  template <class Visit>
  void for_each_known(Visit visit);
  KnownObject& known_or_throw(ObjectHandle object, AttributeSet attributes);
  AttributeSet owned_of(ObjectHandle object, const KnownObject& known) const;
  Holding& holding_of(ObjectHandle object, const KnownObject& known);
  void settle_holding(ObjectHandle object, KnownObject& known);
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
  void take_notice(ObjectHandle object, KnownObject& known, OwnershipNotice notice,
                   AttributeSet attributes, Bytes tag);
  void call_back(ObjectHandle object, OwnershipNotice notice, AttributeSet attributes, Bytes tag);
  void lose(std::string_view why);
  bool hold(Bytes bytes);
  bool take_bytes(Bytes bytes);

  // Datagrams (ambassador_datagrams.cpp).
  bool take_datagram(const DatagramHead& head, Reader& reader);
  bool take_datagram_updates(const DatagramHead& head, Reader& reader, const ReadContext& context);
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

  std::unique_ptr<CallbackQueue>
      queue_;                      ///< null in the immediate model, which pays nothing for it
  FederateAmbassador& callbacks_;  ///< the federate, or the queue before it
  bool are_callbacks_enabled_ = true;
  std::vector<std::byte> held_;  ///< what came while callbacks were disabled in the immediate model
  std::string held_loss_;        ///< and why the connection was lost
  Patience patience_;
  JoinPhase phase_;
  FrameOutbox frames_{phase_};
  std::uint32_t object_block_ = 0, objects_registered_ = 0;  ///< in that block
  std::optional<std::uint32_t> further_block_;               ///< for when it is used up
  std::vector<std::uint32_t> former_blocks_;
  std::vector<KnownObject> own_;  ///< registered here, by number within our block
  ObjectMap<KnownObject> known_;  ///< of others: few of many, so memory follows what is in sight
  std::vector<GoneObject> gone_;  ///< of others, that the RTI may still tell of
  NameBook names_;
  RegionBook regions_;
  std::vector<Range> ranges_;
  std::string fom_difference_;  ///< from the federation's model, if the RTI told
  std::vector<std::byte> region_records_;
  std::vector<std::pair<FederateHandle, std::string>>
      federates_;  ///< that we were told of, and ourselves first
  std::vector<std::string>
      announced_points_;  ///< synchronisation points that we have not achieved yet
  std::vector<FederationExecutionInformation> executions_;  ///< of the list that is being told
  std::vector<FederationReport> reports_;                   ///< likewise
  bool has_asked_ = false;                                  ///< the host, before the join
  ObjectMap<Holding> holdings_;  ///< of objects owned in part or negotiated about
  DeclaredState declared_;
  FrameReader incoming_;
  std::vector<std::byte> coded_, decoded_;
  KeyframeMemory keyframes_;

  // Datagrams.
  ArrivalOrder arrivals_;
  DatagramReceipts receipts_;
  std::vector<std::vector<std::byte>> held_datagrams_;  ///< came before the frames that they follow
  std::vector<std::byte> acknowledgement_, cut_values_, best_effort_values_;
  std::vector<std::byte> heard_values_;  ///< of the datagram whose callback runs: apart from those
                                         ///< above, for a callback may send
  std::vector<Datagram> datagrams_;      ///< that go out
  std::unique_ptr<BestEffortOutbox>
      outbox_;  ///< null until there is a way and something to send by it
  ObjectMap<AttributeSet> made_reliable_;  ///< of objects of ours
  bool is_timed_ = false;                  ///< it has used time management
  std::uint32_t frames_heard_ = 0;         ///< from the one that let us in
  bool has_datagrams_ = false;             ///< one may come
  double receipts_due_since_ = 0.0;

  double now_ = 0.0, last_heard_ = 0.0, last_said_ = 0.0;
  bool has_clock_ = false, has_said_ = false, has_heard_ = false;
  AmbassadorCounters counters_;

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
