// The parts of an ambassador; for its own sources only.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "rti/federate/ambassador_ground.h"
#include "rti/federate/delivery/datagram_receiver.h"
#include "rti/federate/delivery/entry_reader.h"
#include "rti/federate/delivery/keyframe_reader.h"
#include "rti/federate/delivery/update_receiver.h"
#include "rti/federate/services/federate_ownership.h"
#include "rti/federate/services/federate_regions.h"
#include "rti/federate/services/federate_saves.h"
#include "rti/federate/services/federate_synchronization.h"
#include "rti/federate/services/federate_time.h"
#include "rti/federate/services/federate_transportation.h"
#include "rti/federate/services/host_questions.h"
#include "rti/federate/services/join_session.h"
#include "rti/fom/fom_lookup.h"

namespace rink::rti {

/// Owns the services, each of which sees only those above it, and does what concerns several of
/// them in a stated order: joining, losing the connection, and reading messages.
class AmbassadorParts final {
 public:
  AmbassadorParts(const Fom& fom, FederateAmbassador& callbacks, const Timeouts& timeouts,
                  CallbackModel model);

  void join(std::string_view federation, std::string_view federate_name,
            std::string_view federate_type);
  void resign(ResignAction action);
  bool receive(Bytes bytes);
  void receive_datagram(Bytes datagram);
  void expect_datagrams(std::size_t size_max);
  std::span<const Datagram> outgoing_datagrams();
  void clear_outgoing_datagrams();
  void clear_outgoing();
  void advance_clock(double now, bool is_behind);
  void enable_callbacks();
  void disable_callbacks();
  void lose(std::string_view why);
  /// Memory of the parts without this object itself [bytes].
  std::size_t memory_bytes() const;

  // Messages that concern several services.
  bool handle_joined(Reader& reader);
  bool handle_expelled(Reader& reader);
  bool handle_timed(Reader& reader, const ReadContext& context);
  bool handle_entries(Reader& reader, const ReadContext& context, bool is_again);

  AmbassadorGround ground;
  FomLookup lookup;
  UpdateSender sender;
  Sparing sparing;
  FederateUpdates updates;
  FederateOwnership owners;
  FederateDeclarations declarations;
  InstanceNames names;
  FederateObjects objects;
  FederateTransportation transportation;
  FederateRegions regions;
  FederateTime time;
  FederateSynchronization synchronization;
  HostQuestions questions;
  JoinSession session;
  FederateSaves saves;
  UpdateReceiver update_receiver;
  KeyframeReader keyframes;
  DatagramReceiver datagrams;

 private:
  bool handle_bytes(Bytes bytes);
  bool handle_frame(Bytes frame);
  bool handle_message(Reader& reader, ReadContext& context);
  /// Passes a message whose kind was read to its service (federate_message_table.cpp). False if it
  /// is malformed or not allowed now.
  bool dispatch(MessageKind kind, Reader& reader, ReadContext& context);
  bool postpone(Reader& reader, MessageKind kind, const ReadContext& context);
  bool release_postponed();
  void lose_if_overfull();

  /// True if messages in receive order wait now.
  bool is_postponing(const ReadContext& context) const {
    return time.clock().holds_receive_order() && context.timed == nullptr;
  }

  EntryReader entries_;
};

}  // namespace rink::rti
